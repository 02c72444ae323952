//! The exact shortest path among discs, capsules and polygons, inflated by the
//! robot's radius, within the field: the yardstick of the bench.
//!
//! A shortest path among open obstacles is a chain of arcs and common tangents that
//! never turns away from the disc it leaves, so it is smooth. The search runs on
//! *oriented circles* (`bitangent`): a disc passed counter-clockwise has signed
//! radius ρ = r, clockwise ρ = −r, and start and goal are circles of radius 0.
//! A node is an arrival on an oriented circle with a heading; an edge is an arc
//! to the heading of a tangent, and that tangent.
//!
//! A* (`search`) draws both from the whole scene as it asks for them: the
//! neighbours of an arrival are the sites in a lens towards the goal that nearer
//! obstacles leave in sight (`lens`), up to a length limit that rises as it proves
//! too low; a tangent is tested when it comes up, and covers of a circle (`covers`)
//! are found when the first path arrives there. Capsules and polygons are corners to
//! go round and pieces that block (`terrain`).
//! This is lazy search (Dellin & Srinivasa, ICAPS 2016) on a tangent graph
//! (Liu & Arimoto, *IJRR* 11(4), 1992) that is discovered along the way.
//!
//! [`Solver`] is the bare algorithm, [`optimum`] the bench's yardstick,
//! [`Tangent`] the planner.

mod bitangent;
mod candidate;
mod cells;
mod covers;
mod lens;
mod optimum;
mod planner;
mod route;
mod search;
mod separation;
mod terrain;

pub use optimum::{NoOptimum, Optimum, optimum};
pub use planner::{Settings, Tangent};
pub use search::{Outcome, Solver};
