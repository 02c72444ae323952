//! Outliers by the modified z-score.

use super::median;

/// Scores beyond this are outliers: hyperfine's 14.826 (x − median)/MAD, which is ten standard deviations of normal
/// values. Iglewicz and Hoaglin's own 3.5 is for normal values; times have heavier upper tails.
pub const THRESHOLD: f64 = 10.0;

/// 0.6745 (xᵢ − median)/MAD for each of finite `values`, MAD the median of |xᵢ − median|.
///
/// Where half of the values or more are equal, MAD is 0 and (xᵢ − median)/(1.2533 · mean |xᵢ − median|) takes its
/// place; 0 where all are equal. Iglewicz & Hoaglin, *How to Detect and Handle Outliers* (1993), §3.3.
pub fn modified_z_scores(values: &[f64]) -> Vec<f64> {
    let Some(middle) = median(values) else { return Vec::new() };
    let away: Vec<f64> = values.iter().map(|v| (v - middle).abs()).collect();
    let mad = median(&away).unwrap_or(0.0);
    let mean = away.iter().sum::<f64>() / away.len() as f64;
    // √(π/2), as 1/Φ⁻¹(¾) for MAD, makes both scores standard deviations of normal values.
    let scale = if mad > 0.0 { mad / 0.6745 } else { 1.253_314 * mean };
    values.iter().map(|v| if scale > 0.0 { (v - middle) / scale } else { 0.0 }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scores() {
        // By hand: median 3, |x − 3| = 2 1 0 1 97, MAD 1.
        let z = modified_z_scores(&[1.0, 2.0, 3.0, 4.0, 100.0]);
        let expected = [-1.349, -0.6745, 0.0, 0.6745, 65.4265];
        assert!(z.iter().zip(expected).all(|(z, e)| (z - e).abs() < 1e-12), "{z:?}");
        // By hand: MAD 0, mean of |x − 1| = 2: 8/(1.253314·2) for the last.
        let z = modified_z_scores(&[1.0, 1.0, 1.0, 9.0]);
        assert!(z[..3].iter().all(|z| *z == 0.0) && (z[3] - 8.0 / 2.506_628).abs() < 1e-12, "{z:?}");
        assert_eq!(modified_z_scores(&[7.0; 4]), [0.0; 4]);
        assert_eq!(modified_z_scores(&[7.0]), [0.0]);
        assert!(modified_z_scores(&[]).is_empty());
    }
}
