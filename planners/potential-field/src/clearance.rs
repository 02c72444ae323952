//! Clearance to an inflated obstacle, and the direction in which it grows.

use env_model::{Inflated, Point, Vector};

/// Distance to an obstacle and its gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// ρ, in scene units, negative inside.
    pub distance: f64,
    /// ∇ρ, a unit vector; zero on the core itself (only a point robot can be there), where it has no direction.
    pub gradient: Vector,
}

/// Clearance ρ of `p` to `obstacle`, and ∇ρ: [`Inflated::clearance_direction`].
pub fn clearance(obstacle: &Inflated, p: Point) -> Clearance {
    let (distance, gradient) = obstacle.clearance_direction(p);
    Clearance { distance, gradient }
}
