//! Real roots of polynomials of degree four at most, on an interval.
//!
//! Between neighbouring roots of its derivative a polynomial is monotone, so each such stretch has one root at most
//! and bisection, sped up by Newton's steps, finds it to the last bits. No closed formula of Ferrari's keeps as many.
//! Most polynomials never change their sign, which their Bernstein coefficients tell at once (the hull property; Farouki,
//! *The Bernstein polynomial basis: a centennial retrospective*, 2012).

/// Coefficients c₀ + c₁t + c₂t² + c₃t³ + c₄t⁴.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polynomial(pub [f64; 5]);

/// Up to four ascending numbers.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Roots {
    values: [f64; 4],
    len: usize,
}

impl Roots {
    fn push(&mut self, value: f64) {
        self.values[self.len] = value;
        self.len += 1;
    }
}

impl std::ops::Deref for Roots {
    type Target = [f64];

    fn deref(&self) -> &[f64] {
        &self.values[..self.len]
    }
}

impl Polynomial {
    /// Its value at `t`, by Horner's rule.
    pub fn at(&self, t: f64) -> f64 {
        let c = &self.0;
        (((c[4] * t + c[3]) * t + c[2]) * t + c[1]) * t + c[0]
    }

    /// Its derivative.
    #[must_use]
    pub fn derivative(&self) -> Self {
        let c = &self.0;
        Self([c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 0.0])
    }

    fn degree(&self) -> usize {
        self.0.iter().rposition(|c| *c != 0.0).unwrap_or(0)
    }

    /// Where it changes its sign in (low, high), ascending; both finite.
    pub fn roots(&self, low: f64, high: f64) -> Roots {
        let mut roots = Roots::default();
        match self.degree() {
            0 => {}
            1 => {
                let t = -self.0[0] / self.0[1];
                if t > low && t < high {
                    roots.push(t);
                }
            }
            2 => self.quadratic_roots(low, high, &mut roots),
            _ => {
                let slope = self.derivative();
                let turns = slope.roots(low, high);
                let (mut a, mut fa) = (low, self.at(low));
                for b in turns.iter().copied().chain([high]) {
                    let fb = self.at(b);
                    if (fa < 0.0 && fb > 0.0) || (fa > 0.0 && fb < 0.0) {
                        roots.push(self.bracketed(&slope, a, b, fa));
                    } else if fb == 0.0 && fa != 0.0 && b < high && self.changes_sign(fa, &turns, b, high) {
                        roots.push(b);
                    }
                    (a, fa) = (b, fb);
                }
            }
        }
        roots
    }

    /// Both or none, without cancellation: q = −(b + sign(b)√(b² − 4ac))/2, t₁ = q/a, t₂ = c/q.
    fn quadratic_roots(&self, low: f64, high: f64, roots: &mut Roots) {
        let [c, b, a, ..] = self.0;
        let discriminant = b * b - 4.0 * a * c;
        if discriminant > 0.0 {
            let q = -0.5 * (b + discriminant.sqrt().copysign(b));
            let (t, u) = (q / a, c / q);
            [t.min(u), t.max(u)].into_iter().filter(|t| *t > low && *t < high).for_each(|t| roots.push(t));
        }
    }

    /// Whether its sign after its zero at the turning point `b` is another one than `fa`'s before it.
    fn changes_sign(&self, fa: f64, turns: &Roots, b: f64, high: f64) -> bool {
        let next = turns.iter().copied().find(|t| *t > b).unwrap_or(high);
        self.at(next) * fa < 0.0
    }

    /// The root between `a` and `b`, where its values have different signs, `fa` at `a`.
    fn bracketed(&self, slope: &Self, mut a: f64, mut b: f64, fa: f64) -> f64 {
        let mut t = 0.5 * (a + b);
        // Bisection alone ends after 64 halvings or so; Newton's steps are taken where they stay inside.
        for _ in 0..128 {
            let f = self.at(t);
            if f == 0.0 {
                return t;
            }
            if (f < 0.0) == (fa < 0.0) {
                a = t;
            } else {
                b = t;
            }
            let newton = t - f / slope.at(t);
            let middle = 0.5 * (a + b);
            let next = if newton > a && newton < b { newton } else { middle };
            if next == t || middle <= a || middle >= b {
                return next;
            }
            t = next;
        }
        t
    }

    /// Its coefficients bᵢ in Bernstein's basis on [0, high]: between neighbours of one sign it has that sign.
    fn bernstein(&self, high: f64) -> [f64; 5] {
        let mut scaled = self.0;
        let mut power = 1.0;
        for c in &mut scaled {
            *c *= power;
            power *= high;
        }
        let [c0, c1, c2, c3, c4] = scaled;
        let (c1, c2, c3) = (0.25 * c1, c2 / 6.0, 0.25 * c3);
        [c0, c0 + c1, c0 + 2.0 * c1 + c2, c0 + 3.0 * (c1 + c2) + c3, c0 + 4.0 * (c1 + c3) + 6.0 * c2 + c4]
    }

    /// The first time in [0, high] from which on it is below zero, at least for a while.
    pub fn first_below(&self, high: f64) -> Option<f64> {
        if self.0[0] < 0.0 {
            return Some(0.0);
        }
        if self.bernstein(high).iter().all(|b| *b >= 0.0) {
            return None;
        }
        let slope = self.derivative();
        let (mut a, mut fa) = (0.0, self.0[0]);
        for b in slope.roots(0.0, high).iter().copied().chain([high]) {
            let fb = self.at(b);
            if fb < 0.0 {
                return Some(if fa > 0.0 { self.bracketed(&slope, a, b, fa) } else { a });
            }
            (a, fa) = (b, fb);
        }
        None
    }

    /// Where in [0, high] it is least, and its value there.
    pub fn least(&self, high: f64) -> (f64, f64) {
        let mut least = (0.0, self.0[0]);
        for t in self.derivative().roots(0.0, high).iter().copied().chain([high]) {
            let value = self.at(t);
            if value < least.1 {
                least = (t, value);
            }
        }
        least
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_of_known_polynomials() {
        // (t − 1)(t − 2)(t − 3)(t − 4)
        let p = Polynomial([24.0, -50.0, 35.0, -10.0, 1.0]);
        let roots = p.roots(0.0, 10.0);
        assert_eq!(roots.len(), 4);
        for (root, expected) in roots.iter().zip([1.0, 2.0, 3.0, 4.0]) {
            assert!((root - expected).abs() < 1e-13, "{root}");
        }
        assert_eq!(p.roots(1.5, 3.5).len(), 2);
        assert_eq!(Polynomial([1.0, 0.0, 1.0, 0.0, 0.0]).roots(-9.0, 9.0).len(), 0);
        assert_eq!(Polynomial([-2.0, 1.0, 0.0, 0.0, 0.0]).roots(0.0, 9.0)[..], [2.0]);
        // t²: touches, does not cross; t³ crosses.
        assert_eq!(Polynomial([0.0, 0.0, 1.0, 0.0, 0.0]).roots(-1.0, 1.0).len(), 0);
        assert_eq!(Polynomial([0.0, 0.0, 0.0, 1.0, 0.0]).roots(-1.0, 1.0)[..], [0.0]);
    }

    #[test]
    fn first_time_below_zero() {
        let p = Polynomial([24.0, -50.0, 35.0, -10.0, 1.0]);
        assert!((p.first_below(10.0).unwrap() - 1.0).abs() < 1e-13);
        assert_eq!(p.first_below(0.9), None);
        assert_eq!(Polynomial([-1.0, 5.0, 0.0, 0.0, 0.0]).first_below(1.0), Some(0.0));
        assert_eq!(Polynomial([0.0, -1.0, 0.0, 0.0, 0.0]).first_below(1.0), Some(0.0), "enters at once");
        assert_eq!(Polynomial([0.0, 1.0, 0.0, 0.0, 0.0]).first_below(1.0), None, "touches and leaves");
        assert_eq!(p.least(5.0).1, p.at(p.least(5.0).0));
    }
}
