//! Concentric tubes.

use super::Issues;
use crate::{Model, Mount, Profile, Shape, Tube, Tubes};

/// Numbers that differ by less, relatively, are the same.
const ROUND_OFF: f64 = 1e-9;

impl Model {
    pub(super) fn check_tubes(&self, issues: &mut Issues) {
        for tubes in &self.tubes {
            let path = format!("tubes.{}", tubes.name);
            let base = format!("{path}.base");
            match tubes.base.mount {
                Mount::Beam(_) => issues.add(
                    format!("{base}.beam"),
                    "the guide of tubes is on a body or on the ground, not on a beam",
                ),
                mount => self.check_mount(mount, &base, issues),
            }
            issues.pose(&base, &tubes.base.pose);
            issues.finite_vector(format_args!("{path}.force"), &tubes.force);
            issues.finite_vector(format_args!("{path}.moment"), &tubes.moment);
            let path = format!("{path}.tube");
            if !(1..=4).contains(&tubes.tubes.len()) {
                issues.add(path.clone(), format!("there must be 1 to 4 tubes, not {}", tubes.tubes.len()));
            }
            for (i, tube) in tubes.tubes.iter().enumerate() {
                let path = format!("{path}[{i}]");
                check_lengths(tube, i, &path, issues);
                self.check_tube_section(tube, i, &path, issues);
            }
            check_reaches(tubes, &path, issues);
            self.check_nesting(tubes, &path, issues);
        }
    }

    fn check_tube_section(&self, tube: &Tube, i: usize, path: &str, issues: &mut Issues) {
        if tube.material.is_some_and(|id| id.0 >= self.materials.len()) {
            issues.add(format!("{path}.material"), "refers to a material that does not exist");
        }
        let at = format!("{path}.section");
        let Some(section) = self.sections.get(tube.section.0) else {
            issues.add(at, "refers to a section that does not exist");
            return;
        };
        let name = &section.name;
        if !matches!(section.shape, Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. })
            && tube.material.is_none()
        {
            issues.add_with_hint(
                path,
                format!("tube {} has no material", i + 1),
                "only a tube whose section is given as a stiffness needs none",
            );
        }
        let profiles: Vec<(&str, &Profile)> = match &section.shape {
            Shape::Circle { diameter } => vec![("diameter", diameter)],
            Shape::Tube { outer_diameter, inner_diameter } => {
                vec![("outer_diameter", outer_diameter), ("inner_diameter", inner_diameter)]
            }
            Shape::Stiffness { gj, ei2, ei3, .. } => vec![("GJ", gj), ("EI2", ei2), ("EI3", ei3)],
            Shape::Rectangle { .. } | Shape::Ellipse { .. } | Shape::StiffnessMatrix { .. } => {
                issues.add_with_hint(
                    at,
                    format!("concentric tubes are round, but section `{name}` of tube {} is not", i + 1),
                    "take a circle, a tube, or a stiffness with EI2 = EI3",
                );
                return;
            }
        };
        if section.plane_strain {
            issues.add(
                at.clone(),
                format!("`plane_strain` is for wide strips, but section `{name}` is that of a tube"),
            );
        }
        if let Some((key, _)) = profiles.iter().find(|(_, profile)| profile.as_constant().is_none()) {
            issues.add_with_hint(
                at,
                format!("section `{name}` changes along the tube"),
                format!("its {key} must be the same everywhere"),
            );
            return;
        }
        if let Shape::Stiffness { ei2, ei3, .. } = &section.shape
            && let (Some(a), Some(b)) = (ei2.as_constant(), ei3.as_constant())
        {
            if let Some((key, _)) =
                profiles.iter().find(|(_, profile)| profile.as_constant() == Some(f64::INFINITY))
            {
                issues.add(
                    at,
                    format!("a tube must bend and twist, but {key} of section `{name}` is infinite"),
                );
            } else if (a - b).abs() > ROUND_OFF * a.abs().max(b.abs()) {
                issues.add_with_hint(
                    at,
                    format!("section `{name}` is stiffer in one direction than in the other: EI2 is {a} N*m^2, EI3 {b} N*m^2"),
                    "concentric tubes are round: EI2 = EI3",
                );
            }
        }
    }

    /// Each tube must have room in the next. Of one given as a stiffness nothing is known.
    fn check_nesting(&self, tubes: &Tubes, path: &str, issues: &mut Issues) {
        let mut within: Option<(usize, f64)> = None;
        for (i, tube) in tubes.tubes.iter().enumerate() {
            let Some(section) = self.sections.get(tube.section.0) else { continue };
            let at = format!("{path}[{i}].section");
            let outer = match &section.shape {
                Shape::Circle { diameter } => {
                    if i > 0 {
                        issues.add_with_hint(
                            at,
                            format!(
                                "tube {} is solid (section `{}`), so no other can lie within",
                                i + 1,
                                section.name
                            ),
                            "only the innermost, which comes first, may be solid",
                        );
                    }
                    diameter
                }
                Shape::Tube { outer_diameter, inner_diameter } => {
                    if let Some((j, outer)) = within
                        && let Some(inner) = inner_diameter.as_constant()
                        && outer > inner * (1.0 + ROUND_OFF)
                    {
                        issues.add_with_hint(
                            at,
                            format!(
                                "tube {} (outer diameter {outer} m) does not fit into tube {} (inner diameter {inner} m)",
                                j + 1,
                                i + 1
                            ),
                            "the innermost tube comes first",
                        );
                    }
                    outer_diameter
                }
                _ => continue,
            };
            if let Some(outer) = outer.as_constant() {
                within = Some((i, outer));
            }
        }
    }
}

fn check_lengths(tube: &Tube, i: usize, path: &str, issues: &mut Issues) {
    issues.not_negative(format_args!("{path}.straight"), tube.straight);
    issues.not_negative(format_args!("{path}.curved"), tube.curved);
    issues.finite(format_args!("{path}.curvature"), tube.curvature);
    issues.finite(format_args!("{path}.rotation"), tube.rotation);
    let at = format!("{path}.translation");
    if !issues.finite(at.clone(), tube.translation) {
        return;
    }
    // Derivatives at the mouth look a hair beyond it.
    if tube.translation > 1e-4 * (tube.straight + tube.curved) {
        issues.add_with_hint(
            at,
            format!("the back end of tube {} is {} m in front of the guide's mouth", i + 1, tube.translation),
            "it must be in the guide: zero or negative",
        );
    } else if sound(tube) && tube.reach() <= 0.0 {
        let length = short(tube.straight + tube.curved);
        issues.add_with_hint(
            path,
            format!(
                "tube {} does not leave the guide: it is {length} m long, its back end {} m behind the mouth",
                i + 1,
                short(-tube.translation)
            ),
            "straight + curved + translation must be positive",
        );
    }
}

/// Are its lengths finite and not negative?
fn sound(tube: &Tube) -> bool {
    let length = |x: f64| x.is_finite() && x >= 0.0;
    length(tube.straight) && length(tube.curved) && tube.translation.is_finite()
}

fn check_reaches(tubes: &Tubes, path: &str, issues: &mut Issues) {
    let Some(first) = tubes.tubes.first().filter(|tube| sound(tube)) else { return };
    let reach = first.reach();
    for (i, tube) in tubes.tubes.iter().enumerate().skip(1) {
        if sound(tube) && tube.reach() > reach + ROUND_OFF * reach.abs() {
            issues.add_with_hint(
                format!("{path}[{i}]"),
                format!(
                    "tube {} reaches {} m from the guide's mouth, farther than the innermost, which reaches {} m",
                    i + 1,
                    short(tube.reach()),
                    short(reach)
                ),
                "make the first tube longer, or draw this one back by `translation`",
            );
        }
    }
}

/// A length to the nanometre, for a message.
fn short(length: f64) -> f64 {
    (length * 1e9).round() / 1e9
}
