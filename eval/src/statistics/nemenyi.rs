//! Nemenyi's critical difference of mean ranks.
//!
//! CD = q/√2 · √(k(k + 1)/(6n)) with q the upper α point of the studentised range of k normal values and infinite
//! degrees of freedom. Demšar, *J. Mach. Learn. Res.* 7 (2006) 1–30, table 5 gives q/√2.

use std::f64::consts::{PI, SQRT_2};

use super::distributions::normal_below;

/// Two of k treatments whose mean ranks over n blocks differ by at least this differ at level `alpha`.
///
/// `None` for fewer than two treatments or no blocks.
pub fn critical_difference(k: usize, n: usize, alpha: f64) -> Option<f64> {
    if k < 2 || n == 0 {
        return None;
    }
    let (blocks, treatments) = (n as f64, k as f64);
    Some(upper_point(k, alpha) / SQRT_2 * (treatments * (treatments + 1.0) / (6.0 * blocks)).sqrt())
}

/// P(range of k standard normal values ≤ q) = k ∫ φ(z) [Φ(z + q) − Φ(z)]ᵏ⁻¹ dz, z being the least of them.
fn range_below(k: usize, q: f64) -> f64 {
    // The trapezoidal rule converges faster than any power for such an integrand: at step 0.1 it is exact to
    // rounding; beyond ±9 lie 2e-19 of the mass.
    const STEP: f64 = 0.1;
    const END: i32 = 90;
    let integrand = |i: i32| {
        let z = f64::from(i) * STEP;
        let inside = if z > 0.0 {
            // Differences of upper tails keep their digits.
            normal_below(-z) - normal_below(-z - q)
        } else {
            normal_below(z + q) - normal_below(z)
        };
        libm::exp(-0.5 * z * z) / (2.0 * PI).sqrt() * libm::pow(inside, k as f64 - 1.0)
    };
    k as f64 * STEP * (-END..=END).map(integrand).sum::<f64>()
}

/// The q with P(range ≤ q) = 1 − α, by bisection.
fn upper_point(k: usize, alpha: f64) -> f64 {
    let (mut low, mut high) = (0.0, 50.0);
    // 60 halvings of 50 are below one rounding.
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if range_below(k, middle) < 1.0 - alpha {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}
