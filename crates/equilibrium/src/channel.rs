//! A cable's channel along a span: a tendon.

use crate::beam::{BeamLaw, stage};
use flexura_mechanics::ode::STAGES;
use flexura_mechanics::rod::{Channel, ChannelSample};
use flexura_model::Profile;
use flexura_spatial::Vector3;

/// The part of a channel that lies in one span.
#[derive(Clone, Debug)]
pub(crate) struct TendonChannel {
    /// Position in the span's list of tendons.
    pub tendon: usize,
    /// First and last arc length, m.
    pub s: [f64; 2],
    route: Route,
    /// Largest distance from the axis, nondimensional.
    pub reach: f64,
    /// Arc lengths (m) at which it begins, ends or is not smooth.
    breaks: Vec<f64>,
    /// m to a nondimensional length of one.
    unit: f64,
    /// How fast it winds or swings about the axis, radians or so per nondimensional length.
    pub rate: f64,
}

/// Where a channel runs in the sections of its beam.
#[derive(Clone, Debug)]
pub(crate) struct Route {
    /// y and z against s, m.
    pub offset: [Profile; 2],
    /// Undeformed length of the beam, m.
    pub length: f64,
}

impl Route {
    /// Offset (m) and slope at `s`.
    pub fn at(&self, s: f64) -> ChannelSample {
        let [y, z] = &self.offset;
        ChannelSample {
            offset: [y.value(s, self.length), z.value(s, self.length)],
            slope: [y.slope(s, self.length), z.slope(s, self.length)],
        }
    }

    /// The offset in the section's axes, m.
    pub fn point(&self, s: f64) -> Vector3<f64> {
        let [y, z] = self.at(s).offset;
        Vector3::new(0.0, y, z)
    }

    pub fn is_uniform(&self) -> bool {
        self.offset.iter().all(|profile| profile.as_constant().is_some())
    }

    /// The forward part of w = ν + k × d + d' in the undeformed beam; not positive where the channel would run
    /// backwards.
    pub fn advance_at_rest(&self, law: &BeamLaw, s: f64) -> Vector3<f64> {
        let ChannelSample { offset: [y, z], slope: [dy, dz] } = self.at(s);
        Vector3::x() + law.shape.curvature(s).cross(&Vector3::new(0.0, y, z)) + Vector3::new(0.0, dy, dz)
    }

    /// Length in the undeformed beam between `a` and `b`, m.
    pub fn rest_length(&self, law: &BeamLaw, [a, b]: [f64; 2]) -> f64 {
        const PARTS: usize = 64;
        let mut cuts = law.breaks().to_vec();
        self.offset.iter().for_each(|profile| cuts.extend(profile.breaks(self.length)));
        cuts.retain(|s| *s > a && *s < b);
        cuts.push(b);
        cuts.sort_by(f64::total_cmp);
        let (mut from, mut sum) = (a, 0.0);
        for to in cuts {
            let h = (to - from) / PARTS as f64;
            for i in 0..PARTS {
                for (node, weight) in crate::extract::GAUSS {
                    sum += h * weight * self.advance_at_rest(law, from + h * (i as f64 + node)).norm();
                }
            }
            from = to;
        }
        sum
    }
}

impl TendonChannel {
    pub fn new(law: &BeamLaw, tendon: usize, route: Route, s: [f64; 2]) -> Self {
        const PLACES: usize = 65;
        let step = (s[1] - s[0]) / PLACES as f64;
        let samples: Vec<ChannelSample> =
            (0..PLACES).map(|i| route.at(s[0] + step * (i as f64 + 0.5))).collect();
        let size = |[y, z]: [f64; 2]| y.hypot(z);
        let largest = |f: &dyn Fn(&ChannelSample) -> f64| samples.iter().map(f).fold(0.0, f64::max);
        let (reach, slope) = (largest(&|c| size(c.offset)), largest(&|c| size(c.slope)));
        let bend = samples
            .windows(2)
            .map(|pair| {
                size([pair[1].slope[0] - pair[0].slope[0], pair[1].slope[1] - pair[0].slope[1]]) / step
            })
            .fold(0.0, f64::max);
        let per = |a: f64, b: f64| if b > 0.0 { a / b } else { 0.0 };
        let rate = per(slope, reach).max(per(bend, slope)) * law.scale.length;
        let mut breaks = s.to_vec();
        route.offset.iter().for_each(|profile| breaks.extend(profile.breaks(route.length)));
        breaks.retain(|place| *place >= s[0] && *place <= s[1]);
        Self { tendon, s, route, breaks, reach: reach / law.scale.length, unit: law.scale.length, rate }
    }

    /// Does it run at the same place of every section?
    pub fn is_even(&self) -> bool {
        self.route.is_uniform()
    }

    /// How far offset (in parts of the reach) and slope may stray between two arc lengths without that a few places show it.
    pub fn hidden(&self, [a, b]: [f64; 2]) -> [f64; 2] {
        let variations = || self.route.offset.iter().filter_map(|profile| profile.variation(a, b));
        let offset: f64 = variations().map(|v| v.hidden()).sum();
        let reach = self.reach * self.unit;
        [if reach > 0.0 { offset / reach } else { 0.0 }, variations().map(|v| v.hidden_slope()).sum()]
    }

    /// Does the stretch between `a` and `b` lie in it?
    pub fn holds(&self, [a, b]: [f64; 2]) -> bool {
        let middle = 0.5 * (a + b);
        self.s[0] < middle && middle < self.s[1]
    }

    pub fn breaks(&self) -> &[f64] {
        &self.breaks
    }

    /// Offset (m) and slope at `s`.
    pub fn at(&self, s: f64) -> ChannelSample {
        self.route.at(s)
    }

    /// What the kernel reads of it, nondimensional, from `a` to `b` in `steps`.
    pub fn samples(&self, law: &BeamLaw, [a, b]: [f64; 2], steps: usize) -> Channel {
        let count = if self.route.is_uniform() { 1 } else { steps * STAGES };
        let at = |i: usize| {
            let sample = self.route.at(stage(a, b, steps, i));
            ChannelSample { offset: sample.offset.map(|v| v / law.scale.length), ..sample }
        };
        Channel { tendon: self.tendon, samples: (0..count).map(at).collect() }
    }
}
