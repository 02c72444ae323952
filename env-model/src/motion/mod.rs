//! Time in the model: how robots move, and when moving things meet.
//!
//! A robot is omnidirectional: its acceleration and its speed are bounded in every direction alike ([`Limits`]). A
//! [`Trajectory`] is a chain of pieces of constant acceleration, so that positions are quadratic in time, distances
//! to discs are roots of quartics, and every question about contact has an exact answer ([`contact`]).
//!
//! Times are seconds from *now*, lengths scene units.

pub mod axis;
pub mod bang_bang;
pub mod bound;
pub mod contact;
mod follow;
mod limits;
mod mover;
pub mod polynomial;
mod trajectory;

pub use bang_bang::{bang_bang, brake, change_velocity, slow_down, stop};
pub use bound::least_time;
pub use contact::{Contact, Touched, first_contact, least_clearance};
pub use follow::{Follower, follow};
pub use limits::{Limits, MotionError};
pub use mover::{Mover, Path, Side};
pub use trajectory::{Piece, State, Trajectory};
