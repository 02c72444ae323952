//! Composition: a planner, then refiners, under one budget.

use planner_api::{Plan, PlanError, Planner, Problem, Refinement, Refiner, Run, Status};

/// A planner whose plans are refined.
pub struct Refined {
    planner: Box<dyn Planner>,
    refiners: Vec<Box<dyn Refiner>>,
}

impl Refined {
    /// `planner`, then each of `refiners` in turn.
    pub fn new(planner: Box<dyn Planner>, refiners: Vec<Box<dyn Refiner>>) -> Self {
        Self { planner, refiners }
    }
}

impl Planner for Refined {
    fn plan_into(&mut self, problem: &Problem<'_>, run: &mut Run<'_>, plan: &mut Plan) -> Result<Status, PlanError> {
        let mut status = self.planner.plan_into(problem, run, plan)?;
        if status == Status::Infeasible {
            return Ok(status);
        }
        for refiner in &mut self.refiners {
            status = match refiner.refine(problem, run, plan)? {
                Refinement::Improved | Refinement::Repaired => Status::Solved,
                Refinement::Unchanged => status,
                Refinement::NotRepaired => Status::NotFound,
                Refinement::BudgetSpent => Status::BudgetSpent,
            };
        }
        Ok(if run.stopped() { Status::BudgetSpent } else { status })
    }

    fn reset(&mut self) {
        self.planner.reset();
    }
}
