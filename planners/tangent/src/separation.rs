//! Whether obstacles separate start from goal: a closed chain of overlapping
//! pieces winds round one of them.
//!
//! Join overlapping pieces through their nearest points by curves that stay
//! inside them. A closed curve separates start from goal when it crosses the
//! segment between them an odd number of times, so: label every piece of a
//! cluster with the parity of the crossings on the way to it; start and goal are
//! separated if and only if some cluster has two pieces whose labels disagree with
//! the curve between them. Everything outside the field is one more piece, in which curves
//! cross nothing. Only clusters that touch the segment need looking at.
//!
//! The search would find out too, but only after visiting everything it can reach.

use env_model::geometry::{closest_point, cross, segments_cross};
use env_model::{Aabb, Point};

use crate::terrain::{BroadPhase, FIRST, Piece, Terrain};

/// Reusable buffers.
#[derive(Debug, Default)]
pub(crate) struct Separation {
    /// Parity of the way to every site's piece, once it is reached; the last is the outside.
    labels: Vec<Option<bool>>,
    queue: Vec<usize>,
}

impl Separation {
    /// Whether the obstacles separate start from goal; overlaps below twice the tolerance, which
    /// the search can pass, do not count. Ends with `None` as soon as `allows` says no.
    pub fn separated<B: BroadPhase>(
        &mut self,
        terrain: &Terrain,
        near: &B,
        mut allows: impl FnMut() -> bool,
    ) -> Option<bool> {
        let straight = Straight { from: Point::origin(), to: terrain.goal() };
        let outside = terrain.len();
        let margin = 4.0 * terrain.tolerance();
        let Self { labels, queue } = self;
        labels.clear();
        labels.resize(terrain.len() + 1, None);
        queue.clear();
        terrain.pieces_near(near, &Aabb::of_points([&straight.from, &straight.to]), |site| queue.push(site));
        let roots = queue.len();
        let mut next_root = 0;
        let mut next = roots;
        loop {
            if next == queue.len() {
                // The cluster is done; the next root that no cluster has reached begins another.
                let Some(&root) = queue[..roots].get(next_root) else { return Some(false) };
                next_root += 1;
                if labels[root].is_none() {
                    labels[root] = Some(false);
                    queue.push(root);
                }
                continue;
            }
            if !allows() {
                return None;
            }
            let site = queue[next];
            next += 1;
            let parity = labels[site].unwrap_or(false);
            let mut odd = false;
            let mut reach = |site: usize, crossed: bool| {
                let label = parity ^ crossed;
                match labels[site] {
                    Some(known) => odd |= known != label,
                    None => {
                        labels[site] = Some(label);
                        queue.push(site);
                    }
                }
            };
            if site == outside {
                for other in FIRST..terrain.len() {
                    if let Some(crossed) = terrain.piece(other).and_then(|p| straight.to_outside(&p, terrain, margin)) {
                        reach(other, crossed);
                    }
                }
            } else if let Some(piece) = terrain.piece(site) {
                let region = Aabb::of_points([&piece.from, &piece.to]).inflated(piece.radius);
                terrain.pieces_near(near, &region, |other| {
                    if other != site
                        && let Some(crossed) = terrain.piece(other).and_then(|p| straight.between(&piece, &p, margin))
                    {
                        reach(other, crossed);
                    }
                });
                if let Some(crossed) = straight.to_outside(&piece, terrain, margin) {
                    reach(outside, crossed);
                }
            }
            if odd {
                return Some(true);
            }
        }
    }
}

/// The segment from start to goal.
struct Straight {
    from: Point,
    to: Point,
}

impl Straight {
    /// Whether the segment `c d` crosses. A point on the line counts as right of it,
    /// so that a chain through it is counted once.
    fn crosses(&self, c: Point, d: Point) -> bool {
        let left = |o: Point, u: Point, p: Point| cross(u - o, p - o) > 0.0;
        left(self.from, self.to, c) != left(self.from, self.to, d) && left(c, d, self.from) != left(c, d, self.to)
    }

    /// Parity of the curve from one piece's first end to the other's, if they overlap.
    fn between(&self, a: &Piece, b: &Piece, margin: f64) -> Option<bool> {
        let (p, q) = nearest(a, b);
        ((p - q).norm() < a.radius + b.radius - margin)
            .then(|| self.crosses(a.from, p) ^ self.crosses(p, q) ^ self.crosses(q, b.from))
    }

    /// Parity of the curve from a piece's first end to the outside of the field, if it sticks out.
    fn to_outside(&self, piece: &Piece, terrain: &Terrain, margin: f64) -> Option<bool> {
        let bounds = terrain.bounds()?;
        let end =
            [piece.from, piece.to].into_iter().min_by(|a, b| bounds.depth_of(*a).total_cmp(&bounds.depth_of(*b)))?;
        if bounds.depth_of(end) >= piece.radius - margin {
            return None;
        }
        let (low, high) = (end - bounds.min, bounds.max - end);
        let sides = [
            (low.x, Point::new(bounds.min.x - piece.radius, end.y)),
            (low.y, Point::new(end.x, bounds.min.y - piece.radius)),
            (high.x, Point::new(bounds.max.x + piece.radius, end.y)),
            (high.y, Point::new(end.x, bounds.max.y + piece.radius)),
        ];
        let (room, out) = sides.into_iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        // An end that lies outside need not go anywhere.
        let out = if room < 0.0 { end } else { out };
        Some(self.crosses(piece.from, end) ^ self.crosses(end, out))
    }
}

/// The nearest points of two pieces' segments.
fn nearest(a: &Piece, b: &Piece) -> (Point, Point) {
    if segments_cross(a.from, a.to, b.from, b.to) {
        let (u, v) = (a.to - a.from, b.to - b.from);
        let across = cross(u, v);
        if across != 0.0 {
            let p = a.from + u * (cross(b.from - a.from, v) / across).clamp(0.0, 1.0);
            return (p, p);
        }
    }
    let pairs = [
        (a.from, closest_point(a.from, b.from, b.to)),
        (a.to, closest_point(a.to, b.from, b.to)),
        (closest_point(b.from, a.from, a.to), b.from),
        (closest_point(b.to, a.from, a.to), b.to),
    ];
    let distance2 = |(p, q): &(Point, Point)| (p - q).norm_squared();
    pairs.into_iter().min_by(|x, y| distance2(x).total_cmp(&distance2(y))).unwrap_or((a.from, b.from))
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::terrain::Everything;

    fn separated(discs: &[(Point, f64)], goal: Point) -> bool {
        let mut terrain = Terrain::default();
        terrain.read_discs(discs, Point::origin(), goal, 0.0);
        Separation::default().separated(&terrain, &Everything(discs.len()), || true).unwrap()
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
