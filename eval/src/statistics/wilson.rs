//! Intervals of shares.

/// 95 % interval of a share k/n. Wilson, *J. Am. Stat. Assoc.* 22 (1927) 209–212.
pub fn wilson(k: usize, n: usize) -> (f64, f64) {
    if n == 0 {
        return (0.0, 1.0);
    }
    let (none, all) = (k == 0, k == n);
    let (n, p, z) = (n as f64, k as f64 / n as f64, 1.959_963_984_540_054);
    let middle = p + z * z / (2.0 * n);
    let half = z * (p * (1.0 - p) / n + z * z / (4.0 * n * n)).sqrt();
    let scale = 1.0 + z * z / n;
    // These two ends are exact; rounding would leave them a little off.
    let low = if none { 0.0 } else { ((middle - half) / scale).max(0.0) };
    let high = if all { 1.0 } else { ((middle + half) / scale).min(1.0) };
    (low, high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares() {
        // scipy.stats.binomtest(k, n).proportion_ci(method='wilson'); 1e-12 is a few roundings.
        let reference = [
            (29, 30, 0.833_296_090_085_908_3, 0.994_091_409_618_387_5),
            (0, 30, 0.0, 0.113_513_393_173_968_75),
            (30, 30, 0.886_486_606_826_031_2, 1.0),
            (1, 7, 0.025_679_624_344_743_58, 0.513_127_829_274_318_9),
            (500, 1000, 0.469_069_600_368_104_2, 0.530_930_399_631_895_8),
        ];
        for (k, n, low, high) in reference {
            let (l, h) = wilson(k, n);
            assert!((l - low).abs() < 1e-12 && (h - high).abs() < 1e-12, "{k}/{n}: {l} {h}");
        }
        assert_eq!(wilson(0, 0), (0.0, 1.0));
        assert_eq!(wilson(0, 30).0, 0.0);
        assert_eq!(wilson(30, 30).1, 1.0);
    }
}
