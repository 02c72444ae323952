//! Random numbers, mapped from generator words by arithmetic that is the same everywhere.

use planner_api::seed::unit;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// All randomness of a run.
#[derive(Debug, Clone)]
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// The dice of a seed.
    pub fn new(seed: u64) -> Self {
        Self(ChaCha8Rng::seed_from_u64(seed))
    }

    /// Uniform on [0, 1), a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        unit(self.0.random())
    }

    /// Uniform on 0 … n − 1; `n` > 0. The bias, n/2⁶⁴, is far below what a run could show.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.0.random::<u64>()) * n as u128) >> 64) as usize
    }

    /// True with probability `p`; always draws, so that a rate of 0 does not shift what follows.
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_kept_and_covered() {
        let mut dice = Dice::new(1);
        let mut counts = [0_u32; 3];
        for _ in 0..3000 {
            counts[dice.below(3)] += 1;
            assert!((0.0..1.0).contains(&dice.unit()));
        }
        // Binomial, n = 3000, p = 1/3: standard deviation 26; five of them.
        assert!(counts.iter().all(|c| c.abs_diff(1000) < 130), "{counts:?}");
        assert!((0..100).all(|_| !dice.chance(0.0) && dice.chance(1.0)));
    }
}
