//! How fast a polyline's corners are passed, and what that takes.
//!
//! A corner between the unit directions u₁ and u₂ is passed on a *blend*: constant acceleration v(u₂ − u₁)/τ during
//! τ = v|u₂ − u₁|/a, from speed v to speed v. It begins and ends v²|u₂ − u₁|/(2a) from the corner, whose *turn* is
//! c = |u₂ − u₁|. Of a side of length L between corners of squared speeds x and y, (cx + dy)/(2a) belongs to their
//! blends, so that y can be reached from x by accelerating if y(1 + d) ≤ x(1 − c) + 2aL, and by braking if
//! x(1 + c) ≤ y(1 − d) + 2aL: one pass from the goal and one from the start give the greatest speeds.
//!
//! Circles that the sides of a polyline touch in their middles stay clear: blends that fill all sides are parabolas
//! outside them, passed at √(ar/cos(θ/2)).

use crate::motion::{Limits, Piece, Trajectory};
use crate::{Point, Vector};

/// A corner of the path, its first point included.
#[derive(Debug, Clone, Copy)]
pub struct Corner {
    pub at: Point,
    /// Unit direction to the next corner, zero at the end.
    pub ahead: Vector,
    /// Distance to the next corner.
    pub length: f64,
    /// |u₂ − u₁|; 0 at both ends.
    turn: f64,
    /// The greatest squared speed whose blend may be free of the world.
    free: f64,
    /// The greatest from which all that follows can be passed and the goal reached.
    back: f64,
    /// The greatest on the quickest way from the first corner on.
    square: f64,
    /// How long that way takes from the end of this corner's blend on.
    after: f64,
    /// The squared speed last seen to be free.
    pub checked: f64,
}

/// How the robot joins the path: with the speed √`square` it passes a corner `from`, where it turns by `turn`, and then
/// goes straight to the corner `next` of the path.
#[derive(Debug, Clone, Copy)]
pub struct Entry {
    pub from: Point,
    pub ahead: Vector,
    pub length: f64,
    pub turn: f64,
    pub square: f64,
    pub next: usize,
}

/// The corners of a path and their speeds. Its buffers are reused.
#[derive(Debug, Clone, Default)]
pub struct Profile {
    corners: Vec<Corner>,
    /// Squared speeds for one entry.
    squares: Vec<f64>,
}

/// The way that a blend takes on each side of its corner.
pub fn reach(turn: f64, square: f64, limits: Limits) -> f64 {
    0.5 * turn * square / limits.acceleration
}

/// How long a blend takes.
pub fn blend_time(turn: f64, square: f64, limits: Limits) -> f64 {
    square.sqrt() * turn / limits.acceleration
}

/// Accelerating, cruising and braking on `way`, from the squared speed `x` to `y`: the peak speed and the cruise's way.
fn peak(way: f64, x: f64, y: f64, limits: Limits) -> (f64, f64) {
    let a = limits.acceleration;
    let square = (0.5 * (x + y) + a * way).min(limits.speed * limits.speed).max(x).max(y);
    (square.sqrt(), (way - (square - 0.5 * (x + y)) / a).max(0.0))
}

/// How long the quickest motion on a straight `way` takes.
pub fn straight_time(way: f64, x: f64, y: f64, limits: Limits) -> f64 {
    let (top, cruise) = peak(way, x, y, limits);
    let coast = if cruise > 0.0 { cruise / top } else { 0.0 };
    (2.0 * top - x.sqrt() - y.sqrt()) / limits.acceleration + coast
}

/// Appends the quickest motion on a straight `way` in the unit direction `ahead`.
pub fn push_straight(ahead: Vector, way: f64, x: f64, y: f64, limits: Limits, out: &mut Trajectory) {
    let (top, cruise) = peak(way, x, y, limits);
    let a = limits.acceleration;
    out.push((top - x.sqrt()) / a, ahead * a);
    if cruise > 0.0 {
        out.push(cruise / top, Vector::zeros());
    }
    out.push((top - y.sqrt()) / a, ahead * -a);
}

/// The blend in a corner `at` between the directions `before` and `after`; `None` where there is nothing to turn.
pub fn blend(at: Point, before: Vector, after: Vector, square: f64, limits: Limits) -> Option<Piece> {
    let change = after - before;
    let turn = change.norm();
    (turn > 0.0 && square > 0.0).then(|| Piece {
        duration: blend_time(turn, square, limits),
        position: at - before * reach(turn, square, limits),
        velocity: before * square.sqrt(),
        acceleration: change * (limits.acceleration / turn),
    })
}

impl Profile {
    /// Takes over a path; points that coincide with the one before are left out.
    pub fn load(&mut self, path: &[Point]) {
        let corner = |at: Point| Corner {
            at,
            ahead: Vector::zeros(),
            length: 0.0,
            turn: 0.0,
            free: f64::INFINITY,
            back: 0.0,
            square: 0.0,
            after: 0.0,
            checked: f64::NAN,
        };
        self.corners.clear();
        for p in path {
            if let Some(last) = self.corners.last_mut() {
                let way = p - last.at;
                let length = way.norm();
                // But a path from a point to itself keeps both.
                if length == 0.0 && path.len() > 2 {
                    continue;
                }
                last.length = length;
                last.ahead = if length > 0.0 { way / length } else { Vector::zeros() };
            }
            self.corners.push(corner(*p));
        }
        for i in 1..self.corners.len().saturating_sub(1) {
            self.corners[i].turn = (self.corners[i].ahead - self.corners[i - 1].ahead).norm();
        }
        self.squares.clear();
        self.squares.resize(self.corners.len(), 0.0);
    }

    pub fn corners(&self) -> &[Corner] {
        &self.corners
    }

    /// Squared speed in corner `i` for the entry last filled in.
    pub fn square(&self, i: usize) -> f64 {
        self.squares[i]
    }

    /// Notes that corner `i` is free at its speed.
    pub fn approve(&mut self, i: usize) {
        self.corners[i].checked = self.squares[i];
    }

    /// Allows corner `i` no more than `share` of its squared speed.
    pub fn slow_down(&mut self, i: usize, share: f64) {
        self.corners[i].free = share * self.squares[i];
    }

    /// Stops in every corner.
    pub fn stop_everywhere(&mut self) {
        self.corners.iter_mut().for_each(|c| c.free = 0.0);
    }

    fn last(&self) -> usize {
        self.corners.len() - 1
    }

    /// The greatest squared speed in corner `i` turning by `turn`, for what comes after it.
    fn most(&self, i: usize, turn: f64, limits: Limits) -> f64 {
        if i == self.last() {
            return 0.0;
        }
        let (here, next) = (&self.corners[i], &self.corners[i + 1]);
        // The last side has one blend only, the others are shared by two.
        let share = if i + 1 == self.last() { 2.0 } else { 1.0 };
        let energy = 2.0 * limits.acceleration * here.length;
        (limits.speed * limits.speed)
            .min(here.free)
            .min(0.5 * share * energy / turn)
            .min((next.back * (1.0 - next.turn) + energy) / (1.0 + turn))
            .max(0.0)
    }

    /// The greatest speeds, from the goal and from the first corner.
    pub fn pass(&mut self, limits: Limits) {
        let last = self.last();
        for i in (1..last).rev() {
            let Corner { turn, .. } = self.corners[i];
            let before = self.corners[i - 1].length * if i == 1 { 2.0 } else { 1.0 };
            self.corners[i].back = self.most(i, turn, limits).min(limits.acceleration * before / turn);
        }
        if last > 0 {
            self.corners[1].square = self.corners[1].back;
        }
        for i in 1..last {
            let (y, time) = self.side(i, self.corners[i].turn, self.corners[i].square, limits);
            self.corners[i + 1].square = y;
            self.corners[i].after = time;
        }
        for i in (1..last).rev() {
            self.corners[i].after += self.corners[i + 1].after;
        }
    }

    /// From corner `i`, which turns by `turn` with the squared speed `x`: the squared speed in the next corner, and the
    /// time from the end of the one blend to the end of the other.
    fn side(&self, i: usize, turn: f64, x: f64, limits: Limits) -> (f64, f64) {
        let (here, next) = (&self.corners[i], &self.corners[i + 1]);
        let reached = (x * (1.0 - turn) + 2.0 * limits.acceleration * here.length) / (1.0 + next.turn);
        let y = next.back.min(reached);
        (y, side_time(here.length, turn, x, next.turn, y, limits))
    }

    /// The turn in corner `i` when one comes from `before`.
    fn turn(&self, i: usize, before: Vector) -> f64 {
        if i == self.last() { 0.0 } else { (self.corners[i].ahead - before).norm() }
    }

    /// The turn and the squared speed in the entry's next corner and the time that it takes to leave that; `None` where
    /// the entry is too fast.
    fn join(&self, entry: &Entry, limits: Limits) -> Option<(f64, f64, f64)> {
        let &Entry { turn, square: x, length, next, .. } = entry;
        let d = self.turn(next, entry.ahead);
        let energy = 2.0 * limits.acceleration * length;
        let spare = energy - x * (1.0 + turn);
        let mut y =
            self.most(next, d, limits).min((energy - turn * x) / d).min((x * (1.0 - turn) + energy) / (1.0 + d));
        if d > 1.0 {
            y = y.min(spare / (d - 1.0));
        }
        // A few roundings of each term.
        let band = 1e-14 * (energy + x);
        if !(y >= -band && y * (1.0 - d) + spare >= -band) {
            return None;
        }
        let y = y.max(0.0);
        Some((d, y, side_time(length, turn, x, d, y, limits)))
    }

    /// How long it takes from the end of the entry's blend to the goal; `None` where it is too fast to stop there.
    pub fn time(&self, entry: &Entry, limits: Limits) -> Option<f64> {
        self.walk(entry, limits, |_, _| {}).map(|(_, time)| time)
    }

    /// Chooses the speeds for `entry`, whose [`Profile::time`] exists.
    pub fn fill(&mut self, entry: &Entry, limits: Limits) {
        let mut squares = std::mem::take(&mut self.squares);
        let (from, _) = self.walk(entry, limits, |i, x| squares[i] = x).unwrap_or((self.last(), 0.0));
        for (square, corner) in squares.iter_mut().zip(&self.corners).skip(from) {
            *square = corner.square;
        }
        self.squares = squares;
    }

    /// Tells `visit` the squared speeds up to a corner from which on all is as on the quickest way from the first
    /// corner; that corner, and the time to the goal.
    fn walk(&self, entry: &Entry, limits: Limits, mut visit: impl FnMut(usize, f64)) -> Option<(usize, f64)> {
        let (mut turn, mut x, mut time) = self.join(entry, limits)?;
        for i in entry.next..self.last() {
            if x == self.corners[i].square && turn == self.corners[i].turn {
                return Some((i, time + self.corners[i].after));
            }
            visit(i, x);
            let (y, side) = self.side(i, turn, x, limits);
            time += side;
            (x, turn) = (y, self.corners[i + 1].turn);
        }
        visit(self.last(), 0.0);
        Some((self.last(), time))
    }
}

/// From the end of the blend with turn `c` and squared speed `x` to the end of that with `d` and `y`, `length` apart.
fn side_time(length: f64, c: f64, x: f64, d: f64, y: f64, limits: Limits) -> f64 {
    let way = length - reach(c, x, limits) - reach(d, y, limits);
    straight_time(way, x, y, limits) + blend_time(d, y, limits)
}
