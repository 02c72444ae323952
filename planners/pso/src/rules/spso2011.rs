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

#[cfg(test)]
mod tests {
    use super::super::by_hand::check;
    use super::*;
    use crate::choices::{Bounds, Rule, Topology};
    use crate::lanes::Lanes;

    #[test]
    fn three_updates_by_hand() {
        let topology = Some(Topology::Global);
        let settings = Settings { rule: Rule::Spso2011, topology, iterations: 3, ..Settings::default() }.filled();
        // w = 0.721348, c = 1.193147. Particle 0: p = x = (2, −1), l = (1, 1.5), so that
        // G − x = c (l − x)/3 = (−0.397716, 0.994289), of length 1.070874; r1 = 3/8 of it is
        // 0.401578, in direction 2π/8 (the first pair's second number; in two dimensions its
        // first cancels out): (0.283958, 0.283958). With v = (0.5, −0.5):
        // v = (0.360674 − 0.397716 + 0.283958, −0.360674 + 0.994289 + 0.283958) = (0.246916, 0.917573).
        // Particle 1 leads itself and sits on its best: G = x, and v = w v.
        let expected = [
            [
                [2.2469186024016063, -0.08242387405627238],
                [0.2786524795555183, 1.6803368801111205],
                [-0.4681927646172186, 1.7006085763460996],
            ],
            [
                [1.9291135857145472, 0.6078745615080822],
                [0.18864711441523685, 2.0909716863673906],
                [1.5292781213605824, 2.434787832335999],
            ],
            [
                [1.2022706164699166, 1.4606319435832797],
                [0.7665394730291185, 1.8758381833313411],
                [1.5394163752175087, 2.726416358452016],
            ],
        ];
        let velocities = [[0.5, -0.5], [-1.0, 0.25], [0.0, 2.0]];
        check(&settings, &mut Spso2011::new(&settings), velocities, 0, expected);
    }

    #[test]
    fn first_move_stays_inside() {
        let settings = Settings { rule: Rule::Spso2011, ..Settings::default() }.filled();
        let mut swarm = Swarm::default();
        swarm.rng.seed(&mut 3, 8);
        swarm.x.resize(800, 0.0);
        swarm.v.resize(800, 0.0);
        for (i, x) in swarm.x.iter_mut().enumerate() {
            *x = 3.0 - 6.0 * (i % 8) as f64 / 7.0;
        }
        let border = Border { bounds: Bounds::Rebound, half_width: 3.0, max_speed: f64::INFINITY };
        Spso2011::new(&settings).begin(&mut swarm, border);
        let landed: Vec<f64> = swarm.x.iter().zip(swarm.v.iter()).map(|(x, v)| x + v).collect();
        assert!(landed.iter().all(|y| y.abs() <= 3.0));
        // Uniform on [−3, 3): the mean of 800 has a standard error of 0.061; five of them.
        assert!(landed.iter().sum::<f64>().abs() / 800.0 < 0.31);
    }

    #[test]
    fn normal_variates_are_standard_and_uncorrelated() {
        let mut generator = Lanes::default();
        generator.seed(&mut 11, 1);
        let n = 100_000;
        let (mut sums, mut squares, mut product) = ([0.0; 2], [0.0; 2], 0.0);
        for _ in 0..n {
            let pair = normals(generator.one(), generator.one());
            product += pair[0] * pair[1];
            for k in 0..2 {
                sums[k] += pair[k];
                squares[k] += pair[k] * pair[k];
            }
        }
        // Standard errors of mean, mean product and mean square: 0.0032, 0.0032, 0.0045; five of them.
        let n = f64::from(n);
        assert!((product / n).abs() < 0.016);
        for k in 0..2 {
            assert!((sums[k] / n).abs() < 0.016 && (squares[k] / n - 1.0).abs() < 0.023);
        }
        assert_eq!(normals(0.0, 0.3), [0.0; 2]);
    }
}
