//! Nested dissection: in which order blocks of unknowns are eliminated.
//!
//! A set of blocks is cut in two along its longest extent near the median. The blocks on one side that touch the
//! other side are its separator; they are eliminated after both sides, which then know nothing of each other.
//! Each side is cut again, until few unknowns are left (A. George, "Nested dissection of a regular finite element
//! mesh", SIAM J. Numer. Anal. 10 (1973) 345-363). On a plane lattice the numbers in the factors grow like
//! n log n and the work like n^1.5.
//!
//! Where places say nothing of the graph, the distance from an outermost block takes the part of the coordinate.
//!
//! Absent: refinement of separators (Kernighan-Lin, minimal vertex cover), multilevel partitioning, minimum degree.

/// Sets of at most so many unknowns are not cut. Below it fronts get so small that their bookkeeping costs more
/// than the zeros which they no longer hold.
const LEAF: usize = 32;
/// Separators that hold more than this part of the unknowns of a set are compared with a cut by distance.
const POOR: f64 = 0.25;
/// A cut leaves at least this part of the unknowns on either side.
const BALANCE: f64 = 0.4;
const NOT_IN_SET: u8 = 0;

/// Blocks of unknowns, how many each holds, where it stands and which others it touches.
#[derive(Debug, Default)]
pub(super) struct Graph {
    pub starts: Vec<usize>,
    pub neighbours: Vec<u32>,
    pub weights: Vec<u32>,
    pub places: Vec<[f64; 3]>,
}

impl Graph {
    /// The blocks that block `i` touches, without itself.
    pub fn neighbours(&self, i: u32) -> &[u32] {
        &self.neighbours[self.starts[i as usize]..self.starts[i as usize + 1]]
    }
}

/// Groups of blocks in the order of their elimination: leaves and separators.
pub(super) fn dissect(graph: &Graph) -> Vec<Vec<u32>> {
    let n = graph.weights.len();
    let mut dissection =
        Dissection { graph, side: vec![NOT_IN_SET; n], level: vec![f64::INFINITY; n], groups: Vec::new() };
    dissection.split((0..n as u32).collect());
    dissection.groups
}

struct Dissection<'a> {
    graph: &'a Graph,
    /// 1 or 2 for the blocks of the set that is being cut.
    side: Vec<u8>,
    /// Distance from the outermost block; infinite between uses.
    level: Vec<f64>,
    groups: Vec<Vec<u32>>,
}

/// Blocks in order of a key, the number that go to the first side, and the separator.
struct Cut {
    order: Vec<u32>,
    first: usize,
    /// The side that holds the separator.
    side: u8,
    weight: usize,
}

impl Dissection<'_> {
    /// Every cut leaves at most about 1 - `BALANCE` of the unknowns on a side, so this goes no deeper than a few
    /// times log n.
    fn split(&mut self, set: Vec<u32>) {
        let total = self.weight(&set);
        if total <= LEAF || set.len() < 2 {
            if !set.is_empty() {
                self.groups.push(set);
            }
            return;
        }
        let mut cut = self.cut(&set, total, self.coordinates(&set));
        if cut.as_ref().is_none_or(|cut| cut.weight as f64 > POOR * total as f64) {
            let levels = self.levels(&set);
            let other = self.cut(&set, total, Some(levels));
            if let Some(other) = other
                && cut.as_ref().is_none_or(|cut| other.weight < cut.weight)
            {
                cut = Some(other);
            }
        }
        let Some(Cut { order, first, side, .. }) = cut else {
            self.groups.push(set);
            return;
        };
        drop(set);
        self.mark(&order, first);
        let (mut sides, mut separator) = ([Vec::new(), Vec::new()], Vec::new());
        for &i in &order {
            if self.side[i as usize] == side && self.touches(i, 3 - side) {
                separator.push(i);
            } else {
                sides[usize::from(self.side[i as usize] - 1)].push(i);
            }
        }
        self.unmark(&order);
        drop(order);
        let [one, other] = sides;
        self.split(one);
        self.split(other);
        if !separator.is_empty() {
            separator.sort_unstable();
            self.groups.push(separator);
        }
    }

    fn weight(&self, set: &[u32]) -> usize {
        set.iter().map(|&i| self.graph.weights[i as usize] as usize).sum()
    }

    fn mark(&mut self, order: &[u32], first: usize) {
        for (k, &i) in order.iter().enumerate() {
            self.side[i as usize] = if k < first { 1 } else { 2 };
        }
    }

    fn unmark(&mut self, order: &[u32]) {
        for &i in order {
            self.side[i as usize] = NOT_IN_SET;
        }
    }

    fn touches(&self, i: u32, side: u8) -> bool {
        self.graph.neighbours(i).iter().any(|&j| self.side[j as usize] == side)
    }

    /// The coordinates along the longest extent, if there is one.
    fn coordinates(&self, set: &[u32]) -> Option<Vec<f64>> {
        let places = &self.graph.places;
        let extent = |axis: usize| {
            let (low, high) = set.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &i| {
                let x = places[i as usize][axis];
                (low.min(x), high.max(x))
            });
            high - low
        };
        let extents = [extent(0), extent(1), extent(2)];
        let axis = (1..3).fold(0, |best, k| if extents[k] > extents[best] { k } else { best });
        (extents[axis] > 0.0 && extents.iter().all(|e| e.is_finite()))
            .then(|| set.iter().map(|&i| places[i as usize][axis]).collect())
    }

    /// The distances of the blocks from an outermost one; parts that do not hang together follow one another.
    fn levels(&mut self, set: &[u32]) -> Vec<f64> {
        self.mark(set, set.len());
        let mut reached: Vec<u32> = Vec::with_capacity(set.len());
        for &start in set {
            if self.level[start as usize].is_finite() {
                continue;
            }
            // The last block that a search reaches is at an end of its part.
            let first = reached.len();
            let base = reached.last().map_or(0.0, |&i| self.level[i as usize] + 1.0);
            self.search(start, base, &mut reached);
            if let Some(&end) = reached.last() {
                for &i in &reached[first..] {
                    self.level[i as usize] = f64::INFINITY;
                }
                reached.truncate(first);
                self.search(end, base, &mut reached);
            }
        }
        let levels = set.iter().map(|&i| self.level[i as usize]).collect();
        for &i in set {
            self.level[i as usize] = f64::INFINITY;
        }
        self.unmark(set);
        levels
    }

    /// Breadth-first search from `start` within the marked set.
    fn search(&mut self, start: u32, base: f64, reached: &mut Vec<u32>) {
        let mut next = reached.len();
        self.level[start as usize] = base;
        reached.push(start);
        while let Some(&i) = reached.get(next) {
            next += 1;
            for &j in self.graph.neighbours(i) {
                if self.side[j as usize] != NOT_IN_SET && self.level[j as usize] == f64::INFINITY {
                    self.level[j as usize] = self.level[i as usize] + 1.0;
                    reached.push(j);
                }
            }
        }
    }

    /// Cuts in order of the keys: at the middle, or beside it where the keys leave a gap, so that the columns of
    /// a lattice stay whole.
    fn cut(&mut self, set: &[u32], total: usize, keys: Option<Vec<f64>>) -> Option<Cut> {
        let keys = keys?;
        let mut numbers: Vec<u32> = (0..set.len() as u32).collect();
        numbers.sort_unstable_by(|&a, &b| {
            keys[a as usize].total_cmp(&keys[b as usize]).then(set[a as usize].cmp(&set[b as usize]))
        });
        // (blocks before, distance from the middle, gap)
        let mut candidates: Vec<(usize, f64, f64)> = Vec::new();
        let (mut before, mut nearest) = (0, (0, f64::INFINITY));
        for k in 1..numbers.len() {
            before += self.graph.weights[set[numbers[k - 1] as usize] as usize] as usize;
            let off = (before as f64 / total as f64 - 0.5).abs();
            if off < nearest.1 {
                nearest = (k, off);
            }
            if off <= 0.5 - BALANCE {
                candidates.push((k, off, keys[numbers[k] as usize] - keys[numbers[k - 1] as usize]));
            }
        }
        let widest = candidates.iter().fold(0.0_f64, |m, c| m.max(c.2));
        if widest > 0.0 {
            nearest.1 = f64::INFINITY;
            for &(k, off, gap) in &candidates {
                if gap >= 0.5 * widest && off < nearest.1 {
                    nearest = (k, off);
                }
            }
        }
        let first = nearest.0;
        let order: Vec<u32> = numbers.iter().map(|&k| set[k as usize]).collect();
        self.mark(&order, first);
        let mut weights = [0, 0];
        for &i in &order {
            let side = self.side[i as usize];
            if self.touches(i, 3 - side) {
                weights[usize::from(side - 1)] += self.graph.weights[i as usize] as usize;
            }
        }
        self.unmark(&order);
        let side = if weights[0] <= weights[1] { 1 } else { 2 };
        Some(Cut { order, first, side, weight: weights[0].min(weights[1]) })
    }
}
