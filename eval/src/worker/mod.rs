//! Planners in processes of their own: the worker protocol from both ends.
//!
//! [`protocol`] holds the messages, [`serve()`] answers them with planners of the catalogue (`touchline worker`),
//! [`Seat`] is where a campaign's planner runs: in this process, or behind a [`process`] that may crash, hang or
//! talk rubbish without harm to any other run.

pub mod process;
pub mod protocol;
mod seat;
mod serve;
pub mod tether;

pub use seat::Seat;
pub use serve::serve;
