//! Behaviour control (Fang 2009, chapter 5) and the genetic algorithm that tunes it.
//!
//! Four behaviours, each a vector: to the goal, away from what stands, away from robots, to one's slot of the
//! formation; and a little noise. Their weighted sum is the wished velocity. The text of the thesis breaks off before
//! its formulas, so these are the motor schemas of Balch & Arkin (1998), "Behavior-based formation control for
//! multirobot teams", IEEE Transactions on Robotics and Automation 14(6), whose published gains are
//! [`Parameters::default`].
//!
//! [`Behaviour`] drives one robot. [`tune`] searches better parameters by a genetic algorithm in a small closed-loop
//! world of its own ([`Protocol`]); [`fitness`] measures parameters on scenarios that training never saw.

mod attraction;
mod avoidance;
mod controller;
mod dice;
mod episode;
mod fitness;
mod formation;
mod noise;
mod parameters;
mod protocol;
mod scenario;
mod settings;
mod steering;
mod swirl;
mod tuning;

pub use controller::Behaviour;
pub use fitness::{Fitness, fitness};
pub use formation::Formation;
pub use parameters::Parameters;
pub use protocol::{Charge, Protocol, Weights};
pub use scenario::Set;
pub use settings::BehaviourSettings;
pub use tuning::{Coding, Generation, Selection, Tuned, Tuning, tune};
