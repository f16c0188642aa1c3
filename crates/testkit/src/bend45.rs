//! The 45-degree bend of Bathe and Bolourchi: an arc, clamped, under a transverse tip force.
//!
//! R = 100, a 1 x 1 section, E = 1e7, ν = 0, so EA = 1e7, EI = 1e7/12, GA = 5e6 (no shear coefficient),
//! GJ = 5e6 J. Clamped at the origin with start tangent +y, centre of the arc at (100, 0, 0), force along z.
//! The unit system is free (the sources use inches and pounds).
//!
//! Two torsion constants are in use: GJ = EI (J = 1/6, the polar moment) and Saint-Venant's J = 0.141.

use crate::rod::Rod;
use flexura_spatial::{Pose, Vector3, rotation_from_axes};
use std::f64::consts::FRAC_PI_4;

/// A published or converged result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reference {
    /// Force along z.
    pub load: f64,
    /// J.
    pub torsion_constant: f64,
    /// Tip displacement.
    pub displacement: Vector3<f64>,
    /// Converged to all printed digits for the true arc (coarse-mesh values are not).
    pub converged: bool,
    /// Where it comes from.
    pub source: &'static str,
}

/// Results for P = 600.
pub const REFERENCES: [Reference; 4] = [
    Reference {
        load: 600.0,
        torsion_constant: 1.0 / 6.0,
        displacement: Vector3::new(-13.6045, -23.5602, 53.4749),
        converged: true,
        source: "true arc, GJ = EI, converged (checked here by collocation)",
    },
    Reference {
        load: 600.0,
        torsion_constant: 0.141,
        displacement: Vector3::new(-13.7290, -23.8139, 53.6049),
        converged: true,
        source: "true arc, J = 0.141, converged (checked here by collocation)",
    },
    Reference {
        load: 600.0,
        torsion_constant: 1.0 / 6.0,
        displacement: Vector3::new(15.79 - TIP_X, 47.23 - TIP_Y, 53.37),
        converged: false,
        source: "J. C. Simo and L. Vu-Quoc, Comput. Methods Appl. Mech. Eng. 58 (1986) 79: eight straight elements",
    },
    Reference {
        load: 600.0,
        torsion_constant: 1.0 / 6.0,
        displacement: Vector3::new(15.9 - TIP_X, 47.2 - TIP_Y, 53.4),
        converged: false,
        source: "K. J. Bathe and S. Bolourchi, Int. J. Numer. Meth. Eng. 14 (1979) 961: eight straight elements",
    },
];

const TIP_X: f64 = 29.289_321_881_345_254;
const TIP_Y: f64 = 70.710_678_118_654_76;

/// The undeformed rod: bends towards +e2.
pub fn rod(torsion_constant: f64) -> Rod {
    let bending = 12.0 / 1e7;
    Rod::uniform(
        100.0 * FRAC_PI_4,
        [1e-7, 2e-7, 2e-7, 1.0 / (5e6 * torsion_constant), bending, bending],
        Vector3::new(0.0, 0.0, 0.01),
    )
}

/// The clamp: e1 along +y, e2 towards the centre (+x), e3 along -z.
pub fn clamp() -> Pose {
    Pose::new(rotation_from_axes(&Vector3::y(), &Vector3::x(), &-Vector3::z()), Vector3::zeros())
}

/// The undeformed tip.
pub fn tip() -> Vector3<f64> {
    Vector3::new(TIP_X, TIP_Y, 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::assert_close_vec;
    use crate::ivp::rest_poses;

    #[test]
    fn the_undeformed_arc_ends_where_it_should() {
        let rest = clamp() * rest_poses(&rod(0.141), 16)[16].1;
        assert_close_vec(&rest.position, &tip(), 1e-12, "tip");
    }

    #[test]
    fn the_coarse_mesh_values_are_a_few_tenths_of_a_percent_off() {
        let exact = REFERENCES[0].displacement;
        for reference in REFERENCES.iter().filter(|r| !r.converged) {
            let off = (reference.displacement - exact).norm() / exact.norm();
            assert!((2e-3..5e-3).contains(&off), "{}: {off}", reference.source);
        }
    }
}
