//! The exact shortest path among discs: the yardstick of the bench.
//!
//! A shortest path among open discs is a chain of arcs and common tangents that
//! never turns away from the disc it leaves, so it is smooth. The search runs on
//! *oriented circles* (`bitangent`): a disc passed counter-clockwise has signed
//! radius ρ = r, clockwise ρ = −r, and start and goal are circles of radius 0.
//! A node is an arrival on an oriented circle with a heading; an edge is an arc
//! to the heading of a tangent, and that tangent.
//!
//! Few obstacles matter: the shortest path among a subset is a lower bound, and
//! when it is free of all the others it is the optimum. So rounds of A*
//! (`search`) begin with no obstacle. A round's tangents are tested against the
//! subset (`subset`) as they come up; its path is then tested against the whole
//! world, and what each tangent enters deepest joins the subset. A disc whose
//! overlap cuts an arc joins at once, so that walls are followed within a round.
//! This is the scheme of lazy shortest paths (Dellin & Srinivasa, ICAPS 2016)
//! on a graph whose vertices are discovered along with its edges.
//!
//! [`Solver`] is the bare algorithm, [`optimum`] the bench's yardstick,
//! [`Tangent`] the planner.

mod bitangent;
mod candidate;
mod discs;
mod optimum;
mod pairs;
mod planner;
mod route;
mod search;
mod separation;
mod subset;

pub use optimum::{NoOptimum, Optimum, optimum};
pub use planner::{Settings, Tangent};
pub use search::{Outcome, Solver};
