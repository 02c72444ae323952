//! Clearance to an inflated obstacle, and the direction in which it grows.

use env_model::geometry::{closest_point, point_segment_distance_squared};
use env_model::{Core, Inflated, Point, Vector};

/// Distance to an obstacle and its gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clearance {
    /// ρ ≥ 0 outside, in scene units.
    pub distance: f64,
    /// ∇ρ, a unit vector away from the obstacle's nearest point; zero on the
    /// core itself (only a point robot can be there), where it has no direction.
    pub gradient: Vector,
}

/// Clearance ρ of `p` outside `obstacle`, and ∇ρ = (p − c)/‖p − c‖ with c the
/// nearest point of its core.
///
/// Of a non-convex polygon c is the nearest point of its sides; where two are
/// equally near ρ has a ridge and the side of the lower number decides.
/// Inside a polygon's core the values mean nothing.
pub fn clearance(obstacle: &Inflated, p: Point) -> Clearance {
    let nearest = match &obstacle.core {
        Core::Point(c) => *c,
        Core::Segment(a, b) => closest_point(p, *a, *b),
        Core::Polygon(polygon) => {
            let mut best = (f64::INFINITY, p);
            for (a, b) in polygon.sides() {
                let d2 = point_segment_distance_squared(p, a, b);
                if d2 < best.0 {
                    best = (d2, closest_point(p, a, b));
                }
            }
            best.1
        }
    };
    let away = p - nearest;
    let distance = away.norm();
    let gradient = if distance > 0.0 { away / distance } else { Vector::zeros() };
    Clearance { distance: distance - obstacle.radius, gradient }
}

#[cfg(test)]
mod tests {
    use env_model::Polygon;

    use super::*;

    fn at(core: Core, radius: f64, p: [f64; 2]) -> (f64, [f64; 2]) {
        let Clearance { distance, gradient } = clearance(&Inflated { core, radius }, p.into());
        (distance, gradient.into())
    }

    #[test]
    fn of_each_shape_worked_by_hand() {
        let p = |x: f64, y: f64| Point::new(x, y);
        // 3-4-5 triangles; all values are exact.
        assert_eq!(at(Core::Point(p(1.0, 1.0)), 2.0, [4.0, 5.0]), (3.0, [0.6, 0.8]));
        let axis = Core::Segment(p(0.0, 0.0), p(4.0, 0.0));
        assert_eq!(at(axis.clone(), 0.5, [2.0, -2.0]), (1.5, [0.0, -1.0]), "beside the axis");
        assert_eq!(at(axis, 0.5, [7.0, 4.0]), (4.5, [0.6, 0.8]), "beyond its end");
        // A U, open above: non-convex.
        let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [5.0, 5.0], [5.0, 1.0], [1.0, 1.0], [1.0, 5.0], [0.0, 5.0]];
        let u = Core::Polygon(Polygon::new(corners.map(Point::from).to_vec()).unwrap());
        assert_eq!(at(u.clone(), 0.0, [3.0, 2.0]), (1.0, [0.0, 1.0]), "in the mouth, over the floor");
        assert_eq!(at(u.clone(), 0.0, [4.0, 4.0]), (1.0, [-1.0, 0.0]), "beside the right arm");
        assert_eq!(at(u.clone(), 0.25, [9.0, 9.0]), (4.75, [0.6, 0.8]), "beyond a corner");
        assert_eq!(at(u, 0.0, [3.0, 1.0]), (0.0, [0.0, 0.0]), "on the border of a core");
    }
}
