//! Springs.

use super::Issues;
use super::load::point_path;
use crate::{Model, Obstacle, Spring, SpringLaw, Wrap};

impl Model {
    pub(super) fn check_springs(&self, issues: &mut Issues) {
        for spring in &self.springs {
            let path = format!("spring.{}", spring.name);
            for (attachment, word) in [(&spring.from, "from"), (&spring.to, "to")] {
                self.check_mount(attachment.mount, &format!("{path}.{word}"), issues);
                issues.finite_vector(point_path(attachment, &format!("{path}.{word}")), &attachment.point);
            }
            if spring.from == spring.to {
                issues.add(format!("{path}.to"), "a spring must connect two different points");
            }
            issues.positive(format_args!("{path}.size"), spring.size);
            issues.not_negative(format_args!("{path}.damping"), spring.damping);
            check_law(spring, &path, issues);
            if let Some(wrap) = &spring.wrap {
                self.check_wrap(wrap, &format!("{path}.wrap"), issues);
            }
        }
    }

    fn check_wrap(&self, wrap: &Wrap, path: &str, issues: &mut Issues) {
        self.check_mount(wrap.frame.mount, path, issues);
        issues.pose(path, &wrap.frame.pose);
        match &wrap.obstacle {
            Obstacle::Sphere { radius } => {
                issues.positive(format_args!("{path}.sphere"), *radius);
            }
            Obstacle::Cylinder { radius, axis, .. } => {
                issues.positive(format_args!("{path}.cylinder"), *radius);
                if (axis.norm() - 1.0).is_nan() || (axis.norm() - 1.0).abs() > 1e-9 {
                    issues.add(format!("{path}.axis"), "must be a unit vector");
                }
            }
        }
    }
}

fn check_law(spring: &Spring, path: &str, issues: &mut Issues) {
    if let Some(rest_length) = spring.rest_length {
        let rest = format!("{path}.rest_length");
        match spring.law {
            SpringLaw::Linear { .. } | SpringLaw::Table { .. } => issues.not_negative(rest, rest_length),
            // The strain is measured by it.
            SpringLaw::Exponential { .. } | SpringLaw::Toe { .. } => {
                issues.positive(rest, rest_length);
            }
        }
    }
    match &spring.law {
        SpringLaw::Linear { stiffness, .. } => {
            issues.not_negative(format_args!("{path}.stiffness"), *stiffness);
        }
        SpringLaw::Exponential { area, exponent, stress, .. } => {
            for (key, value) in [("area", area), ("exponent", exponent), ("stress", stress)] {
                issues.positive(format_args!("{path}.{key}"), *value);
            }
        }
        SpringLaw::Toe { axial_stiffness, toe_strain } => {
            issues.positive(format_args!("{path}.axial_stiffness"), *axial_stiffness);
            if issues.finite(format_args!("{path}.toe_strain"), *toe_strain) && *toe_strain <= 0.0 {
                issues.add_with_hint(
                    format!("{path}.toe_strain"),
                    format!("must be positive, is {toe_strain}"),
                    "without a toe the law is `linear` with `tension_only = true`",
                );
            }
        }
        SpringLaw::Table { rows } => check_rows(rows, &format!("{path}.rows"), issues),
    }
}

fn check_rows(rows: &[[f64; 2]], path: &str, issues: &mut Issues) {
    if rows.len() < 2 {
        let message = format!("a law needs at least two rows, has {}", rows.len());
        issues.add_with_hint(path, message, "for example `rows = [[0, 0], [\"2 mm\", \"5 N\"]]`");
    }
    for (i, row) in rows.iter().enumerate() {
        for (value, k) in row.iter().zip(0..) {
            issues.finite(format_args!("{path}[{i}][{k}]"), *value);
        }
    }
    for (i, pair) in rows.windows(2).enumerate() {
        let [before, row] = [pair[0], pair[1]];
        if row[0] <= before[0] {
            issues.add_with_hint(
                format!("{path}[{}]", i + 1),
                format!("elongations must increase; {} m follows {} m", row[0], before[0]),
                "order the rows by elongation, one row for each",
            );
            break;
        }
        if row[1] < before[1] {
            issues.add_with_hint(
                format!("{path}[{}]", i + 1),
                format!("the force must not fall; {} N follows {} N", row[1], before[1]),
                "end the table where the force is largest",
            );
            break;
        }
    }
}
