//! Tests that cross crates: every planner and every controller of the catalogue against its contract, golden experiments, and what families promise.

mod allocation;
mod contract;
mod controllers;
mod golden;
mod optimum;
mod rrt;

use touchline_tests::{planners, scenes};
