//! Do the discs separate start from goal? Decided without searching for a path.
//!
//! The union of open discs separates two points exactly when some closed chain
//! of overlapping discs, drawn from centre to centre, crosses the segment
//! between the points an odd number of times: the chains carry the first
//! homology of the union (nerve theorem), and Alexander duality over ℤ/2 does
//! the rest. Giving every disc the parity of its chain from a root finds an odd
//! closed chain, O(overlaps). Only clusters that touch the segment need looking at.
//!
//! The search would find out too, but only after visiting everything it can reach.

use env_model::Point;
use env_model::geometry::cross;

use crate::discs::Discs;

/// Reusable buffers.
#[derive(Debug, Default)]
pub(crate) struct Separation {
    /// Query in which the disc was reached, and the parity of its chain.
    labels: Vec<(u32, bool)>,
    epoch: u32,
    queue: Vec<usize>,
}

impl Separation {
    /// Whether the discs separate `start` from `goal`; overlaps below `margin`
    /// do not count. Ends with `None` as soon as `allows` says no.
    pub fn separated<D: Discs>(
        &mut self,
        discs: &D,
        start: Point,
        goal: Point,
        margin: f64,
        mut allows: impl FnMut() -> bool,
    ) -> Option<bool> {
        if self.labels.len() < discs.len() {
            self.labels.resize(discs.len(), (0, false));
        }
        if self.epoch == u32::MAX {
            self.labels.fill((0, false));
            self.epoch = 0;
        }
        self.epoch += 1;
        let Self { labels, epoch, queue } = self;
        queue.clear();
        discs.along(start, goal, |i| queue.push(i));
        let roots = queue.len();
        let mut next_root = 0;
        let mut next = roots;
        loop {
            if next == queue.len() {
                // The cluster is done; the next root that no cluster has reached begins another.
                let Some(&root) = queue[..roots].get(next_root) else { return Some(false) };
                next_root += 1;
                if labels[root].0 != *epoch && discs.disc(root).is_some() {
                    labels[root] = (*epoch, false);
                    queue.push(root);
                }
                continue;
            }
            if !allows() {
                return None;
            }
            let i = queue[next];
            next += 1;
            let Some((ci, ri)) = discs.disc(i) else { continue };
            let parity = labels[i].1;
            let mut odd = false;
            discs.around(ci, ri, |j| {
                let Some((cj, rj)) = discs.disc(j) else { return };
                if j == i || (cj - ci).norm() >= ri + rj - margin {
                    return;
                }
                let along_j = parity ^ crosses(start, goal, ci, cj);
                if labels[j].0 == *epoch {
                    odd |= labels[j].1 != along_j;
                } else {
                    labels[j] = (*epoch, along_j);
                    queue.push(j);
                }
            });
            if odd {
                return Some(true);
            }
        }
    }
}

/// Whether the segments `a b` and `c d` cross. A centre on the line through
/// `a b` counts as right of it, so that a chain through it is counted once.
fn crosses(a: Point, b: Point, c: Point, d: Point) -> bool {
    let left = |o: Point, u: Point, p: Point| cross(u - o, p - o) > 0.0;
    left(a, b, c) != left(a, b, d) && left(c, d, a) != left(c, d, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discs::Listed;
    use env_model::Vector;
    use std::f64::consts::TAU;

    fn separated(discs: &[(Point, f64)], goal: Point) -> bool {
        let listed = Listed { discs, origin: Vector::zeros() };
        Separation::default().separated(&listed, Point::origin(), goal, 0.0, || true).unwrap()
    }

    #[test]
    fn a_closed_ring_separates_and_an_open_one_does_not() {
        let ring: Vec<_> = (0..12)
            .map(|i| TAU * f64::from(i) / 12.0)
            .map(|a| (Point::new(4.0 * a.cos(), 4.0 * a.sin()), 1.2))
            .collect();
        assert!(separated(&ring, Point::new(10.0, 0.0)), "through a centre");
        assert!(separated(&ring, Point::new(10.0, 1.0)));
        assert!(!separated(&ring, Point::new(1.0, 1.0)), "both inside");
        for i in 0..12 {
            let mut open = ring.clone();
            open.remove(i);
            assert!(!separated(&open, Point::new(10.0, 1.0)), "gap at {i}");
        }
        assert!(!separated(&ring[..6], Point::new(10.0, 0.0)));
    }
}
