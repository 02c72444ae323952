//! Axis-aligned boxes.

use crate::{Point, Vector};

/// An axis-aligned box, `min` ≤ `max` component by component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Lower left corner.
    pub min: Point,
    /// Upper right corner.
    pub max: Point,
}

impl Aabb {
    /// The box of nothing: growing it by a point gives that point.
    pub const EMPTY: Self =
        Self { min: Point::new(f64::INFINITY, f64::INFINITY), max: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY) };

    /// The smallest box round `points`.
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, p| b.including(*p))
    }

    /// The smallest box round the segment `a b`, finite.
    #[inline]
    pub(crate) fn of_segment(a: Point, b: Point) -> Self {
        // f64::min and max take three instructions each, because they look for NaN.
        let lesser = |u: f64, v: f64| if u < v { u } else { v };
        let greater = |u: f64, v: f64| if u > v { u } else { v };
        Self {
            min: Point::new(lesser(a.x, b.x), lesser(a.y, b.y)),
            max: Point::new(greater(a.x, b.x), greater(a.y, b.y)),
        }
    }

    /// The smallest box that holds this one and `p`.
    #[must_use]
    pub fn including(self, p: Point) -> Self {
        Self { min: self.min.inf(&p), max: self.max.sup(&p) }
    }

    /// The smallest box that holds both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.inf(&other.min), max: self.max.sup(&other.max) }
    }

    /// Moves every side outward by `margin` (inward when negative).
    #[must_use]
    pub fn inflated(self, margin: f64) -> Self {
        let m = Vector::new(margin, margin);
        Self { min: self.min - m, max: self.max + m }
    }

    /// Width and height.
    pub fn size(&self) -> Vector {
        self.max - self.min
    }

    /// Length of the diagonal.
    pub fn diagonal(&self) -> f64 {
        self.size().norm()
    }

    /// The middle point.
    pub fn centre(&self) -> Point {
        nalgebra::center(&self.min, &self.max)
    }

    /// Signed distance of `p` to the nearest side, positive inside (exact
    /// inside; outside, minus the largest excess over a side).
    pub fn depth_of(&self, p: Point) -> f64 {
        let lo = p - self.min;
        let hi = self.max - p;
        lo.x.min(lo.y).min(hi.x).min(hi.y)
    }

    /// Whether the boxes share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.x <= other.max.x && other.min.x <= self.max.x && self.min.y <= other.max.y && other.min.y <= self.max.y
    }

    /// Square of the distance between two boxes, 0 when they overlap.
    pub fn distance_squared(&self, other: &Self) -> f64 {
        let dx = (other.min.x - self.max.x).max(self.min.x - other.max.x).max(0.0);
        let dy = (other.min.y - self.max.y).max(self.min.y - other.max.y).max(0.0);
        dx * dx + dy * dy
    }
}
