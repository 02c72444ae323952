//! Up to 64 boxes as the bits of one word: which of them a region may meet.
//!
//! Each axis is cut into equal slabs. For every slab two words tell which boxes begin
//! in it or before, and which end in it or after; a box overlaps the slabs i … j when it
//! has begun by j and has not ended before i. A query is four loads and three ANDs,
//! whatever the number of boxes and the size of the region.

use crate::Aabb;
use crate::probe::clamped_index;

/// Slabs an axis. 128 make the words of both axes 4 KiB, which stay in the first-level cache.
const SLABS: usize = 128;

/// One axis.
#[derive(Debug, Clone)]
struct Axis {
    origin: f64,
    /// Slabs a scene unit.
    scale: f64,
    begun: [u64; SLABS],
    unended: [u64; SLABS],
}

impl Axis {
    /// `sides` holds the two ends of every box.
    fn new(sides: impl Iterator<Item = (f64, f64)> + Clone) -> Self {
        let (low, high) = sides.clone().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), s| (l.min(s.0), h.max(s.1)));
        let scale = if high > low { (SLABS - 1) as f64 / (high - low) } else { 0.0 };
        let mut axis = Self { origin: low, scale, begun: [0; SLABS], unended: [0; SLABS] };
        for (bit, (from, to)) in sides.enumerate() {
            axis.begun[axis.slab(from)] |= 1 << bit;
            axis.unended[axis.slab(to)] |= 1 << bit;
        }
        for k in 1..SLABS {
            axis.begun[k] |= axis.begun[k - 1];
            axis.unended[SLABS - 1 - k] |= axis.unended[SLABS - k];
        }
        axis
    }

    /// The slab of `v`, the first or last one beyond the ends. It never falls as `v` rises, so
    /// that rounding cannot part what overlaps.
    #[inline]
    fn slab(&self, v: f64) -> usize {
        // The remainder changes nothing and spares the test of the bound.
        clamped_index((v - self.origin) * self.scale, (SLABS - 1) as f64) % SLABS
    }

    #[inline]
    fn meeting(&self, low: f64, high: f64) -> u64 {
        self.begun[self.slab(high)] & self.unended[self.slab(low)]
    }
}

/// The two axes' words.
#[derive(Debug, Clone)]
pub struct Slabs {
    x: Axis,
    y: Axis,
}

impl Slabs {
    /// The most boxes that it can hold.
    pub const MOST: usize = u64::BITS as usize;

    /// Box i of `boxes`, at most [`Slabs::MOST`], becomes bit i.
    pub fn new(boxes: &[Aabb]) -> Self {
        Self {
            x: Axis::new(boxes.iter().map(|b| (b.min.x, b.max.x))),
            y: Axis::new(boxes.iter().map(|b| (b.min.y, b.max.y))),
        }
    }

    /// The boxes that may overlap `region`, at least all that do.
    #[inline]
    pub fn meeting(&self, region: &Aabb) -> u64 {
        self.x.meeting(region.min.x, region.max.x) & self.y.meeting(region.min.y, region.max.y)
    }
}
