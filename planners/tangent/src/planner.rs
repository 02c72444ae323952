//! The exact planner.

use env_model::Point;
use planner_api::{Plan, PlanError, Planner, Problem, Run, SettingError, Status, View};
use serde::{Deserialize, Serialize};

use crate::optimum::{among_discs, write_path};
use crate::search::{Outcome, Solver, Watch};

/// What can be set.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Settings {
    /// Greatest relative excess of the polyline over the exact path with its
    /// arcs; 1e-9 to 0.1, default 1e-6. The polyline gets about
    /// 0.3 θ/√excess corners for a turn of θ, fewer on small discs.
    pub excess: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { excess: 1e-6 }
    }
}

impl Settings {
    /// Checks the ranges.
    ///
    /// # Errors
    /// The setting outside its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let ok = (1e-9..=0.1).contains(&self.excess);
        SettingError::check(ok, "excess", self.excess, "a number from 1e-9 to 0.1")
    }
}

/// The exact planner among discs.
///
/// Solves with radii less ε/4, which leaves ε/4 for rounding to what planners
/// call free ([`World::slack`](env_model::World::slack) = ε/2). Where other shapes or the border
/// of the field stand in the way of that path, it returns the path with
/// [`Status::NotFound`]: a lower bound, which collides.
///
/// Counts as iterations the rounds of the subset's growth, as evaluations the
/// arrivals expanded, as collision checks the tangents tested. A frame shows a
/// round's path: the shortest among the obstacles met so far, a lower bound.
#[derive(Debug)]
pub struct Tangent {
    settings: Settings,
    solver: Solver,
    /// A buffer for frames.
    sketch: Vec<Point>,
}

impl Tangent {
    /// A planner with checked settings.
    ///
    /// # Errors
    /// The setting outside its range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, solver: Solver::new(), sketch: Vec::new() })
    }
}

impl Planner for Tangent {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let Self { settings, solver, sketch } = self;
        let straight = [problem.start, problem.goal];
        run.report(STAGE, f64::INFINITY, || View::Path(&straight));
        let slack = problem.world.slack();
        let outcome = among_discs(solver, problem, 0.5 * slack, &mut Supervised { run, sketch });
        let status = match outcome {
            Outcome::Stopped => Status::BudgetSpent,
            // What is closed by less than ε is open to the judge: no proof then.
            Outcome::Infeasible => {
                match among_discs(solver, problem, problem.world.epsilon(), &mut Supervised { run, sketch }) {
                    Outcome::Infeasible => Status::Infeasible,
                    Outcome::Stopped => Status::BudgetSpent,
                    Outcome::Found { .. } => Status::NotFound,
                }
            }
            Outcome::Found { length } => {
                let obstruction = write_path(solver, problem, slack, settings.excess, &mut plan.path);
                plan.cost = length;
                run.spent.iterations += 1;
                run.report(STAGE, length, || View::Path(&plan.path));
                if obstruction.is_some() { Status::NotFound } else { Status::Solved }
            }
        };
        plan.counters = run.spent;
        Ok(status)
    }
}

const STAGE: &str = "tangent";

/// The run watches the search.
struct Supervised<'a, 'r> {
    run: &'a mut Run<'r>,
    sketch: &'a mut Vec<Point>,
}

impl Watch for Supervised<'_, '_> {
    fn allows(&mut self) -> bool {
        self.run.allows(1)
    }

    fn expanded(&mut self) {
        self.run.spent.evaluations += 1;
    }

    fn tested(&mut self) {
        self.run.spent.collision_checks += 1;
    }

    fn collided(&mut self, write: impl FnOnce(&mut Vec<Point>)) {
        self.run.spent.iterations += 1;
        self.run.report(STAGE, f64::INFINITY, || {
            write(self.sketch);
            View::Path(self.sketch)
        });
    }
}
