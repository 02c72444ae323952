//! The half-plane between a segment and a convex piece.
//!
//! With q on the segment and c on the core the closest points, n = (q − c)/|q − c|,
//! every p with n·p ≥ n·c + r keeps clear of the piece, and so does every
//! segment between two such points. The convex feasible set of Liu, Lin &
//! Tomizuka (2018), doi 10.1137/16M1091460, applied to whole segments.

use env_model::geometry::closest_point;
use env_model::{Point, Vector};

use crate::piece::Piece;

/// n·p ≥ `offset` keeps the piece's distance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HalfPlane {
    /// Unit normal, away from the piece.
    pub(crate) normal: Vector,
    /// n·c + r, c the core's farthest point along n.
    pub(crate) offset: f64,
}

/// The half-plane that separates segment `a b` from `piece` best.
///
/// Where they touch to within `grazing` (a polygon without rounding), the
/// closest points give no direction; then the normals of the core's and the
/// segment's own edges are candidates (separating axes). Any direction gives
/// a half-plane that keeps clear; a poor one leaves less room.
pub(crate) fn between(a: Point, b: Point, piece: &Piece, grazing: f64) -> HalfPlane {
    let mut nearest = (f64::INFINITY, Vector::new(0.0, 1.0));
    let mut consider = |q: Point, c: Point| {
        let d = (q - c).norm();
        if d < nearest.0 {
            nearest = (d, (q - c) / d);
        }
    };
    for c in &piece.corners {
        consider(closest_point(*c, a, b), *c);
    }
    for (c, e) in piece.edges() {
        consider(a, closest_point(a, c, e));
        consider(b, closest_point(b, c, e));
    }
    let plane = |normal: Vector| {
        let reach = piece.corners.iter().map(|c| normal.dot(&c.coords)).fold(f64::NEG_INFINITY, f64::max);
        HalfPlane { normal, offset: reach + piece.radius }
    };
    let room = |h: &HalfPlane| h.normal.dot(&a.coords).min(h.normal.dot(&b.coords)) - h.offset;
    // A direction of zero length is NaN and loses every comparison.
    let mut best = plane(nearest.1);
    if nearest.0 > grazing {
        return best;
    }
    for (c, e) in piece.edges().chain([(a, b)]) {
        let d = e - c;
        if d.norm() > 0.0 {
            let across = Vector::new(-d.y, d.x) / d.norm();
            for candidate in [plane(across), plane(-across)] {
                if room(&best).is_nan() || room(&candidate) > room(&best) {
                    best = candidate;
                }
            }
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::piece::decompose;
    use env_model::{Core, Inflated, Polygon};

    fn piece(core: Core, radius: f64) -> Piece {
        let mut pieces = Vec::new();
        decompose(&Inflated { core, radius }, 0, &mut pieces);
        pieces.remove(0)
    }

    #[test]
    fn offset_minus_position_is_the_clearance() {
        let p = Point::new;
        let square = Polygon::new(vec![p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)]).unwrap();
        for (core, radius) in [
            (Core::Point(p(1.0, 1.0)), 1.0),
            (Core::Segment(p(0.0, 0.0), p(2.0, 1.0)), 0.5),
            (Core::Polygon(square), 0.25),
        ] {
            let shape = Inflated { core: core.clone(), radius };
            let piece = piece(core, radius);
            for (a, b) in [(p(-3.0, 4.0), p(5.0, 3.0)), (p(4.0, -1.0), p(3.0, 5.0)), (p(-1.0, -2.0), p(-1.0, -2.0))] {
                let h = between(a, b, &piece, 1e-9);
                let room = h.normal.dot(&a.coords).min(h.normal.dot(&b.coords)) - h.offset;
                // Rounding of a few operations on numbers below 10.
                assert!((room - shape.segment_clearance(a, b)).abs() < 1e-13, "{shape:?} {a} {b}: {room}");
            }
        }
    }

    #[test]
    fn touching_segments_still_get_a_direction() {
        let p = Point::new;
        let square = Polygon::new(vec![p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)]).unwrap();
        let piece = piece(Core::Polygon(square), 0.0);
        // Along a side, and across a corner.
        for (a, b) in [(p(-1.0, 2.0), p(3.0, 2.0)), (p(1.0, 3.0), p(3.0, 1.0))] {
            let h = between(a, b, &piece, 1e-9);
            let room = h.normal.dot(&a.coords).min(h.normal.dot(&b.coords)) - h.offset;
            assert!(room.abs() < 1e-15, "{a} {b}: {h:?}");
        }
    }
}
