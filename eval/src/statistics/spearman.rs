//! Spearman's rank correlation.

use super::distributions::student_beyond;
use super::ranks::ranks;

/// The outcome.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spearman {
    /// The correlation of ranks, −1 to 1.
    pub rho: f64,
    /// Two-sided p-value by Student's t with n − 2 degrees of freedom.
    pub p: f64,
}

/// The correlation of `x` and `y`, of equal lengths, ties sharing ranks; `None` for fewer than three values or where
/// a side is constant.
///
/// Spearman, *Am. J. Psychol.* 15 (1904) 72–101; t = ρ √((n − 2)/(1 − ρ²)).
pub fn spearman(x: &[f64], y: &[f64]) -> Option<Spearman> {
    let n = x.len() as f64;
    if x.len() < 3 {
        return None;
    }
    let centred = |v: &[f64]| ranks(v).ranks.iter().map(|r| r - (n + 1.0) / 2.0).collect::<Vec<f64>>();
    let (x, y) = (centred(x), centred(y));
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let scale = (dot(&x, &x) * dot(&y, &y)).sqrt();
    if scale == 0.0 {
        return None;
    }
    let rho = (dot(&x, &y) / scale).clamp(-1.0, 1.0);
    let t = rho * ((n - 2.0) / ((1.0 + rho) * (1.0 - rho))).sqrt();
    Some(Spearman { rho, p: student_beyond(t, n - 2.0) })
}
