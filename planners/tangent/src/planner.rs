//! The exact planner.

use env_model::Point;
use planner_api::{Detail, Plan, PlanError, Planner, Problem, Run, SettingError, Status, TreeView, View};
use serde::{Deserialize, Serialize};

use crate::optimum::solve;
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

/// The exact planner.
///
/// Solves with obstacles less ε/4, which leaves ε/4 for rounding to what planners
/// call free ([`World::slack`](env_model::World::slack) = ε/2).
///
/// Counts as iterations the lengths up to which paths were looked for, as
/// evaluations the arrivals expanded, as collision checks the tangents tested. A
/// frame shows the tree of arrivals, with chords for arcs.
#[derive(Debug)]
pub struct Tangent {
    settings: Settings,
    solver: Solver,
    tree: Tree,
}

/// Buffers for frames.
#[derive(Debug, Default)]
struct Tree {
    nodes: Vec<Point>,
    parents: Vec<u32>,
}

impl Tree {
    fn show(&mut self, run: &mut Run<'_>, cost: f64, write: impl FnOnce(&mut Vec<Point>, &mut Vec<u32>)) {
        let Self { nodes, parents } = self;
        if run.detail() == Detail::State {
            nodes.clear();
            parents.clear();
            write(nodes, parents);
        }
        let trees = [TreeView { nodes, parents }];
        run.report(STAGE, cost, || View::Trees(&trees));
    }
}

impl Tangent {
    /// A planner with checked settings.
    ///
    /// # Errors
    /// The setting outside its range.
    pub fn new(settings: Settings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, solver: Solver::new(), tree: Tree::default() })
    }
}

impl Planner for Tangent {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        let Self { settings, solver, tree } = self;
        tree.show(run, f64::INFINITY, |nodes, parents| {
            nodes.push(problem.start);
            parents.push(0);
        });
        let outcome = solve(solver, problem, 0.5 * problem.world.slack(), &mut Supervised { run, tree });
        let status = match outcome {
            Outcome::Stopped => Status::BudgetSpent,
            // What is closed by less than ε is open to the judge: no proof then.
            Outcome::Infeasible => {
                match solve(solver, problem, problem.world.epsilon(), &mut Supervised { run, tree }) {
                    Outcome::Infeasible => Status::Infeasible,
                    Outcome::Stopped => Status::BudgetSpent,
                    Outcome::Found { .. } => Status::NotFound,
                }
            }
            Outcome::Found { length } => {
                solver.write_polyline(settings.excess, &mut plan.path);
                plan.cost = length;
                run.spent.iterations += 1;
                tree.show(run, length, |nodes, parents| solver.write_tree(nodes, parents));
                Status::Solved
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
    tree: &'a mut Tree,
}

impl Watch for Supervised<'_, '_> {
    fn allows(&mut self) -> bool {
        self.run.allows(1)
    }

    fn in_time(&mut self) -> bool {
        self.run.in_time()
    }

    fn expanded(&mut self) {
        self.run.spent.evaluations += 1;
    }

    fn tested(&mut self) {
        self.run.spent.collision_checks += 1;
    }

    fn raised(&mut self, write: impl FnOnce(&mut Vec<Point>, &mut Vec<u32>)) {
        self.run.spent.iterations += 1;
        self.tree.show(self.run, f64::INFINITY, write);
    }
}
