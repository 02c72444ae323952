//! Replan-frozen: every frame a path among obstacles as if they stood still, and the motion along it.
//!
//! The baseline of every comparison among moving obstacles, and how a planner of static scenes drives a robot.

use env_model::motion::{Follower, Trajectory};
use env_model::{Inflated, World};
use planner_api::{ControlError, Controller, Outcome, Plan, Planner, Problem, Run, Situation, Status};

/// A planner that is asked anew every frame.
pub struct Replan {
    planner: Box<dyn Planner>,
    plan: Plan,
    follower: Follower,
}

impl Replan {
    /// Has `planner` plan every frame.
    pub fn new(planner: Box<dyn Planner>) -> Self {
        Self { planner, plan: Plan::new(), follower: Follower::default() }
    }

    /// The path of the last frame, empty where none was found.
    pub fn path(&self) -> &[env_model::Point] {
        &self.plan.path
    }
}

/// The world with the movers where they are now, grown by their margins as far as start and goal stay free.
fn frozen(situation: &Situation<'_>) -> World {
    let ends = [situation.state.position, situation.goal];
    let frozen = situation.movers.iter().filter_map(|mover| {
        let room = ends.iter().map(|p| mover.shape.point_clearance(*p)).fold(f64::INFINITY, f64::min);
        // What an end lies in would make the problem a typed error: another robot that stands on the goal.
        (room >= 0.0).then(|| Inflated {
            radius: mover.shape.radius + mover.margin.min(room * (1.0 - 1e-9)),
            ..mover.shape.clone()
        })
    });
    situation.world.with_obstacles(frozen)
}

impl Controller for Replan {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { state, goal, limits, .. } = *situation;
        if (goal - state.position).norm() <= situation.world.epsilon() {
            env_model::motion::bang_bang(state, goal, limits, trajectory);
            return Ok(Outcome::Arrives);
        }
        let world = frozen(situation);
        let problem = Problem::new(&world, state.position, goal)?;
        let status = self.planner.plan_into(&problem, run, &mut self.plan)?;
        let found = match status {
            Status::Solved => true,
            // The best by the end of the budget, perhaps a colliding one.
            Status::BudgetSpent => self.plan.path.len() > 1 && world.path_free(&self.plan.path),
            Status::NotFound | Status::Infeasible => false,
        };
        if !found || self.plan.path.len() < 2 {
            return Ok(Outcome::NotFound);
        }
        self.follower.follow(&self.plan.path, state, limits, &world, trajectory);
        Ok(Outcome::Arrives)
    }

    fn reset(&mut self) {
        self.planner.reset();
    }
}
