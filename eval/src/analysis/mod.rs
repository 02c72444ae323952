//! From a campaign's results to figures ready to print.
//!
//! Everything but [`summarise`] starts from a [`Grid`], the runs of the test scenes sorted once by planner and scene:
//! tuning scenes are no evidence. Planners and scenes are named by their position in the grid.

mod blocks;
mod curves;
pub mod fixed_budget;
mod grid;
mod moving;
pub mod noise;
pub mod pairs;
pub mod ranking;
pub mod sentences;
mod spent;
mod summary;
pub mod targets;

#[cfg(test)]
mod testing;

pub use blocks::{Measure, Over, quality};
pub(crate) use curves::{Course, Step, cost_is_length};
pub use curves::{Curves, Effort};
pub use grid::Grid;
pub use moving::{MovingSummary, summarise_moving};
pub(crate) use summary::counted_cost;
pub use summary::{Summary, counted_gap, counted_length, summarise};
