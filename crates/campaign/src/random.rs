//! Random numbers that are the same everywhere.

/// SplitMix64 (G. L. Steele, D. Lea and C. H. Flood, *OOPSLA* 2014, 453). All that is drawn from it is made of integers and
/// of the four operations, which round alike on every machine: the same seed writes the same file.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// The sequence of a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    fn next(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number from 0 to `count` - 1; 0 where `count` is 0.
    pub fn below(&mut self, count: usize) -> usize {
        let drawn = self.next() >> 11;
        if count == 0 { 0 } else { (drawn % count as u64) as usize }
    }

    /// True in so many of a hundred cases.
    pub fn chance(&mut self, percent: usize) -> bool {
        self.below(100) < percent
    }

    /// One of a thousand values from `low` to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.below(1001) as f64 / 1000.0
    }

    /// Three digits times a power of ten from 10^`from` to 10^`to`.
    pub fn decade(&mut self, from: i32, to: i32) -> f64 {
        let digits = (100 + self.below(900)) as f64 / 100.0;
        digits * power_of_ten(from + self.below((to - from).max(0) as usize) as i32)
    }

    /// One of some.
    pub fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// +1 or -1.
    pub fn sign(&mut self) -> f64 {
        if self.chance(50) { 1.0 } else { -1.0 }
    }
}

/// 10^`exponent`, rounded once.
fn power_of_ten(exponent: i32) -> f64 {
    let power: f64 = (0..exponent.unsigned_abs()).map(|_| 10.0).product();
    if exponent < 0 { 1.0 / power } else { power }
}

/// A number as it stands in a file: four digits.
pub fn number(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.3e}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sequence_is_that_of_the_published_algorithm() {
        // First values of SplitMix64 from the seed 1234567 (its reference implementation in C).
        let mut random = Random::new(1_234_567);
        let values: Vec<u64> = (0..3).map(|_| random.next()).collect();
        assert_eq!(values, [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423]);
    }

    #[test]
    fn numbers_have_four_digits() {
        assert_eq!(number(1.23456e-7), "1.235e-7");
        assert_eq!(number(0.0), "0");
    }
}
