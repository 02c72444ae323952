//! A*, Dijkstra and Theta* on a cell grid: one best-first search, three ways to
//! measure.
//!
//! The pitch ([`World::extent`](env_model::World::extent)) is divided into square
//! cells; those that an inflated obstacle touches are blocked. A robot moves from a
//! cell's centre to one of its eight neighbours', without cutting the corners of
//! blocked cells, and joins the grid at either end by a straight segment
//! ([`CellGrid::entries`](env_model::CellGrid::entries)).
//!
//! | kind | order of expansion | path |
//! |---|---|---|
//! | [`GridSearch::dijkstra`] | g | shortest on the grid (Dijkstra 1959, [doi](https://doi.org/10.1007/BF01386390)) |
//! | [`GridSearch::astar`] | g + octile distance | shortest on the grid (Hart, Nilsson & Raphael 1968, [doi](https://doi.org/10.1109/TSSC.1968.300136)) |
//! | [`GridSearch::theta_star`] | g + straight distance | any angle, turns at cell centres (Nash, Daniel, Koenig & Felner 2007; Daniel, Nash, Koenig & Felner 2010, [doi](https://doi.org/10.1613/jair.2994)) |
//!
//! The paths of A* and Dijkstra stay on the grid even where the straight segment
//! from start to goal is free: up to 8.2 % longer than the shortest path round
//! the same cells, which is what separates them from Theta*.

mod graph;
mod length;
mod method;
mod planner;
mod search;
mod settings;

pub use planner::GridSearch;
pub use settings::Settings;
