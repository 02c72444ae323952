//! Wilcoxon's signed-rank test of paired differences.
//!
//! W⁺ is the sum of the ranks of |d| over positive d. Under the hypothesis that d is distributed symmetrically round
//! 0, every sign is a coin's. With at most [`MOST_EXACT`] differences and neither ties nor zeros, or with at most
//! [`MOST_TIED`], all signs are counted; otherwise W⁺ is taken as normal with the ties' correction and without
//! correction for continuity. That is `SciPy`'s choice of method too, so its `wilcoxon(d)` gives the same values.
//! Wilcoxon, *Biometrics Bull.* 1 (1945) 80–83; Pratt, *J. Am. Stat. Assoc.* 54 (1959) 655–667;
//! Cureton, *J. Am. Stat. Assoc.* 62 (1967) 1068–1069.

use super::distributions::normal_beyond;
use super::ranks::ranks;

/// Most differences without ties or zeros of which all signs are counted.
pub const MOST_EXACT: usize = 50;
/// Most differences with ties or zeros of which all signs are counted.
pub const MOST_TIED: usize = 13;

/// What differences of zero do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Zeros {
    /// They are left out before ranking (Wilcoxon).
    Wilcox,
    /// They take the lowest ranks, which count for neither side (Pratt).
    Pratt,
}

/// The outcome of the test.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SignedRank {
    /// Sum of the ranks of positive differences.
    pub positive: f64,
    /// Sum of the ranks of negative differences.
    pub negative: f64,
    /// Two-sided p-value.
    pub p: f64,
    /// Whether all signs were counted.
    pub exact: bool,
}

impl SignedRank {
    /// The lesser sum, as tables and `SciPy` give it.
    pub fn statistic(&self) -> f64 {
        self.positive.min(self.negative)
    }
}

/// The two-sided test of `differences`; ±∞ are the greatest and tie with each other. `None` for no differences;
/// where all are zero nothing speaks against the hypothesis: p = 1.
pub fn signed_rank(differences: &[f64], zeros: Zeros) -> Option<SignedRank> {
    if differences.is_empty() {
        return None;
    }
    let kept: Vec<f64> = differences.iter().copied().filter(|d| zeros == Zeros::Pratt || *d != 0.0).collect();
    let none = differences.iter().filter(|d| **d == 0.0).count();
    let ranked = ranks(&kept.iter().map(|d| d.abs()).collect::<Vec<_>>());
    let sum = |side: fn(f64) -> bool| kept.iter().zip(&ranked.ranks).filter(|(d, _)| side(**d)).map(|(_, r)| r).sum();
    let (positive, negative): (f64, f64) = (sum(|d| d > 0.0), sum(|d| d < 0.0));
    let exact = differences.len() <= if none == 0 && ranked.ties == 0.0 { MOST_EXACT } else { MOST_TIED };
    let signed: Vec<f64> = kept.iter().zip(&ranked.ranks).filter(|(d, _)| **d != 0.0).map(|(_, r)| *r).collect();
    let p = if signed.is_empty() {
        1.0
    } else if exact {
        exact_p(&signed, positive)
    } else {
        let zeros = if zeros == Zeros::Pratt { none as f64 } else { 0.0 };
        normal_p(kept.len() as f64, zeros, ranked.ties, positive)
    };
    Some(SignedRank { positive, negative, p, exact })
}

/// Twice the lesser tail of the distribution of W⁺ over all signs.
fn exact_p(ranks: &[f64], positive: f64) -> f64 {
    // Twice the ranks are whole: shares are of twice the sum.
    let doubled = |r: f64| (2.0 * r) as usize;
    let most: usize = ranks.iter().map(|r| doubled(*r)).sum();
    let mut shares = vec![0.0; most + 1];
    shares[0] = 1.0;
    let mut reached = 0;
    for r in ranks.iter().map(|r| doubled(*r)) {
        reached += r;
        for sum in (0..=reached).rev() {
            let with = if sum >= r { shares[sum - r] } else { 0.0 };
            shares[sum] = 0.5 * (shares[sum] + with);
        }
    }
    let at = doubled(positive);
    let (below, above): (f64, f64) = (shares[..=at].iter().sum(), shares[at..].iter().sum());
    (2.0 * below.min(above)).min(1.0)
}

/// The normal approximation: n ranks, `zeros` of them without sign.
fn normal_p(n: f64, zeros: f64, ties: f64, positive: f64) -> f64 {
    let mean = (n * (n + 1.0) - zeros * (zeros + 1.0)) / 4.0;
    let cube = |n: f64| n * (n + 1.0) * (2.0 * n + 1.0);
    // The zeros' own tie is no tie among the signed.
    let ties = ties - (zeros * zeros * zeros - zeros);
    let variance = (cube(n) - cube(zeros) - ties / 2.0) / 24.0;
    normal_beyond((positive - mean) / variance.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use Zeros::{Pratt, Wilcox};

    const INF: f64 = f64::INFINITY;

    /// The statistic and p of `scipy.stats.wilcoxon(d, zero_method=…)`, 1.17.1.
    fn check(d: &[f64], zeros: Zeros, statistic: f64, p: f64) {
        let r = signed_rank(d, zeros).unwrap();
        assert_eq!(r.statistic(), statistic, "{zeros:?} {d:?}");
        assert!((r.p - p).abs() < 1e-12, "{zeros:?} {d:?}: {} against {p}", r.p);
        let turned = signed_rank(&d.iter().map(|d| -d).collect::<Vec<_>>(), zeros).unwrap();
        assert!((turned.p - p).abs() < 1e-12 && turned.positive == r.negative, "the sides are equal");
    }

    #[test]
    fn without_ties_all_signs_are_counted() {
        // Darwin's maize, the example of SciPy's documentation.
        let darwin = [49, -67, 8, 16, 6, 23, 28, 41, 14, 29, 56, 24, 75, 60, -48].map(f64::from);
        check(&darwin, Wilcox, 24.0, 0.041_259_765_625);
        let plain = [
            16.9, 3.2, -11.3, 26.4, 11.5, -1.4, -16.7, 21.8, 6.1, -6.0, 28.9, 17.2, 0.7, -10.6, 23.5, 12.6, -4.7,
            -15.2, 18.1, 8.0, -10.1, 31.2, 12.7, 3.4, -15.5,
        ];
        check(&plain, Wilcox, 91.0, 0.055_070_459_842_681_885);
        check(&[3.0], Wilcox, 0.0, 1.0);
    }

    #[test]
    fn beyond_fifty_the_normal_distribution_serves() {
        // (i + ½)·(1 if i² mod 7 in (0, 1, 2) else −1), i = 1 … n
        let d = |n: u32| -> Vec<f64> {
            (1..=n).map(|i| (f64::from(i) + 0.5) * if (i * i) % 7 <= 2 { 1.0 } else { -1.0 }).collect()
        };
        check(&d(50), Wilcox, 343.0, 0.003_913_313_547_160_513);
        check(&d(51), Wilcox, 394.0, 0.011_686_810_240_322_15);
        assert!(signed_rank(&d(50), Wilcox).unwrap().exact && !signed_rank(&d(51), Wilcox).unwrap().exact);
    }

    #[test]
    fn ties_and_zeros() {
        let ties = [1, 1, -2, 2, 3, 3, -3, 5, 6, 7, 8, 8, 9, 9].map(f64::from);
        check(&ties[..13], Wilcox, 9.5, 0.009_033_203_125);
        check(&ties, Pratt, 9.5, 0.006_836_126_627_285_55);
        let zeros = [0, 0, 0, 1, 1, 2, -2, 3, 4, -1, 5, 6, 7].map(f64::from);
        check(&zeros, Wilcox, 6.5, 0.033_203_125);
        check(&zeros, Pratt, 12.5, 0.037_109_375);
        let more = [0, 0, 0, 0, 1, 1, 2, -2, 3, 4, -1, 5, 6, 7, -7, 7, 8, 9, 10, -3].map(f64::from);
        check(&more, Wilcox, 25.0, 0.025_933_769_129_646_365);
        check(&more, Pratt, 41.0, 0.026_679_021_778_791_542);
    }

    #[test]
    fn failures_are_the_greatest_differences() {
        // SciPy with ±1e300 for ±∞.
        let d =
            [INF, -INF, INF, INF, 0.0, 0.0, 1.0, 2.0, -3.0, 4.0, 5.0, 6.0, 7.0, 8.0, -9.0, 10.0, 11.0, 12.0, INF, INF];
        check(&d, Wilcox, 27.5, 0.011_197_759_784_866_293);
        check(&d, Pratt, 33.5, 0.008_700_814_159_371_616);
    }

    #[test]
    fn nothing_to_tell() {
        assert_eq!(signed_rank(&[], Pratt), None);
        for d in [&[0.0][..], &[0.0; 80]] {
            assert!([Wilcox, Pratt].iter().all(|z| signed_rank(d, *z).unwrap().p == 1.0));
        }
        // All alike, by hand: two of 2⁶ assignments are as extreme.
        assert_eq!(signed_rank(&[INF; 6], Pratt).unwrap().p, 2.0 / 64.0);
        assert!(signed_rank(&[INF; 1000], Pratt).unwrap().p < 1e-9);
    }
}
