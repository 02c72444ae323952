//! A taut path: straight pieces joined by arcs, and its polyline.

use env_model::geometry::point_segment_distance;
use env_model::{Aabb, Point, Vector};

use crate::bitangent::{OrientedCircle, perp};
use crate::discs::Discs;

/// The most that one corner of the polyline turns, radians. Keeps the
/// expansion of tan that [`Route::write`] relies on good to 3 %.
const LARGEST_STEP: f64 = 0.5;
/// An arc of a taut path.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arc {
    /// The circle it follows.
    pub circle: OrientedCircle,
    /// Unit heading on arrival.
    pub heading: Vector,
    /// Angle in [0, 2π] that it turns, in the circle's sense.
    pub turn: f64,
    /// End of its range in `Route::near`.
    near_end: usize,
}

impl Arc {
    /// Direction from the centre after the fraction `angle` of the turn, unit length.
    fn outward(&self, angle: f64) -> Vector {
        let sense = self.circle.rho.signum();
        let out = perp(self.heading) * -sense;
        let (sin, cos) = libm::sincos(angle);
        out * cos + perp(out) * (sin * sense)
    }

    /// The point of its circle after turning by `angle`.
    pub fn point(&self, angle: f64) -> Point {
        self.circle.centre + self.outward(angle) * self.circle.rho.abs()
    }
}

/// A taut path, in coordinates relative to the start.
#[derive(Debug, Default)]
pub(crate) struct Route {
    /// The arcs from start to goal.
    pub arcs: Vec<Arc>,
    /// Discs that a corner outside an arc might enter.
    near: Vec<(Point, f64)>,
    /// Exact length.
    pub length: f64,
}

impl Route {
    /// Forgets the path.
    pub fn clear(&mut self) {
        self.arcs.clear();
        self.near.clear();
        self.length = 0.0;
    }

    /// Appends an arc.
    pub fn push(&mut self, circle: OrientedCircle, heading: Vector, turn: f64) {
        self.arcs.push(Arc { circle, heading, turn, near_end: self.near.len() });
    }

    /// Notes which discs lie so near the arcs that polylines must mind them.
    pub fn note_near<D: Discs>(&mut self, discs: &D) {
        // A corner of step δ lies r(1/cos(δ/2) − 1) outside the arc, ≤ 0.033 r.
        let bulge = 1.0 / libm::cos(0.5 * LARGEST_STEP);
        for arc in &mut self.arcs {
            let (centre, r) = (arc.circle.centre, arc.circle.rho.abs());
            discs.around(centre, bulge * r, |j| {
                if let Some((c, rj)) = discs.disc(j) {
                    let distance = (c - centre).norm();
                    // A disc inside the arc's own cannot be entered from outside.
                    if distance < bulge * r + rj && distance + rj > r {
                        self.near.push((c, rj));
                    }
                }
            });
            arc.near_end = self.near.len();
        }
    }

    /// Appends the corners of a polyline round the outside of every arc: its
    /// segments are tangents, so it enters no disc by more than `tolerance`.
    ///
    /// A corner that turns by δ replaces rδ by 2r tan(δ/2) = rδ(1 + δ²/12 + δ⁴/120 + …).
    /// With A = Σrθ the total excess stays below `excess` · length for
    /// δ = √(12 · excess · length/A), less 3 % for the higher terms. Where a
    /// corner would enter another disc or leave `bounds`, its step is halved.
    pub fn write(&self, excess: f64, bounds: Option<&Aabb>, tolerance: f64, mut corner: impl FnMut(Point)) {
        let total: f64 = self.arcs.iter().map(|arc| arc.circle.rho.abs() * arc.turn).sum();
        // A caller's 0 must not ask for infinitely many corners.
        let excess = excess.max(1e-12);
        let step = (0.97 * 12.0 * excess * self.length / total).sqrt().min(LARGEST_STEP);
        let mut begin = 0;
        for arc in &self.arcs {
            let around = Surroundings { discs: &self.near[begin..arc.near_end], bounds, tolerance };
            begin = arc.near_end;
            let pieces = (arc.turn / step).ceil().max(1.0);
            let delta = arc.turn / pieces;
            for i in 0..pieces as u64 {
                arc.piece(i as f64 * delta, delta, &around, &mut corner);
            }
        }
    }
}

/// What the corners of one arc must mind.
struct Surroundings<'a> {
    discs: &'a [(Point, f64)],
    bounds: Option<&'a Aabb>,
    tolerance: f64,
}

impl Surroundings<'_> {
    fn allow(&self, a: Point, apex: Point, b: Point) -> bool {
        let clear = |c: Point, r: f64| {
            let limit = r - self.tolerance;
            point_segment_distance(c, a, apex) >= limit && point_segment_distance(c, apex, b) >= limit
        };
        self.bounds.is_none_or(|bounds| bounds.depth_of(apex) >= 0.0) && self.discs.iter().all(|&(c, r)| clear(c, r))
    }
}

impl Arc {
    /// Appends one corner for the angles from `from` to `from + delta`, or several
    /// where the surroundings ask for it. The arc itself is free, so a bulge
    /// below the tolerance will do.
    fn piece(&self, from: f64, delta: f64, around: &Surroundings<'_>, corner: &mut impl FnMut(Point)) {
        let half = 0.5 * delta;
        let radius = self.circle.rho.abs();
        let outer = radius / libm::cos(half);
        let apex = self.circle.centre + self.outward(from + half) * outer;
        let alone = around.discs.is_empty() && around.bounds.is_none();
        if alone || outer - radius <= around.tolerance || around.allow(self.point(from), apex, self.point(from + delta))
        {
            corner(apex);
        } else {
            self.piece(from, half, around, corner);
            self.piece(from + half, half, around, corner);
        }
    }
}
