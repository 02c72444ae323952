//! Timing a path: from the polyline of any planner to a trajectory.
//!
//! Linear segments with parabolic blends (Kunz and Stilman, *Turning paths into trajectories using parabolic blends*,
//! 2011, who slow down where blends overlap, as here). A blend must be free of the world; where it is not, it is passed
//! more slowly, which keeps it nearer to its corner, at last with a stop. A robot that moves already runs out on the line
//! of its velocity to a first corner of its own, from where it joins the path.

mod profile;
mod run_out;

use profile::{Entry, Profile, blend, blend_time, push_straight, reach, straight_time};
use run_out::run_out;

use super::contact::enters_world;
use super::{Limits, Piece, State, Trajectory};
use crate::geometry::cross;
use crate::{Point, Vector, World};

/// Shares of its squared speed to which a robot may brake before its first turn: 1, ¾, ½, ¼ and 0 of its speed.
const SHARES: [f64; 5] = [1.0, 0.5625, 0.25, 0.0625, 0.0];
/// Where a moving robot may join the path: where it starts, in the next corner, in the first ones at these braking distances, and, seen
/// from where it could stand, in that where a straight line touches a turning path.
const AHEAD: [f64; 4] = [0.25, 0.5, 1.0, 2.0];
/// Corners to join in.
const JOINTS: usize = 3 + AHEAD.len();
/// Combinations with shares.
const WAYS_IN: usize = SHARES.len() * JOINTS;
/// Rounds of slowing down in corners that are not free, to a quarter of the squared speed each, before the last ones.
const SLOWER: usize = 5;
/// Rounds of stopping in such corners. Then all are stopped in.
const STOPS: usize = 3;

/// The motion along `path` that starts with `state` at its first point and ends at rest at its last one: see
/// [`Follower::follow`], which keeps its buffers.
pub fn follow(path: &[Point], state: State, limits: Limits, world: &World, out: &mut Trajectory) {
    Follower::default().follow(path, state, limits, world, out);
}

/// Times paths. Its buffers are reused.
#[derive(Debug, Clone, Default)]
pub struct Follower {
    profile: Profile,
}

/// A way in, with the way to its corner.
#[derive(Debug, Clone, Copy)]
struct WayIn {
    /// Seconds from now to the goal.
    time: f64,
    /// Straight ahead, before the blend of the entry.
    way: f64,
    entry: Entry,
}

impl Follower {
    /// The motion along `path` that starts with `state` at its first point and ends at rest at its last one, into `out`.
    ///
    /// From rest it stays on the path but for its corners, which it cuts where that is free of the `world`. From a
    /// moving start it joins the path where that is quickest among a few tries that are free; if none is, it brakes,
    /// comes back and starts from rest. A start above the speed limit first brakes down to it, straight on. If the
    /// path is free, so is the motion, unless the robot cannot but leave free space before it stands. An empty path
    /// is one that ends at its start: there the robot brakes and comes back.
    pub fn follow(&mut self, path: &[Point], state: State, limits: Limits, world: &World, out: &mut Trajectory) {
        out.begin(state);
        super::slow_down(out, limits.speed, limits);
        let start = out.end();
        let goal = path.last().copied().unwrap_or(state.position);
        let speed = start.velocity.norm();
        self.profile.load(path);
        if speed > 0.0 {
            if self.profile.corners().len() < 2 {
                self.profile.load(&[goal, goal]);
            }
            if !self.join(start, speed, limits, world, out) {
                super::stop(out, limits);
                let (turned, back) = (out.end().position, path.first().copied().unwrap_or(goal));
                self.profile.load(&[turned, back]);
                self.go(limits, world, out);
                self.profile.load(path);
                self.go(limits, world, out);
            }
        } else {
            self.go(limits, world, out);
        }
        out.end_at(State::at_rest(goal));
    }

    /// From rest at the first corner.
    fn go(&mut self, limits: Limits, world: &World, out: &mut Trajectory) {
        let [first, _, ..] = *self.profile.corners() else { return };
        let entry = Entry { from: first.at, ahead: first.ahead, length: first.length, turn: 0.0, square: 0.0, next: 1 };
        for round in 0.. {
            self.profile.pass(limits);
            self.profile.fill(&entry, limits);
            if self.all_free(&entry, round, limits, world) {
                break;
            }
        }
        self.push_path(&entry, limits, out);
    }

    /// From a moving start; false where no way in is free.
    fn join(&mut self, start: State, speed: f64, limits: Limits, world: &World, out: &mut Trajectory) -> bool {
        let along = start.velocity / speed;
        for round in 0.. {
            self.profile.pass(limits);
            let Some(WayIn { way, entry, .. }) = self.way_in(start.position, along, speed, limits, world) else {
                return false;
            };
            self.profile.fill(&entry, limits);
            if self.all_free(&entry, round, limits, world) {
                push_straight(along, way, speed * speed, entry.square, limits, out);
                push_blend(entry.from, along, entry.ahead, entry.square, limits, out);
                self.push_path(&entry, limits, out);
                return true;
            }
        }
        false
    }

    /// The quickest free way in.
    fn way_in(&self, from: Point, along: Vector, speed: f64, limits: Limits, world: &World) -> Option<WayIn> {
        let square = speed * speed;
        let braking = limits.braking_distance(speed);
        let time = |w: &Option<WayIn>| w.map_or(f64::INFINITY, |w| w.time);
        let mut ways = [None; WAYS_IN];
        let mut count = 0;
        let joints = self.joints(from + along * braking, braking);
        for (k, &next) in joints.iter().enumerate() {
            if joints[..k].contains(&next) {
                continue;
            }
            for share in SHARES {
                ways[count] = self.try_way_in(from, along, (square, share), next, limits);
                count += usize::from(ways[count].is_some());
            }
        }
        let ways = &mut ways[..count];
        ways.sort_unstable_by(|a, b| time(a).total_cmp(&time(b)));
        ways.iter().flatten().copied().find(|w| {
            let Entry { from: corner, ahead, square, turn, next, .. } = w.entry;
            let reach = reach(turn, square, limits);
            world.segment_free(from, corner - along * reach)
                && world.segment_free(corner + ahead * reach, self.profile.corners()[next].at)
                && is_free(blend(corner, along, ahead, square, limits), world)
        })
    }

    /// The corners where the path may be joined; `stand` is where the robot would stand after braking.
    fn joints(&self, stand: Point, braking: f64) -> [usize; JOINTS] {
        let corners = self.profile.corners();
        let mut joints = [1; JOINTS];
        joints[0] = 0;
        let (mut i, mut way) = (1, corners[0].length);
        for (joint, share) in joints.iter_mut().skip(2).zip(AHEAD) {
            while i + 1 < corners.len() && way < share * braking {
                way += corners[i].length;
                i += 1;
            }
            *joint = i;
        }
        let touches = |i: &usize| {
            let (before, here) = (&corners[i - 1], &corners[*i]);
            let line = here.at - stand;
            // Both sides on one side of the line, and the path goes on along it.
            cross(line, before.ahead) * cross(line, here.ahead) <= 0.0 && line.dot(&here.ahead) > 0.0
        };
        joints[JOINTS - 1] = (1..corners.len() - 1).find(touches).unwrap_or(1);
        joints
    }

    fn try_way_in(
        &self,
        from: Point,
        along: Vector,
        (square, share): (f64, f64),
        next: usize,
        limits: Limits,
    ) -> Option<WayIn> {
        let braking = 0.5 * square / limits.acceleration;
        let corner = run_out(self.profile.corners()[next].at - from, along, braking, share)?;
        let entry = Entry {
            from: from + along * corner.way,
            ahead: corner.ahead,
            length: corner.length,
            turn: corner.turn,
            square: share * square,
            next,
        };
        let way = (corner.way - reach(entry.turn, entry.square, limits)).max(0.0);
        let before = straight_time(way, square, entry.square, limits) + blend_time(entry.turn, entry.square, limits);
        let time = before + self.profile.time(&entry, limits)?;
        time.is_finite().then_some(WayIn { time, way, entry })
    }

    /// Whether all blends on the path are free at their speeds; where not, they are to be slower in the next round.
    fn all_free(&mut self, entry: &Entry, round: usize, limits: Limits, world: &World) -> bool {
        let mut all = true;
        for i in entry.next..self.profile.corners().len() - 1 {
            let joins = i == entry.next;
            let (corner, square) = (&self.profile.corners()[i], self.profile.square(i));
            if square == corner.checked && !joins {
                continue;
            }
            let before = if joins { entry.ahead } else { self.profile.corners()[i - 1].ahead };
            if is_free(blend(corner.at, before, corner.ahead, square, limits), world) {
                if !joins {
                    self.profile.approve(i);
                }
            } else {
                self.profile.slow_down(i, if round < SLOWER { 0.25 } else { 0.0 });
                all = false;
            }
        }
        if !all && round >= SLOWER + STOPS {
            self.profile.stop_everywhere();
        }
        all
    }

    /// From the end of the entry's blend to the goal.
    fn push_path(&self, entry: &Entry, limits: Limits, out: &mut Trajectory) {
        let (mut at, mut ahead, mut turn, mut x) = (entry.from, entry.ahead, entry.turn, entry.square);
        let mut length = entry.length;
        for (i, corner) in self.profile.corners().iter().enumerate().skip(entry.next) {
            let y = self.profile.square(i);
            let last = corner.length == 0.0;
            let d = if last { 0.0 } else { (corner.ahead - ahead).norm() };
            let leave = reach(turn, x, limits);
            anchor(out, State { position: at + ahead * leave, velocity: ahead * x.sqrt() });
            push_straight(ahead, length - leave - reach(d, y, limits), x, y, limits, out);
            if !last {
                push_blend(corner.at, ahead, corner.ahead, y, limits, out);
            }
            (at, ahead, turn, x, length) = (corner.at, corner.ahead, d, y, corner.length);
        }
    }
}

/// Where the next piece begins, exactly, so that rounding does not add up; the motion's own start stays as it was given.
fn anchor(out: &mut Trajectory, state: State) {
    if !out.pieces().is_empty() {
        out.end_at(state);
    }
}

/// Appends the blend, from exactly where it begins.
fn push_blend(at: Point, before: Vector, after: Vector, square: f64, limits: Limits, out: &mut Trajectory) {
    if let Some(Piece { duration, position, velocity, acceleration }) = blend(at, before, after, square, limits) {
        anchor(out, State { position, velocity });
        out.push(duration, acceleration);
    }
}

fn is_free(blend: Option<Piece>, world: &World) -> bool {
    blend.is_none_or(|piece| enters_world(&piece, world).is_none())
}
