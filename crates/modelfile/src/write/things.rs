//! The tables of parameters, materials, sections, beams, bodies, joints, springs, cables, tubes, masses and loads.

use super::Writer;
use super::shapes::body_name;
use super::tree::{Table, Value};
use flexura_model::{
    Beam, Body, Cable, CableLaw, Coupling, Distributed, ExponentialForm, Foundation, FoundationLaw, Guide,
    Issue, Load, LoadAxes, LoadFrame, LoadTarget, Material, Obstacle, Profile, Rule, Section, Shape, Spring,
    SpringLaw, Tubes, Turn,
};
use flexura_spatial::{Matrix3, Vector3};

impl Writer<'_> {
    pub(super) fn things(&self, text: &mut String) -> Result<(), Issue> {
        let model = self.model;
        let mut parameters = Table::default();
        for parameter in &model.parameters {
            let value = match (&parameter.formula, parameter.unit.as_str()) {
                (Some(formula), _) => Value::text(formula.text()),
                (None, "") => Value::number(parameter.value),
                (None, unit) => Value::text(&format!("{:?} {unit}", parameter.value)),
            };
            parameters.put(&parameter.name, value);
        }
        if !parameters.is_empty() {
            text.push_str(&parameters.section("parameter", ""));
        }
        for one in &model.materials {
            text.push_str(&self.material(one).section("material", &one.name));
        }
        for one in &model.sections {
            text.push_str(&self.section(one)?.section("section", &one.name));
        }
        for one in &model.bodies {
            text.push_str(&self.body(one).section("body", &one.name));
        }
        for one in &model.beams {
            text.push_str(&self.beam(one)?.section("beam", &one.name));
        }
        for one in &model.joints {
            let path = format!("joint.{}", one.name);
            let mut table = self.law(&one.law, &path, "kind", false);
            let pose = Some(&one.parent.pose);
            let parent = self.frame(&format!("{path}.parent"), one.parent.mount, pose);
            table.put("parent", Value::Table(parent));
            let child = self.frame(&format!("{path}.child"), one.child, one.child_pose.as_ref());
            table.put("child", Value::Table(child));
            text.push_str(&table.section("joint", &one.name));
        }
        for one in &model.couplings {
            text.push_str(&self.coupling(one).section("coupling", &one.name));
        }
        for one in &model.springs {
            text.push_str(&self.spring(one).section("spring", &one.name));
        }
        for one in &model.cables {
            text.push_str(&self.cable(one)?.section("cable", &one.name));
        }
        for one in &model.tubes {
            text.push_str(&self.tubes(one).section("tubes", &one.name));
        }
        for one in &model.masses {
            let path = format!("mass.{}", one.name);
            let mut table = Table::default();
            table.put("beam", Value::text(&model[one.point.beam].name));
            table.put("at", self.at(&format!("{path}.at"), one.point.at));
            table.put("mass", self.number(&format!("{path}.mass"), one.mass));
            self.moments(&path, &one.inertia, &mut table);
            text.push_str(&table.section("mass", &one.name));
        }
        for one in &model.loads {
            text.push_str(&self.load(one).section("load", &one.name));
        }
        Ok(())
    }

    fn material(&self, material: &Material) -> Table {
        let path = format!("material.{}", material.name);
        let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
        let mut table = Table::default();
        table.put("young", own("young", material.young));
        match self.rule(&format!("{path}.shear")) {
            Some(Rule::ShearModulus { poisson, .. }) => table.put("poisson", Value::text(poisson.text())),
            _ => table.put("shear", own("shear", material.shear)),
        }
        table.put_some("density", material.density.map(|value| own("density", value)));
        let strength = material.yield_strength.map(|value| own("yield_strength", value));
        table.put_some("yield_strength", strength);
        table
    }

    fn section(&self, section: &Section) -> Result<Table, Issue> {
        let path = format!("section.{}", section.name);
        let mut table = Table::default();
        let (word, columns): (&str, Vec<(&'static str, &Profile)>) = match &section.shape {
            Shape::Rectangle { width, height } => ("rectangle", vec![("width", width), ("height", height)]),
            Shape::Ellipse { width, height } => ("ellipse", vec![("width", width), ("height", height)]),
            Shape::Circle { diameter } => ("circle", vec![("diameter", diameter)]),
            Shape::Tube { outer_diameter, inner_diameter } => {
                ("tube", vec![("outer_diameter", outer_diameter), ("inner_diameter", inner_diameter)])
            }
            Shape::Stiffness { ea, gj, ei2, ei3, ga2, ga3, mass_per_length, rotary_inertia: _ } => {
                let mut list = vec![("EA", ea), ("GJ", gj), ("EI2", ei2), ("EI3", ei3)];
                list.extend(ga2.iter().map(|of| ("GA2", of)));
                list.extend(ga3.iter().map(|of| ("GA3", of)));
                list.extend(mass_per_length.iter().map(|of| ("mass_per_length", of)));
                ("stiffness", list)
            }
            Shape::StiffnessMatrix { mass_per_length, .. } => {
                ("stiffness", mass_per_length.iter().map(|of| ("mass_per_length", of)).collect())
            }
        };
        table.put("shape", Value::text(word));
        if let Shape::StiffnessMatrix { matrix, .. } = &section.shape {
            let rows = (0..6).map(|i| std::array::from_fn::<f64, 6, _>(|j| matrix[(i, j)]));
            table.put("matrix", self.rows(&format!("{path}.matrix"), rows));
        }
        for (key, profile) in &columns {
            if !matches!(profile, Profile::Table { .. }) {
                table.put(key, self.profile(&format!("{path}.{key}"), profile)?);
            }
        }
        if let Shape::Stiffness { rotary_inertia: Some(three), .. }
        | Shape::StiffnessMatrix { rotary_inertia: Some(three), .. } = &section.shape
        {
            table.put("rotary_inertia", self.profiles(&format!("{path}.rotary_inertia"), &three[..])?);
        }
        table.put_some("along", self.along(&path, &columns)?);
        if section.plane_strain {
            table.put("plane_strain", Value::flag(true));
        }
        Ok(table)
    }

    fn body(&self, body: &Body) -> Table {
        let path = format!("body.{}", body.name);
        let mut table = Table::default();
        table.put("at", self.vector(&format!("{path}.at"), &body.pose.position));
        table.put_some("rotation", self.rotation(&format!("{path}.rotation"), &body.pose.rotation));
        if body.mass != 0.0 || self.is_bound(&format!("{path}.mass")) {
            table.put("mass", self.number(&format!("{path}.mass"), body.mass));
        }
        let center = format!("{path}.center_of_mass");
        if body.center_of_mass != Vector3::zeros() || self.is_bound(&center) {
            table.put("center_of_mass", self.vector(&center, &body.center_of_mass));
        }
        self.moments(&path, &body.inertia, &mut table);
        table
    }

    fn moments(&self, path: &str, inertia: &Matrix3<f64>, table: &mut Table) {
        let path = format!("{path}.inertia");
        if *inertia != Matrix3::zeros() || self.is_bound(&path) {
            let rows = (0..3).map(|i| std::array::from_fn::<f64, 3, _>(|j| inertia[(i, j)]));
            table.put("inertia", self.rows(&path, rows));
        }
    }

    fn beam(&self, beam: &Beam) -> Result<Table, Issue> {
        let path = format!("beam.{}", beam.name);
        let mut table = Table::default();
        table.put_some("material", beam.material.map(|id| Value::text(&self.model[id].name)));
        table.put("section", Value::text(&self.model[beam.section].name));
        self.curve(beam, &path, &mut table)?;
        for (key, end) in [("start", &beam.start), ("end", &beam.end)] {
            if let Some(end) = end {
                let path = format!("{path}.{key}");
                let mut inner = self.frame(&path, end.mount, end.placement.as_ref());
                inner.extend(self.law(&end.hold, &path, "hold", true));
                table.put(key, Value::Table(inner));
            }
        }
        if beam.theory.shear {
            table.put("shear", Value::flag(true));
        }
        if !beam.theory.extension {
            table.put("extension", Value::flag(false));
        }
        if beam.damping != 0.0 || self.is_bound(&format!("{path}.damping")) {
            table.put("damping", self.number(&format!("{path}.damping"), beam.damping));
        }
        if beam.added_mass != 0.0 || self.is_bound(&format!("{path}.added_mass")) {
            table.put("added_mass", self.number(&format!("{path}.added_mass"), beam.added_mass));
        }
        let loads = beam.distributed.iter().enumerate();
        let loads = loads.map(|(i, load)| self.distributed(load, &self.of_list(&path, "distributed", i)));
        let loads = loads.collect::<Result<Vec<_>, _>>()?;
        if !loads.is_empty() {
            table.put("distributed", Value::List(loads));
        }
        let beds = beam.foundation.iter().enumerate();
        let beds = beds.map(|(i, bed)| self.foundation(bed, &self.of_list(&path, "foundation", i)));
        let beds = beds.collect::<Result<Vec<_>, _>>()?;
        if !beds.is_empty() {
            table.put("foundation", Value::List(beds));
        }
        Ok(table)
    }

    /// The path of an element of a list of tables, under which its rules stand: without the index where the file left it out.
    fn of_list(&self, path: &str, key: &str, i: usize) -> String {
        let indexed = format!("{path}.{key}[{i}]");
        let bare = format!("{path}.{key}");
        let left_out = self
            .rules
            .range(bare.as_str()..)
            .next()
            .is_some_and(|(other, _)| other.starts_with(&bare) && other[bare.len()..].starts_with('.'));
        if left_out { bare } else { indexed }
    }

    fn distributed(&self, load: &Distributed, path: &str) -> Result<Value, Issue> {
        let mut table = Table::default();
        table.put("force", self.profiles(&format!("{path}.force"), &load.force)?);
        table.put("moment", self.profiles(&format!("{path}.moment"), &load.moment)?);
        if load.axes == LoadAxes::Section {
            table.put("frame", Value::text("section"));
        }
        for (key, at) in ["from", "to"].into_iter().zip(load.between) {
            table.put(key, self.at(&format!("{path}.{key}"), at));
        }
        Ok(Value::Table(table))
    }

    fn foundation(&self, bed: &Foundation, path: &str) -> Result<Value, Issue> {
        let mut table = Table::default();
        match &bed.law {
            FoundationLaw::Linear(stiffness) => {
                table.put("stiffness", self.profile(&format!("{path}.stiffness"), stiffness)?);
            }
            FoundationLaw::Force(force) => {
                table.put("force", self.function_at(&format!("{path}.force"), force));
            }
        }
        let direction = bed.direction.as_ref().map(|d| self.direction(&format!("{path}.direction"), d));
        table.put_some("direction", direction);
        if bed.axes == LoadAxes::Section {
            table.put("axes", Value::text("section"));
        }
        for (key, at) in ["from", "to"].into_iter().zip(bed.between) {
            table.put(key, self.at(&format!("{path}.{key}"), at));
        }
        Ok(Value::Table(table))
    }

    fn coupling(&self, coupling: &Coupling) -> Table {
        let mut table = Table::default();
        let relation = match self.rule(&format!("coupling.{}.offset", coupling.name)) {
            Some(Rule::Offset([left, right])) => {
                format!("{} = {}", left.text().trim(), right.text().trim())
            }
            _ => self.relation(coupling),
        };
        table.put("relation", Value::text(&relation));
        table
    }

    /// Σ factor q = offset, all of it as lengths where any coordinate is one.
    fn relation(&self, coupling: &Coupling) -> String {
        use flexura_model::CoordinateKind::Length;
        let kind = |term: &flexura_model::CouplingTerm| {
            self.model[term.joint].law.kind.coordinate_kinds().get(term.coordinate).copied()
        };
        let any_length = coupling.terms.iter().any(|term| kind(term) == Some(Length));
        let term = |term: &flexura_model::CouplingTerm| {
            let joint = &self.model[term.joint];
            let names = joint.law.kind.coordinate_names();
            let name = if names.len() == 1 { "coordinate" } else { names[term.coordinate] };
            let unit = if any_length && kind(term) != Some(Length) { " m" } else { "" };
            format!("({:?}{unit})*joint.{}.{name}", term.factor, quoted(&joint.name))
        };
        let terms: Vec<String> = coupling.terms.iter().map(term).collect();
        format!("{} = {:?}{}", terms.join(" + "), coupling.offset, if any_length { " m" } else { "" })
    }

    fn spring(&self, spring: &Spring) -> Table {
        let path = format!("spring.{}", spring.name);
        let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
        let mut table = Table::default();
        table.put("from", Value::Table(self.attachment(&format!("{path}.from"), &spring.from)));
        table.put("to", Value::Table(self.attachment(&format!("{path}.to"), &spring.to)));
        match &spring.law {
            SpringLaw::Linear { stiffness, tension_only } => {
                table.put("stiffness", own("stiffness", *stiffness));
                if *tension_only {
                    table.put("tension_only", Value::flag(true));
                }
            }
            SpringLaw::Exponential { area, exponent, stress, form } => {
                table.put("law", Value::text("exponential"));
                table.put("area", own("area", *area));
                table.put("exponent", own("exponent", *exponent));
                table.put("stress", own("stress", *stress));
                if *form == ExponentialForm::Printed {
                    table.put("form", Value::text("printed"));
                }
            }
            SpringLaw::Toe { axial_stiffness, toe_strain } => {
                table.put("law", Value::text("toe"));
                table.put("axial_stiffness", own("axial_stiffness", *axial_stiffness));
                table.put("toe_strain", own("toe_strain", *toe_strain));
            }
            SpringLaw::Table { rows } => {
                table.put("law", Value::text("table"));
                table.put("rows", self.rows(&format!("{path}.rows"), rows.iter().copied()));
            }
        }
        table.put_some("rest_length", spring.rest_length.map(|value| own("rest_length", value)));
        if spring.size != 1.0 || self.is_bound(&format!("{path}.size")) {
            table.put("size", own("size", spring.size));
        }
        if spring.damping != 0.0 || self.is_bound(&format!("{path}.damping")) {
            table.put("damping", own("damping", spring.damping));
        }
        if let Some(wrap) = &spring.wrap {
            let path = format!("{path}.wrap");
            let mut inner = self.frame(&path, wrap.frame.mount, Some(&wrap.frame.pose));
            match &wrap.obstacle {
                Obstacle::Sphere { radius } => {
                    inner.put("sphere", self.number(&format!("{path}.sphere"), *radius));
                }
                Obstacle::Cylinder { radius, axis, turn } => {
                    inner.put("cylinder", self.number(&format!("{path}.cylinder"), *radius));
                    inner.put("axis", self.direction(&format!("{path}.axis"), axis));
                    let word = turn.map(|turn| if turn == Turn::Positive { "positive" } else { "negative" });
                    inner.put_some("turn", word.map(Value::text));
                }
            }
            table.put("wrap", Value::Table(inner));
        }
        table
    }

    fn cable(&self, cable: &Cable) -> Result<Table, Issue> {
        let path = format!("cable.{}", cable.name);
        let mut table = Table::default();
        match cable.law {
            CableLaw::Tension(tension) => {
                table.put("tension", self.number(&format!("{path}.tension"), tension));
            }
            CableLaw::Length(length) => table.put("length", self.number(&format!("{path}.length"), length)),
        }
        let guide = |(i, guide): (usize, &Guide)| -> Result<Value, Issue> {
            let path = self.of_list(&path, "route", i);
            Ok(Value::Table(match guide {
                Guide::Point(point) => self.attachment(&path, point),
                Guide::Channel { beam, between, offset } => {
                    let mut inner = Table::default();
                    inner.put("beam", Value::text(&self.model[*beam].name));
                    for (key, at) in ["from", "to"].into_iter().zip(*between) {
                        inner.put(key, self.at(&format!("{path}.{key}"), at));
                    }
                    inner.put("offset", self.profiles(&format!("{path}.offset"), offset)?);
                    inner
                }
            }))
        };
        let route = cable.route.iter().enumerate().map(guide).collect::<Result<Vec<_>, _>>()?;
        table.put("route", Value::List(route));
        Ok(table)
    }

    fn tubes(&self, nest: &Tubes) -> Table {
        let path = format!("tubes.{}", nest.name);
        let mut table = Table::default();
        let base = self.frame(&format!("{path}.base"), nest.base.mount, Some(&nest.base.pose));
        table.put("base", Value::Table(base));
        let tube = |(i, tube): (usize, &flexura_model::Tube)| {
            let path = self.of_list(&path, "tube", i);
            let own = |key: &str, value: f64| self.number(&format!("{path}.{key}"), value);
            let mut inner = Table::default();
            inner.put_some("material", tube.material.map(|id| Value::text(&self.model[id].name)));
            inner.put("section", Value::text(&self.model[tube.section].name));
            inner.put("straight", own("straight", tube.straight));
            inner.put("curved", own("curved", tube.curved));
            match self.rule(&format!("{path}.curvature")) {
                Some(Rule::Reciprocal(radius)) => inner.put("radius", Value::text(radius.text())),
                _ => inner.put("curvature", own("curvature", tube.curvature)),
            }
            inner.put("rotation", own("rotation", tube.rotation));
            inner.put("translation", own("translation", tube.translation));
            Value::Table(inner)
        };
        table.put("tube", Value::List(nest.tubes.iter().enumerate().map(tube).collect()));
        for (key, vector) in [("force", &nest.force), ("moment", &nest.moment)] {
            let path = format!("{path}.{key}");
            if *vector != Vector3::zeros() || self.is_bound(&path) {
                table.put(key, self.vector(&path, vector));
            }
        }
        table
    }

    fn load(&self, load: &Load) -> Table {
        let path = format!("load.{}", load.name);
        let mut table = Table::default();
        match &load.target {
            LoadTarget::Body { body, point } => {
                table.put("body", body_name(self.model, *body));
                table.put("at", self.vector(&format!("{path}.at"), point));
            }
            LoadTarget::Beam(point) => {
                table.put("beam", Value::text(&self.model[point.beam].name));
                table.put("at", self.at(&format!("{path}.at"), point.at));
            }
        }
        table.put("force", self.vector(&format!("{path}.force"), &load.force));
        table.put("moment", self.vector(&format!("{path}.moment"), &load.moment));
        if load.frame == LoadFrame::Local {
            table.put("frame", Value::text("local"));
        }
        table
    }
}

/// A name as an expression takes it.
pub(super) fn quoted(name: &str) -> String {
    let plain = name.chars().all(|c| c.is_alphanumeric() || c == '_')
        && name.chars().next().is_some_and(|c| !c.is_numeric());
    if plain { name.to_string() } else { format!("\"{name}\"") }
}
