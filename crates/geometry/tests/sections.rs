//! The laws of cross sections: stiffness, suppressed strains, stress.

use flexura_expression::Function;
use flexura_geometry::{
    Compliance, SectionError, compliance, is_uniform, mass_per_length, outline, peak_stress, section_breaks,
    stiffness,
};
use flexura_model::{At, BeamTheory, Material, Profile, Section, Shape};
use nalgebra::{Matrix6, Vector3, Vector6};
use proptest::prelude::*;
use std::f64::consts::PI;

const SHEARABLE: BeamTheory = BeamTheory { shear: true, extension: true };
const SLENDER: BeamTheory = BeamTheory { shear: false, extension: true };
const INEXTENSIBLE: BeamTheory = BeamTheory { shear: false, extension: false };

fn section(shape: Shape) -> Section {
    Section { name: "section".into(), shape, plane_strain: false }
}

fn rectangle(width: f64, height: f64) -> Section {
    section(Shape::Rectangle { width: width.into(), height: height.into() })
}

fn ellipse(width: f64, height: f64) -> Section {
    section(Shape::Ellipse { width: width.into(), height: height.into() })
}

fn steel() -> Material {
    Material {
        name: "steel".into(),
        young: 207e9,
        shear: 79.3e9,
        density: Some(7850.0),
        yield_strength: None,
    }
}

fn diagonal(section: &Section, theory: BeamTheory) -> [f64; 6] {
    match compliance(section, Some(&steel()), theory, 0.0, 1.0).expect("good") {
        Compliance::Diagonal(diagonal) => diagonal,
        Compliance::Full(_) => panic!("a solid section is uncoupled"),
    }
}

fn matrix_section(matrix: Matrix6<f64>) -> Section {
    section(Shape::StiffnessMatrix { matrix: Box::new(matrix), mass_per_length: None, rotary_inertia: None })
}

/// A symmetric positive definite matrix with the sizes of a real section: N, N, N, N·m², N·m², N·m².
fn coupled() -> Matrix6<f64> {
    let mixing = Matrix6::from_fn(|i, j| if i == j { 1.0 } else { 0.3 * ((3 * i + 5 * j) as f64).sin() });
    let size = Matrix6::from_diagonal(&Vector6::new(1e6, 4e5, 4e5, 2.0, 3.0, 5.0).map(f64::sqrt));
    size * (mixing.transpose() * mixing) * size
}

fn assert_relative(actual: f64, expected: f64, tolerance: f64) {
    assert!((actual / expected - 1.0).abs() <= tolerance, "{actual:e} against {expected:e}");
}

#[test]
fn a_rectangle_has_the_compliances_of_the_textbook() {
    let (b, h) = (20.32e-3, 0.254e-3);
    let c = diagonal(&rectangle(b, h), SHEARABLE);
    assert_relative(c[0], 1.0 / (207e9 * b * h), 1e-15);
    assert_relative(c[4], 12.0 / (207e9 * b * h * h * h), 1e-15);
    assert_relative(c[5], 12.0 / (207e9 * h * b * b * b), 1e-15);
    assert_relative(c[4] / c[3], 1.5203, 4e-5);
    let nu = 207.0 / (2.0 * 79.3) - 1.0;
    let shear = 10.0 * (1.0 + nu) / (12.0 + 11.0 * nu);
    assert_relative(c[1], 1.0 / (shear * 79.3e9 * b * h), 1e-14);
    let k = stiffness(&rectangle(b, h), Some(&steel()), 0.0, 1.0).expect("good");
    for i in 0..6 {
        assert_relative(k[(i, i)] * c[i], 1.0, 1e-15);
    }
}

#[test]
fn suppressed_strains_have_no_compliance() {
    let full = diagonal(&rectangle(0.1, 0.2), SHEARABLE);
    let slender = diagonal(&rectangle(0.1, 0.2), SLENDER);
    let stiff = diagonal(&rectangle(0.1, 0.2), INEXTENSIBLE);
    assert_eq!(slender, [full[0], 0.0, 0.0, full[3], full[4], full[5]]);
    assert_eq!(stiff, [0.0, 0.0, 0.0, full[3], full[4], full[5]]);
}

#[test]
fn an_infinite_stiffness_is_rigid() {
    let shape = |ga2| Shape::Stiffness {
        ea: f64::INFINITY.into(),
        gj: 2.0.into(),
        ei2: 4.0.into(),
        ei3: f64::INFINITY.into(),
        ga2,
        ga3: Some(10.0.into()),
        mass_per_length: Some(0.3.into()),
        rotary_inertia: None,
    };
    let rigid = section(shape(Some(5.0.into())));
    let c = compliance(&rigid, None, SHEARABLE, 0.0, 1.0).expect("good");
    assert_eq!(c, Compliance::Diagonal([0.0, 0.2, 0.1, 0.5, 0.25, 0.0]));
    assert_eq!(mass_per_length(&rigid, None, 0.0, 1.0), Ok(0.3));
    let missing = section(shape(None));
    assert!(compliance(&missing, None, SLENDER, 0.0, 1.0).is_ok());
    let error = compliance(&missing, None, SHEARABLE, 0.0, 1.0).unwrap_err();
    assert_eq!(error, SectionError::NoShearStiffness { which: "ga2" });
    assert!(peak_stress(&rigid, None, 0.0, 1.0, &Vector3::x(), &Vector3::x()).is_none());
    assert!(outline(&rigid, 0.0, 1.0).is_none());
}

#[test]
fn a_coupled_section_is_inverted_on_its_active_strains() {
    let k = coupled();
    let section = matrix_section(k);
    for (theory, active) in [
        (SHEARABLE, [true; 6]),
        (SLENDER, [true, false, false, true, true, true]),
        (INEXTENSIBLE, [false, false, false, true, true, true]),
        (BeamTheory { shear: true, extension: false }, [false, true, true, true, true, true]),
    ] {
        let c = compliance(&section, None, theory, 0.0, 1.0).expect("good").to_matrix();
        let wrench = Vector6::new(100.0, -70.0, 40.0, 0.3, 0.2, -0.5);
        let strain = c * wrench;
        let back = k * strain;
        for i in 0..6 {
            if active[i] {
                assert!((back[i] - wrench[i]).abs() < 1e-12 * wrench[i].abs(), "{theory:?} {i}");
            } else {
                assert_eq!(strain[i], 0.0);
            }
        }
        assert_eq!(c, c.transpose());
    }
}

#[test]
fn a_diagonal_matrix_is_the_uncoupled_section() {
    let k = Matrix6::from_diagonal(&Vector6::new(1e6, 2e5, 3e5, 2.0, 3.0, 4.0));
    let c = compliance(&matrix_section(k), None, SHEARABLE, 0.0, 1.0).expect("good").to_matrix();
    assert!((c * k - Matrix6::identity()).norm() < 1e-14);
    assert_eq!(stiffness(&matrix_section(k), None, 0.0, 1.0), Ok(k));
}

#[test]
fn impossible_matrices_are_refused() {
    let mut k = coupled();
    k[(0, 3)] += 100.0;
    let error = compliance(&matrix_section(k), None, SLENDER, 0.0, 1.0).unwrap_err();
    assert!(matches!(error, SectionError::NotSymmetric { row: 4, column: 1, .. }), "{error}");
    let mut k = Matrix6::identity();
    (k[(0, 3)], k[(3, 0)]) = (1.5, 1.5);
    for theory in [SHEARABLE, INEXTENSIBLE] {
        let error = compliance(&matrix_section(k), None, theory, 0.0, 1.0).unwrap_err();
        assert_eq!(error, SectionError::NotPositiveDefinite);
    }
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut k = Matrix6::identity();
        k[(4, 4)] = bad;
        let error = compliance(&matrix_section(k), None, SLENDER, 0.0, 1.0).unwrap_err();
        assert!(
            matches!(error, SectionError::NotPositiveDefinite | SectionError::NotSymmetric { .. }),
            "{bad}"
        );
    }
}

#[test]
fn a_solid_section_needs_a_material() {
    let error = compliance(&rectangle(1.0, 1.0), None, SLENDER, 0.0, 1.0).unwrap_err();
    assert_eq!(error, SectionError::NoMaterial);
}

#[test]
fn plane_strain_stiffens_bending_about_the_wide_axis_only() {
    let nu: f64 = 207.0 / (2.0 * 79.3) - 1.0;
    for (b, h, soft) in [(20e-3, 0.25e-3, 4), (0.25e-3, 20e-3, 5)] {
        let mut strip = rectangle(b, h);
        let plain = diagonal(&strip, SLENDER);
        strip.plane_strain = true;
        let plate = diagonal(&strip, SLENDER);
        for i in [0, 3, 4, 5] {
            let factor = if i == soft { 1.0 - nu * nu } else { 1.0 };
            assert_relative(plate[i], plain[i] * factor, 1e-15);
        }
    }
    let mut round = section(Shape::Circle { diameter: 1.0.into() });
    round.plane_strain = true;
    let error = compliance(&round, Some(&steel()), SLENDER, 0.0, 1.0).unwrap_err();
    assert_eq!(error, SectionError::PlaneStrain { shape: "circle" });
}

#[test]
fn dimensions_may_vary_along_the_beam() {
    let height = Function::parse("0.2 - 0.1*s", "s").expect("good");
    let width = Profile::Table { at: vec![At::Fraction(0.0), At::Fraction(0.5)], value: vec![0.1, 0.3] };
    let varying = section(Shape::Rectangle { width, height: Profile::Function(height) });
    assert!(!is_uniform(&varying) && is_uniform(&rectangle(1.0, 2.0)));
    assert_eq!(section_breaks(&varying, 2.0), vec![1.0]);
    let here = compliance(&varying, Some(&steel()), SLENDER, 0.5, 2.0).expect("good");
    let same = compliance(&rectangle(0.2, 0.15), Some(&steel()), SLENDER, 0.0, 1.0).expect("good");
    assert!((here.to_matrix() - same.to_matrix()).norm() < 1e-14 * same.to_matrix().norm());
    let error = compliance(&varying, Some(&steel()), SLENDER, 2.0, 2.0).unwrap_err();
    assert_eq!(error, SectionError::NotPositive { what: "height", value: 0.0, s: 2.0 });
    assert_relative(mass_per_length(&varying, Some(&steel()), 0.5, 2.0).expect("good"), 7850.0 * 0.03, 1e-14);
    assert_eq!(mass_per_length(&varying, None, 0.5, 2.0), Ok(0.0));
}

#[test]
fn simple_loads_have_the_stresses_of_the_textbook() {
    let stress = |section: &Section, force: f64, moment: [f64; 3]| {
        let force = Vector3::new(force, 0.0, 0.0);
        peak_stress(section, Some(&steel()), 0.0, 1.0, &force, &moment.into()).expect("a solid")
    };
    let r = rectangle(0.1, 0.02);
    let pull = stress(&r, -30.0, [0.0; 3]);
    assert_relative(pull.axial, -30.0 / 0.002, 1e-15);
    assert_relative(pull.von_mises, 30.0 / 0.002, 1e-15);
    assert_relative(pull.strain, 30.0 / 0.002 / 207e9, 1e-15);
    assert_eq!(pull.bending_strain, 0.0);
    let bend = stress(&r, 0.0, [0.0, 5.0, 0.0]);
    assert_relative(bend.bending, 6.0 * 5.0 / (0.1 * 0.02 * 0.02), 1e-14);
    assert_relative(bend.von_mises, bend.bending, 1e-15);
    assert_relative(bend.strain, bend.bending / 207e9, 1e-15);
    let bend = stress(&r, 0.0, [0.0, 0.0, 5.0]);
    assert_relative(bend.bending, 6.0 * 5.0 / (0.02 * 0.1 * 0.1), 1e-14);
    // Thin strip: 3 M/(a b²) as a/b grows; square: M/(0.208 a³) (Timoshenko and Goodier, art. 109).
    let thin = stress(&rectangle(1.0, 1e-4), 0.0, [1.0, 0.0, 0.0]);
    assert_relative(thin.torsion, 3.0 / 1e-8, 1e-4);
    let square = stress(&rectangle(0.1, 0.1), 0.0, [1.0, 0.0, 0.0]);
    assert_relative(square.torsion, 1.0 / (0.208 * 1e-3), 1e-3);
    assert_relative(square.von_mises, square.torsion * 3f64.sqrt(), 1e-15);
    let oval = stress(&ellipse(0.2, 0.1), 0.0, [1.0, 0.0, 0.0]);
    assert_relative(oval.torsion, 2.0 / (PI * 0.1 * 0.05 * 0.05), 1e-14);
    let tube = section(Shape::Tube { outer_diameter: 0.1.into(), inner_diameter: 0.08.into() });
    let both = stress(&tube, 0.0, [3.0, 4.0, 0.0]);
    let i = PI / 64.0 * (0.1f64.powi(4) - 0.08f64.powi(4));
    assert_relative(both.torsion, 3.0 * 0.05 / (2.0 * i), 1e-14);
    assert_relative(both.bending, 4.0 * 0.05 / i, 1e-14);
    assert_relative(both.von_mises, both.bending.hypot(3f64.sqrt() * both.torsion), 1e-14);
}

#[test]
fn the_weighted_strip_has_its_surface_strain() {
    // κ h/2 at mid-length of the strip of 20.32 x 0.254 x 152.4 mm that carries 50 g: 621.664 µε.
    let curvature = 621.664e-6 / 0.127e-3;
    let strip = rectangle(20.32e-3, 0.254e-3);
    let stiff = stiffness(&strip, Some(&steel()), 0.0, 1.0).expect("good");
    let moment = Vector3::new(0.0, stiff[(4, 4)] * curvature, 0.0);
    let force = Vector3::new(0.49, 0.0, 0.0);
    let found = peak_stress(&strip, Some(&steel()), 0.0, 1.0, &force, &moment).expect("a solid");
    assert_relative(found.bending_strain, 621.664e-6, 1e-14);
    assert_relative(found.strain, 621.664e-6 + 0.49 / stiff[(0, 0)], 1e-14);
}

#[test]
fn plane_strain_keeps_the_stress_and_lowers_the_strain() {
    let mut strip = rectangle(20e-3, 0.25e-3);
    let moment = Vector3::new(0.0, 1e-2, 0.0);
    let at =
        |s: &Section| peak_stress(s, Some(&steel()), 0.0, 1.0, &Vector3::zeros(), &moment).expect("solid");
    let plain = at(&strip);
    strip.plane_strain = true;
    let plate = at(&strip);
    let nu: f64 = 207.0 / (2.0 * 79.3) - 1.0;
    assert_eq!(plate.bending, plain.bending);
    assert_relative(plate.strain, plain.strain * (1.0 - nu * nu), 1e-14);
    assert_relative(plate.von_mises, plain.von_mises * (1.0 - nu + nu * nu).sqrt(), 1e-14);
}

#[test]
fn outlines_have_the_size_of_the_section() {
    let corners = outline(&rectangle(0.2, 0.1), 0.0, 1.0).expect("a solid");
    assert_eq!(corners, vec![[-0.1, -0.05], [0.1, -0.05], [0.1, 0.05], [-0.1, 0.05]]);
    let area = |p: &[[f64; 2]]| -> f64 {
        (0..p.len())
            .map(|i| {
                let (a, b) = (p[i], p[(i + 1) % p.len()]);
                0.5 * (a[0] * b[1] - a[1] * b[0])
            })
            .sum()
    };
    let oval = outline(&ellipse(0.4, 0.2), 0.0, 1.0).expect("a solid");
    assert_relative(area(&oval), PI * 0.2 * 0.1, 4e-3);
}

/// Σ cosh(nπy/b)/(n² cosh(nπa/2b)), n odd, b = 1.
fn series(a: f64, y: f64) -> f64 {
    let mut sum = 0.0;
    for n in (1..400).step_by(2).map(f64::from) {
        let grow = |x: f64| 1.0 + (-2.0 * n * PI * x).exp();
        let term = (n * PI * (y - 0.5 * a)).exp() * grow(y) / grow(0.5 * a) / (n * n);
        sum += term;
        if term < 1e-9 {
            break;
        }
    }
    sum
}

proptest! {
    #[test]
    fn ellipses_find_the_worst_point_of_their_boundary(
        a in 0.01..0.3f64, b in 0.01..0.3f64, axial in -1e3..1e3, m1 in -10.0..10.0f64, m2 in -10.0..10.0f64, m3 in -10.0..10.0f64,
    ) {
        let force = Vector3::new(axial, 0.0, 0.0);
        let found = peak_stress(&ellipse(2.0 * a, 2.0 * b), Some(&steel()), 0.0, 1.0, &force, &Vector3::new(m1, m2, m3))
            .expect("a solid");
        let mut worst = 0.0f64;
        for i in 0..20_000 {
            let (s, c) = (2.0 * PI * f64::from(i) / 20_000.0).sin_cos();
            let (y, z) = (a * c, b * s);
            let sigma = axial / (PI * a * b) + m2 * z / (PI / 4.0 * a * b.powi(3)) - m3 * y / (PI / 4.0 * b * a.powi(3));
            // Timoshenko and Goodier, art. 105: τ12 = -2 M z/(π a b³), τ13 = 2 M y/(π a³ b).
            let tau = (2.0 * m1 * z / (PI * a * b.powi(3))).hypot(2.0 * m1 * y / (PI * a.powi(3) * b));
            worst = worst.max((sigma * sigma + 3.0 * tau * tau).sqrt());
        }
        prop_assert!(found.von_mises >= worst * (1.0 - 1e-12) && found.von_mises <= worst * (1.0 + 1e-6));
    }

    #[test]
    fn rectangles_find_the_worst_point_of_their_sides(
        ratio in 1.0..100.0f64, axial in -3.0..3.0f64, shear in 0.0..3.0f64, s2 in -3.0..3.0f64, s3 in -3.0..3.0f64,
    ) {
        // Moments chosen by the stresses that they make, Pa.
        let (a, b) = (ratio, 1.0);
        let area = a * b;
        let (i2, i3) = (a / 12.0, a.powi(3) / 12.0);
        let (m2, m3) = (s2 * i2 / 0.5, s3 * i3 / (0.5 * a));
        let at = |m1: f64| {
            let force = Vector3::new(axial * area, 0.0, 0.0);
            peak_stress(&rectangle(a, b), Some(&steel()), 0.0, 1.0, &force, &Vector3::new(m1, m2, m3)).expect("solid")
        };
        // J cancels: the largest torsion shear scales the profile.
        let unit = at(1.0).torsion;
        let found = at(shear / unit);
        let middle = 1.0 - 8.0 / (PI * PI) * series(a, 0.0);
        let mut worst = 0.0f64;
        for i in 0..=4000 {
            let y = 0.5 * a * f64::from(i) / 4000.0;
            let tau = shear * (1.0 - 8.0 / (PI * PI) * series(a, y)) / middle;
            for (y, sign) in [(y, 1.0), (y, -1.0), (-y, 1.0), (-y, -1.0)] {
                let sigma = axial + sign * s2 - s3 * y / (0.5 * a);
                worst = worst.max((sigma * sigma + 3.0 * tau * tau).sqrt());
            }
        }
        // The short sides may be worse still, so only a bound from below is checked where they could be.
        prop_assert!(found.von_mises >= worst * (1.0 - 5e-3), "{} {worst}", found.von_mises);
        let short = (axial.abs() + s2.abs() + s3.abs()).hypot(3f64.sqrt() * 0.7425 * shear / middle);
        prop_assert!(found.von_mises <= worst.max(short) * (1.0 + 5e-3), "{} {worst}", found.von_mises);
    }

    #[test]
    fn turning_a_section_by_a_right_angle_turns_its_laws(
        width in 1e-4..1.0f64, height in 1e-4..1.0f64, m1 in -10.0..10.0f64, m2 in -10.0..10.0f64, m3 in -10.0..10.0f64,
    ) {
        for (here, turned) in [
            (rectangle(width, height), rectangle(height, width)),
            (ellipse(width, height), ellipse(height, width)),
        ] {
            let (c, t) = (diagonal(&here, SHEARABLE), diagonal(&turned, SHEARABLE));
            for (i, j) in [(0, 0), (1, 2), (2, 1), (3, 3), (4, 5), (5, 4)] {
                prop_assert!((c[i] - t[j]).abs() <= 1e-14 * c[i]);
            }
            let force = Vector3::new(1.0, 0.0, 0.0);
            // e2 -> e3, e3 -> -e2.
            let (moment, other) = (Vector3::new(m1, m2, m3), Vector3::new(m1, -m3, m2));
            let a = peak_stress(&here, Some(&steel()), 0.0, 1.0, &force, &moment).expect("a solid");
            let b = peak_stress(&turned, Some(&steel()), 0.0, 1.0, &force, &other).expect("a solid");
            prop_assert!((a.von_mises - b.von_mises).abs() <= 1e-6 * a.von_mises);
            prop_assert!((a.torsion - b.torsion).abs() <= 1e-13 * a.torsion);
            prop_assert!((a.strain - b.strain).abs() <= 1e-6 * a.strain);
        }
    }
}
