//! The entries of the open set.

use std::cmp::Ordering;

/// An untested way to go on: along the circle of arrival `from`, then the tangent to circle `to`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Candidate {
    /// Lower bound of the whole path's length.
    pub bound: f64,
    /// Index of the arrival.
    pub from: usize,
    /// Index of the circle.
    pub to: usize,
    /// Whether the bound holds the exact arc, or a cheaper lower bound of it.
    pub exact: bool,
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
        other.bound.total_cmp(&self.bound).then_with(|| other.from.cmp(&self.from)).then_with(|| other.to.cmp(&self.to))
    }
}

/// Both tangents from an arrival to a member, put off because they lead too far round.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Deferred {
    /// Lower bound of the whole path's length.
    pub bound: f64,
    /// Index of the arrival.
    pub from: usize,
    /// Number of the member.
    pub member: usize,
}
