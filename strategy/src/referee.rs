//! Who touches whom: the verdict on what bodies truly did, frame by frame.
//!
//! Exact: within a frame motions are quadratic in time, and the least clearance of two of them is found from the
//! extremes of a quartic, not by sampling. Bodies that touch go on through each other; a contact counts once, until
//! they have parted.

use env_model::World;
use env_model::motion::{Mover, Path, Side, contact};

use crate::league::ROBOT_RADIUS;
use crate::rules::Rules;
use crate::rules::crash::{Guilt, closing_speed, crash};
use crate::{Body, Event, Task};

/// Touching is allowed: rounding of positions within a field is far below, in metres.
const SLACK: f64 = 1e-9;

/// The verdict so far.
#[derive(Debug, Clone, Default)]
pub struct Referee {
    own: usize,
    /// Pairs in contact at the end of the last frame.
    touching: Vec<bool>,
    /// Collisions, in the order of frames.
    pub events: Vec<Event>,
    /// How often own robots went where they must not be, or became too fast.
    pub violations: u32,
    /// Seconds that own robots spent so, all together.
    pub violation_s: f64,
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
            events: Vec::new(),
            violations: 0,
            violation_s: 0.0,
            least_clearance: f64::INFINITY,
        }
    }

    /// Judges the frame that began at `time` and lasted `period` seconds; own robots are the first `bodies`,
    /// with these tasks under these rules.
    pub fn judge(&mut self, time: f64, period: f64, bodies: &[Body], tasks: &[Task], rules: &Rules) {
        for a in 0..self.own {
            for b in a + 1..bodies.len() {
                self.pair(time, period, bodies, a, b);
            }
            let (body, role) = (&bodies[a], tasks[a].role);
            let after = rules.allows(role, body.state);
            // Who was in a zone before, perhaps since the zone came, has not entered it now.
            let before = rules.allows(role, body.motion.start());
            let broken = !after || enters(body, &rules.worlds()[tasks[a].world], period);
            self.violations += u32::from(before && broken);
            self.violation_s += if after { 0.0 } else { period };
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
        self.events.push(Event {
            time_s: time + at,
            bodies: [a, b],
            at: middle(p.position, q.position),
            closing: closing_speed(p, q),
            foul: b >= self.own && matches!(crash(p, q), Some(Guilt::First | Guilt::Both)),
        });
    }
}

/// Whether a body went into what stands in its world during the last frame.
fn enters(body: &Body, world: &World, period: f64) -> bool {
    body.motion.timed().take_while(|(begin, _)| *begin < period).any(|(begin, mut piece)| {
        piece.duration = piece.duration.min(period - begin);
        contact::enters_world(&piece, world).is_some()
    })
}

fn middle(p: env_model::Point, q: env_model::Point) -> [f64; 2] {
    (p + (q - p) * 0.5).into()
}
