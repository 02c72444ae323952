//! Particle-swarm path planning after Lu & Sun, "Soccer Robot Path Planning
//! Based on PSO", *Computer Technology and Development* 22(7), 2012, 124–127,
//! and the family of swarms that the field would expect beside it.
//!
//! A particle is a vector of heights y'₁ … y'ₘ on the columns of
//! [`env_model::Columns`]. Fitness (eq. 4, minimised) is Σ λᵢ fᵢ with fᵢ the
//! length of segment i and λᵢ = 1 when it is free, 1000 when it collides.
//! Every reading of what the paper leaves open is a setting; see [`Settings`].
//!
//! One swarm, several update rules (`rules`, one a file): a [`Rule`] says how
//! particles move, a [`Topology`] whose best they follow, [`Bounds`] what happens
//! at the border. Evaluation and bests are common.
//!
//! # What keeps the bits the same everywhere
//!
//! Particles sit in lanes. Each lane owns a generator (`lanes`), and a vector
//! unit's arithmetic touches no other lane, so its width cannot change a result;
//! what looks across lanes (bests, neighbours, mean best) is scalar code in the
//! order of the particles; sums over segments run in path order; there is no fused
//! multiply-add, and transcendental functions are `libm`'s.

mod border;
mod choices;
mod lanes;
mod neighbours;
mod pass;
mod planner;
mod rules;
mod settings;
mod sides;
mod swarm;
mod terrain;
mod width;

pub use choices::{Bounds, NoLimit, RandomNumbers, Rule, Schedule, Topology, VelocityLimit};
pub use planner::Pso;
pub use settings::Settings;
pub use width::Width;
