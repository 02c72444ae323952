//! Start to goal, whatever stands between.

use planner_api::{Plan, PlanError, Planner, Problem, Run, Status, View};
use serde::{Deserialize, Serialize};

/// The straight line has no settings.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StraightLineSettings {}

/// One segment and one collision test: `Solved` when it is free, else `NotFound` with the same path.
#[derive(Debug, Clone, Copy, Default)]
pub struct StraightLine;

impl Planner for StraightLine {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        plan.clear();
        if !run.allows(1) {
            plan.counters = run.spent;
            return Ok(Status::BudgetSpent);
        }
        plan.path.extend([problem.start, problem.goal]);
        plan.cost = (problem.goal - problem.start).norm();
        let free = problem.world.segment_free(problem.start, problem.goal);
        run.spent.iterations += 1;
        run.spent.evaluations += 1;
        run.spent.collision_checks += 1;
        plan.counters = run.spent;
        run.report("straight-line", plan.cost, || View::Path(&plan.path));
        Ok(if free { Status::Solved } else { Status::NotFound })
    }
}
