//! Vargha and Delaney's effect size.

/// A₁₂ = P(X > Y) + ½ P(X = Y) over all pairs of `x` and `y`: ½ where neither tends to be larger.
///
/// Infinite values are equal to each other. `None` where a side has no values.
/// Vargha & Delaney, *J. Educ. Behav. Stat.* 25 (2000) 101–132.
pub fn a12(x: &[f64], y: &[f64]) -> Option<f64> {
    if x.is_empty() || y.is_empty() {
        return None;
    }
    let mut sorted = y.to_vec();
    sorted.sort_by(f64::total_cmp);
    // Twice the wins, so that ties are whole numbers.
    let wins: usize = x.iter().map(|v| sorted.partition_point(|w| w < v) + sorted.partition_point(|w| w <= v)).sum();
    Some(wins as f64 / (2 * x.len() * y.len()) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wins_and_ties() {
        let inf = f64::INFINITY;
        // By hand: 3 beats 1 and 2 and ties with 3, 5 beats all three: (2½ + 3)/6.
        assert_eq!(a12(&[3.0, 5.0], &[1.0, 2.0, 3.0]), Some(5.5 / 6.0));
        // scipy.stats.mannwhitneyu(x, y).statistic/30
        assert_eq!(a12(&[1.0, 5.0, 5.0, 7.0, 9.0, 12.0], &[2.0, 5.0, 6.0, 6.0, 10.0]), Some(16.0 / 30.0));
        assert_eq!(a12(&[inf, 1.0], &[inf, 2.0]), Some((0.5 + 1.0) / 4.0));
        assert_eq!(a12(&[inf; 3], &[inf; 2]), Some(0.5));
        assert_eq!(a12(&[0.0], &[-0.0]), Some(0.5));
        assert_eq!(a12(&[], &[1.0]), None);
        assert_eq!(a12(&[1.0], &[]), None);
    }
}
