//! Tests that cross crates: every planner of the catalogue against the contract, and golden experiments.

mod allocation;
mod contract;
mod golden;
mod planners;
mod scenes;
