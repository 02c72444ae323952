//! The paper's rule, and Clerc & Kennedy's: inertia and two attractors.
//!
//! v ← w v + c1 r1 (pbest − x) + c2 r2 (gbest − x), x ← x + v (Lu & Sun 2012,
//! equations 1 and 2; Shi & Eberhart 1998), r1, r2 uniform on [0, 1). With
//! constriction (Clerc & Kennedy 2002) w = χ and c1 = c2 = χφ/2, φ = 4.1.
//!
//! It has no loops: the evaluation's sweep ([`crate::pass`]) draws the random numbers
//! and computes the velocities as it reads the positions.

use super::UpdateRule;
use crate::choices::{Rule, Schedule};
use crate::lanes::INV_2_32;
use crate::settings::Settings;
use crate::swarm::Swarm;
use crate::width::Vectors;

/// χ for φ = 4.1, and χφ/2, as everyone rounds them.
const CONSTRICTION: Weights = Weights { w: 0.7298, c1: 1.49618, c2: 1.49618 };

/// The numbers of equation (1) in one iteration.
#[derive(Debug, Clone, Copy)]
pub struct Weights {
    /// Inertia.
    pub w: f64,
    /// Pull of the personal best.
    pub c1: f64,
    /// Pull of the social best.
    pub c2: f64,
}

impl Weights {
    /// For random numbers of 0 … 2³² instead of 0 … 1. Exact, so that the bits stay the
    /// same: multiplying by a power of two commutes with rounding.
    pub fn for_words(self) -> Self {
        Self { c1: self.c1 * INV_2_32, c2: self.c2 * INV_2_32, ..self }
    }

    /// Equation (1): the new velocities of particles at `x`.
    #[inline(always)]
    pub fn velocity<V: Vectors>(
        &self,
        unit: V,
        (r1, r2): (V::f64s, V::f64s),
        (x, v): (V::f64s, V::f64s),
        (own, social): (V::f64s, V::f64s),
    ) -> V::f64s {
        let splat = |value: f64| unit.splat_f64s(value);
        let pull = |c: f64, r, to| unit.mul_f64s(unit.mul_f64s(splat(c), r), unit.sub_f64s(to, x));
        unit.add_f64s(unit.add_f64s(unit.mul_f64s(splat(self.w), v), pull(self.c1, r1, own)), pull(self.c2, r2, social))
    }
}

/// The rule.
pub struct Inertia {
    inertia: Schedule,
    iterations: u64,
    weights: Weights,
}

impl Inertia {
    /// With the weights of `settings`, or with constriction's.
    pub fn new(settings: &Settings) -> Self {
        let weights = match settings.rule {
            Rule::Constriction => CONSTRICTION,
            _ => Weights { w: 0.0, c1: settings.c1.unwrap_or_default(), c2: settings.c2.unwrap_or_default() },
        };
        Self {
            inertia: settings.inertia.unwrap_or(Schedule::Constant(weights.w)),
            iterations: settings.iterations,
            weights,
        }
    }
}

impl UpdateRule for Inertia {
    /// None: the sweep that moves the particles draws their numbers as well.
    fn rows(&self, _: usize) -> usize {
        0
    }

    fn steer(&mut self, _: &mut Swarm, t: u64) -> Option<Weights> {
        Some(Weights { w: self.inertia.at(t, self.iterations), ..self.weights })
    }
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::check;
    use super::*;

    #[test]
    fn three_updates_by_hand() {
        let settings = Settings { iterations: 3, ..Settings::default() }.filled();
        // w = 0.9, 0.65, 0.4. Particle 0, height 0: r2 = 1/8, pbest = x = 2, gbest = 1:
        // v = 2·1/8·(1 − 2) = −0.25. Particle 2: v = 2·7/8·(1 + 2.5) is cut to H/2 = 1.5.
        let expected = [
            [[1.75, 0.25], [1.0, 1.5], [-1.0, 0.75]],
            [[0.4625, 1.75], [1.0, 1.5], [0.5, 2.0375]],
            [[0.485, 2.0375], [1.0, 1.5], [0.725, 0.7275]],
        ];
        check(&settings, &mut Inertia::new(&settings), [[0.0; 2]; 3], 0, expected);
    }

    #[test]
    fn three_updates_with_constriction_by_hand() {
        let settings = Settings { rule: Rule::Constriction, iterations: 3, ..Settings::default() }.filled();
        // As above with 1.49618: v = 1.49618·1/8·(1 − 2) = −0.1870225.
        let expected = [
            [[1.8129775, -0.0648875], [1.0, 1.5], [-1.0, 0.6870225]],
            [[0.7642179725375, 1.4351125], [1.0, 1.5], [0.5, 1.7357820274625]],
            [
                [-0.00116673060463246, 2.5298125],
                [0.6913241903822622, 1.48786457753125],
                [1.1818766173066837, 1.491672348905789],
            ],
        ];
        check(&settings, &mut Inertia::new(&settings), [[0.0; 2]; 3], 0, expected);
    }
}
