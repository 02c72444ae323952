//! Particle-swarm path planning after Lu & Sun, "Soccer Robot Path Planning
//! Based on PSO", *Computer Technology and Development* 22(7), 2012, 124–127.
//!
//! A particle is a vector of heights y'₁ … y'ₘ on the columns of
//! [`env_model::Columns`]. Fitness (eq. 4, minimised) is Σ λᵢ fᵢ with fᵢ the
//! length of segment i and λᵢ = 1 when it is free, 1000 when it collides.
//! Every reading of what the paper leaves open is a setting; see [`Settings`].
//!
//! # What keeps the bits the same everywhere
//!
//! Particles sit in lanes. Each lane owns a generator (`lanes`) and its
//! arithmetic touches no other lane, so the width of the vector unit cannot
//! change a result; sums over segments run in path order; there is no fused
//! multiply-add and no transcendental function.

mod lanes;
mod pass;
mod planner;
mod settings;
mod sides;
mod swarm;
mod terrain;

pub use planner::Pso;
pub use settings::{Bounds, Inertia, NoLimit, RandomNumbers, Settings, Topology, VelocityLimit};
