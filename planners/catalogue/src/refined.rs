//! Composition: a planner, then refiners, under one budget.

use planner_api::{Plan, PlanError, Planner, Problem, Refinement, Refiner, Run, Status};

/// Where the run's budget is limited, the planner gets this share of its iterations and evaluations: one that takes
/// all it can get (a swarm) would leave nothing to refine with.
const COUNTS: f64 = 0.9;
/// And this share of the time. A refinement takes few evaluations, but each is a convex programme.
const TIME: f64 = 0.75;

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
        let mut status = run.with_share(COUNTS, TIME, |run| self.planner.plan_into(problem, run, plan))?;
        if status == Status::Infeasible {
            return Ok(status);
        }
        for refiner in &mut self.refiners {
            status = match refiner.refine(problem, run, plan)? {
                Refinement::Improved | Refinement::Repaired => Status::Solved,
                Refinement::Unchanged => status,
                // A planner cut short might have found what cannot be repaired now.
                Refinement::NotRepaired if status == Status::BudgetSpent => status,
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
