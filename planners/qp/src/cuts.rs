//! Cutting planes that keep whole segments on their side of every piece.
//!
//! For side σ segment i is safe when at every x of the piece within its strip
//! σ((1 − s) yᵢ + s yᵢ₊₁) ≥ σ u(x), s = (x − xᵢ)/Δ: linear in (yᵢ, yᵢ₊₁) for
//! each x, so the feasible set is convex and exact, overlapping pieces
//! included. The most violated x for a segment of slope μ is the piece's
//! support point in direction σ(−μ, 1), clamped to the strip, because u is concave.

use crate::piece::{Piece, Side};
use crate::strip::Strip;

/// σ((1 − s) yᵢ + s yᵢ₊₁) ≥ σ h. Columns 0 and m + 1 have height 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cut {
    pub(crate) segment: usize,
    pub(crate) s: f64,
    pub(crate) side: Side,
    pub(crate) height: f64,
    /// Radius of the border there, when the segment can roll on it; else 0.
    pub(crate) rounding: f64,
}

/// The cuts of one side class that have been found necessary.
#[derive(Debug)]
pub(crate) struct Cuts<'a> {
    strip: &'a Strip,
    sides: &'a [Side],
    /// Heights of the columns that the field and the segments at start and goal allow.
    bounds: Vec<(f64, f64)>,
    pub(crate) list: Vec<Cut>,
}

impl<'a> Cuts<'a> {
    /// The bounds of a class; `None` when they leave a column no height.
    pub(crate) fn new(strip: &'a Strip, sides: &'a [Side]) -> Option<Self> {
        let bounds = class_bounds(strip, sides)?;
        Some(Self { strip, sides, bounds, list: Vec::new() })
    }

    /// Adds a cut wherever the polyline at `heights` comes vertically nearer to
    /// a piece than `within` or violates it; a negative `within` is a violation
    /// to ignore. Returns the largest violation, perhaps negative.
    pub(crate) fn separate(&mut self, heights: &[f64], within: f64) -> f64 {
        let mut worst = f64::NEG_INFINITY;
        for (i, (&y, &(lo, hi))) in heights.iter().zip(&self.bounds).enumerate() {
            for (side, height) in [(Side::Above, lo), (Side::Below, hi)] {
                let violation = side.sign() * (height - y);
                worst = worst.max(violation);
                if violation > -within {
                    self.list.push(Cut { segment: i, s: 1.0, side, height, rounding: 0.0 });
                }
            }
        }
        let (strip, spacing, count) = (self.strip, self.strip.columns.spacing(), heights.len());
        for (piece, &side) in strip.pieces.iter().zip(self.sides) {
            // The segments at start and goal are held by `bounds`.
            let first = ((piece.x.0 / spacing).floor().max(1.0)) as usize;
            for segment in first..count {
                let (x0, x1) = (strip.columns.x(segment), strip.columns.x(segment + 1));
                if x0 >= piece.x.1 {
                    break;
                }
                let (y0, y1) = (heights[segment - 1], heights[segment]);
                let clear = match side {
                    Side::Above => y0.min(y1) - piece.y.1,
                    Side::Below => piece.y.0 - y0.max(y1),
                };
                if clear >= within.max(0.0) || x1 <= piece.x.0 {
                    continue;
                }
                let slope = (y1 - y0) / spacing;
                let free = piece.support_x(slope, side);
                let x = free.clamp(piece.x.0.max(x0), piece.x.1.min(x1));
                let (s, height) = ((x - x0) / spacing, piece.envelope(x, side));
                let violation = side.sign() * (height - (y0 + s * (y1 - y0)));
                worst = worst.max(violation);
                if violation > -within {
                    let rounding = if x == free { piece.radius } else { 0.0 };
                    self.list.push(Cut { segment, s, side, height, rounding });
                }
            }
        }
        worst
    }
}

/// The heights of the columns that the field and the segments at start and goal allow a class;
/// `None` when they leave a column none.
pub(crate) fn class_bounds(strip: &Strip, sides: &[Side]) -> Option<Vec<(f64, f64)>> {
    let count = strip.columns.count();
    let mut bounds =
        if strip.field.is_empty() { vec![(f64::NEG_INFINITY, f64::INFINITY); count] } else { strip.field.clone() };
    for (piece, &side) in strip.pieces.iter().zip(sides) {
        for (column, at_start) in [(1, true), (count, false)] {
            let bound = &mut bounds[column - 1];
            let least = fan_bound(strip, piece, side, at_start);
            match side {
                Side::Above => bound.0 = bound.0.max(least),
                Side::Below => bound.1 = bound.1.min(-least),
            }
        }
    }
    let open =
        bounds.iter().all(|&(lo, hi)| lo < f64::INFINITY && hi > f64::NEG_INFINITY && lo <= hi + strip.tolerance);
    open.then_some(bounds)
}

/// The least σ y of the column next to start or goal whose segment is safe:
/// max over x of σ u(x)/s; +∞ when there is none, −∞ when the piece is not there.
///
/// A one-dimensional problem, so it is solved here, by the same cuts, and not in the programme.
fn fan_bound(strip: &Strip, piece: &Piece, side: Side, at_start: bool) -> f64 {
    let (length, spacing, sigma) = (strip.columns.frame().length(), strip.columns.spacing(), side.sign());
    // z: distance from the fixed end.
    let (near, far) = if at_start { piece.x } else { (length - piece.x.1, length - piece.x.0) };
    let (near, far) = (near.max(0.0), far.min(spacing));
    if near >= far {
        return f64::NEG_INFINITY;
    }
    let x_of = |z: f64| if at_start { z } else { length - z };
    if near == 0.0 && sigma * piece.envelope(x_of(0.0), side) > strip.tolerance {
        return f64::INFINITY;
    }
    let mut least = sigma * piece.envelope(x_of(far), side) / (far / spacing);
    // Each step at least halves the error (grazing start); usually it squares it.
    for _ in 0..64 {
        let rise = sigma * least / spacing;
        let z = {
            let x = piece.support_x(if at_start { rise } else { -rise }, side);
            (if at_start { x } else { length - x }).clamp(near, far)
        };
        let s = z / spacing;
        // Nearer than this rounding of u exceeds what is left to gain.
        if s < 1e-6 {
            break;
        }
        let next = sigma * piece.envelope(x_of(z), side) / s;
        if next <= least + 1e-14 * least.abs() {
            break;
        }
        least = next;
    }
    least
}
