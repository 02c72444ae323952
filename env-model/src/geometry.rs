//! Distances between points and segments: the narrow phase's ground floor.
//!
//! Ericson, *Real-Time Collision Detection* (2005), §5.1.

use crate::{Point, Vector};

/// z component of the cross product, |a||b| sin∠(a, b).
pub fn cross(a: Vector, b: Vector) -> f64 {
    a.x * b.y - a.y * b.x
}

/// Parameter in [0, 1] of the point of segment `a b` nearest to `p`; 0 when `a` = `b`.
pub fn closest_parameter(p: Point, a: Point, b: Point) -> f64 {
    let d = b - a;
    let len2 = d.norm_squared();
    if len2 > 0.0 { ((p - a).dot(&d) / len2).clamp(0.0, 1.0) } else { 0.0 }
}

/// The point of segment `a b` nearest to `p`.
pub fn closest_point(p: Point, a: Point, b: Point) -> Point {
    a + (b - a) * closest_parameter(p, a, b)
}

/// Square of the distance from `p` to segment `a b`.
///
/// Inside the segment the distance is |d × (p − a)|/|d|, which keeps its
/// accuracy for long segments where `p − closest` cancels.
pub fn point_segment_distance_squared(p: Point, a: Point, b: Point) -> f64 {
    let d = b - a;
    let len2 = d.norm_squared();
    let s = (p - a).dot(&d);
    if s <= 0.0 || len2 == 0.0 {
        (p - a).norm_squared()
    } else if s >= len2 {
        (p - b).norm_squared()
    } else {
        let c = cross(d, p - a);
        c * c / len2
    }
}

/// Distance from `p` to segment `a b`.
pub fn point_segment_distance(p: Point, a: Point, b: Point) -> f64 {
    point_segment_distance_squared(p, a, b).sqrt()
}

/// Whether the segments `a b` and `c d` share a point (end points and overlaps count).
pub fn segments_cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    // In line but apart, rounding may put either's ends on both sides of the other.
    let apart = |a: f64, b: f64, c: f64, d: f64| c.min(d) > a.max(b) || a.min(b) > c.max(d);
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let side = |o: Point, u: Point, p: Point| cross(u - o, p - o);
    let (s1, s2) = (side(a, b, c), side(a, b, d));
    let (s3, s4) = (side(c, d, a), side(c, d, b));
    let proper = |u: f64, v: f64| (u > 0.0 && v < 0.0) || (u < 0.0 && v > 0.0);
    if proper(s1, s2) && proper(s3, s4) {
        return true;
    }
    let within = |o: Point, u: Point, p: Point| {
        p.x >= o.x.min(u.x) && p.x <= o.x.max(u.x) && p.y >= o.y.min(u.y) && p.y <= o.y.max(u.y)
    };
    (s1 == 0.0 && within(a, b, c))
        || (s2 == 0.0 && within(a, b, d))
        || (s3 == 0.0 && within(c, d, a))
        || (s4 == 0.0 && within(c, d, b))
}

/// Distance between the segments `a b` and `c d`, 0 when they cross.
///
/// In the plane the distance of disjoint segments is attained at an end point.
pub fn segment_segment_distance(a: Point, b: Point, c: Point, d: Point) -> f64 {
    if segments_cross(a, b, c, d) {
        return 0.0;
    }
    point_segment_distance_squared(a, c, d)
        .min(point_segment_distance_squared(b, c, d))
        .min(point_segment_distance_squared(c, a, b))
        .min(point_segment_distance_squared(d, a, b))
        .sqrt()
}

/// Whether the segments `a b` and `c d` come nearer to each other than `reach`. No root, no division.
///
/// Most pairs are far apart, which their coordinates alone tell, or one segment lies
/// beyond the other's line.
pub fn segments_nearer_than(reach: f64, a: Point, b: Point, c: Point, d: Point) -> bool {
    let apart = |a: f64, b: f64, c: f64, d: f64| c.min(d) - a.max(b) >= reach || a.min(b) - c.max(d) >= reach;
    if apart(a.x, b.x, c.x, d.x) || apart(a.y, b.y, c.y, d.y) {
        return false;
    }
    let r2 = reach * reach;
    // Whether p and q are on one side of the line through o and o + u, and at least `reach` from it.
    let beyond = |o: Point, u: Vector, p: Point, q: Point| {
        let (s, t) = (cross(u, p - o), cross(u, q - o));
        s * t > 0.0 && (s * s).min(t * t) >= r2 * u.norm_squared()
    };
    if beyond(c, d - c, a, b) || beyond(a, b - a, c, d) {
        return false;
    }
    segments_cross(a, b, c, d)
        || point_segment_distance_squared(a, c, d) < r2
        || point_segment_distance_squared(b, c, d) < r2
        || point_segment_distance_squared(c, a, b) < r2
        || point_segment_distance_squared(d, a, b) < r2
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn distances_of_hand_made_cases() {
        let (a, b) = (p(0.0, 0.0), p(4.0, 0.0));
        assert_eq!(point_segment_distance(p(2.0, 3.0), a, b), 3.0);
        assert_eq!(point_segment_distance(p(-3.0, 4.0), a, b), 5.0);
        assert_eq!(point_segment_distance(p(7.0, 4.0), a, b), 5.0);
        assert_eq!(point_segment_distance(p(3.0, 4.0), a, a), 5.0, "zero length");
        assert_eq!(segment_segment_distance(a, b, p(2.0, -1.0), p(2.0, 1.0)), 0.0, "crossing");
        assert_eq!(segment_segment_distance(a, b, p(4.0, 0.0), p(5.0, 1.0)), 0.0, "touching ends");
        assert_eq!(segment_segment_distance(a, b, p(1.0, 0.0), p(9.0, 0.0)), 0.0, "collinear overlap");
        assert_eq!(segment_segment_distance(a, b, p(5.0, 0.0), p(9.0, 0.0)), 1.0, "collinear apart");
        assert_eq!(segment_segment_distance(a, b, p(0.0, 2.0), p(4.0, 2.0)), 2.0, "parallel");
    }

    #[test]
    fn segments_in_line_but_apart_do_not_cross() {
        // Rounding flips both straddle tests of this pair.
        let (a, b) =
            (p(0.946_641_161_946_803_1, -2.133_213_887_862_182_5), p(0.369_521_754_767_896_84, -1.523_219_968_010_213));
        let (c, d) = (
            p(0.105_994_506_580_192_1, -1.244_681_389_840_395),
            p(-0.471_124_900_598_714_26, -0.634_687_469_988_425_5),
        );
        assert!(!segments_cross(a, b, c, d));
        assert!((segment_segment_distance(a, b, c, d) - (c - b).norm()).abs() < 1e-15);
    }

    #[test]
    fn long_segments_keep_their_accuracy() {
        let (a, b) = (p(-1e7, 0.0), p(1e7, 1.0));
        // The line is y = (x + 1e7) / 2e7; at x = 0 it is at 0.5 and nearly level.
        let d = point_segment_distance(p(0.0, 1.5), a, b);
        assert!((d - 1.0).abs() < 1e-9, "{d}");
    }
}
