//! Comprehensive learning: every dimension learns from its own exemplar.
//!
//! v_d ← w v_d + c r_d (pbest_{f(d)},d − x_d), x ← x + v, with c = 1.49445, w from
//! 0.9 to 0.4 and |v_d| ≤ 0.2 of the range. Particle i's exemplar f(d) is the
//! better of two others drawn at random, with probability
//!
//! Pc_i = 0.05 + 0.45 (e^{10(i−1)/(N−1)} − 1)/(e^{10} − 1), i = 1 … N,
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
            if improved[i] {
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
