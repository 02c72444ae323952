//! Who touches whom: the verdict on what bodies truly did, frame by frame.
//!
//! Exact: within a frame motions are quadratic in time, and the least clearance of two of them is found from the
//! extremes of a quartic, not by sampling. Bodies that touch go on through each other; a contact counts once, until
//! they have parted.

use env_model::World;
use env_model::motion::{Mover, Path, Side, contact};

use crate::league::ROBOT_RADIUS;
use crate::{Body, Event};

/// Closing speed above which contact is a crash foul, in m/s (rules of 2026).
pub const CRASH_SPEED: f64 = 1.5;
/// Where speeds differ by less, in m/s, both are guilty.
pub const CRASH_MARGIN: f64 = 0.3;
/// Touching is allowed: rounding of positions within a field is far below, in metres.
const SLACK: f64 = 1e-9;

/// The verdict so far.
#[derive(Debug, Clone, Default)]
pub struct Referee {
    own: usize,
    /// Pairs in contact at the end of the last frame.
    touching: Vec<bool>,
    /// Own robots outside the world's free space at the end of the last frame.
    astray: Vec<bool>,
    /// Collisions, in the order of frames.
    pub events: Vec<Event>,
    /// Steps of own robots into what stands still or over the border.
    pub violations: u32,
    /// Least clearance between an own robot and another one, in metres.
    pub least_clearance: f64,
}

impl Referee {
    /// Watches `own` robots among `others`.
    pub fn new(own: usize, others: usize) -> Self {
        let bodies = own + others;
        Self {
            own,
            touching: vec![false; own * bodies],
            astray: vec![false; own],
            events: Vec::new(),
            violations: 0,
            least_clearance: f64::INFINITY,
        }
    }

    /// Judges the frame that began at `time` and lasted `period` seconds; own robots are the first `bodies`. `world_of`
    /// says what stands in an own robot's way.
    pub fn judge<'w>(&mut self, time: f64, period: f64, bodies: &[Body], world_of: impl Fn(usize) -> &'w World) {
        for a in 0..self.own {
            for b in a + 1..bodies.len() {
                self.pair(time, period, bodies, a, b);
            }
            let world = world_of(a);
            let entered =
                bodies[a].motion.timed().take_while(|(begin, _)| *begin < period).any(|(begin, mut piece)| {
                    piece.duration = piece.duration.min(period - begin);
                    contact::enters_world(&piece, world).is_some()
                });
            self.violations += u32::from(entered && !self.astray[a]);
            self.astray[a] = entered && !world.point_free(bodies[a].state.position);
        }
    }

    fn pair(&mut self, time: f64, period: f64, bodies: &[Body], a: usize, b: usize) {
        let other = &bodies[b].motion;
        let mover = Mover::disc(other.start().position, 2.0 * ROBOT_RADIUS, Path::Trajectory(other), Side::Other);
        let motion = &bodies[a].motion;
        let (_, clearance) = contact::least_clearance(motion, &mover, period);
        self.least_clearance = self.least_clearance.min(clearance);
        let before = std::mem::replace(&mut self.touching[a * bodies.len() + b], clearance < -SLACK);
        if clearance >= -SLACK || before {
            return;
        }
        let at = contact::meets(motion, &mover, 0.0, period).unwrap_or(0.0);
        let [p, q] = [motion.state(at), other.state(at)];
        let line = (q.position - p.position).normalize();
        let closing = (p.velocity - q.velocity).dot(&line);
        let guilty = b >= self.own && p.velocity.norm() > q.velocity.norm() - CRASH_MARGIN;
        self.events.push(Event {
            time_s: time + at,
            bodies: [a, b],
            at: middle(p.position, q.position),
            closing,
            foul: closing > CRASH_SPEED && guilty,
        });
    }
}

fn middle(p: env_model::Point, q: env_model::Point) -> [f64; 2] {
    (p + (q - p) * 0.5).into()
}
