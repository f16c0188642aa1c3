//! Area, second moments, torsion constant and shear coefficients of a shape.

use super::torsion::rectangle_constant;
use crate::SectionError;
use flexura_model::{Material, Profile, Section, Shape};
use std::f64::consts::PI;

/// Geometric properties of a section given by its dimensions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Properties {
    /// A, m².
    pub area: f64,
    /// I2 = ∫z² dA, m⁴: bending about e2.
    pub i2: f64,
    /// I3 = ∫y² dA, m⁴: bending about e3.
    pub i3: f64,
    /// J, m⁴: Saint-Venant's torsion constant, not the polar moment.
    pub j: f64,
    /// Shear coefficient along e2: shear stiffness is `shear2` G A.
    pub shear2: f64,
    /// Shear coefficient along e3.
    pub shear3: f64,
}

/// The dimensions of a solid at one place, all checked.
#[derive(Clone, Copy, Debug)]
pub(super) enum Solid {
    Rectangle { width: f64, height: f64 },
    Ellipse { width: f64, height: f64 },
    Tube { outer: f64, inner: f64 },
}

impl Solid {
    /// The dimensions of the shape at `s`; None for stiffness sections.
    pub fn at(shape: &Shape, s: f64, length: f64) -> Result<Option<Self>, SectionError> {
        let value = |what, profile: &Profile| positive(what, profile, s, length);
        Ok(Some(match shape {
            Shape::Rectangle { width, height } => {
                Solid::Rectangle { width: value("width", width)?, height: value("height", height)? }
            }
            Shape::Ellipse { width, height } => {
                Solid::Ellipse { width: value("width", width)?, height: value("height", height)? }
            }
            Shape::Circle { diameter } => Solid::Tube { outer: value("diameter", diameter)?, inner: 0.0 },
            Shape::Tube { outer_diameter, inner_diameter } => {
                let outer = value("outer diameter", outer_diameter)?;
                let inner = inner_diameter.value(s, length);
                if !(inner >= 0.0) {
                    return Err(SectionError::NotPositive { what: "inner diameter", value: inner, s });
                }
                if inner >= outer {
                    return Err(SectionError::NoWall { inner, outer, s });
                }
                Solid::Tube { outer, inner }
            }
            Shape::Stiffness { .. } | Shape::StiffnessMatrix { .. } => return Ok(None),
        }))
    }

    fn area(&self) -> f64 {
        match *self {
            Solid::Rectangle { width, height } => width * height,
            Solid::Ellipse { width, height } => PI * (0.5 * width) * (0.5 * height),
            // Factors, so that a thin wall loses no digits.
            Solid::Tube { outer, inner } => PI * (0.5 * outer - 0.5 * inner) * (0.5 * outer + 0.5 * inner),
        }
    }

    /// Its properties for Poisson's ratio `nu` (which only the shear coefficients depend on).
    pub fn properties(&self, nu: f64) -> Properties {
        let area = self.area();
        match *self {
            Solid::Rectangle { width, height } => {
                let shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
                Properties {
                    area,
                    i2: width * height.powi(3) / 12.0,
                    i3: height * width.powi(3) / 12.0,
                    j: rectangle_constant(width, height),
                    shear2: shear,
                    shear3: shear,
                }
            }
            Solid::Ellipse { width, height } => {
                let (a, b) = (0.5 * width, 0.5 * height);
                Properties {
                    area,
                    i2: 0.25 * PI * a * b.powi(3),
                    i3: 0.25 * PI * b * a.powi(3),
                    j: PI * (a * b).powi(3) / (a * a + b * b),
                    shear2: ellipse_shear(a, b, nu),
                    shear3: ellipse_shear(b, a, nu),
                }
            }
            Solid::Tube { outer, inner } => {
                let (a, b) = (0.5 * outer, 0.5 * inner);
                let i = 0.25 * area * (a * a + b * b);
                let m2 = (b / a).powi(2);
                let shear = 6.0 * (1.0 + nu) * (1.0 + m2).powi(2)
                    / ((7.0 + 6.0 * nu) * (1.0 + m2).powi(2) + (20.0 + 12.0 * nu) * m2);
                Properties { area, i2: i, i3: i, j: 2.0 * i, shear2: shear, shear3: shear }
            }
        }
    }
}

/// Cowper's shear coefficient of an ellipse for a force along the semi-axis `a`.
fn ellipse_shear(a: f64, b: f64, nu: f64) -> f64 {
    let (a2, b2) = (a * a, b * b);
    12.0 * (1.0 + nu) * a2 * (3.0 * a2 + b2)
        / ((40.0 + 37.0 * nu) * a2 * a2 + (16.0 + 10.0 * nu) * a2 * b2 + nu * b2 * b2)
}

/// The profile's value at `s`, which must be positive (infinity is allowed by the caller's meaning only).
fn positive(what: &'static str, profile: &Profile, s: f64, length: f64) -> Result<f64, SectionError> {
    let value = profile.value(s, length);
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(SectionError::NotPositive { what, value, s })
    }
}

/// Poisson's ratio ν = E/2G - 1 of an isotropic material. Where E and G belong to none, as along the fibres of a
/// composite, they say nothing of it, and zero stands for it: the shear coefficients are then those without it, 5/6 of
/// a rectangle.
pub(super) fn poisson(material: &Material) -> f64 {
    if material.is_isotropic() { 0.5 * material.young / material.shear - 1.0 } else { 0.0 }
}

/// The geometric properties at arc length `s` of a beam of the given length; None for stiffness sections.
///
/// Shear coefficients for Poisson's ratio `nu` after G. R. Cowper, "The shear coefficient in Timoshenko's
/// beam theory", *J. Appl. Mech.* 33 (1966) 335: rectangle 10(1+ν)/(12+11ν) (5/6 at ν = 0), circle
/// 6(1+ν)/(7+6ν), tube and ellipse likewise. Torsion constants: rectangle by Saint-Venant's series, ellipse
/// π a³b³/(a²+b²), circle and tube the polar moment (Timoshenko and Goodier, 1970, ch. 10).
///
/// # Errors
/// Dimensions that are not positive, a tube without a wall.
pub fn properties(
    section: &Section,
    s: f64,
    length: f64,
    nu: f64,
) -> Result<Option<Properties>, SectionError> {
    Ok(Solid::at(&section.shape, s, length)?.map(|solid| solid.properties(nu)))
}

/// Mass per undeformed length at arc length `s`, kg/m; zero for a material without density.
///
/// # Errors
/// Dimensions that are not positive.
pub fn mass_per_length(
    section: &Section,
    material: Option<&Material>,
    s: f64,
    length: f64,
) -> Result<f64, SectionError> {
    match &section.shape {
        Shape::Stiffness { mass_per_length, .. } | Shape::StiffnessMatrix { mass_per_length, .. } => {
            let value = mass_per_length.as_ref().map_or(0.0, |profile| profile.value(s, length));
            if value >= 0.0 && value.is_finite() {
                Ok(value)
            } else {
                Err(SectionError::NotPositive { what: "mass per length", value, s })
            }
        }
        _ => {
            let density = material.and_then(|material| material.density).unwrap_or(0.0);
            Ok(Solid::at(&section.shape, s, length)?.map_or(0.0, |solid| density * solid.area()))
        }
    }
}

/// Moments of inertia per undeformed length about e1, e2 and e3 at arc length `s`, kg·m: ρ (I2 + I3), ρ I2 and ρ I3; zero for
/// a material without density.
///
/// # Errors
/// Dimensions that are not positive, a moment that is negative.
pub fn rotary_inertia(
    section: &Section,
    material: Option<&Material>,
    s: f64,
    length: f64,
) -> Result<[f64; 3], SectionError> {
    match &section.shape {
        Shape::Stiffness { rotary_inertia, .. } | Shape::StiffnessMatrix { rotary_inertia, .. } => {
            let Some(given) = rotary_inertia else { return Ok([0.0; 3]) };
            let values = [0, 1, 2].map(|i| given[i].value(s, length));
            match values.iter().find(|value| !(**value >= 0.0 && value.is_finite())) {
                Some(&value) => Err(SectionError::NotPositive { what: "rotary inertia", value, s }),
                None => Ok(values),
            }
        }
        _ => {
            let density = material.and_then(|material| material.density).unwrap_or(0.0);
            let of = |p: Properties| [p.i2 + p.i3, p.i2, p.i3].map(|moment| density * moment);
            Ok(properties(section, s, length, 0.0)?.map_or([0.0; 3], of))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn section(shape: Shape) -> Section {
        Section { name: "s".into(), shape, plane_strain: false }
    }

    fn of(shape: Shape, nu: f64) -> Properties {
        properties(&section(shape), 0.0, 1.0, nu).expect("good").expect("a solid")
    }

    #[test]
    fn the_robot_strip_has_the_known_ratio_of_torsion_to_bending() {
        let p = of(Shape::Rectangle { width: 20.32e-3.into(), height: 0.254e-3.into() }, 0.0);
        assert!((79.3 * p.j / (207.0 * p.i2) - 1.5203).abs() < 5e-5);
        // The polar moment would give 2452.
        assert!((79.3 * (p.i2 + p.i3) / (207.0 * p.i2) - 2452.0).abs() < 1.0);
    }

    #[test]
    fn the_square_of_the_45_degree_bend_has_a_torsion_constant_of_0_141() {
        let p = of(Shape::Rectangle { width: 1.0.into(), height: 1.0.into() }, 0.0);
        assert!((p.j - 0.1406).abs() < 1e-4 && (p.shear2 - 5.0 / 6.0).abs() < 1e-15);
    }

    #[test]
    fn a_round_ellipse_and_a_full_tube_are_a_circle() {
        let circle = of(Shape::Circle { diameter: 0.3.into() }, 0.3);
        let ellipse = of(Shape::Ellipse { width: 0.3.into(), height: 0.3.into() }, 0.3);
        let tube = of(Shape::Tube { outer_diameter: 0.3.into(), inner_diameter: 0.0.into() }, 0.3);
        for other in [ellipse, tube] {
            for (a, b) in [
                (circle.area, other.area),
                (circle.i2, other.i2),
                (circle.i3, other.i3),
                (circle.j, other.j),
                (circle.shear2, other.shear2),
                (circle.shear3, other.shear3),
            ] {
                assert!((a - b).abs() < 1e-15 * b.max(1e-3), "{a} {b}");
            }
        }
        // Cowper: 6(1+ν)/(7+6ν) = 0.886 at ν = 0.3.
        assert!((circle.shear2 - 7.8 / 8.8).abs() < 1e-15);
    }

    #[test]
    fn bending_about_e2_feels_the_height() {
        let p = of(Shape::Rectangle { width: 2.0.into(), height: 3.0.into() }, 0.0);
        assert_eq!((p.i2, p.i3), (4.5, 2.0));
        let p = of(Shape::Ellipse { width: 2.0.into(), height: 4.0.into() }, 0.0);
        assert!((p.i2 - 2.0 * PI).abs() < 1e-14 && (p.i3 - 0.5 * PI).abs() < 1e-15);
    }

    #[test]
    fn impossible_dimensions_are_refused() {
        let at = |shape| properties(&section(shape), 0.2, 1.0, 0.0).unwrap_err();
        let thin = Shape::Rectangle { width: 1.0.into(), height: (-1.0).into() };
        assert_eq!(at(thin), SectionError::NotPositive { what: "height", value: -1.0, s: 0.2 });
        let tube = Shape::Tube { outer_diameter: 1.0.into(), inner_diameter: 1.0.into() };
        assert_eq!(at(tube), SectionError::NoWall { inner: 1.0, outer: 1.0, s: 0.2 });
        let nan = Shape::Circle { diameter: f64::NAN.into() };
        assert!(matches!(at(nan), SectionError::NotPositive { .. }));
    }
}
