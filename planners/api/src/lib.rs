//! What a planner is: the contract that every planner keeps.
//!
//! A [`Planner`] turns a [`Problem`] into a [`Plan`]; the caller's [`Run`]
//! carries seed, budget and observer. A [`Refiner`] improves another planner's
//! plan. Planners do no I/O, start no threads, keep no globals, and read no
//! clock but through the budget. The same problem, settings, seed and *count*
//! budget give the same path, bit for bit.
//!
//! A [`Controller`] is what moves a robot, frame by frame, among obstacles that move: from a [`Situation`] to a
//! trajectory.

mod budget;
mod controller;
mod error;
mod observer;
mod plan;
mod planner;
mod problem;
mod run;
pub mod seed;
mod told;

pub use budget::Budget;
pub use controller::{ControlError, Controller, Outcome, Situation};
pub use error::{PlanError, SettingError};
pub use observer::{
    CellState, CellsView, Detail, ForcesView, Frame, Observer, PopulationView, SwarmView, TreeView, View,
};
pub use plan::{Candidates, Counters, Plan};
pub use planner::{Planner, Refinement, Refiner, Status};
pub use problem::Problem;
pub use run::Run;
pub use told::Told;
