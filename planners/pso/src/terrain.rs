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

/// Lists by column and by strip; strip j lies between columns j and j + 1.
#[derive(Debug, Clone, Default)]
pub struct Terrain {
    /// Discs of all strips; `strip_ends[j]` ends strip j's.
    strip_discs: Vec<StripDisc>,
    strip_ends: Vec<usize>,
    /// Gaps of columns 1 … m + 1 (the last is the goal's, empty).
    gaps: Vec<Gap>,
    gap_ends: Vec<usize>,
    /// Heights where columns 1 … m are inside the field.
    pub inside: Vec<(f64, f64)>,
    /// Whether the scene has a field.
    pub has_field: bool,
    /// Capsules and polygons, as indices into the world's obstacles, with their boxes: all, and by strip.
    others: Vec<(usize, Aabb)>,
    strip_others: Vec<(usize, Aabb)>,
    strip_other_ends: Vec<usize>,
    /// Column spacing.
    pub dx: f64,
    discs: Vec<(f64, f64, f64)>,
}

impl Terrain {
    /// Compiles the world for `columns`. With bounds, only obstacles that meet the search rectangle matter.
    pub fn compile(&mut self, world: &World, columns: &Columns, bounds: Bounds) {
        let (frame, dx, m) = (columns.frame(), columns.spacing(), columns.count());
        let length = frame.length();
        let reach = if bounds == Bounds::None { f64::INFINITY } else { columns.half_width() };
        self.dx = dx;
        self.discs.clear();
        self.others.clear();
        for (i, obstacle) in world.obstacles().iter().enumerate() {
            if let Some((c, r)) = obstacle.as_disc() {
                let c = frame.to_local(c);
                if c.x + r > 0.0 && c.x - r < length && c.y.abs() - r < reach {
                    self.discs.push((c.x, c.y, r));
                }
            } else {
                let b = frame.aabb_of(obstacle);
                if b.max.x > 0.0 && b.min.x < length && b.max.y > -reach && b.min.y < reach {
                    self.others.push((i, b));
                }
            }
        }
        self.strip_discs.clear();
        self.strip_ends.clear();
        self.gaps.clear();
        self.gap_ends.clear();
        self.strip_others.clear();
        self.strip_other_ends.clear();
        for j in 0..=m {
            let (left, right) = (columns.x(j), columns.x(j + 1));
            for &(cx, cy, r) in &self.discs {
                if cx + r > left && cx - r < right {
                    self.strip_discs.push(StripDisc { fx: cx - left, cy, r2: r * r });
                }
                let off = right - cx;
                // The goal's own column takes no part: the goal is free.
                if j < m && off.abs() < r {
                    self.gaps.push(Gap { cy, half: (r * r - off * off).sqrt() });
                }
            }
            for (i, b) in &self.others {
                if b.max.x > left && b.min.x < right {
                    self.strip_others.push((*i, *b));
                }
            }
            self.strip_ends.push(self.strip_discs.len());
            self.gap_ends.push(self.gaps.len());
            self.strip_other_ends.push(self.strip_others.len());
        }
        self.inside.clear();
        self.has_field = world.inner_field().is_some();
        if let Some(field) = world.inner_field() {
            self.inside.extend((1..=m).map(|i| columns.inside(i, field)));
        }
    }

    /// The discs that can touch strip j.
    #[inline(always)]
    pub fn strip(&self, j: usize) -> &[StripDisc] {
        let begin = if j == 0 { 0 } else { self.strip_ends[j - 1] };
        &self.strip_discs[begin..self.strip_ends[j]]
    }

    /// The gaps of column j + 1, the right border of strip j.
    #[inline(always)]
    pub fn gaps_right_of(&self, j: usize) -> &[Gap] {
        let begin = if j == 0 { 0 } else { self.gap_ends[j - 1] };
        &self.gaps[begin..self.gap_ends[j]]
    }

    /// Whether the segment of strip j from height `a` to `b` hits a capsule or polygon of `world`.
    pub fn hits_other(&self, world: &World, columns: &Columns, j: usize, a: f64, b: f64) -> bool {
        let begin = if j == 0 { 0 } else { self.strip_other_ends[j - 1] };
        let strip = &self.strip_others[begin..self.strip_other_ends[j]];
        let (low, high) = (a.min(b), a.max(b));
        let at = |i: usize, y: f64| columns.frame().to_world(Point::new(columns.x(i), y));
        strip.iter().any(|(i, aabb)| {
            low < aabb.max.y && high > aabb.min.y && !world.obstacles()[*i].segment_free(at(j, a), at(j + 1, b), 0.0)
        })
    }

    /// Whether there are no capsules or polygons.
    pub fn only_discs(&self) -> bool {
        self.others.is_empty()
    }

    /// Whether strip j has capsules or polygons.
    #[inline(always)]
    pub fn has_others(&self, j: usize) -> bool {
        let begin = if j == 0 { 0 } else { self.strip_other_ends[j - 1] };
        begin < self.strip_other_ends[j]
    }

    /// Centres (x', y') of every obstacle that the swarm can meet, in scene order by kind.
    pub fn centres(&self) -> impl Iterator<Item = Point> + '_ {
        let discs = self.discs.iter().map(|&(cx, cy, _)| Point::new(cx, cy));
        discs.chain(self.others.iter().map(|(_, b)| b.centre()))
    }
}
