//! Simple polygons, not necessarily convex.

use crate::geometry::{
    cross, point_segment_distance_squared, segment_segment_distance, segments_cross, segments_nearer_than,
};
use crate::{Aabb, Point, Vector};

/// Why a list of corners is not a simple polygon.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PolygonError {
    /// Fewer than three corners.
    #[error("a polygon needs at least 3 corners, this one has {0}")]
    TooFewCorners(usize),
    /// Two neighbouring corners coincide.
    #[error("corners {0} and {1} (counted from 0) coincide")]
    RepeatedCorner(usize, usize),
    /// Two sides that are not neighbours meet, or neighbours fold back on each other.
    #[error("sides {0} and {1} (counted from 0) cross or touch; a polygon must be simple")]
    SelfCrossing(usize, usize),
}

/// A simple polygon with its corners in counter-clockwise order.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    corners: Vec<Point>,
    /// Kept because every collision test asks for it first.
    aabb: Aabb,
    convex: bool,
}

impl Polygon {
    /// Checks that `corners` (either winding) form a simple polygon. O(n²).
    pub fn new(mut corners: Vec<Point>) -> Result<Self, PolygonError> {
        let n = corners.len();
        if n < 3 {
            return Err(PolygonError::TooFewCorners(n));
        }
        for i in 0..n {
            if corners[i] == corners[(i + 1) % n] {
                return Err(PolygonError::RepeatedCorner(i, (i + 1) % n));
            }
        }
        let side = |i: usize| (corners[i], corners[(i + 1) % n]);
        for i in 0..n {
            for j in i + 1..n {
                let ((a, b), (c, d)) = (side(i), side(j));
                let clash = if j == i + 1 || (i == 0 && j == n - 1) {
                    // Neighbours share a corner; they clash when they fold back on each other.
                    let (u, v) = if j == i + 1 { (a - b, d - b) } else { (b - a, c - a) };
                    cross(u, v) == 0.0 && u.dot(&v) > 0.0
                } else {
                    segments_cross(a, b, c, d)
                };
                if clash {
                    return Err(PolygonError::SelfCrossing(i, j));
                }
            }
        }
        // Seen from a corner: far from the origin absolute coordinates lose the sign.
        let seen = |i: usize| corners[i % n] - corners[0];
        let doubled_area: f64 = (0..n).map(|i| cross(seen(i), seen(i + 1))).sum();
        if doubled_area < 0.0 {
            corners.reverse();
        }
        Ok(Self::of(corners))
    }

    /// `corners` of a simple polygon, counter-clockwise.
    fn of(corners: Vec<Point>) -> Self {
        let n = corners.len();
        let turn = |i: usize| {
            let (p, q, r) = (corners[i], corners[(i + 1) % n], corners[(i + 2) % n]);
            cross(q - p, r - q)
        };
        // A simple polygon whose turns are all to the left winds once.
        let convex = (0..n).all(|i| turn(i) >= 0.0);
        Self { aabb: Aabb::of_points(&corners), convex, corners }
    }

    /// The corners, counter-clockwise.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// The sides, counter-clockwise.
    pub fn sides(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let n = self.corners.len();
        (0..n).map(move |i| (self.corners[i], self.corners[(i + 1) % n]))
    }

    /// The smallest box round the polygon.
    pub fn aabb(&self) -> &Aabb {
        &self.aabb
    }

    /// The polygon with every corner mapped by a rigid motion.
    #[must_use]
    pub fn mapped(&self, map: impl FnMut(Point) -> Point) -> Self {
        Self::of(self.corners.iter().copied().map(map).collect())
    }

    /// Whether `p` lies inside by the even–odd rule; on the border either answer.
    pub fn contains(&self, p: Point) -> bool {
        let mut inside = false;
        for (a, b) in self.sides() {
            if (a.y > p.y) != (b.y > p.y) {
                let side = cross(b - a, p - a);
                if (side > 0.0) == (b.y > a.y) {
                    inside = !inside;
                }
            }
        }
        inside
    }

    /// Signed distance of `p` to the border: positive outside, negative inside.
    pub fn signed_distance(&self, p: Point) -> f64 {
        let d2 = self.sides().map(|(a, b)| point_segment_distance_squared(p, a, b)).fold(f64::INFINITY, f64::min);
        if self.contains(p) { -d2.sqrt() } else { d2.sqrt() }
    }

    /// Least signed distance over the points of segment `a b`: the distance to
    /// the polygon, or minus the depth to which the segment enters it.
    ///
    /// Outside, the least side distance. Inside, the largest δ for which some
    /// point is more than δ from every side, by bisection to the last bit: the
    /// points within δ of one side form one interval of the segment (distance
    /// to a convex set is convex), so "some point is deeper than δ" is a sweep
    /// over n intervals. O(n²) a step, and only for segments that enter.
    pub fn segment_signed_distance(&self, a: Point, b: Point) -> f64 {
        let d = self.sides().map(|(c, e)| segment_segment_distance(a, b, c, e)).fold(f64::INFINITY, f64::min);
        let outside = d > 0.0 && !self.contains(a);
        // A segment that enters exactly through a corner may by rounding miss both its
        // sides: what is nearer than rounding is looked at more closely.
        if outside && d > self.rounding(a, b) {
            return d;
        }
        if !self.enters_deeper_than(a, b, 0.0) {
            return if outside { d } else { 0.0 };
        }
        let (mut lo, mut hi) = (0.0, self.aabb.diagonal());
        for _ in 0..80 {
            let mid = 0.5 * (lo + hi);
            if mid <= lo || mid >= hi {
                break;
            }
            if self.enters_deeper_than(a, b, mid) { lo = mid } else { hi = mid }
        }
        -lo
    }

    /// What coordinates as large as the polygon's and the segment's may be off by after a few operations.
    fn rounding(&self, a: Point, b: Point) -> f64 {
        let corners = [&self.aabb.min, &self.aabb.max, &a, &b];
        1e-12 * corners.into_iter().map(|p| p.coords.amax()).fold(0.0, f64::max)
    }

    /// Whether some point of segment `a b` lies inside or nearer than `reach` ≥ 0 to a side. O(n).
    pub fn nearer_than(&self, a: Point, b: Point, reach: f64) -> bool {
        if self.box_apart(a, b, reach) {
            return false;
        }
        if self.convex {
            let beyond = |(c, e): (Point, Point)| {
                let u = e - c;
                let most = -reach * u.norm();
                cross(u, a - c) <= most && cross(u, b - c) <= most
            };
            if self.sides().any(beyond) {
                return false;
            }
        }
        self.contains(a) || self.sides().any(|(c, e)| segments_nearer_than(reach, a, b, c, e))
    }

    /// Whether the box, grown by `reach`, has nothing in common with the segment: separated
    /// by a side of either box or by the segment's line.
    fn box_apart(&self, a: Point, b: Point, reach: f64) -> bool {
        let grown = self.aabb.inflated(reach);
        let d = b - a;
        let (c, h) = (grown.centre(), 0.5 * grown.size());
        !Aabb::of_segment(a, b).overlaps(&grown) || cross(d, c - a).abs() > h.x * d.y.abs() + h.y * d.x.abs()
    }

    /// Whether some point of segment `a b` lies inside, farther than `delta` ≥ 0 from every side.
    ///
    /// Convex polygons cut the segment by their sides moved inward, O(n). For others, and where
    /// rounding could decide, it walks from cut to cut, the ends of the intervals near the sides,
    /// and tests one point between each two: O(n k) for k sides near the segment, no allocation.
    /// The corners' projections are cuts too: for δ = 0 a line through a corner may by rounding
    /// miss both its sides.
    pub fn enters_deeper_than(&self, a: Point, b: Point, delta: f64) -> bool {
        let rounding = self.rounding(a, b);
        if self.box_apart(a, b, rounding) {
            return false;
        }
        if self.convex {
            if self.cut_by_sides(a, b, delta + rounding) {
                return true;
            }
            if !self.cut_by_sides(a, b, delta - rounding) {
                return false;
            }
        }
        // Sides that are farther than δ from the whole segment cut nothing off it.
        let mut near = [0; NEAR_SIDES];
        let mut count = 0;
        for (i, (c, e)) in self.sides().enumerate() {
            if segments_nearer_than(delta + rounding, a, b, c, e) {
                if count < NEAR_SIDES {
                    near[count] = i;
                }
                count += 1;
            }
        }
        if count == 0 {
            return self.contains(a);
        }
        if self.deeper_than(a, delta) || self.deeper_than(b, delta) {
            return true;
        }
        if count <= NEAR_SIDES {
            let n = self.corners.len();
            let side = |&i: &usize| (self.corners[i], self.corners[(i + 1) % n]);
            self.deep_between_cuts(a, b, delta, || near[..count].iter().map(side))
        } else {
            self.deep_between_cuts(a, b, delta, || self.sides())
        }
    }

    /// Whether `p` lies inside, farther than `delta` from every side.
    fn deeper_than(&self, p: Point, delta: f64) -> bool {
        self.contains(p) && self.sides().all(|(c, e)| point_segment_distance_squared(p, c, e) > delta * delta)
    }

    /// Whether more than a point of the segment lies farther than `delta` inside every side's line.
    fn cut_by_sides(&self, a: Point, b: Point, delta: f64) -> bool {
        let (mut from, mut to) = (0.0_f64, 1.0_f64);
        for (c, e) in self.sides() {
            let u = e - c;
            let least = delta * u.norm();
            let (at_a, at_b) = (cross(u, a - c) - least, cross(u, b - c) - least);
            if at_a <= 0.0 && at_b <= 0.0 {
                return false;
            }
            if at_a < 0.0 {
                from = from.max(at_a / (at_a - at_b));
            } else if at_b < 0.0 {
                to = to.min(at_a / (at_a - at_b));
            }
            if from >= to {
                return false;
            }
        }
        true
    }

    /// Whether a point halfway between two neighbouring cuts, by `sides` or the ends, is deep.
    fn deep_between_cuts<S>(&self, a: Point, b: Point, delta: f64, sides: impl Fn() -> S) -> bool
    where
        S: Iterator<Item = (Point, Point)>,
    {
        let d = b - a;
        if d == Vector::zeros() {
            return self.deeper_than(a, delta);
        }
        let cuts = |(c, e): (Point, Point)| {
            let corner = (c - a).dot(&d) / d.norm_squared();
            let (t0, t1) = near_interval(a, b, c, e, delta).unwrap_or((corner, corner));
            [t0, t1, corner]
        };
        let mut from = 0.0;
        while from < 1.0 {
            let next = sides().flat_map(cuts).filter(|t| *t > from).fold(1.0, f64::min);
            if self.deeper_than(a + d * (0.5 * (from + next)), delta) {
                return true;
            }
            from = next;
        }
        false
    }
}

/// Sides near a segment up to which the others are left out of the walk.
const NEAR_SIDES: usize = 8;

/// The parameters of line `a b` within `delta` of segment `c e`: one interval, or none.
///
/// The set of points within δ of a segment is the union of two discs and a
/// rectangle, and convex, so the interval is the hull of the three parts.
fn near_interval(a: Point, b: Point, c: Point, e: Point, delta: f64) -> Option<(f64, f64)> {
    let d = b - a;
    let dd = d.norm_squared();
    if dd == 0.0 {
        return None;
    }
    let mut hull: Option<(f64, f64)> = None;
    let mut grow = |t0: f64, t1: f64| {
        hull = Some(hull.map_or((t0, t1), |(h0, h1)| (h0.min(t0), h1.max(t1))));
    };
    for q in [c, e] {
        let mid = (q - a).dot(&d) / dd;
        let off = cross(d, q - a);
        let half2 = (delta * delta * dd - off * off) / (dd * dd);
        if half2 >= 0.0 {
            grow(mid - half2.sqrt(), mid + half2.sqrt());
        }
    }
    // The rectangle: the line's parameters with 0 ≤ along ≤ |u| and |across| ≤ δ.
    let u = e - c;
    let len = u.norm();
    let (tangent, normal) = (u / len, Vector::new(-u.y, u.x) / len);
    let slab = |n: Vector, lo: f64, hi: f64| -> Option<(f64, f64)> {
        let (at, rate) = ((a - c).dot(&n), d.dot(&n));
        if rate == 0.0 {
            return (at >= lo && at <= hi).then_some((f64::NEG_INFINITY, f64::INFINITY));
        }
        let (t0, t1) = ((lo - at) / rate, (hi - at) / rate);
        Some((t0.min(t1), t0.max(t1)))
    };
    if let (Some((s0, s1)), Some((n0, n1))) = (slab(tangent, 0.0, len), slab(normal, -delta, delta)) {
        let (t0, t1) = (s0.max(n0), s1.min(n1));
        if t0 <= t1 {
            grow(t0, t1);
        }
    }
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(corners: &[[f64; 2]]) -> Result<Polygon, PolygonError> {
        Polygon::new(corners.iter().map(|c| Point::new(c[0], c[1])).collect())
    }

    #[test]
    fn rejects_what_is_not_simple() {
        assert_eq!(polygon(&[[0.0, 0.0], [1.0, 0.0]]), Err(PolygonError::TooFewCorners(2)));
        assert_eq!(polygon(&[[0.0, 0.0], [0.0, 0.0], [1.0, 0.0]]), Err(PolygonError::RepeatedCorner(0, 1)));
        assert_eq!(
            polygon(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]]),
            Err(PolygonError::SelfCrossing(0, 2)),
            "bow tie"
        );
        assert!(
            matches!(polygon(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]]), Err(PolygonError::SelfCrossing(..))),
            "no interior"
        );
        assert!(
            matches!(
                polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]]),
                Err(PolygonError::SelfCrossing(..))
            ),
            "a corner on another side"
        );
    }

    #[test]
    fn depth_in_a_notched_polygon() {
        // A square of side 4 with a notch from above down to y = 2 between x = 1 and x = 3.
        let u =
            polygon(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [3.0, 2.0], [1.0, 2.0], [1.0, 4.0], [0.0, 4.0]])
                .unwrap();
        let p = Point::new;
        assert_eq!(u.segment_signed_distance(p(2.0, 5.0), p(2.0, 3.0)), 1.0, "into the notch");
        assert_eq!(u.segment_signed_distance(p(2.0, 5.0), p(2.0, 2.0)), 0.0, "down to its floor");
        let through = u.segment_signed_distance(p(-1.0, 1.0), p(5.0, 1.0));
        assert!((through + 1.0).abs() < 1e-12, "along the middle of the base: {through}");
        let arm = u.segment_signed_distance(p(-1.0, 3.0), p(5.0, 3.0));
        assert!((arm + 0.5).abs() < 1e-12, "across both arms: {arm}");
        assert_eq!(u.segment_signed_distance(p(-1.0, 0.0), p(5.0, 0.0)), 0.0, "along a side");
        let rev = polygon(&[[0.0, 4.0], [4.0, 4.0], [4.0, 0.0], [0.0, 0.0]]).unwrap();
        assert!((rev.segment_signed_distance(p(2.0, 2.0), p(2.0, 2.0)) + 2.0).abs() < 1e-12, "zero length inside");
    }
}
