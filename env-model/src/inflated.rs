//! Obstacles inflated by the robot's radius: every shape is a core (point,
//! segment, polygon) and a distance that must be kept from it.

use crate::geometry::{
    closest_point, point_segment_distance, point_segment_distance_squared, segment_segment_distance,
    segments_nearer_than,
};
use crate::{Aabb, Point, Polygon, Vector};

/// What remains of a shape when its rounding radius is taken off.
#[derive(Debug, Clone, PartialEq)]
pub enum Core {
    /// A disc's centre.
    Point(Point),
    /// A capsule's axis.
    Segment(Point, Point),
    /// The polygon itself.
    Polygon(Polygon),
}

impl Core {
    /// Its point nearest to `p`: of a polygon that of its sides, also from inside; where two are equally near, that of
    /// the lower number.
    pub fn nearest(&self, p: Point) -> Point {
        match self {
            Self::Point(c) => *c,
            Self::Segment(a, b) => closest_point(p, *a, *b),
            Self::Polygon(polygon) => {
                let mut best = (f64::INFINITY, p);
                for (a, b) in polygon.sides() {
                    let d2 = point_segment_distance_squared(p, a, b);
                    if d2 < best.0 {
                        best = (d2, closest_point(p, a, b));
                    }
                }
                best.1
            }
        }
    }
}

/// The set of points nearer than `radius` to `core` (for polygons, or inside it).
#[derive(Debug, Clone, PartialEq)]
pub struct Inflated {
    /// The shape without its rounding.
    pub core: Core,
    /// Shape radius + robot radius, in scene units.
    pub radius: f64,
}

impl Inflated {
    /// Centre and radius when the inflated shape is a disc.
    pub fn as_disc(&self) -> Option<(Point, f64)> {
        match self.core {
            Core::Point(c) => Some((c, self.radius)),
            _ => None,
        }
    }

    /// The smallest box round the inflated shape.
    pub fn aabb(&self) -> Aabb {
        self.aabb_seen_by(|p| p)
    }

    /// The smallest box round the shape after the rigid motion `map`. Allocates nothing.
    pub fn aabb_seen_by(&self, map: impl Fn(Point) -> Point) -> Aabb {
        let core = match &self.core {
            Core::Point(c) => Aabb::EMPTY.including(map(*c)),
            Core::Segment(a, b) => Aabb::EMPTY.including(map(*a)).including(map(*b)),
            Core::Polygon(polygon) => polygon.corners().iter().fold(Aabb::EMPTY, |box_, p| box_.including(map(*p))),
        };
        core.inflated(self.radius)
    }

    /// The shape under a rigid motion.
    #[must_use]
    pub fn mapped(&self, mut map: impl FnMut(Point) -> Point) -> Self {
        let core = match &self.core {
            Core::Point(c) => Core::Point(map(*c)),
            Core::Segment(a, b) => Core::Segment(map(*a), map(*b)),
            Core::Polygon(polygon) => Core::Polygon(polygon.mapped(map)),
        };
        Self { core, radius: self.radius }
    }

    /// Signed distance of `p` to the inflated border, negative inside.
    ///
    /// Inside a non-convex polygon's core it is −(distance to the nearest side)
    /// − radius, which near reflex corners understates the depth.
    pub fn point_clearance(&self, p: Point) -> f64 {
        let d = match &self.core {
            Core::Point(c) => (p - c).norm(),
            Core::Segment(a, b) => point_segment_distance(p, *a, *b),
            Core::Polygon(polygon) => polygon.signed_distance(p),
        };
        d - self.radius
    }

    /// [`Inflated::point_clearance`] of `p` and its gradient, the unit vector in which it grows fastest: away from the
    /// nearest point of the core, inside a polygon towards it. On the border of the core there is no such direction,
    /// and the vector is zero.
    pub fn clearance_direction(&self, p: Point) -> (f64, Vector) {
        let away = p - self.core.nearest(p);
        let distance = away.norm();
        let sign = match &self.core {
            Core::Polygon(polygon) if polygon.contains(p) => -1.0,
            _ => 1.0,
        };
        let direction = if distance > 0.0 { away * (sign / distance) } else { Vector::zeros() };
        (sign * distance - self.radius, direction)
    }

    /// Least signed distance over the points of segment `a b`, negative when it enters.
    pub fn segment_clearance(&self, a: Point, b: Point) -> f64 {
        let d = match &self.core {
            Core::Point(c) => point_segment_distance(*c, a, b),
            Core::Segment(c, e) => segment_segment_distance(a, b, *c, *e),
            Core::Polygon(polygon) => polygon.segment_signed_distance(a, b),
        };
        d - self.radius
    }

    /// Whether segment `a b` keeps a clearance of at least −`slack`, `slack` ≥ 0.
    pub fn segment_free(&self, a: Point, b: Point, slack: f64) -> bool {
        let reach = self.radius - slack;
        match &self.core {
            Core::Point(c) => reach <= 0.0 || point_segment_distance_squared(*c, a, b) >= reach * reach,
            Core::Segment(c, e) => reach <= 0.0 || !segments_nearer_than(reach, a, b, *c, *e),
            Core::Polygon(polygon) if reach > 0.0 => !polygon.nearer_than(a, b, reach),
            Core::Polygon(polygon) => !polygon.enters_deeper_than(a, b, -reach),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(core: &Core, radius: f64, p: [f64; 2]) -> (f64, [f64; 2]) {
        let (clearance, direction) = Inflated { core: core.clone(), radius }.clearance_direction(p.into());
        (clearance, direction.into())
    }

    #[test]
    fn clearance_and_direction_of_each_shape_worked_by_hand() {
        let p = |x: f64, y: f64| Point::new(x, y);
        // 3-4-5 triangles; all values but products with fifths are exact, and those round alike.
        let disc = Core::Point(p(1.0, 1.0));
        assert_eq!(at(&disc, 2.0, [4.0, 5.0]), (3.0, [3.0 * 0.2, 4.0 * 0.2]));
        assert_eq!(at(&disc, 2.0, [1.0, 2.0]), (-1.0, [0.0, 1.0]), "inside a disc");
        assert_eq!(at(&disc, 2.0, [1.0, 1.0]), (-2.0, [0.0, 0.0]), "on its centre");
        let axis = Core::Segment(p(0.0, 0.0), p(4.0, 0.0));
        assert_eq!(at(&axis, 0.5, [2.0, -2.0]), (1.5, [0.0, -1.0]), "beside the axis");
        assert_eq!(at(&axis, 0.5, [2.0, -0.25]), (-0.25, [0.0, -1.0]), "inside a capsule");
        assert_eq!(at(&axis, 0.5, [7.0, 4.0]), (4.5, [3.0 * 0.2, 4.0 * 0.2]), "beyond its end");
        // A U, open above: non-convex.
        let corners = [[0.0, 0.0], [6.0, 0.0], [6.0, 5.0], [5.0, 5.0], [5.0, 1.0], [1.0, 1.0], [1.0, 5.0], [0.0, 5.0]];
        let u = Core::Polygon(Polygon::new(corners.map(Point::from).to_vec()).unwrap());
        assert_eq!(at(&u, 0.0, [3.0, 2.0]), (1.0, [0.0, 1.0]), "in the mouth, over the floor");
        assert_eq!(at(&u, 0.0, [4.0, 4.0]), (1.0, [-1.0, 0.0]), "beside the right arm");
        assert_eq!(at(&u, 0.25, [9.0, 9.0]), (4.75, [3.0 * 0.2, 4.0 * 0.2]), "beyond a corner");
        assert_eq!(at(&u, 0.0, [3.0, 1.0]), (0.0, [0.0, 0.0]), "on the border of a core");
        assert_eq!(at(&u, 0.5, [0.25, 3.0]), (-0.75, [-1.0, 0.0]), "inside the left arm: out to the left");
        assert_eq!(at(&u, 0.5, [3.0, 0.75]), (-0.75, [0.0, 1.0]), "inside the floor: up into the mouth");
    }
}
