//! Planning in space and time: safe interval path planning (SIPP) among moving obstacles.
//!
//! 1. If the bang-bang trajectory to the goal is free as far as movers are predicted, it is the answer.
//! 2. Else A* over pairs of grid cell and *safe interval*, a longest stretch of time in which no mover comes near the
//!    cell. Of each pair only the earliest arrival matters: whoever is there earlier can wait. Moves take their length
//!    over the cruise speed; one begins when both cells are safe, and both stay so until it ends.
//! 3. The stops become a motion within the robot's limits: legs as long as possible, each checked exactly in time.
//!
//! What is planned on the grid keeps the timing only as far as the limits allow, so the motion is judged on its own:
//! it ends before the first leg that would touch something, and is then `Partial`.
//!
//! Source: M. Phillips & M. Likhachev, *SIPP: Safe interval path planning for dynamic environments*, ICRA 2011,
//! 5628–5635, DOI 10.1109/ICRA.2011.5980306.

mod controller;
mod intervals;
mod retime;
mod search;
mod settings;

pub use controller::Sipp;
pub use search::Stop;
pub use settings::SippSettings;
