//! One obstacle as the judge sees it: parry shapes and a distance to keep from them.

use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::PointQuery;
use parry2d_f64::query::details::distance_segment_segment;
use parry2d_f64::shape::Segment;
use parry2d_f64::utils::point_in_poly2d;

enum Core {
    Point(Vector),
    Segment(Segment),
    /// Corners and sides of a simple polygon.
    Polygon(Vec<Vector>, Vec<Segment>),
}

pub(super) struct Body {
    core: Core,
    /// Own radius plus the robot's.
    radius: f64,
}

impl Body {
    pub(super) fn disc(centre: Vector, radius: f64) -> Self {
        Self { core: Core::Point(centre), radius }
    }

    pub(super) fn capsule(from: Vector, to: Vector, radius: f64) -> Self {
        Self { core: Core::Segment(Segment::new(from, to)), radius }
    }

    pub(super) fn polygon(corners: Vec<Vector>, radius: f64) -> Self {
        let next = corners.iter().cycle().skip(1);
        let sides = corners.iter().zip(next).map(|(a, b)| Segment::new(*a, *b)).collect();
        Self { core: Core::Polygon(corners, sides), radius }
    }

    /// Whether the segment `a b` keeps a distance of at least radius − `epsilon`.
    pub(super) fn lets_pass(&self, a: Vector, b: Vector, epsilon: f64) -> bool {
        let path = Segment::new(a, b);
        let reach = self.radius - epsilon;
        match &self.core {
            Core::Point(centre) => point_distance(&path, *centre) >= reach,
            Core::Segment(axis) => segment_distance(&path, axis) >= reach,
            Core::Polygon(corners, sides) if reach > 0.0 => {
                sides.iter().all(|side| segment_distance(&path, side) >= reach) && !point_in_poly2d(a, corners)
            }
            // A point robot may scratch the border, but not go deeper than ε − radius.
            Core::Polygon(corners, sides) => !enters(corners, sides, &path, -reach),
        }
    }

    /// Least signed distance between the segment `a b` and the inflated border.
    pub(super) fn clearance(&self, a: Vector, b: Vector) -> f64 {
        let path = Segment::new(a, b);
        let core = match &self.core {
            Core::Point(centre) => point_distance(&path, *centre),
            Core::Segment(axis) => segment_distance(&path, axis),
            Core::Polygon(corners, sides) => {
                let border = sides.iter().map(|side| segment_distance(&path, side)).fold(f64::INFINITY, f64::min);
                if enters(corners, sides, &path, 0.0) { -depth(corners, sides, &path) } else { border }
            }
        };
        core - self.radius
    }
}

fn point_distance(segment: &Segment, p: Vector) -> f64 {
    segment.distance_to_local_point(p, true)
}

/// Distance of two segments. parry finds the nearest points of crossing segments, but for nearly
/// parallel ones it loses up to the square root of its accuracy; disjoint segments are nearest at
/// an end point, and those four distances it computes to rounding. Each is an upper bound. Short
/// crossing segments it may take for parallel ones; orientations tell them.
fn segment_distance(s: &Segment, t: &Segment) -> f64 {
    let side = |s: &Segment, p: Vector| (s.b - s.a).perp_dot(p - s.a);
    if side(s, t.a) * side(s, t.b) < 0.0 && side(t, s.a) * side(t, s.b) < 0.0 {
        return 0.0;
    }
    [point_distance(s, t.a), point_distance(s, t.b), point_distance(t, s.a), point_distance(t, s.b)]
        .into_iter()
        .fold(distance_segment_segment(&Pose::IDENTITY, s, t), f64::min)
}

fn at(path: &Segment, t: f64) -> Vector {
    path.a + (path.b - path.a) * t
}

/// Whether some point of `path` lies in the polygon, farther than `delta` ≥ 0 from every side.
///
/// The distance to a side is convex along the path, so the points within δ of it form one
/// interval. Between the ends of all intervals the answer is constant: one probe each decides.
fn enters(corners: &[Vector], sides: &[Segment], path: &Segment, delta: f64) -> bool {
    let deep = |p: Vector| point_in_poly2d(p, corners) && sides.iter().all(|side| point_distance(side, p) > delta);
    if path.a == path.b {
        return deep(path.a);
    }
    let mut cuts = vec![0.0, 1.0];
    for side in sides {
        near(path, side, delta, &mut cuts);
    }
    cuts.sort_by(f64::total_cmp);
    cuts.windows(2).any(|w| w[0] < w[1] && deep(at(path, 0.5 * (w[0] + w[1]))))
}

/// Adds to `cuts` the ends of the interval of parameters at which `path` is within `delta` of `side`,
/// found by bisection on both sides of the nearest point. (Cuts too many do no harm.)
fn near(path: &Segment, side: &Segment, delta: f64, cuts: &mut Vec<f64>) {
    let distance = |t: f64| point_distance(side, at(path, t));
    let (d, e) = (path.b - path.a, side.b - side.a);
    let parameter = |p: Vector| ((p - path.a).dot(d) / d.length_squared()).clamp(0.0, 1.0);
    // The nearest point is an end of either segment, or where their lines cross.
    let mut candidates = [0.0, 1.0, parameter(side.a), parameter(side.b), 0.0];
    let denominator = d.perp_dot(e);
    if denominator != 0.0 {
        candidates[4] = ((side.a - path.a).perp_dot(e) / denominator).clamp(0.0, 1.0);
    }
    if delta == 0.0 {
        // What touches a side does so at one of these, or between two of them.
        cuts.extend(candidates);
        return;
    }
    let nearest = candidates.into_iter().fold(0.0, |s, t| if distance(t) < distance(s) { t } else { s });
    if distance(nearest) > delta {
        return;
    }
    cuts.extend([0.0, 1.0].map(|end| {
        if distance(end) <= delta {
            return end;
        }
        let (mut inside, mut outside) = (nearest, end);
        // 60 halvings exhaust the 53 bits of a parameter in [0, 1].
        for _ in 0..60 {
            let middle = 0.5 * (inside + outside);
            if distance(middle) <= delta { inside = middle } else { outside = middle }
        }
        inside
    }));
}

/// The greatest distance from every side that a point of `path` inside the polygon has, by bisection.
fn depth(corners: &[Vector], sides: &[Segment], path: &Segment) -> f64 {
    let span = corners.iter().map(|c| (*c - corners[0]).length()).fold(0.0, f64::max);
    let (mut lo, mut hi) = (0.0, 2.0 * span);
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if enters(corners, sides, path, middle) { lo = middle } else { hi = middle }
    }
    lo
}
