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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn studentised_range() {
        // The integral at 25 digits, solved with mpmath 1.3's findroot; scipy.stats.studentized_range.ppf(1 - a, k,
        // np.inf) agrees to 1e-14.
        let reference = [
            (2, 0.05, 2.771_807_648_699_356),
            (2, 0.01, 3.642_772_735_436_899),
            (3, 0.05, 3.314_493_155_398_121),
            (5, 0.1, 3.478_280_550_703_067),
            (10, 0.05, 4.474_124_221_725_905),
            (10, 0.01, 5.156_634_960_089_622),
            (25, 0.05, 5.172_996_173_129_59),
            (25, 0.01, 5.792_846_303_437_985),
            (100, 0.05, 6.084_637_537_173_173),
        ];
        for (k, alpha, q) in reference {
            let found = upper_point(k, alpha);
            assert!((found - q).abs() < 1e-12, "{k} {alpha}: {found}");
        }
    }

    #[test]
    fn critical_differences() {
        // Demšar 2006, table 5, k = 2 … 10, whose third decimal is off by one here and there.
        let table = [
            (0.05, [1.960, 2.343, 2.569, 2.728, 2.850, 2.949, 3.031, 3.102, 3.164]),
            (0.10, [1.645, 2.052, 2.291, 2.459, 2.589, 2.693, 2.780, 2.855, 2.920]),
        ];
        for (alpha, row) in table {
            for (k, q) in (2..).zip(row) {
                let found = upper_point(k, alpha) / SQRT_2;
                assert!((found - q).abs() < 1.1e-3, "{k} {alpha}: {found}");
            }
        }
        // His example: four classifiers on 14 data sets, CD = 2.569·√(4·5/(6·14)) = 1.25.
        assert!((critical_difference(4, 14, 0.05).unwrap() - 1.2536).abs() < 1e-4);
        assert_eq!(critical_difference(1, 14, 0.05), None);
        assert_eq!(critical_difference(4, 0, 0.05), None);
    }
}
