//! Portable random draws.

use env_model::Vector;
use planner_api::seed::unit;
use rand::{Rng, RngExt};

/// Uniform in [0, 1), 53 bits.
pub(crate) fn uniform(rng: &mut impl Rng) -> f64 {
    unit(rng.random())
}

/// Uniform in [low, high).
pub(crate) fn between(rng: &mut impl Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * uniform(rng)
}

/// Standard normal (Box & Muller 1958), one of each pair.
pub(crate) fn normal(rng: &mut impl Rng) -> f64 {
    let (u, v) = (1.0 - uniform(rng), uniform(rng));
    (-2.0 * libm::log(u)).sqrt() * libm::cos(std::f64::consts::TAU * v)
}

/// Uniform in the disc of `radius` round the origin.
pub(crate) fn in_disc(rng: &mut impl Rng, radius: f64) -> Vector {
    let (r, angle) = (radius * uniform(rng).sqrt(), std::f64::consts::TAU * uniform(rng));
    Vector::new(libm::cos(angle), libm::sin(angle)) * r
}
