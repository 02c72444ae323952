//! The exact optimum of a scene, from the tangent planner's solver.

use planner_api::Problem;

use crate::results::Optimum;

/// The shortest length among obstacles shrunk by ε, so that no valid path is shorter; or why it is not known.
pub fn of(problem: &Problem<'_>) -> Optimum {
    match planner_tangent::optimum(problem) {
        Ok(planner_tangent::Optimum { length, path }) => Optimum { length: Some(length), path, reason: None },
        Err(reason) => Optimum { length: None, path: Vec::new(), reason: Some(reason.to_string()) },
    }
}
