//! The widths for which the kernels are compiled, here and nowhere else.
//!
//! A generic function is compiled again in every crate that calls it; these kernels are long, and there is one of each
//! for every width, law and processor. As methods of a trait that is implemented for single widths they are compiled
//! once, in this crate, and whoever calls them is built in seconds.

use super::propagate::{self, Piece, RodState};
use super::tendon::{self, Channel, Tension};
use super::tubes::{self, TubePiece, TubeState};

/// A state of a width that the rod's kernels are compiled for: 1, 4, 8, 12, 16 or 24.
pub trait RodKernel<const W: usize> {
    /// See [`advance`].
    fn carry(&mut self, piece: &Piece, load: f64);
    /// See [`advance_tendons`].
    fn carry_tendons(
        &mut self,
        piece: &Piece,
        channels: &[Channel],
        tensions: &[Tension<W>],
        load: f64,
        lengths: &mut [[f64; W]],
    );
}

/// A state of a width that the kernel of concentric tubes is compiled for: 1, 16 or 20.
pub trait TubeKernel {
    /// See [`advance_tubes`].
    fn carry(&mut self, piece: &TubePiece, load: f64);
}

macro_rules! rod_widths {
    ($($width:literal),+) => {$(
        impl RodKernel<$width> for RodState<$width> {
            fn carry(&mut self, piece: &Piece, load: f64) {
                propagate::advance(piece, load, self);
            }

            fn carry_tendons(
                &mut self,
                piece: &Piece,
                channels: &[Channel],
                tensions: &[Tension<$width>],
                load: f64,
                lengths: &mut [[f64; $width]],
            ) {
                tendon::advance_tendons(piece, channels, tensions, load, self, lengths);
            }
        }
    )+};
}

macro_rules! tube_widths {
    ($($width:literal),+) => {$(
        impl TubeKernel for TubeState<$width> {
            fn carry(&mut self, piece: &TubePiece, load: f64) {
                tubes::advance_tubes(piece, load, self);
            }
        }
    )+};
}

rod_widths!(1, 4, 8, 12, 16, 24);
tube_widths!(16);
#[cfg(test)]
tube_widths!(1, 20);
#[cfg(test)]
rod_widths!(20);

/// Takes `state` from the start of `piece` to its end under `load` times its distributed loads.
#[inline]
pub fn advance<const W: usize>(piece: &Piece, load: f64, state: &mut RodState<W>)
where
    RodState<W>: RodKernel<W>,
{
    state.carry(piece, load);
}

/// Takes `state` from the start of `piece` to its end, with tendons in `channels`, under `load` times the
/// distributed loads and the full `tensions`, and adds to `lengths` what each tendon measures in the piece.
///
/// `state` holds the wrench of rod and tendons together. At the end of a channel the tendon's straight
/// part, or its anchor, pulls on rod and tendon as on any point of the section: the wrench jumps by
/// the tension along that straight part; at an anchor nothing jumps.
///
/// Where no strain is found (a tendon shrunk to nothing) the state becomes NaN.
#[inline]
pub fn advance_tendons<const W: usize>(
    piece: &Piece,
    channels: &[Channel],
    tensions: &[Tension<W>],
    load: f64,
    state: &mut RodState<W>,
    lengths: &mut [[f64; W]],
) where
    RodState<W>: RodKernel<W>,
{
    state.carry_tendons(piece, channels, tensions, load, lengths);
}

/// Takes `state` from the start of `piece` to its end under `load` times its distributed loads. The angle
/// and torque of a tube that is not there do not change.
///
/// At the end of a tube only its own torque must have come to zero: its last moment in bending passes to the other
/// tubes. Wrenches at points, at such ends too, are added to `state.rod` by the caller.
#[inline]
pub fn advance_tubes<const W: usize>(piece: &TubePiece, load: f64, state: &mut TubeState<W>)
where
    TubeState<W>: TubeKernel,
{
    state.carry(piece, load);
}
