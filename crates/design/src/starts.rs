//! Designs from which is searched.

/// SplitMix64: equal seeds draw equal numbers on every machine (G. L. Steele, D. Lea, C. H. Flood, OOPSLA 2014).
struct Draw(u64);

impl Draw {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Between 0 and 1.
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// `count` points of the unit box in `dimensions`, spread as a Latin hypercube: along every axis each of `count` equal parts
/// holds one point.
pub fn spread(count: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut draw = Draw(seed);
    let mut points = vec![vec![0.0; dimensions]; count];
    for axis in 0..dimensions {
        let mut order: Vec<usize> = (0..count).collect();
        for i in (1..count).rev() {
            order.swap(i, (draw.next() % (i as u64 + 1)) as usize);
        }
        for (point, part) in points.iter_mut().zip(order) {
            point[axis] = (part as f64 + draw.unit()) / count as f64;
        }
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_every_axis_holds_one_start() {
        let points = spread(12, 3, 7);
        for axis in 0..3 {
            let mut parts: Vec<usize> = points.iter().map(|point| (point[axis] * 12.0) as usize).collect();
            parts.sort_unstable();
            assert_eq!(parts, (0..12).collect::<Vec<_>>());
        }
        assert_eq!(points, spread(12, 3, 7));
        assert_ne!(points, spread(12, 3, 8));
    }
}
