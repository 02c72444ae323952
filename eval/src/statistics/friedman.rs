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

#[cfg(test)]
mod tests {
    use super::*;

    /// χ² and its p from `scipy.stats.friedmanchisquare(*M.T)`, 1.17.1; F by the formula from that χ², its p from
    /// `scipy.stats.f.sf(F, k - 1, (k - 1)*(n - 1))`. Relative, for p-values down to 1e-88.
    fn check(blocks: &[Vec<f64>], [chi_square, p_chi_square, f, p]: [f64; 4]) {
        let r = friedman(blocks).unwrap();
        for (value, expected) in [(r.chi_square, chi_square), (r.p_chi_square, p_chi_square), (r.f, f), (r.p, p)] {
            assert!((value / expected - 1.0).abs() < 1e-11, "{value} against {expected}");
        }
    }

    fn made(value: impl Fn(u32, u32) -> f64) -> Vec<Vec<f64>> {
        (1..=40).map(|i| (0..5).map(|j| value(i, j)).collect()).collect()
    }

    #[test]
    fn as_in_scipy() {
        let plain = [[1, 2, 3, 4], [2, 1, 3, 4], [1, 3, 2, 4], [1, 2, 4, 3], [4, 1, 2, 3], [1, 2, 3, 4]];
        let plain: Vec<Vec<f64>> = plain.iter().map(|b| b.map(f64::from).to_vec()).collect();
        check(
            &plain,
            [9.400_000_000_000_006, 0.024_419_337_395_717_24, 5.465_116_279_069_774_5, 0.009_676_479_740_333_702],
        );
        assert_eq!(friedman(&plain).unwrap().mean_ranks, [10.0 / 6.0, 11.0 / 6.0, 17.0 / 6.0, 22.0 / 6.0]);
        let tied = [[1, 1, 2, 5], [3, 2, 2, 9], [0, 0, 0, 0], [1, 4, 4, 2], [2, 2, 3, 9], [7, 1, 2, 9], [1, 2, 2, 2]];
        let tied: Vec<Vec<f64>> = tied.iter().map(|b| b.map(f64::from).to_vec()).collect();
        check(
            &tied,
            [7.153_846_153_846_157, 0.067_152_520_306_327_76, 3.100_000_000_000_002, 0.052_786_324_393_044_586],
        );
        let spread = made(|i, j| f64::from(i) * 0.01 + f64::from((i * j * 7) % 11) * 0.1);
        check(
            &spread,
            [74.227_027_027_026_99, 2.903_252_865_201_922e-15, 33.750_189_059_742_844, 2.820_675_816_964_284e-20],
        );
        let clear = made(|i, j| f64::from(j + (i * j * 7) % 3));
        check(
            &clear,
            [148.598_930_481_283_47, 4.063_910_450_584_957e-31, 508.317_073_170_734_26, 2.434_120_306_107_611_7e-88],
        );
    }

    #[test]
    fn extremes() {
        let inf = f64::INFINITY;
        let agree = friedman(&vec![vec![1.0, 2.0, inf]; 5]).unwrap();
        assert_eq!((agree.chi_square, agree.f, agree.p), (10.0, inf, 0.0));
        let tie = friedman(&vec![vec![inf; 4]; 5]).unwrap();
        assert_eq!((tie.chi_square, tie.p_chi_square, tie.p), (0.0, 1.0, 1.0));
        assert_eq!(friedman(&[]), None);
        assert_eq!(friedman(&[vec![1.0, 2.0]]), None);
        assert_eq!(friedman(&[vec![1.0], vec![1.0]]), None);
    }
}
