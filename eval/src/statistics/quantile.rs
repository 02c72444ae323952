//! Quantiles in which failures count.

/// The q-quantile, 0 ≤ q ≤ 1, of `values`, by linear interpolation between order
/// statistics (Hyndman & Fan 1996, type 7). Infinite values take part; between a
/// finite value and +∞ the answer is +∞. `None` for no values.
pub fn quantile(values: &[f64], q: f64) -> Option<f64> {
    let mut values = values.to_vec();
    let last = values.len().checked_sub(1)?;
    let at = q * last as f64;
    let (below, share) = (at.floor() as usize, at.fract());
    let (_, low, above) = values.select_nth_unstable_by(below, f64::total_cmp);
    let value = match above.iter().copied().min_by(f64::total_cmp) {
        Some(next) if share != 0.0 => *low + share * (next - *low),
        _ => *low,
    };
    Some(if value.is_nan() { f64::INFINITY } else { value })
}

/// The median of `values`.
pub fn median(values: &[f64]) -> Option<f64> {
    quantile(values, 0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_with_failures() {
        let inf = f64::INFINITY;
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[1.0, 2.0, 3.0, 4.0]), Some(2.5));
        assert_eq!(median(&[1.0, 2.0, inf, inf]), Some(inf));
        assert_eq!(median(&[inf, inf]), Some(inf));
        assert_eq!(quantile(&[1.0, 2.0, 3.0, 4.0, inf], 0.25), Some(2.0));
        assert_eq!(median(&[]), None);
    }
}
