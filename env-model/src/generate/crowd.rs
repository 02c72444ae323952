//! Robots on a pitch that do not stand in each other.
//!
//! A bucket grid finds the neighbours of a place in O(1), so that 10⁵ robots
//! are placed in a moment.

use super::ROBOT_RADIUS;
use super::draw::Draw;
use crate::scene::Field;
use crate::{Obstacle, Point, Scene, Vector};

/// Half the size of a Division A pitch, m.
const HALF: Vector = Vector::new(6.0, 4.5);

/// Share of the pitch that inflated robots may cover, n π (2 r)² / A, before it grows.
///
/// Random discs close every way through at 1.128 (continuum percolation, Quintanilla
/// & Ziff 2007, Phys. Rev. E 76:051115); the solvability check sees each disc 0.04 m
/// larger, which makes 0.35 count as 0.53.
const MOST_COVERED: f64 = 0.35;

/// Start and goal keep at least this much clearance to robots, m: two cells of the
/// solvability check, so that their own cell is always free.
const ROOM_AT_ENDS: f64 = 0.12;

/// The largest obstacle radius, m: a robot and a margin of 0.1 m.
pub(super) const LARGE_RADIUS: f64 = 0.19;

/// Robots placed so far, and the two ends.
pub(super) struct Crowd {
    half: Vector,
    pub start: Point,
    pub goal: Point,
    discs: Vec<(Point, f64)>,
    columns: usize,
    rows: usize,
    buckets: Vec<Vec<u32>>,
}

/// Side of a bucket: two of the largest neighbours may be this far apart and touch.
const BUCKET: f64 = 2.0 * LARGE_RADIUS;

/// Half the pitch for `count` robots: 12 × 9 m, or the same proportions at the covered share [`MOST_COVERED`].
fn half_pitch(count: usize) -> Vector {
    let inflated = 2.0 * ROBOT_RADIUS;
    let needed = count as f64 * std::f64::consts::PI * inflated * inflated / MOST_COVERED;
    let scale = (needed / (4.0 * HALF.x * HALF.y)).sqrt().max(1.0);
    HALF * scale
}

impl Crowd {
    /// An empty pitch for `count` robots with a start on the left and a goal on the right,
    /// a sixth of the half length from the lines, in the middle third of the width.
    pub fn new(draw: &mut Draw, count: usize) -> Self {
        let half = half_pitch(count);
        let x = half.x * (5.0 / 6.0);
        let y = half.y / 3.0;
        let start = Point::new(-x, draw.between(-y, y));
        let goal = Point::new(x, draw.between(-y, y));
        Self::with_ends(half, start, goal)
    }

    /// An empty pitch of that half size.
    pub fn with_ends(half: Vector, start: Point, goal: Point) -> Self {
        let columns = (2.0 * half.x / BUCKET).ceil() as usize;
        let rows = (2.0 * half.y / BUCKET).ceil() as usize;
        Self { half, start, goal, discs: Vec::new(), columns, rows, buckets: vec![Vec::new(); columns * rows] }
    }

    /// Half the size of the pitch.
    pub fn half(&self) -> Vector {
        self.half
    }

    /// Robots placed so far.
    pub fn len(&self) -> usize {
        self.discs.len()
    }

    fn bucket(&self, p: Point) -> (usize, usize) {
        // Casts saturate: places on the far border fall into the last bucket.
        let column = ((p.x + self.half.x) / BUCKET) as usize;
        let row = ((p.y + self.half.y) / BUCKET) as usize;
        (column.min(self.columns - 1), row.min(self.rows - 1))
    }

    /// Adds a robot unless it leaves the pitch, stands in another (by their bodies, not their
    /// margins) or crowds an end.
    pub fn try_add(&mut self, centre: Point, radius: f64) -> bool {
        let inside = centre.x.abs() <= self.half.x - ROBOT_RADIUS && centre.y.abs() <= self.half.y - ROBOT_RADIUS;
        let reach = radius + ROBOT_RADIUS + ROOM_AT_ENDS;
        let clear_of = |end: Point| (end - centre).norm_squared() >= reach * reach;
        if !inside || !clear_of(self.start) || !clear_of(self.goal) {
            return false;
        }
        let apart = 2.0 * ROBOT_RADIUS;
        let (column, row) = self.bucket(centre);
        for r in row.saturating_sub(1)..=(row + 1).min(self.rows - 1) {
            for c in column.saturating_sub(1)..=(column + 1).min(self.columns - 1) {
                let near = &self.buckets[r * self.columns + c];
                if near.iter().any(|&i| (self.discs[i as usize].0 - centre).norm_squared() < apart * apart) {
                    return false;
                }
            }
        }
        self.buckets[row * self.columns + column].push(self.discs.len() as u32);
        self.discs.push((centre, radius));
        true
    }

    /// Adds robots anywhere until there are `count`; `None` when the pitch seems full.
    pub fn scatter(&mut self, draw: &mut Draw, count: usize) -> Option<()> {
        let mut misses = 0;
        while self.len() < count {
            let centre = draw.in_box(Point::origin(), self.half);
            if !self.try_add(centre, ROBOT_RADIUS) {
                misses += 1;
                // At the covered share above nine places of ten are free; this is far beyond bad luck.
                if misses > 1000 + 10 * count {
                    return None;
                }
            }
        }
        Some(())
    }

    /// The scene; obstacle i is called "opponent i".
    pub fn into_scene(self) -> Scene {
        let obstacles = self
            .discs
            .iter()
            .enumerate()
            .map(|(i, &(centre, radius))| Obstacle {
                label: Some(format!("opponent {i}")),
                ..Obstacle::disc(centre, radius)
            })
            .collect();
        let (min, max) = ([-self.half.x, -self.half.y], [self.half.x, self.half.y]);
        scene(self.start, self.goal, Field { min, max }, obstacles)
    }
}

/// A scene in metres for the league's robot, its name still to be given.
pub(super) fn scene(start: Point, goal: Point, field: Field, obstacles: Vec<Obstacle>) -> Scene {
    Scene {
        name: String::new(),
        unit: crate::scene::metre(),
        robot_radius: ROBOT_RADIUS,
        start: start.into(),
        goal: goal.into(),
        field: Some(field),
        obstacles,
    }
}
