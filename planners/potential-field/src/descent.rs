//! Steps of fixed length down the potential.

use env_model::{CellGrid, Point, Vector, path_length};
use planner_api::{Detail, ForcesView, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};

use crate::{Field, PotentialFieldSettings};

/// How often a step that would enter an obstacle is halved before the robot
/// counts as stuck: to 1/256 of a step.
const HALVINGS: u32 = 8;

/// Cells along the longer side at whose centres observers see the force.
const SAMPLES: usize = 40;

/// Follows the force of the [`Field`] step by step.
///
/// An iteration is a step and evaluates the force once. Each step is tested
/// exactly; one that would enter an obstacle or leave the field (possible where
/// a gap is narrower than a step) is halved up to eight times. The robot is
/// stuck where the force is zero, no halved step is free, or the last `window`
/// steps brought it nowhere: `NotFound`, with terms `("stuck_x", x)` and
/// `("stuck_y", y)` in scene units. So do the last of `steps` steps end.
///
/// The cost is the path's length, +∞ until the goal is reached.
#[derive(Debug, Clone)]
pub struct PotentialField {
    settings: PotentialFieldSettings,
    trail: Vec<Point>,
    forces: Vec<Vector>,
}

/// What a step has led to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    OnTheWay,
    Arrived,
    Stuck,
}

impl PotentialField {
    /// A planner with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: PotentialFieldSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, trail: Vec::new(), forces: Vec::new() })
    }

    /// One step from the trail's end.
    fn step(&mut self, problem: &Problem<'_>, length: f64, run: &mut Run<'_>) -> Outcome {
        let at = self.trail[self.trail.len() - 1];
        let mut free = |a: Point, b: Point| {
            run.spent.collision_checks += 1;
            problem.world.segment_free(a, b)
        };
        if (problem.goal - at).norm() <= length && free(at, problem.goal) {
            self.trail.push(problem.goal);
            return Outcome::Arrived;
        }
        let force = Field::new(problem, &self.settings).force(at);
        let norm = force.norm();
        if norm == 0.0 {
            return Outcome::Stuck;
        }
        let mut step = force * (length / norm);
        for _ in 0..=HALVINGS {
            if free(at, at + step) {
                self.trail.push(at + step);
                return if self.is_stuck(length) { Outcome::Stuck } else { Outcome::OnTheWay };
            }
            step *= 0.5;
        }
        Outcome::Stuck
    }

    /// Whether the last `window` steps brought the robot nowhere.
    fn is_stuck(&self, length: f64) -> bool {
        let window = self.settings.window;
        let last = self.trail.len() - 1;
        last.checked_sub(window).is_some_and(|before| {
            (self.trail[last] - self.trail[before]).norm() <= self.settings.progress * window as f64 * length
        })
    }

    /// The force at each cell's centre, zero where no robot can be.
    fn sample(&mut self, problem: &Problem<'_>, grid: &CellGrid) {
        let field = Field::new(problem, &self.settings);
        self.forces.clear();
        self.forces.extend((0..grid.len()).map(|cell| {
            let p = grid.centre(cell);
            if field.is_free(p) { field.force(p) } else { Vector::zeros() }
        }));
    }
}

impl Planner for PotentialField {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let extent = problem.world.extent();
        let length = self.settings.step * extent.diagonal();
        let grid = CellGrid::along_longer_side(&extent, SAMPLES);
        if run.detail() == Detail::State {
            self.sample(problem, &grid);
        }
        self.trail.clear();
        self.trail.push(problem.start);
        let mut outcome = Outcome::OnTheWay;
        let mut steps = 0;
        loop {
            let (trail, end) = (&self.trail, self.trail[self.trail.len() - 1]);
            let stuck = (outcome == Outcome::Stuck).then_some(end);
            run.report("potential-field", plan.cost, || {
                View::Forces(ForcesView { grid: &grid, forces: &self.forces, trail, stuck })
            });
            if outcome != Outcome::OnTheWay || !run.allows(1) {
                break;
            }
            outcome = self.step(problem, length, run);
            steps += 1;
            run.spent.iterations += 1;
            run.spent.evaluations += 1;
            if outcome == Outcome::Arrived {
                plan.path.extend_from_slice(&self.trail);
                plan.cost = path_length(&plan.path);
            } else if steps == self.settings.steps {
                outcome = Outcome::Stuck;
            }
        }
        if outcome == Outcome::Stuck {
            let end = self.trail[self.trail.len() - 1];
            plan.terms.extend([("stuck_x", end.x), ("stuck_y", end.y)]);
        }
        plan.counters = run.spent;
        Ok(match outcome {
            _ if run.stopped() => Status::BudgetSpent,
            Outcome::Arrived => Status::Solved,
            _ => Status::NotFound,
        })
    }
}
