//! Qubits, their observation and the rotation gate (Han & Kim 2002, §III).

use planner_api::seed::unit;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// α|0⟩ + β|1⟩ with real amplitudes, α² + β² = 1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Qubit {
    alpha: f64,
    beta: f64,
}

impl Qubit {
    /// 0 and 1 equally likely: α = β = 1/√2.
    pub const EVEN: Self = Self { alpha: std::f64::consts::FRAC_1_SQRT_2, beta: std::f64::consts::FRAC_1_SQRT_2 };

    /// 1 with probability β², else 0. The qubit stays as it is: nothing quantum about it.
    pub fn observe(self, rng: &mut ChaCha8Rng) -> bool {
        // Uniform on [0, 1), by 53 bits of a word.
        let u = unit(rng.random());
        u < self.beta * self.beta
    }
}

/// A rotation by ±θ: (α, β) ↦ (α cos θ ∓ β sin θ, β cos θ ± α sin θ).
#[derive(Debug, Clone, Copy)]
pub struct Gate {
    cos: f64,
    sin: f64,
}

impl Gate {
    /// The gate of an angle, in radians.
    pub fn new(theta: f64) -> Self {
        Self { cos: libm::cos(theta), sin: libm::sin(theta) }
    }

    /// Turns `qubit` by the look-up table of Han & Kim 2002, whose entries are all 0 but
    /// two: where the string just seen is worse than the best, and the bits differ
    /// (`seen` 0, `best` 1, or the reverse), the qubit turns towards the best's
    /// bit. In the second and fourth quadrant, αβ < 0, that is the other way round.
    pub fn apply(self, qubit: &mut Qubit, seen: bool, best: bool, worse: bool) {
        if !worse || seen == best {
            return;
        }
        let Qubit { alpha, beta } = *qubit;
        let towards_one = best == (alpha * beta >= 0.0);
        let sin = if towards_one { self.sin } else { -self.sin };
        *qubit = Qubit { alpha: alpha * self.cos - beta * sin, beta: beta * self.cos + alpha * sin };
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use rand::SeedableRng;

    use super::*;

    fn turned(alpha: f64, beta: f64, seen: bool, best: bool, worse: bool) -> Qubit {
        let mut qubit = Qubit { alpha, beta };
        Gate::new(0.01 * PI).apply(&mut qubit, seen, best, worse);
        qubit
    }

    #[test]
    fn the_look_up_table() {
        let even = Qubit::EVEN;
        let [a, b] = [even.alpha, even.beta];
        // From 45° by 1.8° to 46.8° or 43.2°; rounding of a few units in the last place.
        let close = |q: Qubit, degrees: f64| {
            let angle = degrees * PI / 180.0;
            (q.alpha - libm::cos(angle)).abs() < 1e-15 && (q.beta - libm::sin(angle)).abs() < 1e-15
        };
        assert!(close(turned(a, b, false, true, true), 46.8), "θ3 = +0.01 π");
        assert!(close(turned(a, b, true, false, true), 43.2), "θ5 = −0.01 π");
        for (seen, best, worse) in [
            (false, false, true),
            (false, false, false),
            (false, true, false),
            (true, false, false),
            (true, true, true),
            (true, true, false),
        ] {
            assert_eq!(turned(a, b, seen, best, worse), even, "θ = 0");
        }
    }

    #[test]
    fn other_quadrants_turn_the_other_way() {
        let (small, large) = (libm::sin(0.3), libm::cos(0.3));
        for (alpha, beta) in [(large, small), (-large, small), (-large, -small), (large, -small)] {
            let more = turned(alpha, beta, false, true, true);
            let less = turned(alpha, beta, true, false, true);
            assert!(more.beta.abs() > small && less.beta.abs() < small, "({alpha}, {beta})");
        }
    }

    #[test]
    fn a_thousand_turns_keep_the_norm() {
        let (gate, mut qubit) = (Gate::new(0.01 * PI), Qubit::EVEN);
        for _ in 0..1000 {
            gate.apply(&mut qubit, false, true, true);
        }
        let norm = qubit.alpha * qubit.alpha + qubit.beta * qubit.beta;
        // Each turn rounds by a few 1e-16.
        assert!((norm - 1.0).abs() < 1e-12 && qubit.beta * qubit.beta > 0.99, "{qubit:?}");
    }

    #[test]
    fn observation_is_as_likely_as_the_amplitude_says() {
        let qubit = Qubit { alpha: libm::cos(0.5), beta: libm::sin(0.5) };
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let n = 10_000;
        let ones = (0..n).filter(|_| qubit.observe(&mut rng)).count() as f64;
        let p = qubit.beta * qubit.beta;
        // Binomial: five standard deviations are missed once in two million.
        assert!((ones - n as f64 * p).abs() < 5.0 * (n as f64 * p * (1.0 - p)).sqrt(), "{ones}");
    }
}
