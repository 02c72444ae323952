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
