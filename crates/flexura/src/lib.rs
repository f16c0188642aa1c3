//! Large-deflection compliant mechanisms.
//!
//! A mechanism is made of flexible **beams** (geometrically exact: any bending, twist and stretch), rigid
//! **bodies**, **joints** and **springs**, under **loads**. It is described by an inert [`model::Model`],
//! solved into a [`solution::Solution`], judged by [`post`] and written out by [`output`]. All numbers are
//! in SI units and radians.
//!
//! # From a model file
//!
//! ```
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let solved = flexura::solve_file("models/cantilever_strip.toml", &[], &flexura::Options::default())?;
//! assert_eq!(solved.solution.status, flexura::solution::Status::Converged);
//! let x_over_length = solved.number("x_over_length").expect("the file asks for this output");
//! assert!((x_over_length - 0.841_075_234).abs() < 1e-7);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Parameters are overridden by name; a value may carry a unit, as in the file:
//!
//! ```
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let overrides = [("payload".to_owned(), "20 g".to_owned())];
//! let solved = flexura::solve_file("models/cantilever_strip.toml", &overrides, &flexura::Options::default())?;
//! let sag = solved.number("z_over_length").expect("the file asks for this output");
//! assert!(sag < 0.0 && sag > -0.491);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # From Rust
//!
//! The same model, built piece by piece. Things refer to each other by typed ids, which are their
//! positions in the model's lists.
//!
//! ```
//! use flexura::model::*;
//! use flexura::spatial::Vector3;
//!
//! let mut model = Model { name: "cantilever".into(), ..Model::default() };
//! model.sections.push(Section {
//!     name: "rod".into(),
//!     shape: Shape::Stiffness {
//!         ea: f64::INFINITY.into(),
//!         gj: 1.0.into(),
//!         ei2: 1.0.into(),
//!         ei3: 1.0.into(),
//!         ga2: None,
//!         ga3: None,
//!         mass_per_length: None,
//!         rotary_inertia: None,
//!     },
//!     plane_strain: false,
//! });
//! model.beams.push(Beam {
//!     name: "rod".into(),
//!     material: None,
//!     section: SectionId(0),
//!     curve: Curve::Straight { length: 1.0 },
//!     frame: SectionFrame::Natural,
//!     theory: BeamTheory { shear: false, extension: false },
//!     damping: 0.0,
//!     added_mass: 0.0,
//!     start: Some(End { mount: Mount::Ground, placement: None, hold: JointLaw::weld() }),
//!     end: None,
//!     distributed: Vec::new(),
//!     foundation: Vec::new(),
//! });
//! model.loads.push(Load {
//!     name: "tip".into(),
//!     target: LoadTarget::Beam(BeamPoint { beam: BeamId(0), at: At::Fraction(1.0) }),
//!     force: Vector3::new(0.0, 10.0, 0.0),
//!     moment: Vector3::zeros(),
//!     frame: LoadFrame::Global,
//! });
//!
//! let solution = flexura::solve(&model, &flexura::Options::default(), &mut |_| {})
//!     .map_err(|error| error.message)?;
//! let tip = solution.beams[0].samples.last().expect("every beam has samples");
//! // Mattiasson (1981): w/L = 0.81061, u/L = 0.55500 at P L²/EI = 10.
//! assert!((tip.pose.position.y - 0.81061).abs() < 1e-5);
//! assert!((1.0 - tip.pose.position.x - 0.55500).abs() < 1e-5);
//! # Ok::<(), String>(())
//! ```
//!
//! # Parameters
//!
//! A number may follow a formula of parameters, in a model that was read and in one that was built. [`model::Model::at`] makes the
//! model with other values, in microseconds; sweeps, paths, inverse problems and sensitivities do the same:
//!
//! ```
//! use flexura::{Options, modelfile::Document, modelfile::to_toml};
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let mut model = Document::read("models/elastica.toml")?.model(&[])?;
//! let reach = model.add_parameter("reach", 1.0, "m");
//! model.bind("beam.rod.length", "reach").map_err(|issue| issue.message)?;
//! let longer = model.at(&[(reach, 1.1)]).map_err(|issue| issue.message)?;
//! let solution = flexura::solve(&longer, &Options::default(), &mut |_| {})?;
//! assert!((solution.beams[0].length - 1.1).abs() < 1e-15);
//! assert!(to_toml(&longer).map_err(|issue| issue.message)?.contains("length = \"reach\""));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Many solves
//!
//! [`Prepared`] keeps everything that does not change between solves; a load is changed in place, and a solve can start
//! from the last solution:
//!
//! ```
//! use flexura::{Prepared, model::LoadId, spatial::Vector3};
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let model = flexura::modelfile::Document::read("models/elastica.toml")?.model(&[])?;
//! let mut prepared = Prepared::new(&model)?;
//! for i in 1..=10 {
//!     prepared.set_point_load(LoadId(0), Vector3::new(0.0, f64::from(i), 0.0), Vector3::zeros());
//!     let outcome = prepared.solve_from_here(1e-8, &mut |_| {});
//!     assert_eq!(outcome.status, flexura::solution::Status::Converged);
//! }
//! assert!((prepared.problem().tip().y - 0.81061).abs() < 1e-5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Whole grids over the parameters of a model are solved by a [`Sweep`], on all cores.
//!
//! # Paths of equilibria
//!
//! Equilibria are followed as one parameter changes, past folds and through branch points, and it is said where they are
//! stable:
//!
//! ```
//! use flexura::model::TraceStudy;
//! use flexura::solution::PointKind;
//! use flexura::{Options, modelfile::Document};
//! # std::env::set_current_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))?;
//! let file = Document::read("models/lee_frame.toml")?;
//! let model = file.model(&[])?;
//! let load = model.parameters.iter().position(|parameter| parameter.name == "load").expect("the file has it");
//! let study = TraceStudy { parameter: load, range: [-2.0, 2.5], start: 0.0, ..TraceStudy::default() };
//! let trace = flexura::trace(&model, &study, &Options::default(), &mut |_| {})?;
//! let folds = trace.branches[0].points.iter().filter(|point| point.kind == PointKind::Fold);
//! let loads: Vec<f64> = folds.map(|point| point.parameter).collect();
//! // Lee, Manuel and Rossow (1968).
//! assert!((loads[0] - 1.85567).abs() < 1e-5 && (loads[1] + 0.94144).abs() < 1e-5);
//!
//! let picture = flexura::output::diagram_svg(&flexura::output::TraceView::new(&model, &study, &trace));
//! assert!(picture.contains("unstable"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A file may hold such studies itself: [`trace_file`] follows one of them, [`buckle_file`] finds critical loads, [`modes_file`] natural modes,
//! [`inverse_dynamics_file`] moves a rigid mechanism in time.
//!
//! # Results
//!
//! Not converging is no error: [`solution::Status`] says how a study ended, and the solution holds how far
//! it came. [`post::evaluate`] gives stresses, safety factors and outputs; [`output::document`] the result
//! document; [`output::beams_csv`], [`output::model_vtp`] and [`output::shape_svg`] the files; [`report::page`] the page that shows a document.

#[cfg(feature = "design")]
mod design_file;
mod modes_file;
mod motion_file;
mod places;
mod solve_file;
mod stepper;
mod sweep;
mod trace_file;

#[cfg(feature = "design")]
pub use design_file::{Optimised, optimise_file};
#[cfg(feature = "design")]
pub use flexura_design::{DesignProgress, optimise};
pub use modes_file::{Vibrated, modes_file};
pub use motion_file::{Moved, inverse_dynamics_file, motion_view};
pub use places::place;
pub use stepper::Stepper;
pub use sweep::{Axis, Remake, Sample, SampleStatus, Sweep, remake};

pub use flexura_expression as expression;
/// Parameters from measurements, and formulas that repeat an answer.
pub use flexura_fitting as fitting;
pub use flexura_fitting::{fit, formula};
pub use flexura_geometry as geometry;
pub use flexura_model as model;
pub use flexura_modelfile as modelfile;
pub use flexura_output as output;
pub use flexura_post as post;
pub use flexura_raster as raster;
pub use flexura_report as report;
pub use flexura_solution as solution;
pub use flexura_spatial as spatial;
pub use flexura_study::{
    Census, Equilibrium, Evaluation, Evaluator, Family, Interrupt, Law, ModelFamily, MotionProgress, Options,
    Outcome, Prepared, ProblemError, Progress, SensitivityError, StateSpaceRequest, TraceProgress, buckle,
    buckle_family, check, equilibria, inverse_dynamics, inverse_dynamics_family, modes, modes_along, solve,
    solve_family, solve_model, state_space, trace, trace_family,
};
pub use solve_file::{Error, Solved, solve_file};
pub use trace_file::{Buckled, Traced, buckle_file, study_named, trace_file};
