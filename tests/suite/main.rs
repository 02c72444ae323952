//! Tests that cross crates: every planner of the catalogue against the contract, golden experiments, and what families promise.

mod allocation;
mod contract;
mod golden;
mod optimum;
mod rrt;

use touchline_tests::{planners, scenes};
