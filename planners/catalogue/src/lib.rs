//! Every planner by name, built from TOML: the one crate that a strategy layer
//! depends on.
//!
//! ```
//! let mut built = planner_catalogue::build_str("pso-qp", "particles = 30").unwrap();
//! assert_eq!(built.settings["particles"].as_integer(), Some(30));
//! # let _ = &mut built.planner;
//! ```

mod build;
mod controllers;
mod kinds;
mod refined;

pub use build::{BuildError, Built, build, build_str};
pub use controllers::{
    BuiltController, ControllerKind, build_controller, build_controller_str, controller_names, controllers,
};
pub use env_model;
pub use kinds::{Kind, kinds};
pub use planner_api as api;
pub use planner_control as control;
pub use refined::Refined;
