//! Random numbers, mapped from generator words by arithmetic that is the same everywhere.

use env_model::Vector;
use planner_api::seed::unit;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub struct Dice(ChaCha8Rng);

impl Dice {
    /// Stream `stream` of `seed`: streams of one seed never meet.
    pub fn new(seed: u64, stream: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(stream);
        Self(rng)
    }

    /// A word of 64 random bits.
    pub fn word(&mut self) -> u64 {
        self.0.random()
    }

    /// Uniform on [0, 1), a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        unit(self.word())
    }

    /// Uniform on [low, high).
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform on 0 … n − 1; `n` > 0. The bias, n/2⁶⁴, is far below what a run could show.
    pub fn below(&mut self, n: usize) -> usize {
        ((u128::from(self.word()) * n as u128) >> 64) as usize
    }

    /// True with probability `p`; always draws, so that a rate of 0 does not shift what follows.
    pub fn chance(&mut self, p: f64) -> bool {
        self.unit() < p
    }

    /// A unit vector of uniform direction.
    pub fn heading(&mut self) -> Vector {
        let angle = std::f64::consts::TAU * self.unit();
        Vector::new(libm::cos(angle), libm::sin(angle))
    }

    /// Normal, mean 0, standard deviation 1 (Box & Muller 1958).
    pub fn normal(&mut self) -> f64 {
        // 1 − u lies in (0, 1]: its logarithm is finite.
        let radius = libm::sqrt(-2.0 * libm::log(1.0 - self.unit()));
        radius * libm::cos(std::f64::consts::TAU * self.unit())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distributions_have_their_moments() {
        let mut dice = Dice::new(1, 0);
        let n = 20_000;
        let draws: Vec<f64> = (0..n).map(|_| dice.normal()).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|x| x * x).sum::<f64>() / f64::from(n);
        // Five standard deviations: 1/√n and √(2/n).
        assert!(mean.abs() < 0.036 && (variance - 1.0).abs() < 0.05, "{mean} {variance}");
        let below: Vec<usize> = (0..3000).map(|_| dice.below(3)).collect();
        for k in 0..3 {
            // Binomial, n = 3000, p = 1/3: standard deviation 26; five of them.
            assert!(below.iter().filter(|b| **b == k).count().abs_diff(1000) < 130);
        }
        assert!((dice.heading().norm() - 1.0).abs() < 1e-15, "rounding");
    }

    #[test]
    fn streams_differ_and_repeat() {
        assert_ne!(Dice::new(1, 0).word(), Dice::new(1, 1).word());
        assert_eq!(Dice::new(1, 7).word(), Dice::new(1, 7).word());
    }
}
