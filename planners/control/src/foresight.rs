//! Whether a motion is free as far as one can see, and whether the robot could still stop on it.
//!
//! Contact is exact: with what stands still on the whole way, with movers until the horizon, grown by their margins. A
//! robot that is nearer to a mover than its margin keeps what distance it has.
//!
//! A motion *can be stopped* if after its first period, the one that is followed for certain, the robot can brake
//! straight on without touching anything until it stands: nothing that stands still, and no mover. A mover with a
//! trajectory is taken to brake after the period as well, one with a velocity either to go on or to brake now, each
//! with its own deceleration. If all robots of a team move so, planning one after the other, each seeing the new
//! trajectories of those before it and the braking of those after it, then braking is always free and no mate is ever
//! hit, by induction over the frames (passive motion safety; Macek, Vasquez Govea, Fraichard & Siegwart 2009).
//!
//! The induction needs what it is made of: mates that are predicted by their trajectories, follow them exactly and are
//! all seen in every frame; decelerations that are known and do not fall from frame to frame; and a first frame in which
//! all could brake. It says nothing of opponents, nothing of mates that overlap already, until they are apart, and holds
//! where braking is free of what stands still, too: what appears in front of a robot may leave it no answer that avoids
//! both, and then the [guard](crate::Guard) puts off the first contact of all.

use env_model::motion::contact::{enters_world, meets};
use env_model::motion::{Limits, Mover, Path, Piece, Side, State, Trajectory, brake};
use env_model::{Point, World};
use planner_api::Situation;

/// How much of the distance that is left to a mover is kept where it is less than the margin: rounding must not count.
const KEPT: f64 = 1.0 - 1e-6;

/// What is kept off known trajectories when braking, in their movers' radii: a safe stop needs no margin but for rounding.
const DISTANCE: f64 = 1e-3;

/// What one robot needs to know of a moment to judge many motions. Its buffers are reused.
#[derive(Debug, Default)]
pub struct Foresight {
    /// The margin of each mover that can be kept.
    margins: Vec<f64>,
    /// Movers, those that were touched last first: they are most likely to be touched again.
    order: Vec<usize>,
    /// How each mover would brake: after a period where its trajectory is known, else now.
    stops: Vec<Trajectory>,
    stop: Trajectory,
    leg: Trajectory,
}

impl Foresight {
    /// Looks at a new moment.
    pub fn begin(&mut self, situation: &Situation<'_>) {
        let Situation { movers, state, period, .. } = *situation;
        self.margins.clear();
        self.margins.extend(movers.iter().map(|mover| {
            let room = mover.shape.point_clearance(state.position) * KEPT;
            mover.margin.min(room).max(0.0)
        }));
        if self.order.len() != movers.len() {
            self.order.clear();
            self.order.extend(0..movers.len());
        }
        self.stops.resize_with(movers.len().max(self.stops.len()), Trajectory::default);
        for (mover, stop) in movers.iter().zip(&mut self.stops) {
            let mut limits = situation.limits;
            limits.acceleration = mover.braking.unwrap_or(limits.acceleration);
            match mover.path {
                Path::Trajectory(trajectory) => stop_after(trajectory, period, limits, &mut self.leg, stop),
                Path::Velocity(velocity) => brake(State { position: Point::origin(), velocity }, limits, stop),
            }
        }
    }

    /// When `trajectory` first touches something, in seconds; +∞ where it is free. As soon as it is known to be no
    /// later than `bar`, any such time.
    pub fn contact(&mut self, situation: &Situation<'_>, trajectory: &Trajectory, bar: f64) -> f64 {
        let Situation { world, movers, horizon, .. } = *situation;
        let mut first = world_contact(trajectory, world);
        for k in 0..self.order.len() {
            if first <= bar {
                break;
            }
            let i = self.order[k];
            if let Some(t) = meets(trajectory, &movers[i], self.margins[i], horizon.min(first)) {
                first = first.min(t);
                self.order[..=k].rotate_right(1);
            }
        }
        first
    }

    /// Whether the robot could stop after the first period of `trajectory` without touching what stands still or a
    /// mate. Opponents are left out: to stand does not help against one who keeps coming.
    pub fn can_stop(&mut self, situation: &Situation<'_>, trajectory: &Trajectory) -> bool {
        self.stops(situation, trajectory, true, |mover| mover.side == Side::Mate)
    }

    /// The same without touching anybody.
    pub fn can_stop_for_all(&mut self, situation: &Situation<'_>, trajectory: &Trajectory) -> bool {
        self.stops(situation, trajectory, true, |_| true)
    }

    /// Whether neither `trajectory`, nor stopping after its first period, touches a mate, but for those that the robot
    /// overlaps now. What stands still is left out.
    pub fn spares_mates(&mut self, situation: &Situation<'_>, trajectory: &Trajectory) -> bool {
        let Situation { movers, state, horizon, .. } = *situation;
        let apart = |mover: &Mover<'_>| mover.side == Side::Mate && mover.shape.point_clearance(state.position) >= 0.0;
        let mut mates = movers.iter().filter(|mover| apart(mover));
        mates.all(|mate| meets(trajectory, mate, 0.0, horizon).is_none())
            && self.stops(situation, trajectory, false, apart)
    }

    fn stops(
        &mut self,
        situation: &Situation<'_>,
        trajectory: &Trajectory,
        heeds_world: bool,
        heeds: impl Fn(&Mover<'_>) -> bool,
    ) -> bool {
        let Situation { world, movers, limits, period, .. } = *situation;
        let mut stop = std::mem::take(&mut self.stop);
        stop_after(trajectory, period, limits, &mut self.leg, &mut stop);
        let mut movers = movers.iter().enumerate().filter(|(_, mover)| heeds(mover));
        let free = (!heeds_world || world_contact(&stop, world).is_infinite())
            && movers.all(|(i, mover)| self.avoids(i, mover, &stop));
        self.stop = stop;
        free
    }

    fn avoids(&self, i: usize, mover: &Mover<'_>, stop: &Trajectory) -> bool {
        let (margin, theirs) = (self.margins[i], &self.stops[i]);
        let braking = Mover { path: Path::Trajectory(theirs), ..mover.clone() };
        match mover.path {
            // Once the robot stands, it is not the one who hits.
            Path::Velocity(_) => {
                let until = stop.duration();
                meets(stop, mover, margin, until).is_none() && meets(stop, &braking, margin, until).is_none()
            }
            Path::Trajectory(_) => {
                let margin = margin.min(mover.shape.radius * DISTANCE);
                meets(stop, &braking, margin, stop.duration().max(theirs.duration())).is_none()
            }
        }
    }
}

/// `trajectory` for `period`, then the brakes.
fn stop_after(trajectory: &Trajectory, period: f64, limits: Limits, leg: &mut Trajectory, out: &mut Trajectory) {
    out.begin(trajectory.start());
    out.append(trajectory, period);
    out.push(period - out.duration(), env_model::Vector::zeros());
    brake(trajectory.state(period), limits, leg);
    out.append(leg, f64::INFINITY);
}

/// When it first touches what stands still.
fn world_contact(trajectory: &Trajectory, world: &World) -> f64 {
    let mut begin = 0.0;
    for piece in trajectory.pieces() {
        if let Some((t, _)) = enters_world(piece, world) {
            return begin + t;
        }
        begin += piece.duration;
    }
    // A motion without pieces stands where it is.
    let rest = Piece {
        duration: 0.0,
        position: trajectory.end().position,
        velocity: trajectory.end().velocity,
        acceleration: env_model::Vector::zeros(),
    };
    if enters_world(&rest, world).is_some() { begin } else { f64::INFINITY }
}
