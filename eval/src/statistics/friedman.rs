//! Friedman's test of k treatments in n blocks, by ranks within each block.

use super::distributions::{chi_square_above, f_above};
use super::ranks::ranks;

/// The outcome of the test.
#[derive(Debug, Clone, PartialEq)]
pub struct Friedman {
    /// Blocks, n.
    pub blocks: usize,
    /// Mean rank of each treatment over the blocks, the least value ranking first.
    pub mean_ranks: Vec<f64>,
    /// Friedman's statistic with the ties' correction, about χ² with k − 1 degrees of freedom.
    pub chi_square: f64,
    /// Share of that χ² above the statistic.
    pub p_chi_square: f64,
    /// Iman and Davenport's statistic (n − 1)χ²/(n(k − 1) − χ²), about F with k − 1 and (k − 1)(n − 1) degrees of
    /// freedom; +∞ where all blocks agree.
    pub f: f64,
    /// Share of that F above the statistic; less conservative than the χ².
    pub p: f64,
}

/// The test of blocks of equal lengths k ≥ 2; `None` for fewer than two blocks or treatments.
///
/// Friedman, *J. Am. Stat. Assoc.* 32 (1937) 675–701; Iman & Davenport, *Commun. Stat.* A9 (1980) 571–595; ties as in
/// Conover, *Practical Nonparametric Statistics* (1999), §5.8. Where every block is one tie, p = 1.
pub fn friedman(blocks: &[Vec<f64>]) -> Option<Friedman> {
    let (n, k) = (blocks.len(), blocks.first()?.len());
    if n < 2 || k < 2 {
        return None;
    }
    let (mut sums, mut ties) = (vec![0.0; k], 0.0);
    for block in blocks {
        let ranked = ranks(block);
        sums.iter_mut().zip(&ranked.ranks).for_each(|(s, r)| *s += r);
        ties += ranked.ties;
    }
    let (blocks, n, k) = (n, n as f64, k as f64);
    let mean_ranks: Vec<f64> = sums.iter().map(|s| s / n).collect();
    let spread: f64 = mean_ranks.iter().map(|r| (r - (k + 1.0) / 2.0).powi(2)).sum();
    let untied = 1.0 - ties / (n * k * (k * k - 1.0));
    let most = n * (k - 1.0);
    let chi_square = if untied > 0.0 { (12.0 * n / (k * (k + 1.0)) * spread / untied).min(most) } else { 0.0 };
    // Where all blocks agree the difference is 0 but for roundings, of which 1e-12 is more than there are.
    let f =
        if chi_square > most * (1.0 - 1e-12) { f64::INFINITY } else { (n - 1.0) * chi_square / (most - chi_square) };
    Some(Friedman {
        blocks,
        mean_ranks,
        chi_square,
        p_chi_square: chi_square_above(chi_square, k - 1.0),
        f,
        p: f_above(f, k - 1.0, (k - 1.0) * (n - 1.0)),
    })
}
