//! The controller.

use env_model::Vector;
use env_model::motion::{Limits, State, Trajectory, bang_bang, change_velocity, stop};
use planner_api::seed::{splitmix64, unit};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};

use crate::OrcaSettings;
use crate::constraints::{Wall, for_each_wall, of_mover};
use crate::program::{HalfPlane, least_violation, solve};
use crate::reach::{Objective, Reach};

/// Optimal reciprocal collision avoidance; see the crate. Remembers nothing from call to call but its buffers.
///
/// A call that must give way answers [`Outcome::Partial`]: one period to the new velocity, which is then held as long
/// as the horizon and the walls permit, and brakes. O(n²) in the number of half-planes at worst.
#[derive(Debug, Clone)]
pub struct Orca {
    settings: OrcaSettings,
    walls: Vec<Wall>,
    planes: Vec<HalfPlane>,
    buffer: Vec<HalfPlane>,
}

impl Orca {
    /// A controller with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: OrcaSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, walls: Vec::new(), planes: Vec::new(), buffer: Vec::new() })
    }

    /// Walls first, which the fallback keeps; then movers in their order.
    fn constrain(&mut self, situation: &Situation<'_>, horizon: f64) {
        let Situation { world, movers, state, limits, period, .. } = *situation;
        let speed = limits.speed.max(state.velocity.norm());
        let reach = speed * horizon.max(period) + limits.braking_distance(speed);
        self.walls.clear();
        for_each_wall(world, state.position, reach, |wall| self.walls.push(wall));
        self.planes.clear();
        self.planes.extend(self.walls.iter().map(|wall| wall.half_plane(limits, period)));
        self.planes.extend(movers.iter().map(|mover| of_mover(mover, state, horizon, period, &self.settings)));
    }

    /// The reachable velocity nearest to `preferred` in all half-planes, or the one of least violation.
    fn velocity(&mut self, reach: &Reach, preferred: Vector) -> Vector {
        let (best, failed) = solve(&self.planes, reach, Objective::Nearest(preferred));
        let Some(failed) = failed else { return best };
        let hard = self.walls.len().min(failed);
        least_violation(&self.planes, hard, failed, reach, best, &mut self.buffer)
    }

    /// How long `velocity` can be held until it is time to brake before a wall, in seconds, at most `horizon`.
    fn held(&self, velocity: Vector, limits: Limits, horizon: f64) -> f64 {
        let stop = 0.5 * velocity.norm() / limits.acceleration;
        let until = |wall: &Wall| {
            let towards = wall.normal.dot(&velocity);
            if towards > 0.0 { wall.clearance / towards - stop } else { f64::INFINITY }
        };
        self.walls.iter().map(until).fold(horizon, f64::min).max(0.0)
    }
}

/// A random vector no longer than `length`: direction and length uniform, as in RVO2.
fn perturbation(mut seed: u64, length: f64) -> Vector {
    let mut uniform = || unit(splitmix64(&mut seed));
    let (angle, length) = (uniform() * std::f64::consts::TAU, uniform() * length);
    Vector::new(libm::cos(angle), libm::sin(angle)) * length
}

impl Controller for Orca {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { state, goal, limits, horizon, period, .. } = *situation;
        let horizon = horizon.min(self.settings.time_horizon);
        self.constrain(situation, horizon);
        run.spent.evaluations += self.planes.len() as u64;
        bang_bang(state, goal, limits, trajectory);
        let preferred = trajectory.state(period).velocity;
        if self.planes.iter().all(|plane| plane.violation(preferred) <= 0.0) {
            return Ok(Outcome::Arrives);
        }
        let reach = Reach::new(state.velocity, limits, period);
        let preferred = preferred + perturbation(run.seed, self.settings.perturbation * limits.speed);
        let velocity = self.velocity(&reach, preferred);
        self.answer(state, velocity, situation, horizon, trajectory);
        Ok(Outcome::Partial)
    }
}

impl Orca {
    /// To `velocity`, on with it, and to a stop.
    fn answer(
        &self,
        state: State,
        velocity: Vector,
        situation: &Situation<'_>,
        horizon: f64,
        trajectory: &mut Trajectory,
    ) {
        let Situation { limits, period, .. } = *situation;
        trajectory.begin(state);
        change_velocity(trajectory, velocity, limits);
        // The period itself is promised; who is still too fast holds nothing.
        let speed = velocity.norm();
        let ramp = trajectory.duration();
        if speed <= limits.speed * (1.0 + 1e-12) {
            let hold = (self.held(velocity, limits, horizon) - ramp).max(period - ramp);
            trajectory.push(hold, Vector::zeros());
        }
        stop(trajectory, limits);
    }
}
