//! Order statistics of times, and the exponent of growth.

/// The q-quantile of `sorted`, 0 ≤ q ≤ 1: the least value that a share of q does not exceed (nearest rank).
///
/// # Panics
/// Without values.
pub fn quantile(sorted: &[f64], q: f64) -> f64 {
    let rank = (q * sorted.len() as f64).ceil() as usize;
    sorted[rank.clamp(1, sorted.len()) - 1]
}

/// The median of `values`, the mean of the middle two where their number is even.
///
/// # Panics
/// Without values.
pub fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { 0.5 * (sorted[middle - 1] + sorted[middle]) }
}

/// The exponent p of y ∝ xᵖ: the slope of log y on log x by least squares.
/// `None` for fewer than two different x.
pub fn exponent(points: &[(f64, f64)]) -> Option<f64> {
    let logs: Vec<(f64, f64)> = points.iter().map(|(x, y)| (x.ln(), y.ln())).collect();
    let n = logs.len() as f64;
    let mean_x = logs.iter().map(|(x, _)| x).sum::<f64>() / n;
    let mean_y = logs.iter().map(|(_, y)| y).sum::<f64>() / n;
    let xx: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let xy: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    (xx > 0.0).then_some(xy / xx)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_values_that_occur() {
        let sorted: Vec<f64> = (1..=1000).map(f64::from).collect();
        assert_eq!([0.0, 0.5, 0.99, 0.999, 1.0].map(|q| quantile(&sorted, q)), [1.0, 500.0, 990.0, 999.0, 1000.0]);
        assert_eq!(quantile(&[7.0], 0.99), 7.0);
    }

    #[test]
    fn medians_of_odd_and_even_numbers() {
        assert_eq!((median(&[3.0, 1.0, 2.0]), median(&[4.0, 1.0, 2.0, 3.0])), (2.0, 2.5));
    }

    #[test]
    fn exponents_of_powers_and_of_noise_round_them() {
        let power = [1.0, 10.0, 100.0].map(|x: f64| (x, 3.0 * x.powf(1.5)));
        assert!((exponent(&power).unwrap() - 1.5).abs() < 1e-12, "rounding only");
        // Residuals orthogonal to log x change nothing.
        let noisy = [(1.0, 2.0), (10.0, 2.5), (100.0, 200.0)];
        assert!((exponent(&noisy).unwrap() - 1.0).abs() < 1e-12, "rounding only");
        assert_eq!(exponent(&[(5.0, 1.0), (5.0, 2.0)]), None);
    }
}
