//! Rapidly exploring random trees: RRT-Connect, RRT* and Informed RRT*.
//!
//! - [`RrtConnect`]: two trees, from start and goal, that grow towards each
//!   other; ends with the first path (Kuffner & `LaValle` 2000).
//! - [`RrtStar`]: one tree whose edges are rewired to shorten the ways from the
//!   start; its best path converges to the optimum (Karaman & Frazzoli 2011).
//!   Its informed form samples, once it has a path, only where a shorter one
//!   may pass (Gammell, Srinivasa & Barfoot 2014).
//!
//! All are probabilistically complete: where a path with some room exists, the
//! probability of missing it tends to 0 with the number of samples. Motions are
//! tested exactly and whole, so the length of a step trades exploration against
//! greed and has nothing to do with safety. Samples are uniform in the box where
//! the robot's centre may be ([`env_model::World::extent`]).
//!
//! As in the sources nobody tries the straight motion from start to goal first:
//! where that is free, RRT-Connect's path still bends towards its first sample, and
//! the others come near the straight line as they come near any optimum.

mod connect;
mod cost_tree;
mod ellipse;
mod nearest;
mod rewire;
mod sampler;
mod settings;
mod star;
mod tree;

pub use connect::RrtConnect;
pub use settings::{ConnectSettings, StarSettings};
pub use star::RrtStar;

/// The scene of Lu & Sun (2012).
#[cfg(test)]
fn paper() -> env_model::Scene {
    env_model::Scene {
        name: "paper".into(),
        unit: "cm".into(),
        robot_radius: 0.0,
        start: [200.0, 150.0],
        goal: [400.0, 260.0],
        field: None,
        obstacles: [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]]
            .map(|c| env_model::Obstacle::disc(c.into(), 16.0))
            .to_vec(),
    }
}
