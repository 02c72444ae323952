//! The standard of 2011: one random point in a ball instead of two random pulls.
//!
//! G = x + c (p + l − 2x)/3 is the centre of gravity of x and of two points a bit
//! beyond the personal best p and the neighbourhood's best l, or x + c (p − x)/2
//! where the particle leads its neighbourhood itself. With x' a random point of
//! the ball round G with radius |G − x|,
//!
//! v ← w v + x' − x, x ← x + v,
//!
//! w = 1/(2 ln 2), c = 1/2 + ln 2. Unlike the classic rule it does not depend on
//! the axes. Zambrano-Bigiarini, Clerc & Rojas, "Standard Particle Swarm
//! Optimisation 2011 at CEC-2013", CEC 2013, 2337–2344; Clerc, "Standard Particle
//! Swarm Optimisation", 2012, with his reference code, as follows.
//!
//! - The point's direction is uniform (normalised normal variates), its distance
//!   from G uniform on [0, |G − x|): denser at the centre than the uniform ball.
//! - Initial velocities are uniform on [−H − x, H − x] in each dimension.
//! - Its neighbourhood and border are settings like everyone's, whose defaults
//!   beside this rule are the standard's: `topology = "random"`, `bounds = "rebound"`.
//! - The reference code moves one particle after the other; here all move at once.

use std::f64::consts::TAU;

use super::{UpdateRule, Weights};
use crate::border::Border;
use crate::choices::Schedule;
use crate::settings::Settings;
use crate::swarm::Swarm;

/// The rule.
pub struct Spso2011 {
    inertia: Schedule,
    iterations: u64,
    c: f64,
    /// G − x of the particle in hand.
    towards: Vec<f64>,
    /// A random direction, not normalised.
    direction: Vec<f64>,
}

impl Spso2011 {
    /// With the inertia and the weight c of `settings`.
    pub fn new(settings: &Settings) -> Self {
        Self {
            inertia: settings.inertia.unwrap_or_default(),
            iterations: settings.iterations,
            c: settings.c.unwrap_or_default(),
            towards: Vec::new(),
            direction: Vec::new(),
        }
    }
}

impl UpdateRule for Spso2011 {
    /// A pair gives two normal variates; the last row, the distances.
    fn rows(&self, dims: usize) -> usize {
        dims.div_ceil(2) + 1
    }

    fn begin(&mut self, swarm: &mut Swarm, border: Border) {
        let Swarm { x, v, rng, .. } = swarm;
        rng.uniform(v);
        for (v, x) in v.iter_mut().zip(x.iter()) {
            *v = (2.0 * *v - 1.0) * border.half_width - x;
        }
    }

    fn steer(&mut self, swarm: &mut Swarm, t: u64) -> Option<Weights> {
        let (dims, stride, w) = (swarm.dims, swarm.stride, self.inertia.at(t, self.iterations));
        let Self { towards, direction, .. } = self;
        for i in 0..swarm.particles {
            let leader = swarm.leader_of(i);
            towards.clear();
            towards.extend((0..dims).map(|d| {
                let (own, x) = (swarm.best[d * stride + i], swarm.x[d * stride + i]);
                if leader == i {
                    self.c * (own - x) / 2.0
                } else {
                    self.c * (own + swarm.best[d * stride + leader] - 2.0 * x) / 3.0
                }
            }));
            direction.clear();
            for pair in 0..dims.div_ceil(2) {
                let at = pair * stride + i;
                direction.extend(normals(swarm.random[0][at], swarm.random[1][at]));
            }
            // An odd number of dimensions leaves one over.
            direction.truncate(dims);
            let length = norm(direction);
            let distance = swarm.random[0][dims.div_ceil(2) * stride + i] * norm(towards);
            let scale = if length > 0.0 { distance / length } else { 0.0 };
            for (d, (towards, direction)) in towards.iter().zip(direction.iter()).enumerate() {
                let v = &mut swarm.v[d * stride + i];
                *v = w * *v + towards + scale * direction;
            }
        }
        None
    }
}

/// Two independent standard normal variates from two numbers uniform on [0, 1)
/// (Box & Muller 1958).
fn normals(r1: f64, r2: f64) -> [f64; 2] {
    let radius = (-2.0 * libm::log(1.0 - r1)).sqrt();
    let (sin, cos) = libm::sincos(TAU * r2);
    [radius * cos, radius * sin]
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|v| v * v).sum::<f64>().sqrt()
}
