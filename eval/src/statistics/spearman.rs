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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_in_scipy() {
        // scipy.stats.spearmanr(x, y), 1.17.1; the last from (i*73) % 200 + 0.5*i, i = 0 … 199.
        let count = |n: u32| (0..n).map(f64::from).collect::<Vec<f64>>();
        let rising = [5, 3, 8, 1, 9, 12, 7, 7, 15, 11, 14, 20].map(f64::from).to_vec();
        let (x, falling) = ([1, 2, 2, 3, 4, 4, 4, 5].map(f64::from), [8, 7, 7, 5, 9, 1, 1, 0].map(f64::from));
        let long = (0..200).map(|i| f64::from((i * 73) % 200) + 0.5 * f64::from(i)).collect();
        for (x, y, rho, p) in [
            (count(12), rising, 0.781_087_012_197_256_1, 0.002_705_295_646_139_688_6),
            (x.to_vec(), falling.to_vec(), -0.633_650_386_724_793_7, 0.091_621_815_807_315_97),
            (count(200), long, 0.446_498_162_454_061_43, 3.429_041_491_176_045e-11),
        ] {
            let s = spearman(&x, &y).unwrap();
            assert!((s.rho - rho).abs() < 1e-12 && (s.p / p - 1.0).abs() < 1e-10, "{s:?}");
        }
    }

    #[test]
    fn extremes() {
        let inf = f64::INFINITY;
        let s = spearman(&[1.0, 2.0, 3.0, 4.0], &[inf, 3.0, 2.0, 1.0]).unwrap();
        assert_eq!((s.rho, s.p), (-1.0, 0.0));
        assert_eq!(spearman(&[1.0, 2.0, 3.0], &[inf; 3]), None);
        assert_eq!(spearman(&[1.0, 2.0], &[1.0, 2.0]), None);
        assert_eq!(spearman(&[], &[]), None);
    }
}
