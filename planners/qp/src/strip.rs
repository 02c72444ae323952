//! The column model: what lies between the perpendiculars of start and goal,
//! which side of each piece a path passes, and a lower bound for each such class.

use env_model::{Columns, Point, World};

use crate::funnel::{Gate, height_at, taut_string};
use crate::piece::{Piece, Side, decompose};

/// One side a piece, in the strip's order.
pub(crate) type Sides = Vec<Side>;

/// The obstacles in the local frame of a set of columns.
#[derive(Debug)]
pub(crate) struct Strip {
    pub(crate) columns: Columns,
    /// Grown by a margin, so that a path that violates them by `tolerance` is free.
    pub(crate) pieces: Vec<Piece>,
    /// Where sides are read: x, and the middle of the piece there.
    middles: Vec<Point>,
    /// Heights that keep inside the field, a column each; empty without a field.
    pub(crate) field: Vec<(f64, f64)>,
    /// Vertical violation that counts as none, scene units.
    pub(crate) tolerance: f64,
    gates: Vec<Gate>,
    /// (piece, gate, lower envelope, upper envelope).
    samples: Vec<(usize, usize, f64, f64)>,
}

impl Strip {
    /// The obstacles between the perpendiculars that a path shorter than `limit` can meet: such a
    /// path lies in the ellipse about start and goal with half-width ½√(`limit`² − L²); +∞ for all.
    ///
    /// Pieces are grown by the world's slack ε/2, less where start or goal
    /// lies nearer, and paths may violate them by half of that: what comes out
    /// keeps clear of the true obstacle, or at worst (start or goal touching
    /// it) within the slack.
    pub(crate) fn new(world: &World, columns: Columns, start: Point, goal: Point, limit: f64) -> Self {
        let (frame, length, margin) = (columns.frame(), columns.frame().length(), world.slack());
        let half_width = 0.5 * (limit * limit - length * length).max(0.0).sqrt() + world.epsilon();
        let mut near = Vec::new();
        world.for_each_beside(start, goal, half_width, |index| near.push(index));
        near.sort_unstable();
        let mut pieces = Vec::new();
        for index in near {
            let obstacle = &world.obstacles()[index];
            let extent = frame.aabb_of(obstacle).inflated(margin);
            let beside = extent.max.x <= 0.0 || extent.min.x >= length;
            if beside || extent.max.y < -half_width || extent.min.y > half_width {
                continue;
            }
            let first = pieces.len();
            decompose(&frame.obstacle_to_local(obstacle), index, &mut pieces);
            let room = obstacle.point_clearance(start).min(obstacle.point_clearance(goal));
            for piece in &mut pieces[first..] {
                piece.grow(margin.min(room));
            }
        }
        pieces.retain(|piece| piece.x.1 > 0.0 && piece.x.0 < length);
        let middles = pieces.iter().map(|piece| {
            let x = (0.5 * (piece.x.0 + piece.x.1)).clamp(0.0, length);
            Point::new(x, 0.5 * (piece.envelope(x, Side::Above) + piece.envelope(x, Side::Below)))
        });
        let mut strip = Self {
            columns,
            middles: middles.collect(),
            pieces,
            field: Vec::new(),
            tolerance: 0.5 * margin,
            gates: Vec::new(),
            samples: Vec::new(),
        };
        strip.place_field(world, start, goal);
        strip.place_gates();
        strip
    }

    /// The columns cross the field, which is convex, in intervals.
    fn place_field(&mut self, world: &World, start: Point, goal: Point) {
        let Some(inner) = world.inner_field() else { return };
        let inner = inner.inflated(-world.slack().min(inner.depth_of(start)).min(inner.depth_of(goal)));
        self.field.extend((1..=self.columns.count()).map(|i| self.columns.inside(i, &inner)));
    }

    /// Gates: the columns that cross pieces, and the pieces' own middles.
    fn place_gates(&mut self) {
        let (spacing, count, length) = (self.columns.spacing(), self.columns.count(), self.columns.frame().length());
        let mut at: Vec<(f64, usize)> = Vec::new();
        for (k, (piece, middle)) in self.pieces.iter().zip(&self.middles).enumerate() {
            let first = ((piece.x.0 / spacing).ceil().max(1.0)) as usize;
            for i in (first..=count).take_while(|&i| self.columns.x(i) <= piece.x.1) {
                at.push((self.columns.x(i), k));
            }
            if middle.x > 0.0 && middle.x < length {
                at.push((middle.x, k));
            }
        }
        at.extend((1..=self.field.len()).map(|i| (self.columns.x(i), usize::MAX)));
        at.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (x, k) in at {
            if self.gates.last().is_none_or(|g| g.x != x) {
                self.gates.push(Gate { x, lo: f64::NEG_INFINITY, hi: f64::INFINITY });
            }
            let gate = self.gates.len() - 1;
            if let Some(piece) = self.pieces.get(k) {
                self.samples.push((k, gate, piece.envelope(x, Side::Below), piece.envelope(x, Side::Above)));
            } else {
                let column = (x / spacing).round() as usize;
                (self.gates[gate].lo, self.gates[gate].hi) = self.field[column - 1];
            }
        }
    }

    /// The sides that `path` (world frame) passes the pieces on, and its
    /// heights at the columns; `None` when it is not monotone along start → goal.
    ///
    /// A side is read at the middle of the piece's extent, where a colliding
    /// path has one too. A path through a polygon with reflex corners is
    /// taken to pass all of its sides alike.
    pub(crate) fn sides_of(&self, world: &World, path: &[Point]) -> Option<(Sides, Vec<f64>)> {
        let frame = self.columns.frame();
        let local: Vec<Point> = path.iter().map(|p| frame.to_local(*p)).collect();
        // Rounding of the frame's rotation is 1e-16 of the coordinates.
        let rounding = 1e-12 * (frame.length() + path.iter().fold(0.0, |m: f64, p| m.max(p.x.abs()).max(p.y.abs())));
        if local.len() < 2 || !local.windows(2).all(|w| w[1].x >= w[0].x - rounding) {
            return None;
        }
        let mut sides: Sides = self
            .middles
            .iter()
            .map(|middle| {
                let mut from = local.partition_point(|p| p.x < middle.x).saturating_sub(1).min(local.len() - 2);
                Side::of(height_at(&local, middle.x, &mut from), middle.y)
            })
            .collect();
        let mut k = 0;
        while k < sides.len() {
            let obstacle = self.pieces[k].obstacle;
            let end = k + self.pieces[k..].iter().take_while(|p| p.obstacle == obstacle).count();
            let shape = &world.obstacles()[obstacle];
            if self.pieces[k].partial && !path.windows(2).all(|w| shape.segment_free(w[0], w[1], world.slack())) {
                let centre = frame.to_local(shape.aabb().centre());
                let x = centre.x.clamp(0.0, frame.length());
                let side = Side::of(height_at(&local, x, &mut 0), centre.y);
                sides[k..end].fill(side);
            }
            k = end;
        }
        let mut from = 0;
        let heights = (1..=self.columns.count()).map(|i| height_at(&local, self.columns.x(i), &mut from)).collect();
        Some((sides, heights))
    }

    /// A lower bound on the length of a class, +∞ when a gate is closed, and
    /// the heights of its taut string at the columns.
    pub(crate) fn bound(&self, sides: &[Side]) -> (f64, Vec<f64>) {
        let mut gates = self.gates.clone();
        for &(k, gate, lower, upper) in &self.samples {
            let gate = &mut gates[gate];
            match sides[k] {
                Side::Above => gate.lo = gate.lo.max(upper),
                Side::Below => gate.hi = gate.hi.min(lower),
            }
        }
        let mut string = Vec::new();
        let bound = taut_string(&gates, self.columns.frame().length(), &mut string);
        if bound.is_infinite() {
            return (bound, Vec::new());
        }
        let mut from = 0;
        (bound, (1..=self.columns.count()).map(|i| height_at(&string, self.columns.x(i), &mut from)).collect())
    }
}
