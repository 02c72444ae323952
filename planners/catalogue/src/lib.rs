//! Every planner by name, built from TOML: the one crate that a strategy layer
//! depends on.
//!
//! ```
//! let mut built = planner_catalogue::build_str("pso-qp", "particles = 30").unwrap();
//! assert_eq!(built.settings["particles"].as_integer(), Some(30));
//! # let _ = &mut built.planner;
//! ```

mod build;
mod kinds;
mod refined;

pub use build::{BuildError, Built, build, build_str};
pub use kinds::{Kind, kinds};
pub use refined::Refined;
