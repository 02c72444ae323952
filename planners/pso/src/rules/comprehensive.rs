//! Comprehensive learning: every dimension learns from its own exemplar.
//!
//! v ← w v + c r (pbest of f(d) − x), x ← x + v in each dimension d, with r uniform
//! on [0, 1), c = 1.49445, w from 0.9 to 0.4 and |v| ≤ 0.2 of the range. Particle
//! i's exemplar f(d) is the better of two others drawn at random, with probability
//!
//! Pcᵢ = 0.05 + 0.45 (e^(10 (i−1)/(N−1)) − 1)/(e^10 − 1), i = 1 … N,
//!
//! and the particle itself otherwise; where all came out its own, one dimension at
//! random gets another's. New exemplars are drawn when the personal best has not
//! improved in `refresh_gap` evaluations. Liang, Qin, Suganthan & Baskar,
//! "Comprehensive learning particle swarm optimizer for global optimization of
//! multimodal functions", IEEE Transactions on Evolutionary Computation 10(3),
//! 2006, 281–295, DOI 10.1109/TEVC.2005.857610.
//!
//! Initial velocities are uniform within the limit (0 without one), as in the
//! authors' code. There a particle outside the search range flies on and is not
//! evaluated, nor does its gap count; here `bounds = "invisible"`, the default
//! beside this rule.

use super::{UpdateRule, Weights};
use crate::border::Border;
use crate::choices::Schedule;
use crate::settings::Settings;
use crate::swarm::{Swarm, better};

/// The rule.
pub struct Comprehensive {
    inertia: Schedule,
    iterations: u64,
    c: f64,
    refresh_gap: u64,
    /// f(d) of each particle, N × m.
    exemplars: Vec<u32>,
    /// Evaluations since each personal best improved, or since its exemplars were drawn.
    stale: Vec<u64>,
}

impl Comprehensive {
    /// With inertia, c and gap of `settings`.
    pub fn new(settings: &Settings) -> Self {
        Self {
            inertia: settings.inertia.unwrap_or_default(),
            iterations: settings.iterations,
            c: settings.c.unwrap_or_default(),
            refresh_gap: settings.refresh_gap.unwrap_or_default(),
            exemplars: Vec::new(),
            stale: Vec::new(),
        }
    }

    /// Counts the last iteration, and draws new exemplars where the gap is reached.
    fn refresh(&mut self, swarm: &mut Swarm, t: u64) {
        let Swarm { particles: n, dims, cost, best_cost, improved, choices, .. } = swarm;
        for i in 0..*n {
            if improved[i] != 0.0 {
                self.stale[i] = 0;
            } else if cost[i] < f64::INFINITY {
                self.stale[i] += 1;
            }
            if t == 0 || self.stale[i] >= self.refresh_gap {
                self.stale[i] = 0;
                let exemplars = &mut self.exemplars[i * *dims..(i + 1) * *dims];
                choose(&best_cost[..*n], i, exemplars, &mut || choices.one());
            }
        }
    }
}

impl UpdateRule for Comprehensive {
    fn begin(&mut self, swarm: &mut Swarm, border: Border) {
        self.exemplars.clear();
        self.exemplars.resize(swarm.particles * swarm.dims, 0);
        self.stale.clear();
        self.stale.resize(swarm.particles, 0);
        if border.max_speed.is_finite() {
            swarm.rng.uniform(&mut swarm.v);
            for v in swarm.v.iter_mut() {
                *v = (2.0 * *v - 1.0) * border.max_speed;
            }
        }
    }

    fn steer(&mut self, swarm: &mut Swarm, t: u64) -> Option<Weights> {
        self.refresh(swarm, t);
        let (dims, stride, w) = (swarm.dims, swarm.stride, self.inertia.at(t, self.iterations));
        for d in 0..dims {
            for i in 0..swarm.particles {
                let (at, exemplar) = (d * stride + i, self.exemplars[i * dims + d] as usize);
                let pull = swarm.best[d * stride + exemplar] - swarm.x[at];
                swarm.v[at] = w * swarm.v[at] + self.c * swarm.random[0][at] * pull;
            }
        }
        None
    }
}

/// Pc of particle `i`, counted from 0, of `n`.
fn learning_probability(i: usize, n: usize) -> f64 {
    let rank = i as f64 / (n - 1).max(1) as f64;
    0.05 + 0.45 * libm::expm1(10.0 * rank) / libm::expm1(10.0)
}

/// Draws particle `i`'s exemplars among particles with these personal bests.
fn choose(costs: &[f64], i: usize, exemplars: &mut [u32], next: &mut dyn FnMut() -> f64) {
    exemplars.fill(i as u32);
    if costs.len() == 1 {
        return;
    }
    let probability = learning_probability(i, costs.len());
    for exemplar in exemplars.iter_mut() {
        if next() < probability {
            *exemplar = tournament(costs, i, next);
        }
    }
    if exemplars.iter().all(|&f| f as usize == i) {
        let d = (next() * exemplars.len() as f64) as usize;
        exemplars[d] = tournament(costs, i, next);
    }
}

/// The better of two particles other than `i`, each drawn from all of them.
fn tournament(costs: &[f64], i: usize, next: &mut dyn FnMut() -> f64) -> u32 {
    let mut other = || {
        let j = (next() * (costs.len() - 1) as f64) as usize;
        if j < i { j } else { j + 1 }
    };
    let (a, b) = (other(), other());
    better(costs, a, b) as u32
}

#[cfg(test)]
mod tests {
    use super::super::by_hand::check;
    use super::*;
    use crate::choices::Rule;

    fn settings() -> Settings {
        Settings { rule: Rule::Comprehensive, iterations: 5, ..Settings::default() }.filled()
    }

    /// A rule whose particles learn from these.
    fn learning(exemplars: &[u32]) -> Comprehensive {
        Comprehensive { exemplars: exemplars.to_vec(), stale: vec![0; 3], ..Comprehensive::new(&settings()) }
    }

    /// Begun already: keeps the exemplars it is given.
    struct Begun(Comprehensive);

    impl UpdateRule for Begun {
        fn steer(&mut self, swarm: &mut Swarm, t: u64) -> Option<Weights> {
            self.0.steer(swarm, t)
        }
    }

    #[test]
    fn three_updates_by_hand() {
        // Iterations 1 to 3 of 5: w = 0.775, 0.65, 0.525. Particle 0, height 0 learns from particle 1:
        // v = 0.775·0.5 + 1.49445·1/8·(1 − 2) = 0.3875 − 0.18680625 = 0.20069375.
        let expected = [
            [[2.20069375, -0.546871875], [0.225, 0.3], [-1.3, 1.275]],
            [[1.00069375, 0.653128125], [-0.27875, -0.9], [-0.1, 1.77875]],
            [
                [-0.19930625, 1.7036745277734373],
                [-0.4491151015625, -0.6595978775976563],
                [0.9412329436718752, 2.04321875],
            ],
        ];
        let velocities = [[0.5, -0.5], [-1.0, 0.25], [0.0, 1.0]];
        check(&settings(), &mut Begun(learning(&[1, 2, 1, 0, 0, 2])), velocities, 1, expected);
    }

    #[test]
    fn learning_probability_rises_with_the_rank() {
        // Of five: 0.05, …, in the middle 0.05 + 0.45 (e⁵ − 1)/(e¹⁰ − 1) = 0.05 + 0.45/(e⁵ + 1), …, 0.5.
        assert_eq!(learning_probability(0, 5), 0.05);
        assert!((learning_probability(2, 5) - 0.053_011_782_916).abs() < 1e-12);
        assert!((learning_probability(4, 5) - 0.5).abs() < 1e-15);
        assert_eq!(learning_probability(0, 1), 0.05);
    }

    /// What particle `i` of these costs learns from with the given random numbers.
    fn chosen<const N: usize>(i: usize, numbers: [f64; N]) -> [u32; 2] {
        let (mut exemplars, mut numbers) = ([9; 2], numbers.into_iter());
        choose(&[3.0, 1.0, 2.0, 2.0], i, &mut exemplars, &mut || numbers.next().expect("enough numbers"));
        assert_eq!(numbers.next(), None, "numbers are left");
        exemplars
    }

    #[test]
    fn exemplars_by_hand() {
        // Pc of the first is 0.05. 0.04: a tournament of ⌊0.9·3⌋ = 2 and ⌊0.5·3⌋ = 1 among 1, 2, 3,
        // which is 3 against 2, equals; the lower wins. 0.06: itself.
        assert_eq!(chosen(0, [0.04, 0.9, 0.5, 0.06]), [2, 0]);
        // All its own: height ⌊0.7·2⌋ = 1 gets the winner of 1 (cost 1) against 2.
        assert_eq!(chosen(0, [0.5, 0.5, 0.7, 0.0, 0.4]), [0, 1]);
        // Pc of the last is 0.5; its others are 0, 1, 2: 0 against 2, and 1 against 1.
        assert_eq!(chosen(3, [0.4, 0.1, 0.9, 0.4, 0.5, 0.5]), [2, 1]);
        let mut alone = [9];
        choose(&[1.0], 0, &mut alone, &mut || unreachable!());
        assert_eq!(alone, [0]);
    }

    #[test]
    fn exemplars_are_drawn_anew_after_the_gap() {
        let mut rule = learning(&[9; 6]);
        let mut swarm = Swarm::default();
        (swarm.particles, swarm.dims) = (3, 2);
        swarm.choices.seed(&mut 1, 1);
        // The first has not improved, the second has, the third was outside and not evaluated.
        for (cost, best, improved) in [(2.0, 1.0, 0.0), (1.0, 1.0, 1.0), (f64::INFINITY, 1.0, 0.0)] {
            swarm.cost.push(cost);
            swarm.best_cost.push(best);
            swarm.improved.push(improved);
        }
        rule.stale = vec![6, 6, 6];
        rule.refresh(&mut swarm, 20);
        assert_eq!(rule.stale, [0, 0, 6]);
        assert!(rule.exemplars[..2].iter().all(|&f| f < 3) && rule.exemplars[2..] == [9; 4]);
    }
}
