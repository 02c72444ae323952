//! Convex pieces of obstacles, seen from a path that is monotone in x: upper
//! and lower envelopes and where a line pierces them most.
//!
//! A piece is the set of points within r of a convex core: a disc's centre, a
//! capsule's axis, a convex polygon. A polygon with reflex corners becomes one
//! piece a side: a path that starts outside and crosses no side stays outside.
//! The upper envelope u is concave, the lower one convex; both are exact.

use env_model::{Core, Inflated, Point, Vector, geometry::cross};

/// Which side of a piece a path passes: above (left of start → goal) or below.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Side {
    /// y ≤ lower envelope.
    Below,
    /// y ≥ upper envelope.
    Above,
}

impl Side {
    /// σ = ±1.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Below => -1.0,
            Self::Above => 1.0,
        }
    }

    /// The side of the middle `y0` on which `y` lies.
    pub(crate) fn of(y: f64, y0: f64) -> Self {
        if y >= y0 { Self::Above } else { Self::Below }
    }
}

/// A convex piece of an obstacle.
#[derive(Debug, Clone)]
pub(crate) struct Piece {
    /// Corners of the convex core in order: 1, 2 or more.
    pub(crate) corners: Vec<Point>,
    /// r, rounding of the core.
    pub(crate) radius: f64,
    /// Index of its obstacle in the world.
    pub(crate) obstacle: usize,
    /// Whether it is one of several pieces of that obstacle.
    pub(crate) partial: bool,
    /// Extent along x, rounding included.
    pub(crate) x: (f64, f64),
    /// Extent along y, rounding included.
    pub(crate) y: (f64, f64),
}

/// Appends the pieces of `shape`, which is obstacle number `obstacle`.
pub(crate) fn decompose(shape: &Inflated, obstacle: usize, pieces: &mut Vec<Piece>) {
    let mut push = |corners: Vec<Point>, partial| pieces.push(Piece::new(corners, shape.radius, obstacle, partial));
    match &shape.core {
        Core::Point(c) => push(vec![*c], false),
        Core::Segment(a, b) => push(vec![*a, *b], false),
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            let n = corners.len();
            let corner = |i: usize| corners[i % n];
            // Corners are counter-clockwise: a right turn is a reflex corner.
            if (0..n).all(|i| cross(corner(i + 1) - corner(i), corner(i + 2) - corner(i + 1)) >= 0.0) {
                push(corners.to_vec(), false);
            } else {
                for (a, b) in polygon.sides() {
                    push(vec![a, b], true);
                }
            }
        }
    }
}

impl Piece {
    fn new(corners: Vec<Point>, radius: f64, obstacle: usize, partial: bool) -> Self {
        let extent = |get: fn(&Point) -> f64| {
            corners.iter().map(get).fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), v| (lo.min(v), hi.max(v)))
        };
        let (x, y) = (extent(|p| p.x), extent(|p| p.y));
        let mut piece = Self { corners, radius: 0.0, obstacle, partial, x, y };
        piece.grow(radius);
        piece
    }

    /// Grows (or shrinks, to the core at most) the rounding by `by`.
    pub(crate) fn grow(&mut self, by: f64) {
        let by = by.max(-self.radius);
        self.radius += by;
        self.x = (self.x.0 - by, self.x.1 + by);
        self.y = (self.y.0 - by, self.y.1 + by);
    }

    /// Sides of the core: none for a disc, one for a capsule.
    pub(crate) fn edges(&self) -> impl Iterator<Item = (Point, Point)> + '_ {
        let n = self.corners.len();
        let count = if n > 2 { n } else { n - 1 };
        (0..count).map(move |i| (self.corners[i], self.corners[(i + 1) % n]))
    }

    /// u(x) for `Above`, the lower envelope for `Below`; `x` is clamped to the piece's extent.
    ///
    /// Disc at (a, b): b + σ√(r² − (x − a)²). Otherwise the extreme of that over the
    /// corners and of the edges shifted by r along their normals.
    pub(crate) fn envelope(&self, x: f64, side: Side) -> f64 {
        let (sigma, r) = (side.sign(), self.radius);
        let x = x.clamp(self.x.0, self.x.1);
        // The extent is r from its outermost corner to within a few roundings,
        // which may be more than a share of a tiny r.
        let rounding = 8.0 * f64::EPSILON * self.x.0.abs().max(self.x.1.abs());
        let mut best = f64::NEG_INFINITY;
        for c in &self.corners {
            let dx = x - c.x;
            if dx.abs() <= r + rounding {
                best = best.max(sigma * c.y + (r * r - dx * dx).max(0.0).sqrt());
            }
        }
        for (a, b) in self.edges() {
            let d = b - a;
            // The normal on this side. On edges of the other side it points
            // into the piece, which never exceeds the envelope.
            let n = Vector::new(-d.y, d.x) * (sigma * d.x.signum() / d.norm());
            let (a, b) = (a + n * r, b + n * r);
            if d.x != 0.0 && x >= a.x.min(b.x) && x <= a.x.max(b.x) {
                best = best.max(sigma * (a.y + (b.y - a.y) * ((x - a.x) / (b.x - a.x))));
            }
        }
        sigma * best
    }

    /// The x where a line of the given slope is pierced most from `side`'s
    /// envelope: the support point in direction σ(−slope, 1).
    ///
    /// Disc at (a, b): a − σ r·slope/√(1 + slope²).
    pub(crate) fn support_x(&self, slope: f64, side: Side) -> f64 {
        let sigma = side.sign();
        let mut top = self.corners[0];
        for c in &self.corners[1..] {
            if sigma * ((c.y - top.y) - slope * (c.x - top.x)) > 0.0 {
                top = *c;
            }
        }
        top.x - sigma * self.radius * slope / (1.0 + slope * slope).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use env_model::Polygon;

    fn shapes() -> Vec<Inflated> {
        let p = Point::new;
        let hexagon = [p(0.0, 0.0), p(2.0, -1.0), p(4.0, 0.0), p(4.0, 2.0), p(3.0, 3.0), p(1.0, 2.5)];
        vec![
            Inflated { core: Core::Point(p(2.0, 1.0)), radius: 1.5 },
            Inflated { core: Core::Segment(p(0.5, 3.0), p(3.0, 0.0)), radius: 0.5 },
            Inflated { core: Core::Segment(p(2.0, 0.0), p(2.0, 2.0)), radius: 0.25 },
            Inflated { core: Core::Polygon(Polygon::new(hexagon.to_vec()).unwrap()), radius: 0.0 },
            Inflated { core: Core::Polygon(Polygon::new(hexagon.to_vec()).unwrap()), radius: 0.75 },
            // A radius that vanishes beside the coordinates, as margins do.
            Inflated { core: Core::Polygon(Polygon::new(hexagon.map(|c| c * 37.7).to_vec()).unwrap()), radius: 1e-9 },
        ]
    }

    #[test]
    fn envelopes_lie_on_the_border() {
        for shape in shapes() {
            let mut pieces = Vec::new();
            decompose(&shape, 0, &mut pieces);
            assert_eq!(pieces.len(), 1);
            let (x0, x1) = pieces[0].x;
            for i in 0..=50 {
                let x = x0 + (x1 - x0) * f64::from(i) / 50.0;
                let up = pieces[0].envelope(x, Side::Above);
                let low = pieces[0].envelope(x, Side::Below);
                assert!(up >= low);
                for y in [up, low] {
                    let d = shape.point_clearance(Point::new(x, y));
                    // Rounding of x and y, magnified where the border is steep: √(2 r ulp) at the extremes.
                    assert!(d.abs() < 1e-7, "{shape:?} at ({x}, {y}): {d}");
                }
                // Nothing of the piece beyond: the border is where clearance turns positive for good.
                assert!(shape.point_clearance(Point::new(x, up + 1e-3)) > 0.0);
                assert!(shape.point_clearance(Point::new(x, low - 1e-3)) > 0.0);
            }
        }
    }

    #[test]
    fn support_is_the_deepest_point_below_a_line() {
        for shape in shapes() {
            let mut pieces = Vec::new();
            decompose(&shape, 0, &mut pieces);
            let piece = &pieces[0];
            for side in [Side::Above, Side::Below] {
                for slope in [-2.0, -0.3, 0.0, 0.7, 5.0] {
                    let height = |x: f64| side.sign() * (piece.envelope(x, side) - slope * x);
                    let best = height(piece.support_x(slope, side));
                    for i in 0..=200 {
                        let x = piece.x.0 + (piece.x.1 - piece.x.0) * f64::from(i) / 200.0;
                        assert!(height(x) <= best + 1e-12, "{shape:?} {side:?} {slope} at {x}");
                    }
                }
            }
        }
    }

    #[test]
    fn reflex_corners_make_one_piece_a_side() {
        let p = Point::new;
        let notch = Polygon::new(vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 4.0), p(2.0, 1.0), p(0.0, 4.0)]).unwrap();
        let mut pieces = Vec::new();
        decompose(&Inflated { core: Core::Polygon(notch), radius: 0.5 }, 7, &mut pieces);
        assert_eq!(pieces.len(), 5);
        assert!(pieces.iter().all(|s| s.partial && s.obstacle == 7 && s.corners.len() == 2));
    }
}
