//! Random numbers that are the same everywhere and under every version of `rand`.
//!
//! Only the words of the generator are taken from the library; how they become
//! numbers is written down here, because libraries change that.

use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::Generator;
use crate::{Point, Vector};

/// The random numbers of one scene.
pub(super) struct Draw(ChaCha8Rng);

impl Draw {
    /// Key: the seed and the family's name; stream: the index.
    pub fn new(generator: Generator, seed: u64, index: u32) -> Self {
        let mut key = [0; 32];
        key[..8].copy_from_slice(&seed.to_le_bytes());
        let name = generator.name().as_bytes();
        key[8..8 + name.len()].copy_from_slice(name);
        let mut words = ChaCha8Rng::from_seed(key);
        words.set_stream(index.into());
        Self(words)
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        (self.0.next_u64() >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }

    /// Uniform in [`low`, `high`).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Uniform in 0 … `count` − 1, `count` > 0 (multiply and shift; the bias is below 2⁻³² for `count` < 2³²).
    pub fn below(&mut self, count: usize) -> usize {
        ((u128::from(self.0.next_u64()) * count as u128) >> 64) as usize
    }

    /// `true` with that probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.unit() < probability
    }

    /// Uniform in the box `centre` ± `half`.
    pub fn in_box(&mut self, centre: Point, half: Vector) -> Point {
        let x = self.between(-half.x, half.x);
        let y = self.between(-half.y, half.y);
        centre + Vector::new(x, y)
    }

    /// Uniform in the unit disc, by rejection: no trigonometry, whose last bits differ between machines.
    pub fn in_unit_disc(&mut self) -> Vector {
        loop {
            let v = self.in_box(Point::origin(), Vector::new(1.0, 1.0)).coords;
            if v.norm_squared() <= 1.0 {
                return v;
            }
        }
    }
}
