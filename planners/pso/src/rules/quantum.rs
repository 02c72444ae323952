//! Quantum-behaved particles.
//!
//! A particle has no momentum; it appears round a point between the two bests, at
//! a distance drawn from the potential well's exponential law, the wider the
//! further it is from the swarm's mean best. In each dimension
//!
//! p = φ pbest + (1 − φ) gbest, mbest = (1/N) Σ pbest,
//! x ← p ± α |mbest − x| ln(1/u),
//!
//! φ uniform on [0, 1), u on (0, 1], both signs equally likely, α linear from 1 to
//! 0.5. Sun, Feng & Xu, "Particle swarm optimization with particles having quantum
//! behavior", CEC 2004, 325–331; mbest from Sun, Xu & Feng, "A global search
//! strategy of quantum-behaved particle swarm optimization", CIS 2004, 111–116.
//!
//! The velocity it writes is the displacement, so that limits of the rectangle
//! work as for the other rules: `"stop"` and `"clip"` both clip the position.

use super::{UpdateRule, Weights};
use crate::choices::Schedule;
use crate::settings::Settings;
use crate::swarm::Swarm;

/// The rule.
pub struct Quantum {
    alpha: Schedule,
    iterations: u64,
}

impl Quantum {
    /// With the contraction–expansion coefficient of `settings`.
    pub fn new(settings: &Settings) -> Self {
        Self { alpha: settings.alpha.unwrap_or_default(), iterations: settings.iterations }
    }
}

impl UpdateRule for Quantum {
    fn steer(&mut self, swarm: &mut Swarm, t: u64) -> Option<Weights> {
        let (n, stride, alpha) = (swarm.particles, swarm.stride, self.alpha.at(t, self.iterations));
        for d in 0..swarm.dims {
            let row = d * stride;
            let mean = swarm.best[row..row + n].iter().sum::<f64>() / n as f64;
            for i in 0..n {
                let (at, leader) = (row + i, row + swarm.leader_of(i));
                let (phi, draw) = (swarm.random[0][at], swarm.random[1][at]);
                let (own, social, x) = (swarm.best[at], swarm.best[leader], swarm.x[at]);
                let between = phi * own + (1.0 - phi) * social;
                let well = alpha * (mean - x).abs();
                swarm.v[at] = between + well * laplace(draw) - x;
            }
        }
        None
    }
}

/// ± ln(1/u) from one number r uniform on [0, 1): the halves of the interval give
/// the signs, u = 1 − 2r in the lower, 2 − 2r in the upper one.
fn laplace(r: f64) -> f64 {
    if r < 0.5 { -libm::log(1.0 - 2.0 * r) } else { libm::log(2.0 - 2.0 * r) }
}
