//! Obstacles inflated by the robot's radius: every shape is a core (point,
//! segment, polygon) and a distance that must be kept from it.

use crate::geometry::{
    point_segment_distance, point_segment_distance_squared, segment_segment_distance, segments_nearer_than,
};
use crate::{Aabb, Point, Polygon};

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
