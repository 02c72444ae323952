//! An interval of a median that assumes nothing of the distribution.
//!
//! Between the j-th least and the j-th greatest of n values lies the median of what they were drawn from with
//! probability P(j ≤ B ≤ n − j), B binomial with n trials of ½, exactly for continuous distributions and at least
//! otherwise. David & Nagaraja, *Order Statistics* (2003), §7.1.

/// Which order statistics bound the median of n values.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MedianRanks {
    /// The j-th least value is the lower end, from 1.
    pub low: usize,
    /// The value of this rank, n + 1 − j, is the upper end.
    pub high: usize,
    /// Probability that the two ends enclose the median, ≥ 0.95.
    pub coverage: f64,
}

/// The narrowest symmetric pair of ranks that covers with 95 % or more; `None` below six values, where even
/// the extremes do not.
pub fn median_ranks(n: usize) -> Option<MedianRanks> {
    let m = n / 2;
    // The middle term of the binomial: C(2m, m)/4ᵐ, for odd n C(n, m)/2ⁿ = C(n + 1, m + 1)/2ⁿ⁺¹.
    let mut term: f64 = (1..=n.div_ceil(2)).map(|i| (2 * i - 1) as f64 / (2 * i) as f64).product();
    let mut j = m;
    let mut coverage = if n.is_multiple_of(2) { term } else { 2.0 * term };
    while coverage < 0.95 {
        if j <= 1 {
            return None;
        }
        term *= j as f64 / (n + 1 - j) as f64;
        j -= 1;
        coverage += 2.0 * term;
    }
    (j > 0).then_some(MedianRanks { low: j, high: n + 1 - j, coverage })
}

/// An interval of a median.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MedianInterval {
    /// Lower end.
    pub low: f64,
    /// Upper end; +∞ where so many values are.
    pub high: f64,
    /// Probability that it encloses the median, ≥ 0.95.
    pub coverage: f64,
}

/// The interval of the median of what `values` were drawn from; `None` for fewer than six values.
pub fn median_interval(values: &[f64]) -> Option<MedianInterval> {
    let MedianRanks { low, high, coverage } = median_ranks(values.len())?;
    let mut values = values.to_vec();
    let (_, &mut lower, above) = values.select_nth_unstable_by(low - 1, f64::total_cmp);
    let (_, &mut upper, _) = above.select_nth_unstable_by(high - low - 1, f64::total_cmp);
    Some(MedianInterval { low: lower, high: upper, coverage })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_and_coverage() {
        // scipy.stats.binom: the largest j with 1 - 2*binom.cdf(j - 1, n, 0.5) >= 0.95, and that value. The product
        // of n/2 rounded quotients is off by n/2 roundings at most.
        let reference = [
            (6, 1, 0.96875),
            (7, 1, 0.984375),
            (8, 1, 0.9921875),
            (9, 2, 0.9609375),
            (10, 2, 0.978515625),
            (17, 5, 0.950958251953125),
            (20, 6, 0.958_610_534_667_968_8),
            (30, 10, 0.957_226_054_742_932_3),
            (31, 10, 0.970_550_626_516_342_2),
            (101, 41, 0.953_955_933_070_658_2),
            (1000, 469, 0.953_708_802_639_502),
            (30_000, 14_830, 0.951_021_656_949_630_6),
        ];
        for (n, low, coverage) in reference {
            let r = median_ranks(n).unwrap();
            assert_eq!((r.low, r.high), (low, n + 1 - low), "{n}");
            assert!((r.coverage - coverage).abs() < 1e-11, "{n}: {}", r.coverage);
        }
        assert!((0..6).all(|n| median_ranks(n).is_none()));
        assert!((6..3000).all(|n| median_ranks(n).is_some_and(|r| r.coverage >= 0.95 && 0 < r.low && r.low < r.high)));
    }

    #[test]
    fn failures_are_ends() {
        let inf = f64::INFINITY;
        let i = median_interval(&[5.0, 1.0, inf, 2.0, 3.0, 4.0]).unwrap();
        assert_eq!((i.low, i.high), (1.0, inf));
        assert_eq!(median_interval(&[inf; 9]).unwrap().low, inf);
        assert_eq!(median_interval(&[2.0; 7]).map(|i| (i.low, i.high)), Some((2.0, 2.0)));
        assert_eq!(median_interval(&[1.0; 5]), None);
        assert_eq!(median_interval(&[]), None);
    }
}
