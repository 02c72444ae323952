//! Tail probabilities of the distributions that the tests refer to.

use std::f64::consts::SQRT_2;

use statrs::function::{beta::beta_reg, gamma::gamma_ur};

/// Φ(z), the normal distribution's share below z.
pub fn normal_below(z: f64) -> f64 {
    0.5 * libm::erfc(-z / SQRT_2)
}

/// The normal distribution's share farther from 0 than |z|.
pub fn normal_beyond(z: f64) -> f64 {
    libm::erfc(z.abs() / SQRT_2)
}

/// Share of Student's t with `freedom` degrees farther from 0 than |t|.
pub fn student_beyond(t: f64, freedom: f64) -> f64 {
    if t.is_infinite() { 0.0 } else { beta_reg(freedom / 2.0, 0.5, freedom / (freedom + t * t)) }
}

/// Share of χ² with `freedom` degrees above x.
pub fn chi_square_above(x: f64, freedom: f64) -> f64 {
    if x <= 0.0 { 1.0 } else { gamma_ur(freedom / 2.0, x / 2.0) }
}

/// Share of Fisher's F with (`over`, `under`) degrees above f.
pub fn f_above(f: f64, over: f64, under: f64) -> f64 {
    if f.is_infinite() { 0.0 } else { beta_reg(under / 2.0, over / 2.0, under / (under + over * f)) }
}
