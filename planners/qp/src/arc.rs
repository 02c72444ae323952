//! The arcs that segments of a side class roll on, each one smooth convex constraint.
//!
//! Segment i keeps σ((1 − s) ηᵢ + s ηᵢ₊₁) ≥ σ h(s) for every s of an arc of a
//! circle (a, b, r) between two ends. The room left at the worst s is
//!
//! c(ηᵢ, ηᵢ₊₁) = σ(ηᵢ + aμ − b) − r√(1 + μ²), s = a − σ r μ/√(1 + μ²), μ = ηᵢ₊₁ − ηᵢ
//!
//! between the ends, and linear beyond them: concave and continuously
//! differentiable, with ∂c = σ(1 − s, s) and ∂²c/∂μ² = −r/(1 + μ²)^{3/2} (0
//! beyond the ends). A disc is one arc; the rounding of any other convex piece is
//! one a corner, and the piece's heights at both columns are two arcs of radius
//! 0, which with its corners hold the edges between. All in units of Δ.

use crate::cuts::class_bounds;
use crate::piece::{Piece, Side};
use crate::strip::Strip;

/// One arc; lengths in units of Δ, places from the segment's left column.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Arc {
    pub(crate) segment: usize,
    /// σ.
    pub(crate) sigma: f64,
    pub(crate) centre: (f64, f64),
    pub(crate) radius: f64,
    /// (s, h(s)) at both ends.
    pub(crate) ends: [(f64, f64); 2],
}

/// How a segment passes an arc.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pass {
    /// c, negative when the arc is pierced.
    pub(crate) room: f64,
    /// ∂c/∂ηᵢ and ∂c/∂ηᵢ₊₁.
    pub(crate) gradient: (f64, f64),
    /// Radius of the arc where the segment rolls on it, 0 beyond its ends.
    pub(crate) rolling: f64,
}

impl Arc {
    /// A height that the polyline keeps to at `s` of a segment.
    pub(crate) fn point(segment: usize, side: Side, s: f64, height: f64) -> Self {
        Self { segment, sigma: side.sign(), centre: (s, height), radius: 0.0, ends: [(s, height); 2] }
    }

    /// What a segment meets of a disc; `None` when the disc lies beside it.
    pub(crate) fn disc(segment: usize, side: Side, (a, b): (f64, f64), radius: f64) -> Option<Self> {
        let (sigma, low, high) = (side.sign(), (a - radius).max(0.0), (a + radius).min(1.0));
        let end = |s: f64| (s, b + sigma * (radius * radius - (s - a) * (s - a)).max(0.0).sqrt());
        (low <= high).then(|| Self { segment, sigma, centre: (a, b), radius, ends: [end(low), end(high)] })
    }

    /// Where the segment from `left` to `right` passes; `inverse` is 1/√(1 + μ²).
    #[inline]
    pub(crate) fn pass(&self, left: f64, right: f64, inverse: f64) -> Pass {
        let (sigma, slope) = (self.sigma, right - left);
        let reach = sigma * self.radius * inverse;
        let free = self.centre.0 - reach * slope;
        let [low, high] = self.ends;
        let (s, height, rolling) = if free < low.0 {
            (low.0, low.1, 0.0)
        } else if free > high.0 {
            (high.0, high.1, 0.0)
        } else {
            (free, self.centre.1 + reach, self.radius)
        };
        Pass { room: sigma * (left + s * slope - height), gradient: (sigma * (1.0 - s), sigma * s), rolling }
    }
}

/// All arcs of the class `sides` into `arcs`; false when they leave a column next to start or goal no height.
pub(crate) fn class_arcs(strip: &Strip, sides: &[Side], arcs: &mut Vec<Arc>) -> bool {
    arcs.clear();
    let spacing = strip.columns.spacing();
    let Some(bounds) = class_bounds(strip, sides) else { return false };
    for (segment, &(lo, hi)) in bounds.iter().enumerate() {
        for (side, height) in [(Side::Above, lo), (Side::Below, hi)] {
            if height.is_finite() {
                arcs.push(Arc::point(segment, side, 1.0, height / spacing));
            }
        }
    }
    for (piece, &side) in strip.pieces.iter().zip(sides) {
        // The segments at start and goal are held by the bounds.
        let first = ((piece.x.0 / spacing).floor().max(1.0)) as usize;
        for segment in first..strip.columns.count() {
            let x0 = strip.columns.x(segment);
            if x0 >= piece.x.1 {
                break;
            }
            if strip.columns.x(segment + 1) > piece.x.0 {
                piece_arcs(piece, side, segment, (x0, strip.columns.x(segment + 1)), arcs);
            }
        }
    }
    true
}

/// The arcs of `piece` between the columns at `x`.
fn piece_arcs(piece: &Piece, side: Side, segment: usize, x: (f64, f64), arcs: &mut Vec<Arc>) {
    let spacing = x.1 - x.0;
    let place = |x_at: f64| (x_at - x.0) / spacing;
    for corner in &piece.corners {
        arcs.extend(Arc::disc(segment, side, (place(corner.x), corner.y / spacing), piece.radius / spacing));
    }
    if piece.corners.len() > 1 {
        for x_end in [x.0, x.1] {
            if x_end >= piece.x.0 && x_end <= piece.x.1 {
                arcs.push(Arc::point(segment, side, place(x_end), piece.envelope(x_end, side) / spacing));
            }
        }
    }
}
