//! When a moving robot first enters something, and how near it comes.
//!
//! Relative to an obstacle that moves with constant acceleration, the robot's centre q(t) is quadratic in time. It
//! enters a disc where ‖q(t)‖² − r², a quartic (a quadratic where nobody accelerates), falls below zero. Any other
//! shape's border is made of circles round its corners and lines beside its sides: the times at which q crosses one of
//! these cut the motion into stretches that lie inside or outside as a whole, which one point of each tells.

use super::polynomial::Polynomial;
use super::{Mover, Path, Piece, State, Trajectory};
use crate::geometry::point_segment_distance_squared;
use crate::{Aabb, Core, Inflated, Point, Vector, World};

/// What a robot touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Touched {
    /// A moving obstacle, by its index.
    Mover(usize),
    /// An obstacle of the world, by its index.
    Obstacle(usize),
    /// The border of the field.
    Border,
}

/// The first moment of a collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Seconds from now.
    pub time: f64,
    /// With what.
    pub with: Touched,
}

/// When the point that moves as `piece` first comes nearer to the core of `shape` than its radius less `slack`, in
/// seconds from the piece's beginning; `None` within its duration, which must be finite.
pub fn enters(piece: &Piece, shape: &Inflated, slack: f64) -> Option<f64> {
    let reach = shape.radius - slack;
    match &shape.core {
        Core::Point(c) if reach > 0.0 => squared_distance(piece, *c, reach).first_below(piece.duration),
        Core::Point(_) => None,
        core => enters_sides(piece, shape, core, slack),
    }
}

/// [`enters`] for shapes with sides.
fn enters_sides(piece: &Piece, shape: &Inflated, core: &Core, slack: f64) -> Option<f64> {
    let reach = shape.radius - slack;
    let region = piece.aabb().inflated(reach.abs() * (1.0 + 1e-9));
    let inside = |t: f64| shape.point_clearance(piece.state(t).position) < -slack;
    if inside(0.0) {
        return Some(0.0);
    }
    let mut from = 0.0;
    loop {
        let mut times = Earliest::after(from);
        times.insert(piece.duration);
        for_each_side(core, |a, b| {
            // Farther sides make no border that the motion could cross.
            if !region.overlaps(&Aabb::of_segment(a, b)) {
                return;
            }
            squared_distance(piece, a, reach).roots(0.0, piece.duration).iter().for_each(|t| times.insert(*t));
            let n = normal(a, b);
            for side in [reach, -reach] {
                height(piece, a, n, side).roots(0.0, piece.duration).iter().for_each(|t| times.insert(*t));
            }
        });
        for t in times.iter() {
            if inside(0.5 * (from + t)) {
                return Some(from);
            }
            from = t;
        }
        if from >= piece.duration || times.is_empty() {
            return None;
        }
    }
}

/// Times kept by [`Earliest`]; more than a motion's crossings of a shape's circles and lines mostly are.
const TIMES: usize = 24;

/// The earliest times after a given one, ascending, each once.
struct Earliest {
    after: f64,
    times: [f64; TIMES],
    len: usize,
}

impl Earliest {
    fn after(after: f64) -> Self {
        Self { after, times: [0.0; TIMES], len: 0 }
    }

    fn insert(&mut self, t: f64) {
        let at = self.times[..self.len].partition_point(|earlier| *earlier < t);
        let known = at < self.len && self.times[at] == t;
        if t > self.after && at < TIMES && !known {
            self.len = (self.len + 1).min(TIMES);
            self.times.copy_within(at..self.len - 1, at + 1);
            self.times[at] = t;
        }
    }

    fn is_empty(&self) -> bool {
        self.len == 0
    }

    fn iter(&self) -> impl Iterator<Item = f64> + '_ {
        self.times[..self.len].iter().copied()
    }
}

/// The least clearance of the point that moves as `piece` to `shape`, and when; the duration must be finite.
pub fn nearest(piece: &Piece, shape: &Inflated) -> (f64, f64) {
    if let Core::Point(c) = shape.core {
        let (t, _) = squared_distance(piece, c, 0.0).least(piece.duration);
        return (t, shape.point_clearance(piece.state(t).position));
    }
    let mut least = (0.0, shape.point_clearance(piece.position));
    let mut consider = |t: f64| {
        let d = shape.point_clearance(piece.state(t).position);
        if d < least.1 {
            least = (t, d);
        }
    };
    consider(piece.duration);
    for_each_side(&shape.core, |a, b| {
        squared_distance(piece, a, 0.0).derivative().roots(0.0, piece.duration).iter().for_each(|t| consider(*t));
        let n = normal(a, b);
        // Nearest to a side within its length, on it, or where it passes from a side to a corner.
        let along = |p: Point| height(piece, p, b - a, 0.0);
        for curve in [height(piece, a, n, 0.0).derivative(), height(piece, a, n, 0.0), along(a), along(b)] {
            curve.roots(0.0, piece.duration).iter().for_each(|t| consider(*t));
        }
    });
    least
}

/// ‖q(t) − c‖² − r².
fn squared_distance(piece: &Piece, c: Point, r: f64) -> Polynomial {
    let (p, v, h) = (piece.position - c, piece.velocity, piece.acceleration * 0.5);
    // ‖p‖² − r² without cancellation; what touches but for the rounding of its coordinates, touches.
    let gap = p.norm() - r;
    let rounding = 4.0 * f64::EPSILON * (piece.position.coords.amax() + c.coords.amax() + r);
    let gap = if gap.abs() <= rounding { 0.0 } else { gap };
    let c0 = gap * (gap + 2.0 * r);
    Polynomial([c0, 2.0 * p.dot(&v), v.norm_squared() + 2.0 * p.dot(&h), 2.0 * v.dot(&h), h.norm_squared()])
}

/// n·(q(t) − a) − offset.
fn height(piece: &Piece, a: Point, n: Vector, offset: f64) -> Polynomial {
    let (p, v, h) = (piece.position - a, piece.velocity, piece.acceleration * 0.5);
    Polynomial([n.dot(&p) - offset, n.dot(&v), n.dot(&h), 0.0, 0.0])
}

/// The unit normal of the line through `a` and `b`; zero where they coincide.
fn normal(a: Point, b: Point) -> Vector {
    let d = b - a;
    let length = d.norm();
    if length > 0.0 { Vector::new(-d.y, d.x) / length } else { Vector::zeros() }
}

/// Calls `visit` with the ends of every side, so that every corner is the first end of one.
fn for_each_side(core: &Core, mut visit: impl FnMut(Point, Point)) {
    match core {
        Core::Point(c) => visit(*c, *c),
        Core::Segment(a, b) => {
            visit(*a, *b);
            visit(*b, *a);
        }
        Core::Polygon(polygon) => {
            let corners = polygon.corners();
            for (i, a) in corners.iter().enumerate() {
                visit(*a, corners[(i + 1) % corners.len()]);
            }
        }
    }
}

/// Pieces one after the other, the last one endless.
struct Chain<'p> {
    pieces: &'p [Piece],
    rest: Piece,
    /// When the first of `pieces` begins.
    begin: f64,
}

impl<'p> Chain<'p> {
    fn of(trajectory: &'p Trajectory) -> Self {
        let State { position, velocity } = trajectory.end();
        let rest = Piece { duration: f64::INFINITY, position, velocity, acceleration: Vector::zeros() };
        Self { pieces: trajectory.pieces(), rest, begin: 0.0 }
    }

    fn endless(velocity: Vector) -> Self {
        let position = Point::origin();
        let rest = Piece { duration: f64::INFINITY, position, velocity, acceleration: Vector::zeros() };
        Self { pieces: &[], rest, begin: 0.0 }
    }

    fn now(&self) -> &Piece {
        self.pieces.first().unwrap_or(&self.rest)
    }

    fn end(&self) -> f64 {
        self.begin + self.now().duration
    }

    /// Goes on to the next piece if this one is over at `time`.
    fn pass(&mut self, time: f64) {
        let end = self.end();
        if end <= time && !self.pieces.is_empty() {
            self.begin = end;
            self.pieces = &self.pieces[1..];
        }
    }
}

/// The stretches of time until `until` in which neither of two chains of pieces changes: their beginnings, and the
/// motion of the first relative to the displacement of the second. One at least.
fn relative<'p>(
    trajectory: &'p Trajectory,
    mover: &'p Mover<'_>,
    until: f64,
) -> impl Iterator<Item = (f64, Piece)> + 'p {
    let mut ours = Chain::of(trajectory);
    let (mut theirs, from) = match mover.path {
        Path::Velocity(velocity) => (Chain::endless(velocity), Vector::zeros()),
        Path::Trajectory(other) => (Chain::of(other), other.start().position.coords),
    };
    let mut begin = 0.0;
    let mut over = false;
    std::iter::from_fn(move || {
        if over {
            return None;
        }
        let end = ours.end().min(theirs.end()).min(until);
        over = end >= until;
        let (a, b) = (ours.now(), theirs.now());
        let (p, q) = (a.state(begin - ours.begin), b.state(begin - theirs.begin));
        let piece = Piece {
            duration: (end - begin).max(0.0),
            position: p.position - (q.position.coords - from),
            velocity: p.velocity - q.velocity,
            acceleration: a.acceleration - b.acceleration,
        };
        let now = begin;
        begin = end;
        ours.pass(end);
        theirs.pass(end);
        Some((now, piece))
    })
}

/// When the robot that follows `trajectory` first enters `mover`, grown by `margin`, in seconds, at the latest at
/// `until`, which must be finite.
pub fn meets(trajectory: &Trajectory, mover: &Mover<'_>, margin: f64, until: f64) -> Option<f64> {
    relative(trajectory, mover, until).find_map(|(begin, piece)| {
        if far(&piece, &mover.shape, margin) {
            return None;
        }
        enters(&piece, &mover.shape, -margin).map(|t| begin + t)
    })
}

/// Whether nothing on the way of `piece` can be nearer to a disc than `margin`: the way is at most ‖a‖t²/8 from its
/// chord. Spares most pairs their quartics.
fn far(piece: &Piece, shape: &Inflated, margin: f64) -> bool {
    let Core::Point(c) = shape.core else { return false };
    let t = piece.duration;
    let bulge = 0.125 * t * t * (piece.acceleration.x.abs() + piece.acceleration.y.abs());
    // Grown by far more than it could be rounded.
    let reach = (shape.radius + margin + bulge) * (1.0 + 1e-9);
    let end = piece.position + (piece.velocity + piece.acceleration * (0.5 * t)) * t;
    point_segment_distance_squared(c, piece.position, end) > reach * reach
}

/// The least clearance between the robot that follows `trajectory` and `mover` until the time `until`, and when.
pub fn least_clearance(trajectory: &Trajectory, mover: &Mover<'_>, until: f64) -> (f64, f64) {
    let mut least = (0.0, f64::INFINITY);
    for (begin, piece) in relative(trajectory, mover, until) {
        let (t, d) = nearest(&piece, &mover.shape);
        if d < least.1 {
            least = (begin + t, d);
        }
    }
    least
}

/// When the point that moves as `piece` first enters an obstacle of `world` or leaves its field by more than the slack
/// that planners may use (ε/2); the duration must be finite.
pub fn enters_world(piece: &Piece, world: &World) -> Option<(f64, Touched)> {
    let slack = world.slack();
    let mut first: Option<(f64, Touched)> = None;
    let mut consider = |t: Option<f64>, with: Touched| {
        if let Some(t) = t
            && first.is_none_or(|(least, _)| t < least)
        {
            first = Some((t, with));
        }
    };
    let region = piece.aabb();
    if let Some(field) = world.inner_field() {
        for axis in 0..2 {
            let n = Vector::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 });
            if region.min[axis] < field.min[axis] - slack {
                consider(height(piece, field.min, n, -slack).first_below(piece.duration), Touched::Border);
            }
            if region.max[axis] > field.max[axis] + slack {
                consider(height(piece, field.max, -n, -slack).first_below(piece.duration), Touched::Border);
            }
        }
    }
    world.for_each_overlapping(&region, |i| {
        consider(enters(piece, &world.obstacles()[i], slack), Touched::Obstacle(i));
    });
    first
}

/// The first collision of a robot that follows `trajectory`, until the time `until` (the prediction's horizon, finite).
pub fn first_contact(trajectory: &Trajectory, world: &World, movers: &[Mover<'_>], until: f64) -> Option<Contact> {
    let mut first = None;
    for (begin, piece) in trajectory.timed() {
        if begin > until {
            break;
        }
        let piece = Piece { duration: piece.duration.min(until - begin), ..piece };
        if let Some((t, with)) = enters_world(&piece, world) {
            first = Some(Contact { time: begin + t, with });
            break;
        }
    }
    for (i, mover) in movers.iter().enumerate() {
        let until = first.map_or(until, |c: Contact| c.time);
        if let Some(time) = meets(trajectory, mover, 0.0, until)
            && first.is_none_or(|c| time < c.time)
        {
            first = Some(Contact { time, with: Touched::Mover(i) });
        }
    }
    first
}
