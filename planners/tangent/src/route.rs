//! A taut path: straight pieces joined by arcs, and its polyline.

use env_model::{Aabb, Point, Vector};

use crate::bitangent::{OrientedCircle, perp};
use crate::terrain::{BroadPhase, Piece, Terrain};

/// The most that one corner of the polyline turns, radians. Keeps the
/// expansion of tan that [`Route::write`] relies on good to 3 %.
const LARGEST_STEP: f64 = 0.5;
/// The same where circles are so small that every corner may be as long as its
/// arc again: 2 tan(1) = 3.1 for 2.
const LARGEST_ANYWAY: f64 = 2.0;

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
    /// Direction from the centre on arrival, unit length.
    fn outward(&self) -> Vector {
        perp(self.heading) * -self.circle.rho.signum()
    }
}

/// `v` turned by an angle in the sense of `sense` = ±1.
fn turned(v: Vector, (sin, cos): (f64, f64), sense: f64) -> Vector {
    v * cos + perp(v) * (sin * sense)
}

/// A taut path, in coordinates relative to the start.
#[derive(Debug, Default)]
pub(crate) struct Route {
    /// The arcs from start to goal.
    pub arcs: Vec<Arc>,
    /// Pieces that a corner outside an arc might enter.
    near: Vec<Piece>,
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

    /// Notes which pieces lie so near the arcs that polylines must mind them.
    pub fn note_near<B: BroadPhase>(&mut self, terrain: &Terrain, near: &B) {
        let Self { arcs, near: list, .. } = self;
        for arc in arcs {
            // A corner of step δ lies r(1/cos(δ/2) − 1) outside the arc: 0.033 r, or 0.85 r on the smallest circles.
            let (centre, r) = (arc.circle.centre, arc.circle.rho.abs());
            let bulge = 1.86 * r;
            terrain.pieces_near(near, &Aabb { min: centre, max: centre }.inflated(bulge), |site| {
                let Some(piece) = terrain.piece(site) else { return };
                let distance = piece.core_distance(centre);
                // A disc inside the arc's own cannot be entered from outside.
                let within = piece.is_disc() && distance + piece.radius <= r;
                if distance < bulge + piece.radius && !within {
                    list.push(piece);
                }
            });
            arc.near_end = list.len();
        }
    }

    /// Appends the corners of a polyline round the outside of every arc: its
    /// segments are tangents, so it enters no obstacle by more than the tolerance.
    ///
    /// A corner that turns by δ replaces rδ by 2r tan(δ/2) = rδ(1 + δ²/12 + δ⁴/120 + …).
    /// With A = Σrθ the total excess stays below `excess` · length for
    /// δ = √(12 · excess · length/A), less 3 % for the higher terms. Where a
    /// corner would enter another obstacle or leave the field, its step is halved.
    pub fn write(&self, terrain: &Terrain, excess: f64, mut corner: impl FnMut(Point)) {
        let total: f64 = self.arcs.iter().map(|arc| arc.circle.rho.abs() * arc.turn).sum();
        // A caller's 0 must not ask for infinitely many corners.
        let share = excess.max(1e-12) * self.length / total;
        let step = if share > 0.6 { LARGEST_ANYWAY } else { (0.97 * 12.0 * share).sqrt().min(LARGEST_STEP) };
        let mut begin = 0;
        for arc in &self.arcs {
            let near = &self.near[begin..arc.near_end];
            begin = arc.near_end;
            let around = Surroundings { near, bounds: terrain.bounds(), tolerance: terrain.tolerance() };
            let pieces = (arc.turn / step).ceil().max(1.0);
            let delta = arc.turn / pieces;
            let (half, whole) = (libm::sincos(0.5 * delta), libm::sincos(delta));
            let sense = arc.circle.rho.signum();
            let mut out = arc.outward();
            let OrientedCircle { centre, rho } = arc.circle;
            let outer = rho.abs() / half.1;
            if near.is_empty() && terrain.bounds().is_none_or(|b| b.depth_of(centre) >= outer) {
                let mut apex = turned(out, half, sense) * outer;
                for _ in 0..pieces as u64 {
                    corner(centre + apex);
                    apex = turned(apex, whole, sense);
                }
                continue;
            }
            for _ in 0..pieces as u64 {
                let middle = turned(out, half, sense);
                let end = turned(out, whole, sense);
                arc.piece([out, middle, end], delta, half.1, &around, &mut corner);
                out = end;
            }
        }
    }
}

/// What the corners of one arc must mind.
struct Surroundings<'a> {
    near: &'a [Piece],
    bounds: Option<&'a Aabb>,
    tolerance: f64,
}

impl Surroundings<'_> {
    fn allow(&self, a: Point, apex: Point, b: Point) -> bool {
        let clear = |piece: &Piece, p: Point, q: Point| piece.segment_distance(p, q) >= piece.radius - self.tolerance;
        self.bounds.is_none_or(|bounds| bounds.depth_of(apex) >= 0.0)
            && self.near.iter().all(|piece| clear(piece, a, apex) && clear(piece, apex, b))
    }
}

impl Arc {
    /// Appends one corner for `delta` of the arc between two outward directions,
    /// with the one in the middle and the cosine of half the angle, or several
    /// where the surroundings ask for it. The arc itself is free, so a bulge
    /// below the tolerance will do.
    fn piece(
        &self,
        [from, middle, to]: [Vector; 3],
        delta: f64,
        cosine: f64,
        around: &Surroundings<'_>,
        corner: &mut impl FnMut(Point),
    ) {
        let OrientedCircle { centre, rho } = self.circle;
        let radius = rho.abs();
        let outer = radius / cosine;
        let apex = centre + middle * outer;
        if outer - radius <= around.tolerance || around.allow(centre + from * radius, apex, centre + to * radius) {
            corner(apex);
        } else {
            let quarter = libm::sincos(0.25 * delta);
            let sense = rho.signum();
            let [first, second] = [from, middle].map(|v| turned(v, quarter, sense));
            self.piece([from, first, middle], 0.5 * delta, quarter.1, around, corner);
            self.piece([middle, second, to], 0.5 * delta, quarter.1, around, corner);
        }
    }
}
