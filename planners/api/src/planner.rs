//! The traits.

use crate::{Plan, PlanError, Problem, Run};

/// How a run ended. Whether the path is valid is for an independent judge to say.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    /// The planner believes in its path.
    Solved,
    /// The run's budget (or its observer) ended it; the plan is the best so far.
    BudgetSpent,
    /// No path that the planner believes in; the plan may hold a colliding one.
    NotFound,
    /// Proved: there is none.
    Infeasible,
}

/// A path planner.
pub trait Planner: Send {
    /// Plans into `plan`, whose buffers are reused: a second call of the same
    /// size allocates nothing (refined planners, which build programmes for a
    /// solver, excepted).
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError>;

    /// Plans into a new [`Plan`].
    fn plan(&mut self, problem: &Problem<'_>, run: &mut Run<'_>) -> Result<(Plan, Status), PlanError> {
        let mut plan = Plan::new();
        let status = self.plan_into(problem, run, &mut plan)?;
        Ok((plan, status))
    }

    /// Forgets warm-start memory.
    fn reset(&mut self) {}
}

/// What a refiner did.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refinement {
    /// The path was free and is better now by the refiner's objective.
    Improved,
    /// The path collided and is free now.
    Repaired,
    /// The path was free and is as it was: nothing better was found.
    Unchanged,
    /// The path collided, could not be repaired, and is as it was.
    NotRepaired,
    /// The run's budget ended the refinement; the path is the best so far,
    /// free if it was free before.
    BudgetSpent,
}

/// Improves the path of another planner. Shares the run's budget with it.
pub trait Refiner: Send {
    /// Refines `plan` in place. Never turns a free path into a colliding one,
    /// and never returns a colliding path as `Improved` or `Repaired`.
    /// `plan.counters` end as the run's totals.
    fn refine(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Refinement, PlanError>;
}
