//! One segment against many discs: the narrow phase's inner loop.

use crate::geometry::cross;
use crate::{Point, Vector};

/// The integer nearest to `t` in 0 ..= `last`, `last` < 2³²; 0 when `t` is not a number. Never falls as `t` rises.
#[inline]
pub(crate) fn clamped_index(t: f64, last: f64) -> usize {
    // Adding 2⁵² rounds to an integer and leaves it in the lowest bits, for a third of a cast's instructions.
    const INTEGER: f64 = (1u64 << 52) as f64;
    (t.max(0.0).min(last) + INTEGER).to_bits() as u32 as usize
}

/// What segments must keep off: a centre and the square of the distance to keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disc {
    /// The centre.
    pub centre: Point,
    /// Square of the distance, in scene units².
    pub reach_squared: f64,
}

impl Disc {
    /// What no segment enters.
    pub const NONE: Self = Self { centre: Point::new(0.0, 0.0), reach_squared: 0.0 };

    /// Segments must keep `reach` off `centre`; nothing when it is not positive.
    pub fn new(centre: Point, reach: f64) -> Self {
        let reach = reach.max(0.0);
        Self { centre, reach_squared: reach * reach }
    }
}

/// A segment with what tests against many discs share.
#[derive(Debug, Clone, Copy)]
pub struct Probe {
    a: Point,
    b: Point,
    d: Vector,
    length_squared: f64,
}

impl Probe {
    /// The segment `a b`, finite.
    #[inline]
    pub fn new(a: Point, b: Point) -> Self {
        let d = b - a;
        Self { a, b, d, length_squared: d.norm_squared() }
    }

    /// Whether the segment comes nearer to the centre than its reach: without root or division.
    ///
    /// Near an end, or between them and near the line: |d × (c − a)|² < reach² |d|².
    #[inline]
    pub fn enters(&self, disc: &Disc) -> bool {
        let (from_a, from_b) = (disc.centre - self.a, disc.centre - self.b);
        let along = from_a.dot(&self.d);
        let across = cross(self.d, from_a);
        let r2 = disc.reach_squared;
        // No lazy operators: the three cost less than guessing which one decides.
        (from_a.norm_squared() < r2)
            | (from_b.norm_squared() < r2)
            | ((along > 0.0) & (along < self.length_squared) & (across * across < r2 * self.length_squared))
    }
}
