//! The optimum that every planner's path is held against.

use env_model::{Aabb, Core, Point, Vector, World};
use planner_api::Problem;

use crate::bitangent::{OrientedCircle, perp};
use crate::discs::{Shrunk, as_disc};
use crate::route::Route;
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
    /// Its polyline, at most a millionth longer. It touches discs shrunk by ε,
    /// so rounding may make a judge who allows just ε refuse it.
    pub path: Vec<Point>,
}

/// Why there is no optimum to be had.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NoOptimum {
    /// There is no valid path.
    #[error("the discs separate start from goal")]
    Infeasible,
    /// The shortest path among the discs meets another shape.
    #[error("obstacle {obstacle} is a {shape}; only discs are supported so far")]
    OtherShape {
        /// Which, counted from 0.
        obstacle: usize,
        /// "capsule" or "polygon".
        shape: &'static str,
    },
    /// The border would bend the path.
    #[error("the shortest path among the discs leaves the field by {depth:.4}; the border is not supported so far")]
    LeavesField {
        /// How far.
        depth: f64,
    },
}

/// The shortest path of `problem` with obstacles shrunk by the world's ε, so
/// that no path with clearance ≥ −ε is shorter.
///
/// Solved among the discs in the whole plane: leaving something out never
/// lengthens a shortest path, so when the result meets neither other shapes nor
/// the border of the field, it is the optimum of the whole problem.
///
/// # Errors
/// [`NoOptimum`] says what the path meets, or that there is none.
pub fn optimum(problem: &Problem<'_>) -> Result<Optimum, NoOptimum> {
    let mut solver = Solver::new();
    let epsilon = problem.world.epsilon();
    let Outcome::Found { length } = among_discs(&mut solver, problem, epsilon, &mut ()) else {
        return Err(NoOptimum::Infeasible);
    };
    let mut path = Vec::new();
    match write_path(&solver, problem, epsilon, EXCESS, &mut path) {
        Some(reason) => Err(reason),
        None => Ok(Optimum { length, path }),
    }
}

/// Solves `problem` among its discs, less `shrink`, in the whole plane.
pub(crate) fn among_discs<W: Watch>(solver: &mut Solver, problem: &Problem<'_>, shrink: f64, watch: &mut W) -> Outcome {
    let Problem { world, start, goal, .. } = *problem;
    let discs = Shrunk { world, shrink, origin: start.coords, goal: goal - start.coords };
    solver.search(&discs, start, goal, TOLERANCE * world.epsilon(), watch)
}

/// Writes the polyline of the path found last, and says what that path meets by
/// more than `allowance`, though it is no disc.
pub(crate) fn write_path(
    solver: &Solver,
    problem: &Problem<'_>,
    allowance: f64,
    excess: f64,
    path: &mut Vec<Point>,
) -> Option<NoOptimum> {
    let world = problem.world;
    let field = world.inner_field().map(|f| f.inflated(allowance));
    let depth = field.map_or(0.0, |f| depth_in(&f, solver.route(), problem));
    solver.write_polyline_within(field.as_ref().filter(|_| depth >= 0.0), excess, path);
    if let Some(obstacle) = first_other_shape(world, path, allowance) {
        let shape = match world.obstacles()[obstacle].core {
            Core::Polygon(_) => "polygon",
            _ => "capsule",
        };
        return Some(NoOptimum::OtherShape { obstacle, shape });
    }
    (depth < 0.0).then_some(NoOptimum::LeavesField { depth: allowance - depth })
}

/// The lowest index of a shape other than a disc that `path` enters.
fn first_other_shape(world: &World, path: &[Point], allowance: f64) -> Option<usize> {
    let mut first: Option<usize> = None;
    for w in path.windows(2) {
        world.for_each_along(w[0], w[1], |i| {
            let obstacle = &world.obstacles()[i];
            let sooner = first.is_none_or(|f| i < f);
            if sooner && as_disc(obstacle).is_none() && !obstacle.segment_free(w[0], w[1], allowance) {
                first = Some(i);
            }
        });
    }
    first
}

/// Least signed distance to the border of `field` over the route, positive inside.
///
/// Straight pieces lie between their ends, and an arc is extreme at an end or
/// where it heads along an axis.
fn depth_in(field: &Aabb, route: &Route, problem: &Problem<'_>) -> f64 {
    let depth = |p: Point| field.depth_of(p + problem.start.coords);
    let mut least = field.depth_of(problem.start).min(field.depth_of(problem.goal));
    for arc in &route.arcs {
        let OrientedCircle { centre, rho } = arc.circle;
        least = least.min(depth(arc.point(0.0))).min(depth(arc.point(arc.turn)));
        for axis in [Vector::x(), Vector::y(), -Vector::x(), -Vector::y()] {
            if arc.circle.turn(arc.heading, axis) <= arc.turn {
                least = least.min(depth(centre - perp(axis) * rho));
            }
        }
    }
    least
}
