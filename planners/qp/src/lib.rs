//! Convex refinement of any planner's path.
//!
//! [`Qp`] shortens or smooths the path of another planner and repairs a
//! colliding one, with guarantees that hold for whole segments:
//! - a free path stays free; a path that collides is never called improved or repaired;
//! - [`Objective::Shorten`] never lengthens;
//! - a colliding path is repaired when a path with its sides exists on the
//!   columns, else it is left as it was.
//!
//! **Columns** ([`Model::Columns`]): vertices on the perpendiculars of start →
//! goal (Lu & Sun 2012). For a fixed side of every obstacle (a *side class*)
//! the set of safe polylines is convex; cutting planes describe it exactly, so
//! the class's optimum is global. Classes come from the plan's path and
//! candidates. The taut string through vertical gates bounds the length of a
//! class from below; classes are polished in that order until the bound
//! exceeds the best length, mostly after one.
//!
//! Clarabel solves the programmes, or a structured interior point of our own
//! ([`Solver::Structured`]) that takes every border of a class as one curved
//! constraint, so that a class is one programme; where it does not converge clarabel
//! takes over. After `max_rounds` the best path so far counts, which among a hundred
//! obstacles clarabel's rounds may leave a few 1e-5 above the optimum.
//!
//! **Free vertices** ([`Model::Free`]): every obstacle near a segment is
//! replaced by a half-plane that both of its ends keep; the current path stays
//! feasible and the objective falls from round to round.
//!
//! Whatever a programme returns is tested segment by segment with
//! [`World::path_free`](env_model::World::path_free) before it counts. Discs,
//! capsules and convex polygons are one convex piece each; a polygon with
//! reflex corners is one piece a side.

mod arc;
mod banded;
mod cuts;
mod free;
mod funnel;
mod halfplane;
mod interior;
mod piece;
mod polish;
mod program;
mod refine;
mod session;
mod settings;
mod smooth;
mod strip;
mod structured;

pub use refine::Qp;
pub use settings::{Classes, Method, Model, Objective, Settings, Solver};
