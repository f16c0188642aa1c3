//! The geometry of two surfaces that touch, in metres, over [`Scalar`].
//!
//! The outward unit normals are n of the parent B, in F's axes, and m of the child A, in M's. In contact the points coincide
//! and the normals oppose, or agree where the child lies within the parent's hollow:
//!
//! ```text
//!   R m = -σ n        p = x_B - R x_A        σ = 1 outside, σ = -1 within
//! ```
//!
//! One of the surfaces, the *host*, may be any; the other must be curved in both directions, so that its place is known
//! from its normal, x = x(normal) with the rate G = dx/dnormal, the inverse of the shape operator S. R and the host's place
//! are then free.

use crate::joint::ContactError;
use flexura_geometry::dual::vector::{Rows, Triple, back, cross, difference, scaled, sum, tangents, turned};
use flexura_geometry::dual::{Dual, Scalar};
use flexura_geometry::{Curvatures, ImplicitSurface, eigenvalues};
use flexura_model::Surfaces;

/// Two surfaces, and how they lie to each other.
#[derive(Clone, Debug)]
pub struct TouchingLaw {
    pub(super) child: ImplicitSurface,
    pub(super) parent: ImplicitSurface,
    /// σ.
    pub(super) sense: f64,
    pub(super) host: Host,
}

/// Whose place is a coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Host {
    Child,
    Parent,
}

/// A contact.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place<T> {
    /// x_A in M's axes.
    pub child: Triple<T>,
    /// x_B in F's axes.
    pub parent: Triple<T>,
    /// m in M's axes.
    pub child_normal: Triple<T>,
    /// n in F's axes.
    pub normal: Triple<T>,
    /// R x_A.
    pub arm: Triple<T>,
}

impl<T: Scalar> Place<T> {
    /// Of M's origin in F.
    pub fn position(&self) -> Triple<T> {
        difference(&self.parent, &self.arm)
    }
}

pub(super) fn axis<T: Scalar>(i: usize) -> Triple<T> {
    std::array::from_fn(|k| T::from(if k == i { 1.0 } else { 0.0 }))
}

/// The rows of R, which turns by ω (in F's axes) along the one direction: Ṙ = hat(ω) R.
pub(super) fn turning(rotation: &Rows<f64>, omega: &Triple<f64>) -> Rows<Dual<1>> {
    let column = |j: usize| [rotation[0][j], rotation[1][j], rotation[2][j]];
    let rates = [0, 1, 2].map(|j| cross(omega, &column(j)));
    std::array::from_fn(|i| std::array::from_fn(|j| Dual::new(rotation[i][j], [rates[j][i]])))
}

impl TouchingLaw {
    /// # Errors
    /// [`ContactError`]: surfaces that make no sense, or that may touch along a line.
    pub fn new(surfaces: &Surfaces) -> Result<Self, ContactError> {
        let made = |which, surface| {
            ImplicitSurface::new(surface).map_err(|source| ContactError::Surface { which, source })
        };
        let (child, parent) = (made("child", &surfaces.child)?, made("parent", &surfaces.parent)?);
        let host = match (child.is_rounded(), parent.is_rounded()) {
            (true, _) => Host::Parent,
            (false, true) => Host::Child,
            (false, false) => return Err(ContactError::NoneRounded),
        };
        Ok(Self { child, parent, sense: if surfaces.concave { -1.0 } else { 1.0 }, host })
    }

    /// The surfaces of child and parent.
    pub fn surfaces(&self) -> [&ImplicitSurface; 2] {
        [&self.child, &self.parent]
    }

    pub(super) fn hosting(&self) -> &ImplicitSurface {
        match self.host {
            Host::Child => &self.child,
            Host::Parent => &self.parent,
        }
    }

    /// The contact at a place of the host; None where the other surface has no such normal or has ended.
    pub(super) fn place<T: Scalar>(&self, rotation: &Rows<T>, host: &Triple<T>) -> Option<Place<T>> {
        let against = T::from(-self.sense);
        let (child, parent, child_normal, normal) = match self.host {
            Host::Parent => {
                let n = self.parent.normal(host);
                let m = scaled(against, &back(rotation, &n));
                (self.child.support(&m)?, *host, m, n)
            }
            Host::Child => {
                let m = self.child.normal(host);
                let n = scaled(against, &turned(rotation, &m));
                (*host, self.parent.support(&n)?, m, n)
            }
        };
        let arm = turned(rotation, &child);
        let ends = self.child.contains(&child.map(Scalar::value))
            && self.parent.contains(&parent.map(Scalar::value));
        ends.then_some(Place { child, parent, child_normal, normal, arm })
    }

    /// The velocity of M's origin (column `i` of H, its linear part): for i < 3 per turning e_i with the host's place kept, for
    /// the others per motion of the host's place along its tangent t_i, which is given in the host's axes.
    ///
    /// ```text
    ///   host B:  -e×Y - σ R G_A Rᵀ (e×n)       t + σ R G_A Rᵀ S_B t
    ///   host A:  -e×Y + G_B (e×n)             -R t - σ G_B R S_A t          Y = R x_A
    /// ```
    pub(super) fn column<T: Scalar>(
        &self,
        rotation: &Rows<T>,
        host: &Triple<T>,
        i: usize,
    ) -> Option<Triple<T>> {
        let place = self.place(rotation, host)?;
        let sense = T::from(self.sense);
        let zero = [T::from(0.0); 3];
        // How the contact moves with its body, and how the normal turns with the step.
        let (moved, turn) = match (self.host, i) {
            (_, 0..3) => {
                let e = axis::<T>(i);
                (difference(&zero, &cross(&e, &place.arm)), cross(&e, &place.normal))
            }
            (Host::Parent, _) => {
                let t = tangents(&place.normal)[i - 3];
                (t, difference(&zero, &self.parent.normal_rate(&place.parent, &t)))
            }
            (Host::Child, _) => {
                let t = tangents(&place.child_normal)[i - 3];
                let turn = turned(rotation, &self.child.normal_rate(&place.child, &t));
                (difference(&zero, &turned(rotation, &t)), scaled(-sense, &turn))
            }
        };
        let answer = match self.host {
            Host::Parent => {
                let rate =
                    self.child.support_rate(&place.child, &place.child_normal, &back(rotation, &turn))?;
                scaled(-sense, &turned(rotation, &rate))
            }
            Host::Child => self.parent.support_rate(&place.parent, &place.normal, &turn)?,
        };
        Some(sum(&moved, &answer))
    }

    /// How [`TouchingLaw::column`] `i` changes along the coordinate `j`, the tangents being carried along.
    pub(super) fn column_change(
        &self,
        rotation: &Rows<f64>,
        host: &Triple<f64>,
        i: usize,
        j: usize,
    ) -> Option<Triple<f64>> {
        let (omega, velocity) = if j < 3 {
            (axis(j), [0.0; 3])
        } else {
            ([0.0; 3], tangents(&self.hosting().normal(host))[j - 3])
        };
        let host = flexura_geometry::dual::vector::moving(host, &velocity);
        let column = self.column(&turning(rotation, &omega), &host, i)?;
        Some(column.map(|x| x.rates[0]))
    }

    /// Curvatures of child and parent added up, S_A + σ S_B, over the tangents at the contact: the gap opens in all directions
    /// where they are positive.
    pub(super) fn relative(&self, rotation: &Rows<f64>, place: &Place<f64>) -> Curvatures {
        let across = tangents(&place.normal);
        let own = self.child.shape(&place.child, &across.map(|t| back(rotation, &t)));
        let other = self.parent.shape(&place.parent, &across);
        eigenvalues(std::array::from_fn(|i| std::array::from_fn(|j| own[i][j] + self.sense * other[i][j])))
    }

    /// Does the child touch without cutting into the parent?
    pub(super) fn fits(&self, rotation: &Rows<f64>, place: &Place<f64>) -> bool {
        let relative = self.relative(rotation, place);
        relative.least > 1e-9 * relative.most
    }
}
