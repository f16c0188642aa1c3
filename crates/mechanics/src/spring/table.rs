//! Force against elongation through measured points.

/// A curve through points that rises wherever they rise: cubic between them, once differentiable, straight on beyond
/// the last. Below the first it is zero if it starts from no force, else straight on as well.
///
/// The slopes at inner points are weighted harmonic means of those of the two chords, zero where these differ in sign (F. N. Fritsch and
/// J. Butland, *SIAM J. Sci. Stat. Comput.* 5 (1984) 300); at the ends the three-point formula, kept within the monotone
/// region of F. N. Fritsch and R. E. Carlson, *SIAM J. Numer. Anal.* 17 (1980) 238. This is what is known as PCHIP.
#[derive(Clone, Debug, PartialEq)]
pub struct MonotoneTable {
    points: Vec<Knot>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Knot {
    /// Elongation, m, and force, N.
    x: f64,
    force: f64,
    /// N/m.
    slope: f64,
    /// Integral of the force from the first point, J.
    energy: f64,
}

impl MonotoneTable {
    /// Through rows of elongation (m, increasing) and force (N, nowhere falling). None for fewer than two rows or rows
    /// that do not increase.
    pub fn new(rows: &[[f64; 2]]) -> Option<Self> {
        let rising = |pair: &[[f64; 2]]| pair[1][0] > pair[0][0] && pair[1][1] >= pair[0][1];
        if rows.len() < 2 || !rows.windows(2).all(rising) {
            return None;
        }
        let widths: Vec<f64> = rows.windows(2).map(|pair| pair[1][0] - pair[0][0]).collect();
        let chords: Vec<f64> =
            rows.windows(2).zip(&widths).map(|(pair, width)| (pair[1][1] - pair[0][1]) / width).collect();
        let last = rows.len() - 1;
        let slope = |i: usize| match i {
            _ if last == 1 => chords[0],
            0 => end_slope([widths[0], widths[1]], [chords[0], chords[1]]),
            i if i == last => {
                end_slope([widths[last - 1], widths[last - 2]], [chords[last - 1], chords[last - 2]])
            }
            i => inner_slope([widths[i - 1], widths[i]], [chords[i - 1], chords[i]]),
        };
        let mut points: Vec<Knot> = Vec::with_capacity(rows.len());
        for (i, [x, force]) in rows.iter().copied().enumerate() {
            let mut knot = Knot { x, force, slope: slope(i), energy: 0.0 };
            if let Some(before) = points.last() {
                let width = x - before.x;
                let cubic = width / 12.0 * (before.slope - knot.slope);
                knot.energy = before.energy + width * (0.5 * (before.force + force) + cubic);
            }
            points.push(knot);
        }
        Some(Self { points })
    }

    /// Force, its derivative and its integral from the first point, at an elongation.
    pub fn at(&self, x: f64) -> (f64, f64, f64) {
        let (first, last) = (&self.points[0], &self.points[self.points.len() - 1]);
        if x < first.x {
            return if first.force == 0.0 { (0.0, 0.0, 0.0) } else { first.straight_on(x) };
        }
        if x >= last.x {
            return last.straight_on(x);
        }
        let i = self.points.partition_point(|knot| knot.x <= x);
        let (a, b) = (&self.points[i - 1], &self.points[i]);
        let h = b.x - a.x;
        let t = (x - a.x) / h;
        let rise = b.force - a.force;
        // The cubic a.force + h (c1 t + c2 t² + c3 t³).
        let [c1, c2, c3] =
            [a.slope, 3.0 * rise / h - 2.0 * a.slope - b.slope, a.slope + b.slope - 2.0 * rise / h];
        let force = a.force + h * t * (c1 + t * (c2 + t * c3));
        let slope = c1 + t * (2.0 * c2 + t * 3.0 * c3);
        let inner = t * (a.force + h * t * (c1 / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0)));
        (force, slope, a.energy + h * inner)
    }

    /// The elongation below which it carries nothing, if it starts from no force.
    pub fn slack_at(&self) -> Option<f64> {
        (self.points[0].force == 0.0).then(|| self.points[0].x)
    }

    /// The last elongation that was given, m.
    pub fn last(&self) -> f64 {
        self.points[self.points.len() - 1].x
    }

    /// An elongation without force: zero if there is none there, else the one where the force begins. None where the force
    /// vanishes nowhere.
    pub fn relaxed(&self) -> Option<f64> {
        let (force, ..) = self.at(0.0);
        if force == 0.0 {
            return Some(0.0);
        }
        let (first, last) = (&self.points[0], &self.points[self.points.len() - 1]);
        if first.force > 0.0 {
            return first.zero();
        }
        if last.force < 0.0 {
            return last.zero();
        }
        let (mut low, mut high) = (first.x, last.x);
        loop {
            let middle = 0.5 * (low + high);
            if middle <= low || middle >= high {
                return Some(low);
            }
            if self.at(middle).0 > 0.0 { high = middle } else { low = middle }
        }
    }
}

impl Knot {
    fn straight_on(&self, x: f64) -> (f64, f64, f64) {
        let d = x - self.x;
        (self.force + self.slope * d, self.slope, self.energy + d * (self.force + 0.5 * self.slope * d))
    }

    fn zero(&self) -> Option<f64> {
        (self.slope > 0.0).then(|| self.x - self.force / self.slope)
    }
}

fn inner_slope(widths: [f64; 2], chords: [f64; 2]) -> f64 {
    if chords[0] * chords[1] <= 0.0 {
        return 0.0;
    }
    let (near, far) = (2.0 * widths[1] + widths[0], widths[1] + 2.0 * widths[0]);
    (near + far) / (near / chords[0] + far / chords[1])
}

/// At an end, from the interval there and the next.
fn end_slope(widths: [f64; 2], chords: [f64; 2]) -> f64 {
    let slope = ((2.0 * widths[0] + widths[1]) * chords[0] - widths[0] * chords[1]) / (widths[0] + widths[1]);
    // Chords do not fall here, so that only too small and too large is to be guarded against.
    slope.clamp(0.0, 3.0 * chords[0])
}
