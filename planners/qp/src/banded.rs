//! Cholesky factors of symmetric matrices of half-bandwidth 2.
//!
//! A = `LDLᵀ` with unit lower L in O(n): Golub & Van Loan, *Matrix Computations*
//! (4th ed., 2013), §4.3.5.

/// A symmetric matrix of half-bandwidth 2, then its factors.
#[derive(Debug, Clone, Default)]
pub(crate) struct Banded {
    /// Row i of the lower triangle from the diagonal to the left: A(i, i), A(i, i − 1), A(i, i − 2);
    /// after [`factor`](Self::factor) 1/D(i), L(i, i − 1), L(i, i − 2).
    pub(crate) rows: Vec<[f64; 3]>,
}

impl Banded {
    /// Becomes the zero matrix of order `n`.
    pub(crate) fn clear(&mut self, n: usize) {
        self.rows.clear();
        self.rows.resize(n, [0.0; 3]);
    }

    /// Factors in place; false, with the matrix spoilt, when it is not numerically positive definite.
    pub(crate) fn factor(&mut self) -> bool {
        // Rows −2 and −1: couplings into them are zero.
        let (mut before, mut last) = ((0.0, 0.0), (0.0, 0.0, 0.0));
        for row in &mut self.rows {
            let [a, b, c] = *row;
            let (inverse2, d2) = before;
            let (inverse1, d1, l1) = last;
            let second = c * inverse2;
            let first = (b - c * l1) * inverse1;
            let d = a - first * first * d1 - second * second * d2;
            if !(d > 0.0 && d.is_finite()) {
                return false;
            }
            *row = [1.0 / d, first, second];
            before = (inverse1, d1);
            last = (row[0], d, first);
        }
        true
    }

    /// x ← A⁻¹x with the factors.
    pub(crate) fn solve(&self, x: &mut [f64]) {
        let (mut one, mut two) = (0.0, 0.0);
        for (v, [_, first, second]) in x.iter_mut().zip(&self.rows) {
            *v -= first * one + second * two;
            (two, one) = (one, *v);
        }
        // (L(i + 1, i), x(i + 1)) and (L(i + 2, i), x(i + 2)) come from the rows below.
        let (mut first, mut second, mut beyond) = (0.0, 0.0, 0.0);
        (one, two) = (0.0, 0.0);
        for (v, row) in x.iter_mut().zip(&self.rows).rev() {
            *v = *v * row[0] - first * one - second * two;
            (two, one) = (one, *v);
            (second, first, beyond) = (beyond, row[1], row[2]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A(i, j) for i ≥ j.
    fn entry(i: usize, j: usize) -> f64 {
        match i - j {
            0 => 6.0 + i as f64,
            1 => -2.0 + 0.25 * j as f64,
            2 => 0.5 - 0.125 * j as f64,
            _ => 0.0,
        }
    }

    #[test]
    fn solutions_multiply_back() {
        for n in 1..8 {
            let mut a = Banded::default();
            a.clear(n);
            for (i, row) in a.rows.iter_mut().enumerate() {
                for (k, v) in row.iter_mut().enumerate().take(i + 1) {
                    *v = entry(i, i - k);
                }
            }
            let expected: Vec<f64> = (0..n).map(|i| 1.0 - 0.5 * i as f64).collect();
            let product = |i: usize| (0..n).map(|j| entry(i.max(j), i.min(j)) * expected[j]).sum();
            let mut x: Vec<f64> = (0..n).map(product).collect();
            assert!(a.factor());
            a.solve(&mut x);
            // Diagonally dominant, entries below 20: a few roundings.
            assert!(x.iter().zip(&expected).all(|(x, e)| (x - e).abs() < 1e-13), "{n}: {x:?}");
        }
    }

    #[test]
    fn indefinite_matrices_are_told() {
        let mut a = Banded { rows: vec![[1.0, 0.0, 0.0], [1.0, 2.0, 0.0]] };
        assert!(!a.factor());
    }
}
