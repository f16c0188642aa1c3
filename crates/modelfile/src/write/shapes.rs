//! Rest shapes, quantities along beams, poses, joints and what touches.

use super::tree::{Table, Value};
use super::{Writer, texts, unwritable};
use flexura_expression::{Expression, Function};
use flexura_model::{
    At, Attachment, Beam, Boundary, BoundaryCurve, Contact, CoordinateLaw, Curve, Drive, Issue, JointKind,
    JointLaw, Model, Mount, Notch, NotchShape, Profile, RevolutionProfile, Rolling, RollingCoordinate, Rule,
    SectionFrame, Side, Slide, Surface, SurfaceMotion, Surfaces,
};
use flexura_spatial::{Pose, UnitQuaternion, Vector3};
use std::f64::consts::PI;

/// Name of the variable of parametric curves unless given.
const VARIABLE: &str = "t";

impl Writer<'_> {
    /// The text of a function that may hang on parameters.
    pub(super) fn function_at(&self, path: &str, function: &Function) -> Value {
        match self.rule(path) {
            Some(Rule::Function(open)) => Value::text(open.text()),
            _ => Value::text(function.text()),
        }
    }

    pub(super) fn profile(&self, path: &str, profile: &Profile) -> Result<Value, Issue> {
        match profile {
            Profile::Constant(value) => Ok(self.number(path, *value)),
            Profile::Function(function) => Ok(self.function_at(path, function)),
            Profile::Notch(notch) => Ok(Value::Table(self.notch(path, notch))),
            Profile::Table { .. } => Err(unwritable(path)),
        }
    }

    pub(super) fn profiles(&self, path: &str, list: &[Profile]) -> Result<Value, Issue> {
        let each = list.iter().enumerate().map(|(i, one)| self.profile(&format!("{path}[{i}]"), one));
        Ok(Value::List(each.collect::<Result<_, _>>()?))
    }

    fn notch(&self, path: &str, notch: &Notch) -> Table {
        let mut table = Table::default();
        let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
        let kind = match notch.shape {
            NotchShape::Circular { .. } => "circular",
            NotchShape::Elliptic { .. } => "elliptic",
            NotchShape::CornerFilleted { .. } => "corner_filleted",
        };
        table.put("notch", Value::text(kind));
        table.put("thickness", own("thickness", notch.thickness));
        table.put_some("at", notch.center.map(|at| self.at(&format!("{path}.at"), at)));
        match notch.shape {
            NotchShape::Circular { radius } => table.put("radius", own("radius", radius)),
            NotchShape::Elliptic { along, across } => {
                table.put("semi_axis_along", own("semi_axis_along", along));
                table.put("semi_axis_across", own("semi_axis_across", across));
            }
            NotchShape::CornerFilleted { radius, length } => {
                table.put("radius", own("radius", radius));
                table.put_some("length", length.map(|length| own("length", length)));
            }
        }
        table
    }

    pub(super) fn rotation(&self, path: &str, rotation: &UnitQuaternion<f64>) -> Option<Value> {
        let mut table = Table::default();
        match self.rule(path) {
            Some(Rule::Turn { axis, angle }) => {
                table.put("axis", texts(axis));
                table.put("angle", Value::text(angle.text()));
            }
            Some(Rule::RollPitchYaw(rpy)) => table.put("rpy", texts(rpy)),
            Some(Rule::Quaternion(wxyz)) => table.put("quat_wxyz", texts(wxyz)),
            _ if *rotation == UnitQuaternion::identity() => return None,
            _ => {
                let q = rotation.quaternion();
                table.put("quat_wxyz", Value::List([q.w, q.i, q.j, q.k].map(Value::number).to_vec()));
            }
        }
        Some(Value::Table(table))
    }

    fn mount(&self, path: &str, mount: Mount, table: &mut Table) -> &'static str {
        match mount {
            Mount::Ground => table.put("body", Value::text("ground")),
            Mount::Body(body) => table.put("body", Value::text(&self.model[body].name)),
            Mount::Beam(point) => {
                table.put("beam", Value::text(&self.model[point.beam].name));
                table.put("at", self.at(&format!("{path}.at"), point.at));
                return "offset";
            }
        }
        "at"
    }

    /// A frame on what carries it.
    pub(super) fn frame(&self, path: &str, mount: Mount, pose: Option<&Pose>) -> Table {
        let mut table = Table::default();
        let origin = self.mount(path, mount, &mut table);
        if let Some(pose) = pose {
            table.put(origin, self.vector(&format!("{path}.{origin}"), &pose.position));
            table.put_some("rotation", self.rotation(&format!("{path}.rotation"), &pose.rotation));
        }
        table
    }

    pub(super) fn attachment(&self, path: &str, attachment: &Attachment) -> Table {
        let mut table = Table::default();
        let origin = self.mount(path, attachment.mount, &mut table);
        let key = format!("{path}.{origin}");
        if attachment.point != Vector3::zeros() || self.is_bound(&key) {
            table.put(origin, self.vector(&key, &attachment.point));
        }
        table
    }

    pub(super) fn curve(&self, beam: &Beam, path: &str, table: &mut Table) -> Result<(), Issue> {
        if let Curve::Straight { length } = beam.curve {
            table.put("length", self.number(&format!("{path}.length"), length));
        } else {
            table.put("curve", Value::Table(self.bent(&beam.curve, &format!("{path}.curve"))?));
        }
        let path = format!("{path}.frame");
        let mut frame = Table::default();
        match &beam.frame {
            SectionFrame::Natural => return Ok(()),
            SectionFrame::Frenet { offset } => {
                frame.put("kind", Value::text("frenet"));
                frame.put("offset", self.number(&format!("{path}.offset"), *offset));
            }
            SectionFrame::RotationMinimising { start, twist } => {
                frame.put("kind", Value::text("rotation_minimising"));
                let start = start.as_ref().map(|start| self.direction(&format!("{path}.start"), start));
                frame.put_some("start", start);
                let twist = twist.as_ref().map(|twist| self.function_at(&format!("{path}.twist"), twist));
                frame.put_some("twist", twist);
            }
            SectionFrame::Direction { along } => {
                frame.put("kind", Value::text("direction"));
                frame.put("along", self.direction(&format!("{path}.along"), along));
            }
        }
        table.put("frame", Value::Table(frame));
        Ok(())
    }

    fn bent(&self, curve: &Curve, path: &str) -> Result<Table, Issue> {
        let mut table = Table::default();
        let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
        match curve {
            Curve::Straight { length } => table.put("length", own("length", *length)),
            Curve::Arc { radius, angle } => {
                table.put("kind", Value::text("arc"));
                table.put("radius", own("radius", *radius));
                table.put("angle", own("angle", *angle));
            }
            Curve::Helix { radius, pitch, turns } => {
                table.put("kind", Value::text("helix"));
                table.put("radius", own("radius", *radius));
                table.put("pitch", own("pitch", *pitch));
                table.put("turns", own("turns", *turns));
            }
            Curve::Parametric { position: [x, y, z], range } => {
                table.put("kind", Value::text("parametric"));
                self.parametric(path, [("x", x), ("y", y), ("z", z)], range, &mut table);
            }
            Curve::Points { points } => {
                table.put("kind", Value::text("points"));
                let rows = points.iter().map(|point| <[f64; 3]>::from(*point));
                table.put("points", self.rows(&format!("{path}.points"), rows));
            }
            Curve::Curvature { curvature, length } => {
                table.put("kind", Value::text("curvature"));
                for (key, k) in ["k1", "k2", "k3"].into_iter().zip(curvature) {
                    table.put(key, self.profile(&format!("{path}.{key}"), k)?);
                }
                table.put("length", own("length", *length));
            }
        }
        Ok(table)
    }

    fn parametric<const N: usize>(
        &self,
        path: &str,
        position: [(&str, &Function); N],
        range: &[f64; 2],
        table: &mut Table,
    ) {
        // The variable is the one name that is no parameter.
        let references = |text: &str| -> Vec<String> {
            let parsed = Expression::parse(text);
            let names = |expression: &Expression| -> Vec<String> {
                let references = expression.references();
                references.iter().filter_map(|reference| reference.name()).map(str::to_string).collect()
            };
            parsed.as_ref().map(names).unwrap_or_default()
        };
        let used = position.iter().flat_map(|(_, function)| references(function.text()));
        let variable = used.into_iter().find(|name| !self.names.contains(&name.as_str()));
        if let Some(variable) = variable.filter(|variable| variable != VARIABLE) {
            table.put("parameter", Value::text(&variable));
        }
        for (key, function) in position {
            table.put(key, self.function_at(&format!("{path}.{key}"), function));
        }
        table.put("range", self.numbers(&format!("{path}.range"), range));
    }

    /// A joint or a hold: its kind, axes, coordinates and what touches.
    pub(super) fn law(&self, law: &JointLaw, path: &str, by: &str, is_hold: bool) -> Table {
        let mut table = Table::default();
        let kind = match law.kind {
            JointKind::Weld if is_hold => "clamp",
            JointKind::Weld => "weld",
            JointKind::Revolute => "revolute",
            JointKind::Prismatic => "prismatic",
            JointKind::Cylindrical => "cylindrical",
            JointKind::Universal => "universal",
            JointKind::Spherical if is_hold => "pin",
            JointKind::Spherical => "spherical",
            JointKind::Planar => "planar",
            JointKind::Free => "free",
            JointKind::Rolling(_) => "rolling",
            JointKind::Contact | JointKind::SurfaceRolling => "contact",
        };
        table.put(by, Value::text(kind));
        let second = match law.kind {
            JointKind::Universal => Some("second_axis"),
            JointKind::Planar | JointKind::Rolling(_) => Some("x_axis"),
            _ => None,
        };
        if second.is_some()
            || matches!(law.kind, JointKind::Revolute | JointKind::Prismatic | JointKind::Cylindrical)
        {
            table.put("axis", self.direction(&format!("{path}.axis"), &law.axis));
        }
        if let Some(second) = second {
            match self.rule(&format!("{path}.{second}")) {
                Some(Rule::Across { near: Some(near), .. }) => table.put(second, texts(near)),
                Some(Rule::Across { near: None, .. }) if law.kind != JointKind::Universal => {}
                _ => table.put(second, self.direction("", &law.second_axis)),
            }
        }
        self.coordinates(law, path, is_hold, &mut table);
        match law.contact.as_deref() {
            None => {}
            Some(Contact::Rolling(rolling)) => self.rolling(law.kind, rolling, path, &mut table),
            Some(Contact::Surfaces(surfaces)) => self.surfaces(surfaces, path, &mut table),
        }
        table
    }

    fn coordinates(&self, law: &JointLaw, path: &str, is_hold: bool, table: &mut Table) {
        let laws = &law.coordinates;
        let turning = if is_hold { "turning" } else { "rotation" };
        match law.kind {
            JointKind::Weld => {}
            JointKind::Spherical => table.extend(self.rotation_vector(laws, path)),
            JointKind::Contact => {
                let inner = self.rotation_vector(&laws[..3.min(laws.len())], &format!("{path}.rotation"));
                if !inner.is_empty() {
                    table.put("rotation", Value::Table(inner));
                }
            }
            JointKind::Revolute
            | JointKind::Prismatic
            | JointKind::SurfaceRolling
            | JointKind::Rolling(RollingCoordinate::Turning | RollingCoordinate::Angle) => {
                laws.iter().for_each(|law| table.extend(self.coordinate(law, path)));
            }
            JointKind::Cylindrical
            | JointKind::Universal
            | JointKind::Planar
            | JointKind::Free
            | JointKind::Rolling(RollingCoordinate::Arc) => {
                let count = if law.kind == JointKind::Free { 3 } else { laws.len() };
                for (name, law) in law.kind.coordinate_names().iter().zip(laws).take(count) {
                    let inner = self.coordinate(law, &format!("{path}.{name}"));
                    if !inner.is_empty() {
                        table.put(name, Value::Table(inner));
                    }
                }
                if law.kind == JointKind::Free && laws.len() == 6 {
                    let inner = self.rotation_vector(&laws[3..], &format!("{path}.{turning}"));
                    if !inner.is_empty() {
                        table.put(turning, Value::Table(inner));
                    }
                }
            }
        }
    }

    fn coordinate(&self, law: &CoordinateLaw, path: &str) -> Table {
        let mut table = Table::default();
        let own = |key: &str, value: f64| {
            let path = format!("{path}.{key}");
            (value != 0.0 || self.is_bound(&path)).then(|| self.number(&path, value))
        };
        match law.drive {
            Drive::Free { effort } => table.put_some("effort", own("effort", effort)),
            Drive::Driven { coordinate } => {
                table.put("coordinate", self.number(&format!("{path}.coordinate"), coordinate));
            }
        }
        let rest = own("rest", law.rest);
        if law.stiffness != 0.0 || rest.is_some() || self.is_bound(&format!("{path}.stiffness")) {
            table.put("stiffness", self.number(&format!("{path}.stiffness"), law.stiffness));
        }
        table.put_some("rest", rest);
        table.put_some("damping", own("damping", law.damping));
        if let Some(limits) = &law.limits {
            let path = format!("{path}.limits");
            let mut inner = Table::default();
            inner.put("range", self.numbers(&format!("{path}.range"), &limits.range));
            let stiffness = limits.stiffness.map(|k| self.number(&format!("{path}.stiffness"), k));
            inner.put_some("stiffness", stiffness);
            table.put("limits", Value::Table(inner));
        }
        table
    }

    /// The laws of three components that share their stiffness.
    fn rotation_vector(&self, laws: &[CoordinateLaw], path: &str) -> Table {
        let mut table = Table::default();
        let list = |key: &str, values: Vec<f64>| {
            let path = format!("{path}.{key}");
            let any = values.iter().any(|value| *value != 0.0) || self.is_bound(&path);
            any.then(|| self.numbers(&path, &values))
        };
        let driven: Vec<f64> = laws
            .iter()
            .filter_map(|law| match law.drive {
                Drive::Driven { coordinate } => Some(coordinate),
                Drive::Free { .. } => None,
            })
            .collect();
        if driven.is_empty() {
            let efforts = laws.iter().map(|law| match law.drive {
                Drive::Free { effort } => effort,
                Drive::Driven { .. } => 0.0,
            });
            table.put_some("effort", list("effort", efforts.collect()));
        } else {
            table.put("coordinate", self.numbers(&format!("{path}.coordinate"), &driven));
        }
        let rest = list("rest", laws.iter().map(|law| law.rest).collect());
        let stiffness = laws.first().map_or(0.0, |law| law.stiffness);
        if stiffness != 0.0 || rest.is_some() || self.is_bound(&format!("{path}.stiffness")) {
            table.put("stiffness", self.number(&format!("{path}.stiffness"), stiffness));
        }
        table.put_some("rest", rest);
        let damping = laws.first().map_or(0.0, |law| law.damping);
        if damping != 0.0 || self.is_bound(&format!("{path}.damping")) {
            table.put("damping", self.number(&format!("{path}.damping"), damping));
        }
        table
    }

    fn rolling(&self, kind: JointKind, rolling: &Rolling, path: &str, table: &mut Table) {
        if let JointKind::Rolling(by) = kind {
            let word = match by {
                RollingCoordinate::Turning => "turning",
                RollingCoordinate::Angle => "angle",
                RollingCoordinate::Arc => "arc",
            };
            table.put("by", Value::text(word));
        }
        for (key, boundary) in [("child_curve", &rolling.child), ("parent_curve", &rolling.parent)] {
            table.put(key, Value::Table(self.boundary(boundary, &format!("{path}.{key}"))));
        }
        if rolling.concave {
            table.put("concave", Value::flag(true));
        }
        let start = rolling.start.map(|start| self.numbers(&format!("{path}.start"), &start));
        table.put_some("start", start);
        let path = format!("{path}.slide");
        let mut slide = Table::default();
        let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
        let law = |key: &str, function: &Function| self.function_at(&format!("{path}.{key}"), function);
        let (word, keys): (&str, Vec<(&str, Value)>) = match &rolling.slide {
            Slide::None => ("none", Vec::new()),
            Slide::Pure => ("pure", Vec::new()),
            Slide::Velocity { velocity, rate } => {
                ("velocity", vec![("velocity", own("velocity", *velocity)), ("rate", own("rate", *rate))])
            }
            Slide::Ratio { ratio } => ("ratio", vec![("ratio", own("ratio", *ratio))]),
            Slide::Function(function) => ("law", vec![("slide", law("slide", function))]),
            Slide::Table(rows) => {
                ("table", vec![("rows", self.rows(&format!("{path}.rows"), rows.iter().copied()))])
            }
            Slide::Measured { roll, slide } => {
                ("measured", vec![("roll", law("roll", roll)), ("slide", law("slide", slide))])
            }
            Slide::Stepped { step } => ("stepped", vec![("step", own("step", *step))]),
        };
        slide.put("kind", Value::text(word));
        keys.into_iter().for_each(|(key, value)| slide.put(key, value));
        table.put("slide", Value::Table(slide));
        if rolling.close {
            table.put("close", Value::flag(true));
        }
    }

    fn boundary(&self, boundary: &Boundary, path: &str) -> Table {
        let mut table = Table::default();
        let numbers = |key: &str, values: &[f64]| self.numbers(&format!("{path}.{key}"), values);
        match &boundary.curve {
            BoundaryCurve::Ellipse { semi_axes, range } => {
                table.put("kind", Value::text("ellipse"));
                table.put("semi_axes", numbers("semi_axes", semi_axes));
                table.put_some("range", range.map(|range| numbers("range", &range)));
            }
            BoundaryCurve::Line { point, normal, range } => {
                table.put("kind", Value::text("line"));
                table.put("point", numbers("point", point));
                table.put("normal", numbers("normal", normal));
                table.put_some("range", range.map(|range| numbers("range", &range)));
            }
            BoundaryCurve::Arcs { point, direction, arcs } => {
                table.put("kind", Value::text("arcs"));
                table.put("point", numbers("point", point));
                table.put("direction", numbers("direction", direction));
                table.put("arcs", self.rows(&format!("{path}.arcs"), arcs.iter().copied()));
            }
            BoundaryCurve::Points { points, closed } => {
                table.put("kind", Value::text("points"));
                table.put("points", self.rows(&format!("{path}.points"), points.iter().copied()));
                table.put("closed", Value::flag(*closed));
            }
            BoundaryCurve::Expression { position: [x, y], range, closed } => {
                table.put("kind", Value::text("expression"));
                self.parametric(path, [("x", x), ("y", y)], range, &mut table);
                table.put("closed", Value::flag(*closed));
            }
        }
        let side = boundary.outside.map(|side| if side == Side::Left { "left" } else { "right" });
        table.put_some("outside", side.map(Value::text));
        table
    }

    fn surfaces(&self, surfaces: &Surfaces, path: &str, table: &mut Table) {
        for (key, surface) in [("child_surface", &surfaces.child), ("parent_surface", &surfaces.parent)] {
            table.put(key, Value::Table(self.surface(surface, &format!("{path}.{key}"))));
        }
        if surfaces.concave {
            table.put("concave", Value::flag(true));
        }
        if let SurfaceMotion::Rolling { about } | SurfaceMotion::Osculating { about } = &surfaces.motion {
            let rolls = matches!(surfaces.motion, SurfaceMotion::Rolling { .. });
            table.put("motion", Value::text(if rolls { "rolling" } else { "osculating" }));
            table.put("about", self.direction(&format!("{path}.about"), about));
            if surfaces.range != [-PI, PI] || self.is_bound(&format!("{path}.range")) {
                table.put("range", self.numbers(&format!("{path}.range"), &surfaces.range));
            }
        }
        if surfaces.close {
            table.put("close", Value::flag(true));
        }
    }

    fn surface(&self, surface: &Surface, path: &str) -> Table {
        let mut table = Table::default();
        let numbers = |key: &str, values: &[f64]| self.numbers(&format!("{path}.{key}"), values);
        match surface {
            Surface::Plane => table.put("kind", Value::text("plane")),
            Surface::Ellipsoid { semi_axes } => {
                table.put("kind", Value::text("ellipsoid"));
                table.put("semi_axes", numbers("semi_axes", semi_axes.as_slice()));
            }
            Surface::Cylinder { semi_axes } => {
                table.put("kind", Value::text("cylinder"));
                table.put("semi_axes", numbers("semi_axes", semi_axes));
            }
            Surface::Revolution { profile } => {
                table.put("kind", Value::text("revolution"));
                match profile {
                    RevolutionProfile::Points(points) => {
                        table.put("points", self.rows(&format!("{path}.points"), points.iter().copied()));
                    }
                    RevolutionProfile::Radius { radius, range } => {
                        table.put("radius", self.function_at(&format!("{path}.radius"), radius));
                        table.put("range", numbers("range", range));
                    }
                }
            }
            Surface::Heights { semi_axes, points, degree } => {
                table.put("kind", Value::text("heights"));
                table.put("semi_axes", numbers("semi_axes", semi_axes.as_slice()));
                let rows = points.iter().map(|point| <[f64; 3]>::from(*point));
                table.put("points", self.rows(&format!("{path}.points"), rows));
                table.put("degree", Value::plain(&degree.to_string()));
            }
        }
        table
    }

    /// The rows of a section's tables, which share their places.
    pub(super) fn along(
        &self,
        path: &str,
        columns: &[(&'static str, &Profile)],
    ) -> Result<Option<Value>, Issue> {
        let mut places: Option<&Vec<At>> = None;
        let mut rows: Vec<Table> = Vec::new();
        for (key, profile) in columns {
            let Profile::Table { at, value } = profile else { continue };
            match places {
                None => {
                    let row = |(i, at): (usize, &At)| {
                        let mut row = Table::default();
                        row.put("at", self.at(&format!("{path}.along[{i}].at"), *at));
                        row
                    };
                    rows = at.iter().enumerate().map(row).collect();
                    places = Some(at);
                }
                Some(places) if places == at => {}
                Some(_) => return Err(unwritable(&format!("{path}.{key}"))),
            }
            for (i, (row, value)) in rows.iter_mut().zip(value).enumerate() {
                row.put(key, self.number(&format!("{path}.along[{i}].{key}"), *value));
            }
        }
        let rows = rows.into_iter().map(Value::Table).collect();
        Ok(places.map(|_| Value::List(rows)))
    }
}

/// The names of bodies, of use to those who write.
pub(super) fn body_name(model: &Model, body: flexura_model::BodyId) -> Value {
    Value::text(&model[body].name)
}
