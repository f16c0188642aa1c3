//! How hard a span is loaded, at its worst and along it.

/// The largest force and moment met along a stretch, nondimensional: what sets rates.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Level {
    pub force: f64,
    pub moment: f64,
    /// Σ T d of the tendons: the moment by which they bend the beam itself, beside that of the whole section.
    pub tendons: f64,
    /// Stiffness of foundations whose law is not linear, at the displacements met.
    pub foundation: f64,
}

impl Level {
    /// The larger of both in everything.
    pub fn max(&self, other: &Self) -> Self {
        Self {
            force: self.force.max(other.force),
            moment: self.moment.max(other.moment),
            tendons: self.tendons.max(other.tendons),
            foundation: self.foundation.max(other.foundation),
        }
    }
}

/// Force and moment at one place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Mark {
    /// m.
    pub s: f64,
    pub force: f64,
    pub moment: f64,
}

/// The level of a span, and force and moment at places along it; between two of these they are taken to go in straight lines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Course {
    pub most: Level,
    /// In order; none where the whole span counts as its worst place.
    pub marks: Vec<Mark>,
}

impl Course {
    /// The level between two places.
    pub fn over(&self, [a, b]: [f64; 2]) -> Level {
        if self.marks.is_empty() {
            return self.most;
        }
        let (mut force, mut moment) = (0.0_f64, 0.0_f64);
        let mut meet = |mark: &Mark| {
            force = force.max(mark.force);
            moment = moment.max(mark.moment);
        };
        meet(&self.at(a));
        meet(&self.at(b));
        let first = self.marks.partition_point(|mark| mark.s < a);
        self.marks[first..].iter().take_while(|mark| mark.s <= b).for_each(meet);
        Level { force, moment, ..self.most }
    }

    /// Takes the force to be this large at least, everywhere.
    pub fn raise(&mut self, force: f64) {
        self.most.force = self.most.force.max(force);
        self.marks.iter_mut().for_each(|mark| mark.force = mark.force.max(force));
    }

    /// Force and moment at one place.
    fn at(&self, s: f64) -> Mark {
        let next = self.marks.partition_point(|mark| mark.s <= s);
        let (before, after) =
            (self.marks[next.saturating_sub(1)], self.marks[next.min(self.marks.len() - 1)]);
        let width = after.s - before.s;
        let t = if width > 0.0 { ((s - before.s) / width).clamp(0.0, 1.0) } else { 0.0 };
        let mix = |a: f64, b: f64| if a == b { a } else { a + t * (b - a) };
        Mark { s, force: mix(before.force, after.force), moment: mix(before.moment, after.moment) }
    }

    /// The larger of both everywhere.
    pub fn max(&self, other: &Self) -> Self {
        let most = self.most.max(&other.most);
        if self.marks.is_empty() || other.marks.is_empty() {
            return Self { most, marks: Vec::new() };
        }
        let mut places: Vec<f64> = self.marks.iter().chain(&other.marks).map(|mark| mark.s).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        let larger = |s: f64| {
            let (a, b) = (self.over([s, s]), other.over([s, s]));
            Mark { s, force: a.force.max(b.force), moment: a.moment.max(b.moment) }
        };
        Self { most, marks: places.into_iter().map(larger).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn course(marks: &[[f64; 3]]) -> Course {
        let marks: Vec<Mark> =
            marks.iter().map(|[s, force, moment]| Mark { s: *s, force: *force, moment: *moment }).collect();
        let most = Level { force: 9.0, moment: 9.0, tendons: 2.0, foundation: 3.0 };
        Course { most, marks }
    }

    #[test]
    fn between_marks_the_level_goes_in_straight_lines() {
        let course = course(&[[0.0, 4.0, 1.0], [1.0, 2.0, 5.0], [2.0, 0.0, 0.0]]);
        let level = course.over([0.25, 0.5]);
        assert_eq!((level.force, level.moment, level.tendons), (3.5, 3.0, 2.0));
        assert_eq!(course.over([0.5, 1.5]).moment, 5.0);
        assert_eq!(course.over([1.5, 3.0]).force, 1.0);
        assert_eq!(Course { marks: Vec::new(), ..course }.over([0.1, 0.2]).force, 9.0);
    }

    #[test]
    fn the_larger_of_two_courses_is_larger_everywhere() {
        let (a, b) = (
            course(&[[0.0, 4.0, 0.0], [2.0, 0.0, 0.0]]),
            course(&[[0.0, 1.0, 0.0], [1.0, 3.0, 1.0], [2.0, 1.0, 0.0]]),
        );
        let both = a.max(&b);
        for i in 0..=20 {
            let s = f64::from(i) / 10.0;
            let force = both.over([s, s]).force;
            assert!(force >= a.over([s, s]).force && force >= b.over([s, s]).force);
        }
    }
}
