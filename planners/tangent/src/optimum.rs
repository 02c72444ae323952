//! The optimum that every planner's path is held against.

use env_model::Point;
use planner_api::Problem;

use crate::search::{Outcome, Solver, Watch};

/// The search's tolerance as a part of ε: far above rounding (some 1e-16 of the
/// scene's diagonal, ε being 1e-9 of it), far below what a judge can see.
const TOLERANCE: f64 = 1e-3;
/// Relative excess of the optimum's polyline.
const EXCESS: f64 = 1e-6;

/// The length that no valid path undercuts, and the path.
#[derive(Debug, Clone, PartialEq)]
pub struct Optimum {
    /// Exact length, in scene units.
    pub length: f64,
    /// Its polyline, at most a millionth longer. It touches obstacles shrunk by
    /// ε (a point robot's polygons by up to 3/2 ε at the tips of their corners),
    /// so a judge who allows just ε may refuse it.
    pub path: Vec<Point>,
}

/// Why there is no optimum.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoOptimum {
    /// There is no valid path.
    #[error("the obstacles separate start from goal")]
    Infeasible,
}

/// The shortest path of `problem` with obstacles shrunk by the world's ε and the
/// field grown by as much, so that no path with clearance ≥ −ε is shorter.
///
/// # Errors
/// [`NoOptimum::Infeasible`] is a proof that there is no such path.
pub fn optimum(problem: &Problem<'_>) -> Result<Optimum, NoOptimum> {
    let mut solver = Solver::new();
    match solve(&mut solver, problem, problem.world.epsilon(), &mut ()) {
        Outcome::Found { length } => {
            let mut path = Vec::new();
            solver.write_polyline(EXCESS, &mut path);
            Ok(Optimum { length, path })
        }
        _ => Err(NoOptimum::Infeasible),
    }
}

/// Solves `problem` with obstacles less `shrink`.
pub(crate) fn solve<W: Watch>(solver: &mut Solver, problem: &Problem<'_>, shrink: f64, watch: &mut W) -> Outcome {
    let Problem { world, start, goal, .. } = *problem;
    solver.shortest_in(world, [start, goal], shrink, TOLERANCE * world.epsilon(), watch)
}
