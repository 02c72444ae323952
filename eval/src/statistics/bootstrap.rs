//! Bootstrap intervals: what a figure might have been had the runs been drawn again.
//!
//! Resamples are kept as how often each value is drawn, so that columns of values which belong together (the same
//! repeats, or scenes, of several planners) share them and stay paired. Percentile intervals of 95 %, Efron &
//! Tibshirani, *An Introduction to the Bootstrap* (1993), §13.3.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// Resamples of n values.
pub struct Resamples {
    n: usize,
    count: usize,
    /// For each value, how often each resample draws it: signed, which processors turn into f64 several at a time.
    draws: Vec<i32>,
}

impl Resamples {
    /// `count` resamples of n values. The ends of a 95 % interval stand at quantiles 0.025 and 0.975 give or take
    /// √(0.025·0.975/count): ± 0.0035 for 2000.
    pub fn new(n: usize, count: usize, seed: u64) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut draws = vec![0; n * count];
        for resample in 0..count {
            for _ in 0..n {
                draws[rng.random_range(0..n as u32) as usize * count + resample] += 1;
            }
        }
        Self { n, count, draws }
    }

    /// How often each resample draws value i.
    fn of(&self, i: usize) -> &[i32] {
        &self.draws[i * self.count..][..self.count]
    }

    /// The median of each resample of `values`, of which there are n ≥ 1.
    pub fn medians(&self, values: &[f64]) -> Vec<f64> {
        let mut order: Vec<usize> = (0..values.len()).collect();
        order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
        let (lower, upper) = ((self.n.max(1) as i32 - 1) / 2, self.n as i32 / 2);
        let mut ends = vec![[f64::INFINITY; 2]; self.count];
        let mut drawn = vec![0; self.count];
        for i in order {
            for ((ends, drawn), draws) in ends.iter_mut().zip(&mut drawn).zip(self.of(i)) {
                let before = *drawn;
                *drawn += draws;
                if before <= lower && lower < *drawn {
                    ends[0] = values[i];
                }
                if before <= upper && upper < *drawn {
                    ends[1] = values[i];
                }
            }
        }
        ends.into_iter().map(|[low, high]| if low == high { low } else { low + 0.5 * (high - low) }).collect()
    }

    /// The sum of each resample of finite `values`, of which there are n.
    pub fn sums(&self, values: &[f64]) -> Vec<f64> {
        let mut sums = vec![0.0; self.count];
        for (i, value) in values.iter().enumerate() {
            sums.iter_mut().zip(self.of(i)).for_each(|(sum, draws)| *sum += f64::from(*draws) * value);
        }
        sums
    }
}

/// The 95 % percentile interval of the ratios `over`/`under` of two columns of non-negative resampled figures, its ends
/// the order statistics next outside the quantiles 0.025 and 0.975.
///
/// 0/0 and ∞/∞ say nothing of the ratio: they count as 0 for the lower end and as +∞ for the upper one.
/// `None` without resamples.
pub fn ratio_interval(over: &[f64], under: &[f64]) -> Option<[f64; 2]> {
    let last = over.len().checked_sub(1)? as f64;
    let end = |place: f64, unknown: f64| {
        let ratio = |(a, b): (&f64, &f64)| Some(a / b).filter(|r| !r.is_nan()).unwrap_or(unknown);
        let mut ratios: Vec<f64> = over.iter().zip(under).map(ratio).collect();
        *ratios.select_nth_unstable_by(place as usize, f64::total_cmp).1
    };
    Some([end((0.025 * last).floor(), 0.0), end((0.975 * last).ceil(), f64::INFINITY)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::median;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn resampled_medians_are_medians_of_resamples() {
        for n in [1, 2, 7, 8] {
            let values: Vec<f64> = (0..n).map(|i| if i == 5 { INF } else { f64::from((i * 5) % 7) }).collect();
            let resamples = Resamples::new(values.len(), 50, 1);
            let medians = resamples.medians(&values);
            let sums = resamples.sums(&(1..=n).map(f64::from).collect::<Vec<_>>());
            assert_eq!((medians.len(), sums.len()), (50, 50));
            for (k, (found, sum)) in medians.into_iter().zip(sums).enumerate() {
                let draws: Vec<i32> = (0..values.len()).map(|i| resamples.of(i)[k]).collect();
                let drawn = |(v, d): (&f64, &i32)| std::iter::repeat_n(*v, *d as usize);
                let sample: Vec<f64> = values.iter().zip(&draws).flat_map(drawn).collect();
                assert_eq!(sample.len(), values.len());
                assert_eq!(Some(found), median(&sample));
                assert_eq!(sum, (1..).zip(&draws).map(|(i, d)| f64::from(i * d)).sum::<f64>());
            }
        }
    }

    #[test]
    fn medians_of_resamples_have_the_exact_distribution() {
        // The median of a resample of 1 … n, n odd, is at most k with probability P(B ≥ (n + 1)/2), B binomial with n
        // trials of k/n; scipy.stats.binom.sf(7, 15, k/15) for n = 15. With 20 000 resamples one standard error is
        // 0.0035 at most: four of them.
        let values: Vec<f64> = (1..=15).map(f64::from).collect();
        let medians = Resamples::new(15, 20_000, 7).medians(&values);
        for (k, p) in
            [(5.0, 0.088_231_6), (6.0, 0.213_103_2), (7.0, 0.396_341_2), (8.0, 0.603_658_8), (11.0, 0.974_549_6)]
        {
            let share = medians.iter().filter(|m| **m <= k).count() as f64 / 20_000.0;
            assert!((share - p).abs() < 0.014, "{k}: {share} against {p}");
        }
    }

    #[test]
    fn intervals_of_ratios() {
        let over: Vec<f64> = (0..1000).map(f64::from).collect();
        let [low, high] = ratio_interval(&over, &[2.0; 1000]).unwrap();
        // By hand: 0.025·999 = 24.975 and 0.975·999 = 974.025, outwards, halved.
        assert_eq!((low, high), (12.0, 487.5));
        assert_eq!(ratio_interval(&[INF, 0.0, 1.0], &[INF, 0.0, 1.0]).unwrap()[1], INF);
        assert_eq!(ratio_interval(&[INF; 9], &[INF; 9]), Some([0.0, INF]), "nothing is known");
        assert_eq!(ratio_interval(&[], &[]), None);
        assert_eq!(Resamples::new(0, 3, 0).medians(&[]), [INF; 3]);
    }
}
