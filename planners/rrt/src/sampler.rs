//! Random numbers and points.

use env_model::{Aabb, Point, Vector};
use planner_api::seed::unit;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// A portable generator: the same seed gives the same samples on any machine.
#[derive(Debug, Clone)]
pub(crate) struct Sampler(Xoshiro256PlusPlus);

impl Sampler {
    pub fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// Uniform in [0, 1), a multiple of 2⁻⁵³.
    pub fn unit(&mut self) -> f64 {
        unit(self.0.next_u64())
    }

    /// Uniform in the box.
    pub fn in_box(&mut self, aabb: &Aabb) -> Point {
        let (u, v) = (self.unit(), self.unit());
        aabb.min + aabb.size().component_mul(&Vector::new(u, v))
    }

    /// Uniform in the unit disc, by rejection from the square round it.
    pub fn in_disc(&mut self) -> Vector {
        loop {
            let v = Vector::new(2.0 * self.unit() - 1.0, 2.0 * self.unit() - 1.0);
            if v.norm_squared() <= 1.0 {
                return v;
            }
        }
    }
}
