//! A* over influence regions and risk (Wang & Zhu 2018).
//!
//! Wang Chen, Zhu Wei-Dong: "Path Planning of Soccer Robot Based on A* Algorithm",
//! *Computer Systems & Applications* 27(1), 2018, 189–194 (in Chinese).
//!
//! The pitch is cut into square cells; a cell's risk is δ for every defender that
//! is nearer to it than the player on the ball, plus a kernel round each defender
//! ([`env_model::RiskMap`]). A path of n₁ cells with n₂ diagonal moves costs
//!
//! g = a·L + b·W,  L = (n₁ − n₂ − 1)·dis + √2·dis·n₂,  W = Σⱼ wⱼ over its n₁ cells,
//!
//! and A* searches the rectangle between start and goal, widened while the path
//! in it is too risky. What the paper shows only as pictures (the kernel, both
//! listed algorithms) is a reading, marked so in [`Settings`].

mod cost;
mod estimate;
mod map;
mod planner;
mod search;
mod settings;
mod space;

pub use planner::InfluenceAstar;
pub use settings::{Heuristic, Obstacles, SearchSpace, Settings};
