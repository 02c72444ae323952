//! Bootstrap intervals: what a figure might have been had the runs been drawn again.
//!
//! Resamples are kept as how often each value is drawn, so that columns of values which belong together (the same
//! repeats, or scenes, of several planners) share them and stay paired. Percentile intervals of 95 %, Efron &
//! Tibshirani, *An Introduction to the Bootstrap* (1993), §13.3.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::quantile;

/// Resamples of n values.
pub struct Resamples {
    n: usize,
    /// For each resample, how often it draws each value.
    draws: Vec<u32>,
}

impl Resamples {
    /// `count` resamples of n ≥ 1 values. The ends of a 95 % interval stand at quantiles 0.025 and 0.975 give or take
    /// √(0.025·0.975/count): ± 0.0035 for 2000.
    pub fn new(n: usize, count: usize, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut draws = vec![0; n * count];
        for resample in draws.chunks_exact_mut(n.max(1)) {
            for _ in 0..n {
                resample[rng.random_range(0..n as u32) as usize] += 1;
            }
        }
        Self { n, draws }
    }

    /// The median of each resample of `values`, of which there are n.
    pub fn medians(&self, values: &[f64]) -> Vec<f64> {
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let (lower, upper) = ((self.n.saturating_sub(1)) / 2, self.n / 2);
        let one = |draws: &[u32]| {
            let (mut drawn, mut low) = (0, None);
            for &i in &order {
                drawn += draws[i] as usize;
                if drawn > lower && low.is_none() {
                    low = Some(values[i]);
                }
                if drawn > upper {
                    let low = low.unwrap_or(values[i]);
                    return if low == values[i] { low } else { low + 0.5 * (values[i] - low) };
                }
            }
            f64::INFINITY
        };
        self.draws.chunks_exact(self.n.max(1)).map(one).collect()
    }

    /// The sum of each resample of finite `values`, of which there are n.
    pub fn sums(&self, values: &[f64]) -> Vec<f64> {
        let one = |draws: &[u32]| draws.iter().zip(values).map(|(d, v)| f64::from(*d) * v).sum();
        self.draws.chunks_exact(self.n.max(1)).map(one).collect()
    }
}

/// The 95 % percentile interval of the ratios `over`/`under` of two columns of non-negative resampled figures.
///
/// 0/0 and ∞/∞ say nothing of the ratio: they count as 0 for the lower end and as +∞ for the upper one.
/// `None` without resamples.
pub fn ratio_interval(over: &[f64], under: &[f64]) -> Option<[f64; 2]> {
    let ratios: Vec<f64> = over.iter().zip(under).map(|(a, b)| a / b).collect();
    let end = |q: f64, unknown: f64| {
        quantile(&ratios.iter().map(|r| if r.is_nan() { unknown } else { *r }).collect::<Vec<_>>(), q)
    };
    Some([end(0.025, 0.0)?, end(0.975, f64::INFINITY)?])
}
