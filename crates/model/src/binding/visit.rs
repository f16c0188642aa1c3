//! One walk over all numbers of a model, in a fixed order, each with its path in the words of the model file.
//!
//! Every struct is taken apart whole, so that a field which is added does not compile before it is visited.

use super::visit_joint::{joints, law};
use crate::{
    At, Attachment, Beam, Body, Cable, CableLaw, Coupling, Curve, Distributed, End, Foundation,
    FoundationLaw, Guide, Load, LoadTarget, Material, Model, Mount, Notch, NotchShape, Obstacle, PointMass,
    Profile, Section, SectionFrame, Shape, Spin, Spring, SpringLaw, Target, Tube, Tubes, Unknown, Wrap,
};
use flexura_expression::Function;
use flexura_spatial::{Pose, UnitQuaternion, Vector3};

/// Something in a model that may hang on parameters.
pub(crate) enum Item<'m> {
    Number(&'m mut f64),
    /// A unit vector.
    Direction(&'m mut Vector3<f64>),
    Rotation(&'m mut UnitQuaternion<f64>),
    Function(&'m mut Function),
}

/// A step on the way to an item.
#[derive(Clone, Copy)]
pub(crate) enum Step<'p> {
    /// `beam.link`: a list of the file, and a name in it.
    Named(&'static str, &'p str),
    /// A target, whose name is an expression in quotes.
    Quoted(&'static str, &'p str),
    Key(&'static str),
    /// An element of a list of numbers.
    Index(usize),
    /// An element of a list of tables, which has no index in the file where it is the only one.
    Table(usize, bool),
}

/// What a number is to the equations.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A force or moment of a point load.
    Load,
    /// What drives or loads a coordinate of a joint, or where its stiffness is relaxed.
    Drive,
    /// Anything else: shapes, places, stiffnesses, laws.
    Other,
}

/// What is done at each item.
pub(crate) trait Visit {
    /// What the next items are.
    fn part(&mut self, _: Part) {}

    fn enter(&mut self, step: Step<'_>);
    fn leave(&mut self);
    /// At the end of the steps.
    fn item(&mut self, item: Item<'_>);

    fn at(&mut self, step: Step<'_>, item: Item<'_>) {
        self.enter(step);
        self.item(item);
        self.leave();
    }

    fn within(&mut self, step: Step<'_>, inner: impl FnOnce(&mut Self))
    where
        Self: Sized,
    {
        self.enter(step);
        inner(self);
        self.leave();
    }
}

pub(super) fn number(v: &mut impl Visit, key: &'static str, number: &mut f64) {
    v.at(Step::Key(key), Item::Number(number));
}

pub(super) fn optional(v: &mut impl Visit, key: &'static str, value: &mut Option<f64>) {
    if let Some(value) = value {
        number(v, key, value);
    }
}

pub(super) fn numbers<'m>(
    v: &mut impl Visit,
    key: &'static str,
    list: impl IntoIterator<Item = &'m mut f64>,
) {
    v.within(Step::Key(key), |v| {
        for (i, value) in list.into_iter().enumerate() {
            v.at(Step::Index(i), Item::Number(value));
        }
    });
}

/// Rows of numbers.
pub(super) fn rows<'m, R: IntoIterator<Item = &'m mut f64>>(
    v: &mut impl Visit,
    key: &'static str,
    list: impl IntoIterator<Item = R>,
) {
    v.within(Step::Key(key), |v| {
        for (i, row) in list.into_iter().enumerate() {
            v.within(Step::Index(i), |v| {
                for (j, value) in row.into_iter().enumerate() {
                    v.at(Step::Index(j), Item::Number(value));
                }
            });
        }
    });
}

pub(super) fn direction(v: &mut impl Visit, key: &'static str, vector: &mut Vector3<f64>) {
    v.at(Step::Key(key), Item::Direction(vector));
}

pub(super) fn function(v: &mut impl Visit, key: &'static str, function: &mut Function) {
    v.at(Step::Key(key), Item::Function(function));
}

pub(super) fn at(v: &mut impl Visit, key: &'static str, at: &mut At) {
    let (At::Fraction(value) | At::Length(value)) = at;
    number(v, key, value);
}

/// Of a pose on a body, or on a place of a beam.
pub(super) fn placed(v: &mut impl Visit, mount: &mut Mount, pose: Option<&mut Pose>) {
    let origin = mount_of(v, mount);
    if let Some(pose) = pose {
        numbers(v, origin, pose.position.iter_mut());
        v.at(Step::Key("rotation"), Item::Rotation(&mut pose.rotation));
    }
}

/// Of what carries something; the key of the point on it.
fn mount_of(v: &mut impl Visit, mount: &mut Mount) -> &'static str {
    match mount {
        Mount::Ground | Mount::Body(_) => "at",
        Mount::Beam(point) => {
            at(v, "at", &mut point.at);
            "offset"
        }
    }
}

fn attachment(v: &mut impl Visit, key: &'static str, attachment: &mut Attachment) {
    v.within(Step::Key(key), |v| point(v, attachment));
}

fn point(v: &mut impl Visit, Attachment { mount, point }: &mut Attachment) {
    let origin = mount_of(v, mount);
    numbers(v, origin, point.iter_mut());
}

/// Of a quantity along a beam. The rows of a section's table stand in its `along`, beside those of others.
fn profile(v: &mut impl Visit, key: &'static str, of_section: bool, profile: &mut Profile) {
    match profile {
        Profile::Constant(value) => number(v, key, value),
        Profile::Function(of_s) => function(v, key, of_s),
        Profile::Notch(notch) => v.within(Step::Key(key), |v| of_notch(v, notch)),
        Profile::Table { at: places, value } => {
            let (table, cell) = if of_section { ("along", key) } else { (key, "value") };
            v.within(Step::Key(table), |v| {
                for (i, (place, value)) in places.iter_mut().zip(value).enumerate() {
                    v.within(Step::Index(i), |v| {
                        at(v, "at", place);
                        number(v, cell, value);
                    });
                }
            });
        }
    }
}

fn of_notch(v: &mut impl Visit, Notch { shape, thickness, center }: &mut Notch) {
    number(v, "thickness", thickness);
    if let Some(center) = center {
        at(v, "at", center);
    }
    match shape {
        NotchShape::Circular { radius } => number(v, "radius", radius),
        NotchShape::Elliptic { along, across } => {
            number(v, "semi_axis_along", along);
            number(v, "semi_axis_across", across);
        }
        NotchShape::CornerFilleted { radius, length } => {
            number(v, "radius", radius);
            optional(v, "length", length);
        }
    }
}

fn profiles<const N: usize>(v: &mut impl Visit, key: &'static str, list: &mut [Profile; N]) {
    v.within(Step::Key(key), |v| {
        for (i, one) in list.iter_mut().enumerate() {
            match one {
                Profile::Constant(value) => v.at(Step::Index(i), Item::Number(value)),
                Profile::Function(of_s) => v.at(Step::Index(i), Item::Function(of_s)),
                other => v.within(Step::Index(i), |v| profile(v, "rows", false, other)),
            }
        }
    });
}

fn material(v: &mut impl Visit, material: &mut Material) {
    let Material { name, young, shear, density, yield_strength } = material;
    v.within(Step::Named("material", name), |v| {
        number(v, "young", young);
        number(v, "shear", shear);
        optional(v, "density", density);
        optional(v, "yield_strength", yield_strength);
    });
}

fn section(v: &mut impl Visit, Section { name, shape, plane_strain: _ }: &mut Section) {
    v.within(Step::Named("section", name), |v| {
        let own = |v: &mut _, key, of: &mut Profile| profile(v, key, true, of);
        match shape {
            Shape::Rectangle { width, height } | Shape::Ellipse { width, height } => {
                own(v, "width", width);
                own(v, "height", height);
            }
            Shape::Circle { diameter } => own(v, "diameter", diameter),
            Shape::Tube { outer_diameter, inner_diameter } => {
                own(v, "outer_diameter", outer_diameter);
                own(v, "inner_diameter", inner_diameter);
            }
            Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, mass_per_length, rotary_inertia } => {
                for (key, of) in [("EA", ea), ("GJ", gj), ("EI2", ei2), ("EI3", ei3)] {
                    own(v, key, of);
                }
                for (key, of) in [("GA2", ga2), ("GA3", ga3), ("mass_per_length", mass_per_length)] {
                    if let Some(of) = of {
                        own(v, key, of);
                    }
                }
                if let Some(of) = rotary_inertia {
                    profiles(v, "rotary_inertia", of);
                }
            }
            Shape::StiffnessMatrix { matrix, mass_per_length, rotary_inertia } => {
                v.within(Step::Key("matrix"), |v| {
                    for i in 0..6 {
                        v.within(Step::Index(i), |v| {
                            for j in 0..6 {
                                v.at(Step::Index(j), Item::Number(&mut matrix[(i, j)]));
                            }
                        });
                    }
                });
                if let Some(of) = mass_per_length {
                    own(v, "mass_per_length", of);
                }
                if let Some(of) = rotary_inertia {
                    profiles(v, "rotary_inertia", of);
                }
            }
        }
    });
}

fn body(v: &mut impl Visit, body: &mut Body) {
    let Body { name, pose, mass, center_of_mass, inertia } = body;
    v.within(Step::Named("body", name), |v| {
        numbers(v, "at", pose.position.iter_mut());
        v.at(Step::Key("rotation"), Item::Rotation(&mut pose.rotation));
        number(v, "mass", mass);
        numbers(v, "center_of_mass", center_of_mass.iter_mut());
        moments(v, inertia);
    });
}

fn moments(v: &mut impl Visit, inertia: &mut flexura_spatial::Matrix3<f64>) {
    v.within(Step::Key("inertia"), |v| {
        for i in 0..3 {
            v.within(Step::Index(i), |v| {
                for j in 0..3 {
                    v.at(Step::Index(j), Item::Number(&mut inertia[(i, j)]));
                }
            });
        }
    });
}

fn beam(v: &mut impl Visit, beam: &mut Beam) {
    let Beam {
        name,
        material: _,
        section: _,
        curve,
        frame,
        theory: _,
        damping,
        added_mass,
        start,
        end,
        distributed: loads,
        foundation: foundations,
    } = beam;
    v.within(Step::Named("beam", name), |v| {
        number(v, "damping", damping);
        number(v, "added_mass", added_mass);
        match curve {
            Curve::Straight { length } => number(v, "length", length),
            other => v.within(Step::Key("curve"), |v| of_curve(v, other)),
        }
        v.within(Step::Key("frame"), |v| match frame {
            SectionFrame::Natural => {}
            SectionFrame::Frenet { offset } => number(v, "offset", offset),
            SectionFrame::RotationMinimising { start, twist } => {
                if let Some(start) = start {
                    direction(v, "start", start);
                }
                if let Some(twist) = twist {
                    function(v, "twist", twist);
                }
            }
            SectionFrame::Direction { along } => direction(v, "along", along),
        });
        for (key, end) in [("start", start), ("end", end)] {
            if let Some(End { mount, placement, hold }) = end {
                v.within(Step::Key(key), |v| {
                    placed(v, mount, placement.as_mut());
                    law(v, hold, "turning", Part::Other);
                });
            }
        }
        let only = loads.len() == 1;
        v.within(Step::Key("distributed"), |v| {
            for (i, load) in loads.iter_mut().enumerate() {
                v.within(Step::Table(i, only), |v| distributed(v, load));
            }
        });
        let only = foundations.len() == 1;
        v.within(Step::Key("foundation"), |v| {
            for (i, one) in foundations.iter_mut().enumerate() {
                v.within(Step::Table(i, only), |v| foundation(v, one));
            }
        });
    });
}

fn of_curve(v: &mut impl Visit, curve: &mut Curve) {
    match curve {
        Curve::Straight { length } => number(v, "length", length),
        Curve::Arc { radius, angle } => {
            number(v, "radius", radius);
            number(v, "angle", angle);
        }
        Curve::Helix { radius, pitch, turns } => {
            number(v, "radius", radius);
            number(v, "pitch", pitch);
            number(v, "turns", turns);
        }
        Curve::Parametric { position: [x, y, z], range } => {
            for (key, of) in [("x", x), ("y", y), ("z", z)] {
                function(v, key, of);
            }
            numbers(v, "range", range);
        }
        Curve::Points { points } => rows(v, "points", points.iter_mut().map(|point| point.iter_mut())),
        Curve::Curvature { curvature: [k1, k2, k3], length } => {
            for (key, of) in [("k1", k1), ("k2", k2), ("k3", k3)] {
                profile(v, key, false, of);
            }
            number(v, "length", length);
        }
    }
}

fn distributed(v: &mut impl Visit, load: &mut Distributed) {
    let Distributed { force, moment, axes: _, between: [from, to] } = load;
    profiles(v, "force", force);
    profiles(v, "moment", moment);
    at(v, "from", from);
    at(v, "to", to);
}

fn foundation(v: &mut impl Visit, foundation: &mut Foundation) {
    let Foundation { law, direction: along, axes: _, between: [from, to] } = foundation;
    match law {
        FoundationLaw::Linear(stiffness) => profile(v, "stiffness", false, stiffness),
        FoundationLaw::Force(force) => function(v, "force", force),
    }
    if let Some(along) = along {
        direction(v, "direction", along);
    }
    at(v, "from", from);
    at(v, "to", to);
}

fn coupling(v: &mut impl Visit, Coupling { name, terms, offset }: &mut Coupling) {
    v.within(Step::Named("coupling", name), |v| {
        numbers(v, "factor", terms.iter_mut().map(|term| &mut term.factor));
        number(v, "offset", offset);
    });
}

fn spring(v: &mut impl Visit, spring: &mut Spring) {
    let Spring { name, from, to, law, rest_length, size, damping, wrap } = spring;
    v.within(Step::Named("spring", name), |v| {
        attachment(v, "from", from);
        attachment(v, "to", to);
        match law {
            SpringLaw::Linear { stiffness, tension_only: _ } => number(v, "stiffness", stiffness),
            SpringLaw::Exponential { area, exponent, stress, form: _ } => {
                number(v, "area", area);
                number(v, "exponent", exponent);
                number(v, "stress", stress);
            }
            SpringLaw::Toe { axial_stiffness, toe_strain } => {
                number(v, "axial_stiffness", axial_stiffness);
                number(v, "toe_strain", toe_strain);
            }
            SpringLaw::Table { rows: list } => rows(v, "rows", list),
        }
        optional(v, "rest_length", rest_length);
        number(v, "size", size);
        number(v, "damping", damping);
        if let Some(Wrap { frame, obstacle }) = wrap {
            v.within(Step::Key("wrap"), |v| {
                placed(v, &mut frame.mount, Some(&mut frame.pose));
                match obstacle {
                    Obstacle::Sphere { radius } => number(v, "sphere", radius),
                    Obstacle::Cylinder { radius, axis, turn: _ } => {
                        number(v, "cylinder", radius);
                        direction(v, "axis", axis);
                    }
                }
            });
        }
    });
}

fn cable(v: &mut impl Visit, Cable { name, route, law }: &mut Cable) {
    v.within(Step::Named("cable", name), |v| {
        match law {
            CableLaw::Tension(tension) => number(v, "tension", tension),
            CableLaw::Length(length) => number(v, "length", length),
        }
        let only = route.len() == 1;
        v.within(Step::Key("route"), |v| {
            for (i, guide) in route.iter_mut().enumerate() {
                v.within(Step::Table(i, only), |v| match guide {
                    Guide::Point(attached) => point(v, attached),
                    Guide::Channel { beam: _, between: [from, to], offset } => {
                        at(v, "from", from);
                        at(v, "to", to);
                        profiles(v, "offset", offset);
                    }
                });
            }
        });
    });
}

fn tubes(v: &mut impl Visit, Tubes { name, base, tubes, force, moment }: &mut Tubes) {
    v.within(Step::Named("tubes", name), |v| {
        v.within(Step::Key("base"), |v| placed(v, &mut base.mount, Some(&mut base.pose)));
        let only = tubes.len() == 1;
        v.within(Step::Key("tube"), |v| {
            for (i, tube) in tubes.iter_mut().enumerate() {
                let Tube { material: _, section: _, straight, curved, curvature, rotation, translation } =
                    tube;
                v.within(Step::Table(i, only), |v| {
                    number(v, "straight", straight);
                    number(v, "curved", curved);
                    number(v, "curvature", curvature);
                    number(v, "rotation", rotation);
                    number(v, "translation", translation);
                });
            }
        });
        numbers(v, "force", force.iter_mut());
        numbers(v, "moment", moment.iter_mut());
    });
}

fn load(v: &mut impl Visit, Load { name, target, force, moment, frame: _ }: &mut Load) {
    v.within(Step::Named("load", name), |v| {
        match target {
            LoadTarget::Body { body: _, point } => numbers(v, "at", point.iter_mut()),
            LoadTarget::Beam(point) => at(v, "at", &mut point.at),
        }
        v.part(Part::Load);
        numbers(v, "force", force.iter_mut());
        numbers(v, "moment", moment.iter_mut());
        v.part(Part::Other);
    });
}

impl Model {
    /// Visits every number but those of parameters, outputs and studies: outputs keep their parameters open, and studies
    /// stay what they were when a parameter changes.
    pub(crate) fn visit(&mut self, v: &mut impl Visit) {
        let Model {
            name: _,
            gravity,
            mass_damping,
            spin,
            parameters,
            bindings: _,
            materials,
            sections,
            beams,
            bodies,
            joints: all_joints,
            couplings,
            springs,
            cables,
            tubes: nests,
            masses,
            loads,
            outputs: _,
            unknowns,
            targets,
            studies: _,
        } = self;
        numbers(v, "gravity", gravity.iter_mut());
        number(v, "mass_damping", mass_damping);
        if let Some(Spin { axis, rate, through }) = spin {
            v.within(Step::Key("spin"), |v| {
                direction(v, "axis", axis);
                number(v, "rate", rate);
                numbers(v, "through", through.iter_mut());
            });
        }
        materials.iter_mut().for_each(|one| material(v, one));
        sections.iter_mut().for_each(|one| section(v, one));
        bodies.iter_mut().for_each(|one| body(v, one));
        beams.iter_mut().for_each(|one| beam(v, one));
        joints(v, all_joints);
        couplings.iter_mut().for_each(|one| coupling(v, one));
        springs.iter_mut().for_each(|one| spring(v, one));
        cables.iter_mut().for_each(|one| cable(v, one));
        nests.iter_mut().for_each(|one| tubes(v, one));
        for PointMass { name, point, mass, inertia } in masses {
            v.within(Step::Named("mass", name), |v| {
                at(v, "at", &mut point.at);
                number(v, "mass", mass);
                moments(v, inertia);
            });
        }
        loads.iter_mut().for_each(|one| load(v, one));
        for Unknown { parameter, range } in unknowns {
            if let (Some(range), Some(parameter)) = (range, parameters.get(*parameter)) {
                v.within(Step::Named("unknown", &parameter.name), |v| numbers(v, "range", range));
            }
        }
        for Target { output, value } in targets {
            v.at(Step::Quoted("target", &output.name), Item::Number(value));
        }
    }
}
