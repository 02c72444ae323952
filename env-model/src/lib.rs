//! The world of robot soccer: shapes, scenes, exact continuous collision, and
//! the local frame of the 2012 paper. Knows no planner.
//!
//! A [`Scene`] is data (TOML, a generator); a [`World`] is a scene compiled for
//! its robot radius: immutable, shared between threads, with a broad phase.
//!
//! Obstacles are *open* sets: touching is allowed, entering is not. Signed
//! clearance is positive outside, zero on the border, negative inside.

pub mod aabb;
pub mod bvh;
pub mod frame;
pub mod generate;
pub mod geometry;
pub mod grid;
#[cfg(feature = "import")]
pub mod import;
pub mod inflated;
pub mod influence;
pub mod motion;
pub mod probe;
pub mod risk;
pub mod scene;
pub mod source;
pub mod world;

mod buckets;
mod near;
mod polygon;
mod scene_file;
mod slabs;

pub use aabb::Aabb;
pub use frame::{Columns, LocalFrame};
pub use grid::CellGrid;
pub use inflated::{Core, Inflated};
pub use influence::{Border, Partition, Region};
pub use polygon::{Polygon, PolygonError};
pub use risk::RiskMap;
pub use scene::{Obstacle, Scene, SceneError, Shape};
pub use source::{FileError, Located};
pub use world::{Violation, World};

/// A point in scene units.
pub type Point = nalgebra::Point2<f64>;
/// A displacement in scene units.
pub type Vector = nalgebra::Vector2<f64>;

/// Path length Σ‖pᵢ₊₁ − pᵢ‖, summed from the start; 0 for fewer than two points.
pub fn path_length(path: &[Point]) -> f64 {
    path.windows(2).map(|w| (w[1] - w[0]).norm()).sum()
}
