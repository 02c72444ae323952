//! The obstacles as a swarm in the column model meets them.
//!
//! Everything that depends only on column or strip is worked out once a call:
//! which discs can touch which strip, and which heights of a column lie in a
//! disc. A segment collides with a disc iff its distance from the centre is
//! below r (the paper's §2.3), that is iff one end lies in the disc (an
//! interval test on its column) or the foot of the perpendicular lies inside
//! the segment and nearer than r.

use env_model::{Aabb, Columns, Point, World};

use crate::choices::Bounds;

/// A disc that can touch a strip, relative to the strip's left column.
#[derive(Debug, Clone, Copy)]
pub struct StripDisc {
    /// Centre's x' less the left column's.
    pub fx: f64,
    /// The same times the column spacing.
    pub fx_dx: f64,
    /// Centre's y'.
    pub cy: f64,
    /// Radius squared.
    pub r2: f64,
}

/// The heights of a column inside a disc: |y' − cy| < half.
#[derive(Debug, Clone, Copy)]
pub struct Gap {
    /// Centre's y'.
    pub cy: f64,
    /// Half the chord.
    pub half: f64,
}

/// A capsule or polygon: its index in the world, and its box in the local frame.
pub type Other = (usize, Aabb);

/// What a strip between two columns has: so many of the terrain's lists, which are in the order of the strips.
#[derive(Debug, Clone, Copy)]
pub struct Strip {
    /// Width squared.
    pub dx2: f64,
    /// Discs that can touch it.
    pub discs: usize,
    /// Gaps of its right column; the goal's has none, as the goal is free.
    pub gaps: usize,
    /// Capsules and polygons that can touch it.
    pub others: usize,
    /// Heights where its right column is inside the field.
    pub inside: (f64, f64),
}

/// Lists by strip; strip j lies between columns j and j + 1.
#[derive(Debug, Clone, Default)]
pub struct Terrain {
    /// A strip of no width before the start, then strips 0 … m.
    pub strips: Vec<Strip>,
    /// Discs of all strips.
    pub discs: Vec<StripDisc>,
    /// Gaps of all columns.
    pub gaps: Vec<Gap>,
    /// Capsules and polygons of all strips.
    pub others: Vec<Other>,
    /// Whether the scene has a field.
    pub has_field: bool,
    /// Column spacing.
    pub dx: f64,
    /// Each disc that the swarm can meet once: centre and radius.
    met_discs: Vec<(f64, f64, f64)>,
    /// Each capsule and polygon once.
    met_others: Vec<Other>,
}

impl Terrain {
    /// Compiles the world for `columns`. With bounds, only obstacles that meet the search rectangle matter.
    pub fn compile(&mut self, world: &World, columns: &Columns, bounds: Bounds) {
        let (frame, dx, m) = (columns.frame(), columns.spacing(), columns.count());
        let length = frame.length();
        let reach = if bounds == Bounds::None { f64::INFINITY } else { columns.half_width() };
        self.dx = dx;
        self.met_discs.clear();
        self.met_others.clear();
        for (i, obstacle) in world.obstacles().iter().enumerate() {
            if let Some((c, r)) = obstacle.as_disc() {
                let c = frame.to_local(c);
                if c.x + r > 0.0 && c.x - r < length && c.y.abs() - r < reach {
                    self.met_discs.push((c.x, c.y, r));
                }
            } else {
                let b = frame.aabb_of(obstacle);
                if b.max.x > 0.0 && b.min.x < length && b.max.y > -reach && b.min.y < reach {
                    self.met_others.push((i, b));
                }
            }
        }
        self.strips.clear();
        self.discs.clear();
        self.gaps.clear();
        self.others.clear();
        self.has_field = world.inner_field().is_some();
        let everywhere = (f64::NEG_INFINITY, f64::INFINITY);
        self.strips.push(Strip { dx2: 0.0, discs: 0, gaps: 0, others: 0, inside: everywhere });
        for j in 0..=m {
            let before = (self.discs.len(), self.gaps.len(), self.others.len());
            let (left, right) = (columns.x(j), columns.x(j + 1));
            for &(cx, cy, r) in &self.met_discs {
                if cx + r > left && cx - r < right {
                    let fx = cx - left;
                    self.discs.push(StripDisc { fx, fx_dx: fx * dx, cy, r2: r * r });
                }
                let off = right - cx;
                if j < m && off.abs() < r {
                    self.gaps.push(Gap { cy, half: (r * r - off * off).sqrt() });
                }
            }
            self.others.extend(self.met_others.iter().filter(|(_, b)| b.max.x > left && b.min.x < right));
            self.strips.push(Strip {
                dx2: dx * dx,
                discs: self.discs.len() - before.0,
                gaps: self.gaps.len() - before.1,
                others: self.others.len() - before.2,
                inside: match world.inner_field() {
                    Some(field) if j < m => columns.inside(j + 1, field),
                    _ => everywhere,
                },
            });
        }
    }

    /// Centres (x', y') of every obstacle that the swarm can meet, in scene order by kind.
    pub fn centres(&self) -> impl Iterator<Item = Point> + '_ {
        let discs = self.met_discs.iter().map(|&(cx, cy, _)| Point::new(cx, cy));
        discs.chain(self.met_others.iter().map(|(_, b)| b.centre()))
    }
}

/// Whether the segment of strip j from height `a` to `b` hits one of `others`, capsules and polygons of `world`.
pub fn hits_other(world: &World, columns: &Columns, others: &[Other], j: usize, a: f64, b: f64) -> bool {
    let (low, high) = (a.min(b), a.max(b));
    let at = |i: usize, y: f64| columns.frame().to_world(Point::new(columns.x(i), y));
    others.iter().any(|(i, aabb)| {
        low < aabb.max.y && high > aabb.min.y && !world.obstacles()[*i].segment_free(at(j, a), at(j + 1, b), 0.0)
    })
}
