//! Holm's correction of several p-values.

/// Adjusted p-values, in the order of `p`: all hypotheses with an adjusted value ≤ α can be rejected with a
/// probability of at most α of one false rejection among them, however the tests depend on each other.
///
/// p̃₍ᵢ₎ = max over j ≤ i of min(1, (m + 1 − j)·p₍ⱼ₎). Holm, *Scand. J. Stat.* 6 (1979) 65–70.
pub fn holm(p: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..p.len()).collect();
    order.sort_by(|&a, &b| p[a].total_cmp(&p[b]));
    let mut out = vec![0.0; p.len()];
    let mut least: f64 = 0.0;
    for (j, i) in order.into_iter().enumerate() {
        least = least.max((p.len() - j) as f64 * p[i]).min(1.0);
        out[i] = least;
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn step_down() {
        // R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm") is 0.03 0.06 0.06 0.02; 1e-15 is a rounding.
        let adjusted = holm(&[0.01, 0.04, 0.03, 0.005]);
        let expected = [0.03, 0.06, 0.06, 0.02];
        assert!(adjusted.iter().zip(expected).all(|(a, e)| (a - e).abs() < 1e-15), "{adjusted:?}");
        assert_eq!(holm(&[0.6, 0.7, 0.9]), [1.0; 3]);
        assert_eq!(holm(&[0.3]), [0.3]);
        assert!(holm(&[]).is_empty());
    }
}
