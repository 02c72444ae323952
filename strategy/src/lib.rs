//! The layer round the planners: roles and rules, whole teams, and a simulator that closes the loop.
//!
//! Frame by frame: a [`View`] of the world → a [`Play`](plays::Play) gives every robot a task → a [`Team`] plans for
//! all by priority, each robot with a controller *by name*, changeable between two frames → simulated omnidirectional
//! robots follow → a [`referee`] who shares nothing with the controllers but the motions → [`Metrics`].
//!
//! Lengths are metres, times seconds. Fixed step, seeded, no clock but the one handed in.

mod bodies;
mod draw;
pub mod league;
mod metrics;
mod orders;
pub mod plays;
mod record;
pub mod referee;
pub mod roles;
pub mod rules;
mod settings;
mod simulation;
mod team;

pub use bodies::Body;
pub use league::League;
pub use metrics::Metrics;
pub use record::{Compute, Event, Record, RobotRecord, Trace, TraceBody};
pub use settings::{Cooperation, Dealing, Formation, PlayKind, Settings, Swap};
pub use simulation::{CallBudget, Simulation, SimulationError, simulate};
pub use team::{Origin, Task, Team, TeamError, TeamSettings, View};
