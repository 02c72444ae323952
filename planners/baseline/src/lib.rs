//! Baselines that every other planner should beat: the straight line, and
//! random search in the column model of the 2012 paper.

mod random_search;
mod straight_line;

pub use random_search::{RandomSearch, RandomSearchSettings};
pub use straight_line::{StraightLine, StraightLineSettings};
