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

#[cfg(test)]
mod tests {
    use super::super::by_hand::check;
    use super::*;
    use crate::choices::Rule;

    #[test]
    fn three_updates_by_hand() {
        let settings = Settings { rule: Rule::Quantum, iterations: 3, ..Settings::default() }.filled();
        // α = 1, 0.75, 0.5. Particle 0, height 0: mbest = (2 + 1 − 2.5)/3 = 1/6; φ = 1/8,
        // p = 2/8 + 7/8 = 1.125; r = 1/8 is + with u = 3/4:
        // x = 1.125 + |1/6 − 2| ln(4/3) = 1.125 + 1.833333·0.287682 = 1.652417.
        // Particle 2, height 0 comes past −H and is put there.
        let expected = [
            [[1.6524171328282649, 1.4866962407465936], [1.0, 1.1643709154729223], [-3.0, 0.9229470120752968]],
            [
                [0.49359423533972246, 0.9524426055386204],
                [1.4934485089477234, 1.282914883707709],
                [-2.2832465821788053, 1.0150898116863198],
            ],
            [
                [0.49359423533972246, 0.9409106637029986],
                [-0.710813773457494, 1.0909831385353777],
                [1.0952925013739798, 0.7262213027693102],
            ],
        ];
        check(&settings, &mut Quantum::new(&settings), [[0.0; 2]; 3], 0, expected);
    }

    #[test]
    fn well_is_symmetric_exponential_and_finite() {
        let ln_2 = std::f64::consts::LN_2;
        assert_eq!([0.0, 0.25, 0.5, 0.75].map(laplace), [0.0, ln_2, 0.0, -ln_2]);
        // The numbers are multiples of 2⁻³², so that u is at least 2⁻³¹.
        let ulp = 2f64.powi(-32);
        assert!((laplace(0.5 - ulp) - 31.0 * ln_2).abs() < 1e-12 && (laplace(1.0 - ulp) + 31.0 * ln_2).abs() < 1e-12);
    }
}
