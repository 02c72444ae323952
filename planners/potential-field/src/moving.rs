//! The potential field among obstacles that move: repulsion by position *and* velocity.
//!
//! An obstacle repels only what approaches it. With n the unit vector towards it, ρ the clearance, w = (v − v₀)·n
//! the speed of approach, b = w²/(2a) the distance in which it can be braked away, and x = ρ − b,
//!
//! - U = η (1/x − 1/ρ0) for w > 0 and x < ρ0, else 0;
//! - F = −∇ₚU − ∇ᵥU = η/x² ( −(1 + w/a) n + w v⊥/(D a) n⊥ ), v⊥ n⊥ the rest of the relative velocity and D the
//!   distance to the obstacle's core: it brakes the approach, and pushes on to the side to which one passes already;
//! - the goal, which stands still, attracts with 2αₚ min(d, d\*) towards it and brakes with 2αᵥ v.
//!
//! The paper adds gradients by position and by velocity, numbers of different units; here they are numbers without
//! any: speeds in units of the speed limit s, lengths of s²/a, forces of a. The force is the acceleration for one
//! period, cut to the limits. Where x ≤ 0 the paper's potential is not defined (contact cannot be averted); x counts as
//! 1/1000 at least.
//!
//! Ours are d\* = αᵥ/αₚ, where the pull of a far goal just sustains the speed limit (the paper has the parabola alone),
//! and the end: inside d\*, with nothing repelling, the exponential approach gives way to the fastest motion to the goal.
//! Faults that are the method's: pockets, and obstacles straight ahead, which have no side (v⊥ = 0).
//!
//! Source: S. S. Ge & Y. J. Cui, *Dynamic motion planning for mobile robots using potential field method*, Autonomous
//! Robots 13:207–222, 2002, DOI 10.1023/A:1020564024509.

use env_model::motion::{Limits, State, Trajectory, bang_bang, stop};
use env_model::{Aabb, Inflated, Vector};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};
use serde::{Deserialize, Serialize};

use crate::clearance::{Clearance, clearance};

/// Least x that the force tells apart.
const NEAREST: f64 = 1e-3;

/// Settings of [`MovingPotentialField`], in its units without dimension. The paper's examples have gains for their own
/// units; these defaults are ours.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MovingPotentialFieldSettings {
    /// ρ0, beyond which an obstacle that could be braked away from repels nothing, in units of s²/a; above 0, at most 100.
    /// Default 0.25: 0.75 m at 3 m/s and 3 m/s².
    pub influence: f64,
    /// η, 0 … 10⁹. Default 0.0025: all of the acceleration at x = 0.05.
    pub repulsion_gain: f64,
    /// αₚ, above 0, at most 10⁹. Default 2: with αᵥ = 2 the approach is critically damped and uses three quarters of the
    /// acceleration.
    pub position_gain: f64,
    /// αᵥ, above 0, at most 10⁹. Default 2.
    pub velocity_gain: f64,
}

impl Default for MovingPotentialFieldSettings {
    fn default() -> Self {
        Self { influence: 0.25, repulsion_gain: 0.0025, position_gain: 2.0, velocity_gain: 2.0 }
    }
}

impl MovingPotentialFieldSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let (influence, eta) = (self.influence, self.repulsion_gain);
        SettingError::check(influence > 0.0 && influence <= 100.0, "influence", influence, "above 0, at most 100")?;
        SettingError::check((0.0..=1e9).contains(&eta), "repulsion_gain", eta, "0 to 1e9")?;
        for (key, gain) in [("position_gain", self.position_gain), ("velocity_gain", self.velocity_gain)] {
            SettingError::check(gain > 0.0 && gain <= 1e9, key, gain, "above 0, at most 1e9")?;
        }
        Ok(())
    }
}

/// The potential field among obstacles that move; see the [module](self). Remembers nothing from call to call.
///
/// The answer is one period of the force's acceleration and then the brakes ([`Outcome::Partial`]), or the fastest
/// motion to the goal.
#[derive(Debug, Clone)]
pub struct MovingPotentialField {
    settings: MovingPotentialFieldSettings,
}

impl MovingPotentialField {
    /// A controller with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: MovingPotentialFieldSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings })
    }

    /// The repulsion of an obstacle at `distance` (clearance) and `core` (to its core) in the direction n, which is
    /// approached with the relative velocity `relative`; all in units without dimension.
    pub fn repulsion(&self, distance: f64, core: f64, n: Vector, relative: Vector) -> Vector {
        let approach = relative.dot(&n);
        let x = distance - 0.5 * approach * approach;
        if approach <= 0.0 || x >= self.settings.influence {
            return Vector::zeros();
        }
        let x = x.max(NEAREST);
        let sideways = relative - n * approach;
        (sideways * (approach / core) - n * (1.0 + approach)) * (self.settings.repulsion_gain / (x * x))
    }

    /// The sum of all repulsions.
    fn repulsions(&self, situation: &Situation<'_>) -> Vector {
        let Situation { world, movers, state, limits, .. } = *situation;
        let (speed, length) = (limits.speed, limits.speed * limits.speed / limits.acceleration);
        let (p, v) = (state.position, state.velocity);
        let mut force = Vector::zeros();
        let mut repel = |shape: &Inflated, margin: f64, theirs: Vector| {
            let Clearance { distance, gradient } = clearance(shape, p);
            // On the core itself nothing has a direction.
            let core = ((distance + shape.radius) / length).max(NEAREST);
            force += self.repulsion((distance - margin) / length, core, -gradient, (v - theirs) / speed);
        };
        movers.iter().for_each(|mover| repel(&mover.shape, mover.margin, mover.velocity()));
        let reach = self.settings.influence * length + limits.braking_distance(v.norm());
        world.for_each_overlapping(&Aabb { min: p, max: p }.inflated(reach), |i| {
            repel(&world.obstacles()[i], 0.0, Vector::zeros());
        });
        if let Some(field) = world.inner_field() {
            let (low, high) = (p - field.min, field.max - p);
            for (distance, n) in
                [(low.x, -Vector::x()), (low.y, -Vector::y()), (high.x, Vector::x()), (high.y, Vector::y())]
            {
                // A line has no core to pass by.
                force += self.repulsion(distance / length, f64::INFINITY, n, v / speed);
            }
        }
        force
    }
}

impl Controller for MovingPotentialField {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { state, goal, limits, period, .. } = *situation;
        let (speed, length) = (limits.speed, limits.speed * limits.speed / limits.acceleration);
        run.spent.evaluations += 1;
        let repulsion = self.repulsions(situation);
        let MovingPotentialFieldSettings { position_gain, velocity_gain, .. } = self.settings;
        let (to, conic) = ((goal - state.position) / length, velocity_gain / position_gain);
        let distance = to.norm();
        if distance <= conic && repulsion == Vector::zeros() {
            bang_bang(state, goal, limits, trajectory);
            return Ok(Outcome::Arrives);
        }
        let pull = if distance > conic { to * (conic / distance) } else { to };
        let force = repulsion + pull * (2.0 * position_gain) - state.velocity * (2.0 * velocity_gain / speed);
        let wanted = force * limits.acceleration;
        let size = wanted.norm();
        let acceleration = if size > limits.acceleration { wanted * (limits.acceleration / size) } else { wanted };
        push_on(state, acceleration, limits, period, trajectory);
        Ok(Outcome::Partial)
    }
}

/// `acceleration` for one period, less where the robot would become too fast, and then the brakes.
fn push_on(state: State, acceleration: Vector, limits: Limits, period: f64, out: &mut Trajectory) {
    out.begin(state);
    if state.velocity.norm() <= limits.speed {
        let then = state.velocity + acceleration * period;
        let speed = then.norm();
        if speed > limits.speed {
            // The nearest permitted velocity is no further than the one asked for, but for rounding, which counts when
            // divided by a short period.
            let change = then * (limits.speed / speed) - state.velocity;
            let size = change.norm();
            let rate = if size > limits.acceleration * period { limits.acceleration / size } else { period.recip() };
            out.push(period, change * rate);
        } else {
            out.push(period, acceleration);
        }
    }
    stop(out, limits);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_is_the_negative_gradient_by_position_and_by_velocity() {
        let field = MovingPotentialField::new(MovingPotentialFieldSettings::default()).unwrap();
        let (eta, reach) = (0.0025, 0.25);
        // A disc of radius 0.06 at the origin; the potential written out apart from the force.
        let potential = |p: Vector, v: Vector| {
            let approach = -v.dot(&p) / p.norm();
            let x = p.norm() - 0.06 - 0.5 * approach * approach;
            eta * (1.0 / x - 1.0 / reach)
        };
        for (p, v) in [
            (Vector::new(-0.25, 0.05), Vector::new(0.4, 0.1)),
            (Vector::new(0.1, 0.2), Vector::new(0.2, -0.3)),
            (Vector::new(0.0, -0.2), Vector::new(-0.3, 0.1)),
        ] {
            let h = 1e-6;
            let gradient = Vector::from_fn(|i, _| {
                let e = Vector::from_fn(|j, _| if i == j { h } else { 0.0 });
                let by_position = potential(p + e, v) - potential(p - e, v);
                let by_velocity = potential(p, v + e) - potential(p, v - e);
                (by_position + by_velocity) / (2.0 * h)
            });
            let force = field.repulsion(p.norm() - 0.06, p.norm(), -p / p.norm(), v);
            // Central differences: h² times third derivatives below 10³, and rounding of 1e-16/h.
            assert!((force + gradient).norm() < 1e-7 * (1.0 + force.norm()), "{force} {gradient}");
        }
    }

    #[test]
    fn what_moves_away_or_is_far_repels_nothing() {
        let field = MovingPotentialField::new(MovingPotentialFieldSettings::default()).unwrap();
        let n = Vector::x();
        assert_eq!(field.repulsion(0.01, 0.1, n, Vector::new(-0.1, 1.0)), Vector::zeros());
        assert_eq!(field.repulsion(0.3, 0.4, n, Vector::new(0.1, 0.0)), Vector::zeros());
        // Nearer by b = ½: the same distance, faster.
        assert!(field.repulsion(0.3, 0.4, n, Vector::new(1.0, 0.0)).x < 0.0);
    }

    #[test]
    fn short_periods_keep_the_limits() {
        let limits = Limits::new(3.0, 2.0).unwrap();
        let mut out = Trajectory::default();
        for period in [1.0, 1e-3, 1e-9, 1e-12, 1e-15, 1e-18, 1e-300, 1e-320] {
            for i in 0..50 {
                let (along, across) = (f64::from(i) * 0.7, f64::from(i) * 1.1);
                let velocity = Vector::new(along.cos(), along.sin()) * (3.0 * (1.0 - 1e-16 * f64::from(i)));
                let push = Vector::new(across.cos(), across.sin()) * 2.0;
                push_on(State { position: env_model::Point::origin(), velocity }, push, limits, period, &mut out);
                let peaks = out.peaks();
                assert!(peaks.acceleration <= 2.0 * (1.0 + 1e-9), "{period} {i}: {peaks:?}");
                assert!(peaks.speed <= 3.0 * (1.0 + 1e-9), "{period} {i}: {peaks:?}");
            }
        }
    }

    #[test]
    fn bad_settings_are_errors_by_name() {
        type Spoil = fn(&mut MovingPotentialFieldSettings);
        let cases: [(&str, Spoil); 5] = [
            ("influence", |s| s.influence = 0.0),
            ("influence", |s| s.influence = f64::NAN),
            ("repulsion_gain", |s| s.repulsion_gain = -1.0),
            ("position_gain", |s| s.position_gain = 0.0),
            ("velocity_gain", |s| s.velocity_gain = f64::INFINITY),
        ];
        assert_eq!(MovingPotentialFieldSettings::default().validate(), Ok(()));
        for (key, spoil) in cases {
            let mut settings = MovingPotentialFieldSettings::default();
            spoil(&mut settings);
            assert_eq!(settings.validate().unwrap_err().key, key);
        }
    }
}
