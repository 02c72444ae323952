//! The entries of the open set.

use std::cmp::Ordering;

/// An untested way to go on from an arrival.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Lower bound of the whole path's length.
    pub bound: f64,
    /// Index of the arrival.
    pub from: u32,
    /// Where to.
    pub way: Way,
}

/// Where a candidate leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Way {
    /// Along the circle, then the tangent to this circle.
    Tangent(u32),
    /// The same; the bound holds the exact arc and no longer a cheaper lower bound of it.
    Measured(u32),
    /// Tangents that lead farther round than those offered so far.
    Farther,
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    /// The least bound is the greatest candidate, because `BinaryHeap` gives the greatest first.
    fn cmp(&self, other: &Self) -> Ordering {
        other.bound.total_cmp(&self.bound).then_with(|| (other.from, other.way).cmp(&(self.from, self.way)))
    }
}
