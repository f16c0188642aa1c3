//! Surfaces against closed forms, differences, and each other.

use super::*;
use crate::dual::Dual;
use crate::dual::vector::{constant, cross, moving, rates, sum, values};
use flexura_expression::Function;
use flexura_model::RevolutionProfile;
use std::f64::consts::{FRAC_PI_2, PI};

const AXES: [f64; 3] = [1.1, 0.8, 1.7];

fn made(surface: Surface) -> ImplicitSurface {
    ImplicitSurface::new(&surface).unwrap()
}

fn ellipsoid() -> ImplicitSurface {
    made(Surface::Ellipsoid { semi_axes: AXES.into() })
}

fn radius(text: &str, range: [f64; 2]) -> Surface {
    let radius = Function::parse(text, "z").unwrap();
    Surface::Revolution { profile: RevolutionProfile::Radius { radius, range } }
}

fn through(points: Vec<[f64; 2]>) -> Surface {
    Surface::Revolution { profile: RevolutionProfile::Points(points) }
}

/// Points of the ellipsoid, moved outwards by `bump` of the direction.
fn measured(bump: impl Fn(&[f64; 3]) -> f64, count: usize) -> Vec<Vector3<f64>> {
    let golden = PI * (3.0 - 5.0_f64.sqrt());
    (0..count)
        .map(|i| {
            let height = 1.0 - (2 * i + 1) as f64 / count as f64;
            let (sin, cos) = (golden * i as f64).sin_cos();
            let across = (1.0 - height * height).sqrt();
            let d = [across * cos, across * sin, height];
            let far = 1.0 + bump(&d);
            Vector3::from_fn(|i, _| far * AXES[i] * d[i])
        })
        .collect()
}

fn bump(d: &[f64; 3]) -> f64 {
    0.03 * d[0] - 0.02 * d[1] * d[2] + 0.02 * d[0] * d[0] * d[1] + 0.01 * d[2]
}

fn heights(bump: impl Fn(&[f64; 3]) -> f64, degree: usize) -> Surface {
    Surface::Heights { semi_axes: AXES.into(), points: measured(bump, 200), degree }
}

/// One of each kind, with its name.
fn all() -> Vec<(&'static str, ImplicitSurface)> {
    let pear = "sqrt(1.2 - z^2)*(1 + 0.15*z)";
    let end = 1.2_f64.sqrt();
    let vase: Vec<[f64; 2]> =
        [-1.0, -0.6, 0.0, 0.5, 1.1].map(|z: f64| [z, 1.3 - 0.2 * z - 0.4 * z * z]).into();
    vec![
        ("ellipsoid", ellipsoid()),
        ("cylinder", made(Surface::Cylinder { semi_axes: [0.7, 1.2] })),
        ("plane", made(Surface::Plane)),
        ("pear", made(radius(pear, [-end, end]))),
        ("barrel", made(radius("1 - 0.3*z^2", [-1.0, 0.8]))),
        ("vase", made(through(vase))),
        ("heights", made(heights(bump, 4))),
    ]
}

fn close(a: &[f64; 3], b: &[f64; 3], tolerance: f64, what: &str) {
    assert!(norm(&difference(a, b)) <= tolerance, "{what}: {a:?} {b:?}");
}

/// Fourth-order differences along v.
fn slope(f: impl Fn(f64) -> [f64; 3]) -> [f64; 3] {
    let h = 1e-3;
    let [p2, p1, m1, m2] = [2.0 * h, h, -h, -2.0 * h].map(f);
    std::array::from_fn(|i| (8.0 * (p1[i] - m1[i]) - (p2[i] - m2[i])) / (12.0 * h))
}

fn places(surface: &ImplicitSurface) -> Vec<[f64; 3]> {
    surface.places(&[0.3, -0.2, 0.4]).into_iter().step_by(17).collect()
}

#[test]
fn places_lie_on_the_surface_and_their_parameters_lead_back() {
    for (name, surface) in all() {
        for x in places(&surface) {
            assert!(surface.value(&x).abs() < 1e-13 && surface.contains(&x), "{name} {x:?}");
            close(&surface.point(surface.parameters(&x)).unwrap(), &x, 1e-13, name);
            let v = [0.3, -0.5, 0.2];
            let rate = surface.parameters_rate(&x, &v);
            let by_differences = slope(|s| {
                let [a, b] = surface.parameters(&sum(&x, &scaled(s, &v)));
                [a, b, 0.0]
            });
            close(&[rate[0], rate[1], 0.0], &by_differences, 1e-6, name);
        }
    }
}

#[test]
fn derivatives_are_derivatives() {
    let (v, w) = ([0.3, -0.7, 0.4], [0.5, 0.2, -0.6]);
    for (name, surface) in all() {
        for x in places(&surface) {
            let along = |s: f64| sum(&x, &scaled(s, &v));
            let gradient = slope(|s| [surface.value(&along(s)), 0.0, 0.0])[0];
            assert!((gradient - dot(&surface.gradient(&x), &v)).abs() < 1e-8, "{name}");
            close(&surface.hessian(&x, &v), &slope(|s| surface.gradient(&along(s))), 1e-7, name);
            // Dual numbers carry the third derivatives.
            let dual = surface.hessian(&moving(&x, &v), &constant::<Dual<1>>(&w));
            let by_differences = slope(|s| surface.hessian(&along(s), &w));
            if name != "vase" {
                close(&rates(&dual).into(), &by_differences, 2e-6, name);
            }
            let by_dual: [f64; 3] = rates(&surface.gradient(&moving(&x, &v))).into();
            close(&by_dual, &surface.hessian(&x, &v), 1e-13, name);
            // The shape operator against normals at neighbouring places.
            let n = surface.normal(&x);
            let t = tangents(&n)[0];
            let turn = slope(|s| surface.normal(&surface.along(&sum(&x, &scaled(s, &t)), &n).unwrap()));
            close(&surface.normal_rate(&x, &t), &turn, 1e-7, name);
        }
    }
}

#[test]
fn supports_are_found_with_their_rates() {
    for (name, surface) in all() {
        assert_eq!(surface.is_rounded(), !matches!(name, "cylinder" | "plane"), "{name}");
        if !surface.is_rounded() {
            assert!(surface.support(&[0.6, 0.0, 0.8]).is_none());
            continue;
        }
        for x in places(&surface) {
            let m = surface.normal(&x);
            let found = surface.support(&m).unwrap();
            close(&found, &x, 1e-12, name);
            let v = [0.2, 0.4, -0.3];
            let rate = surface.support_rate(&found, &m, &v).unwrap();
            close(&slope(|s| surface.support(&sum(&m, &scaled(s, &v))).unwrap()), &rate, 1e-6, name);
            // The rate of dual numbers is the same, and their rate of it its derivative.
            let dual = surface.support(&moving(&m, &v)).unwrap();
            close(&rates(&dual).into(), &rate, 1e-11, name);
            let w = constant::<Dual<1>>(&[0.5, -0.1, 0.2]);
            let second = surface.support_rate(&dual, &moving(&m, &v), &w).unwrap();
            let by_differences = slope(|s| {
                let m = sum(&m, &scaled(s, &v));
                surface.support_rate(&surface.support(&m).unwrap(), &m, &values(&w)).unwrap()
            });
            if name != "vase" {
                let size = norm(&by_differences);
                close(&rates(&second).into(), &by_differences, 1e-5 * (1.0 + size), name);
            }
            // It is the inverse of the shape operator.
            let t = tangents(&m)[1];
            let back = surface.support_rate(&found, &m, &surface.normal_rate(&found, &t)).unwrap();
            close(&back, &t, 1e-11, name);
        }
    }
}

/// Poles of a surface of revolution are places like others.
#[test]
fn poles_are_smooth() {
    for (name, surface) in all() {
        if !matches!(name, "ellipsoid" | "pear") {
            continue;
        }
        for z in [-1.0, 1.0] {
            let pole = surface.support(&[0.0, 0.0, z]).unwrap();
            assert!(pole[0] == 0.0 && pole[1] == 0.0 && (pole[2].abs() > 1.0), "{name} {pole:?}");
            close(&surface.normal(&pole), &[0.0, 0.0, z], 1e-12, name);
        }
    }
}

/// κ at the ends of the axes of an ellipsoid is a/b², a/c² (do Carmo, 3-3).
#[test]
fn curvatures_of_an_ellipsoid() {
    let [a, b, c] = AXES;
    let at_x = ellipsoid().curvatures(&[a, 0.0, 0.0]);
    let at_z = ellipsoid().curvatures(&[0.0, 0.0, -c]);
    for (found, expected) in [
        (at_x.most, a / (b * b)),
        (at_x.least, a / (c * c)),
        (at_z.most, c / (b * b)),
        (at_z.least, c / (a * a)),
    ] {
        assert!((found - expected).abs() < 1e-14);
    }
}

/// A meridian that is an ellipse makes an ellipsoid: the square of its radius is a parabola, which both the spline and the
/// series reproduce.
#[test]
fn a_turned_ellipse_is_an_ellipsoid() {
    let [a, c] = [0.8, 1.7];
    let reference = made(Surface::Ellipsoid { semi_axes: Vector3::new(a, a, c) });
    let points = (0..=8).map(|i| {
        let z = -c + 2.0 * c * f64::from(i) / 8.0;
        [z, a * (1.0 - (z / c).powi(2)).max(0.0).sqrt()]
    });
    for surface in [made(through(points.collect())), made(radius("0.8*sqrt(1-(z/1.7)^2)", [-c, c]))] {
        for x in reference.places(&[0.0; 3]) {
            let n = reference.normal(&x);
            close(&surface.support(&n).unwrap(), &x, 1e-12, "place");
            let (own, other) = (surface.curvatures(&x), reference.curvatures(&x));
            assert!((own.least - other.least).abs() + (own.most - other.most).abs() < 1e-9);
        }
    }
}

/// Points of an ellipsoid over another one, which a quadratic reaches exactly.
#[test]
fn heights_reproduce_an_ellipsoid() {
    let surface =
        Surface::Heights { semi_axes: Vector3::new(1.0, 0.9, 1.6), points: measured(|_| 0.0, 60), degree: 2 };
    let surface = made(surface);
    let fit = surface.fit().unwrap();
    assert!(fit.rms < 1e-14 && fit.largest < 1e-13 && fit.points == 60 && surface.is_rounded(), "{fit:?}");
    for x in ellipsoid().places(&[0.0; 3]) {
        let n = ellipsoid().normal(&x);
        close(&surface.support(&n).unwrap(), &x, 1e-12, "support");
        let (own, other) = (surface.curvatures(&x), ellipsoid().curvatures(&x));
        assert!((own.least - other.least).abs() + (own.most - other.most).abs() < 1e-11);
    }
}

/// A body that is no polynomial: the misfit at places between the points falls with the degree, and the rms says how large it is.
#[test]
fn heights_converge_to_a_body() {
    let body = |d: &[f64; 3]| 0.04 * (2.0 * d[0] + d[1]).sin() + 0.03 * (d[2] * d[0]).exp();
    let between = measured(body, 1777);
    let mut last = f64::INFINITY;
    for degree in [2, 4, 6, 8] {
        let surface = made(heights(body, degree));
        let rms = surface.fit().unwrap().rms;
        let distance = |p: &Vector3<f64>| {
            let p: [f64; 3] = (*p).into();
            norm(&difference(&p, &surface.foot(&p).unwrap()))
        };
        let square: f64 = between.iter().map(|p| distance(p).powi(2)).sum();
        let dense = (square / between.len() as f64).sqrt();
        assert!(dense < 0.25 * last && dense > 0.5 * rms && dense < 3.0 * rms, "{degree}: {dense} {rms}");
        last = dense;
    }
    assert!(last < 1e-5);
}

/// The foot of a point is where a sphere about it touches: the misfit is along the normal, and no other place is nearer.
#[test]
fn feet_are_the_nearest_places() {
    for (name, surface) in all() {
        for x in places(&surface) {
            for height in [-0.1, 0.0, 0.5, 4.0] {
                let n = surface.normal(&x);
                let p = sum(&x, &scaled(height, &n));
                let foot = surface.foot(&p).unwrap_or_else(|| panic!("{name} {x:?} {height}"));
                if surface.contains(&foot) && (name != "vase" || height >= 0.0) {
                    close(&foot, &x, 1e-9, name);
                }
                let arm = difference(&p, &foot);
                assert!(norm(&cross(&arm, &surface.normal(&foot))) < 1e-9, "{name}");
            }
        }
    }
    let beside = ellipsoid().along(&[1.5, 0.0, 0.0], &[0.0, 0.0, 1.0]);
    assert!(beside.is_none());
}

#[test]
fn nonsense_is_refused() {
    let error = |surface: Surface| ImplicitSurface::new(&surface).unwrap_err();
    let axes = Vector3::new(1.0, -2.0, 1.0);
    let wrong = SurfaceError::Axis { axis: "y", value: -2.0 };
    assert_eq!(error(Surface::Ellipsoid { semi_axes: axes }), wrong);
    assert_eq!(error(Surface::Heights { semi_axes: axes, points: vec![], degree: 2 }), wrong);
    assert!(matches!(
        error(Surface::Cylinder { semi_axes: [0.0, 1.0] }),
        SurfaceError::Axis { axis: "x", .. }
    ));
    let of = |points: Vec<Vector3<f64>>, degree| {
        error(Surface::Heights { semi_axes: AXES.into(), points, degree })
    };
    assert_eq!(of(measured(bump, 24), 4), SurfaceError::TooFewPoints { count: 24, needed: 25, degree: 4 });
    assert_eq!(of(measured(bump, 24), 13), SurfaceError::Degree { degree: 13, most: 12 });
    let far = of([measured(bump, 24), vec![Vector3::new(5.0, 0.0, 0.0)]].concat(), 2);
    assert!(
        matches!(far, SurfaceError::PointFar { index: 24, ratio, .. } if (ratio - 5.0 / 1.1).abs() < 1e-12)
    );
    let nowhere = of([measured(bump, 24), vec![Vector3::new(f64::NAN, 0.0, 0.0)]].concat(), 2);
    assert_eq!(nowhere, SurfaceError::PointNotFinite { index: 24 });
    let ring = (0..40).map(|i| {
        let (sin, cos) = f64::from(i).sin_cos();
        Vector3::new(AXES[0] * cos, AXES[1] * sin, 0.0)
    });
    assert_eq!(of(ring.collect(), 2), SurfaceError::Undetermined { degree: 2 });
    assert_eq!(error(through(vec![[0.0, 1.0]; 2])), SurfaceError::TooFewProfilePoints { count: 2 });
    assert_eq!(
        error(through(vec![[0.0, 1.0], [1.0, 1.0], [1.0, 0.5]])),
        SurfaceError::ProfileOrder { index: 1 }
    );
    assert!(matches!(
        error(through(vec![[0.0, 1.0], [1.0, -1.0], [2.0, 0.5]])),
        SurfaceError::Radius { z: 1.0, radius: -1.0 }
    ));
    assert!(matches!(error(radius("z", [-1.0, 1.0])), SurfaceError::Radius { z: -1.0, .. }));
    assert_eq!(error(radius("1", [1.0, 1.0])), SurfaceError::Range { from: 1.0, to: 1.0 });
    // Beyond the end of a profile no normal belongs to any place.
    let barrel = made(radius("1 - 0.3*z^2", [-1.0, 0.8]));
    let (sin, cos) = (FRAC_PI_2 - 0.1).sin_cos();
    assert!(barrel.support(&[cos, 0.0, sin]).is_none());
    let waist = made(radius("1 + 0.3*z^2", [-1.0, 0.8]));
    assert!(!waist.is_rounded() && waist.curvatures(&[1.0, 0.0, 0.0]).least < 0.0);
}
