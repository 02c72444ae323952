//! Whether a robot that goes on can still stop in time.
//!
//! *Passive safety* (Macek, Vasquez Govea, Fraichard & Siegwart 2009): no collision while the robot moves. After an
//! answer has been followed for one period the robot must be able to brake to a stop, straight on, without touching
//! anything; else it brakes now. Where every robot of a team sees the others' ways to stop as their motion, and began where all could
//! stop, by induction all can stop in every frame: each one's way to stop was checked against those of the others.

use env_model::motion::contact::meets;
use env_model::motion::{Contact, Limits, Side, Touched, Trajectory, brake, first_contact};
use planner_api::Situation;

use crate::{Answer, Safety};

/// The motion of a robot that follows `trajectory` for `period` seconds and then brakes to a stop, into `out`.
pub fn stop_after(trajectory: &Trajectory, period: f64, limits: Limits, out: &mut Trajectory) {
    out.begin(trajectory.start());
    for (begin, piece) in trajectory.timed().take_while(|(begin, _)| *begin < period) {
        out.push(piece.duration.min(period - begin), piece.acceleration);
    }
    let end = out.end();
    let mut stop = Trajectory::default();
    brake(end, limits, &mut stop);
    stop.pieces().iter().for_each(|piece| out.push(piece.duration, piece.acceleration));
    out.end_at(stop.end());
}

/// The first collision of a robot that comes to a stop along `stop`: until it stands, and with mates, who stop too,
/// for ever.
fn collision(stop: &Trajectory, situation: &Situation<'_>) -> Option<Contact> {
    let until = |mate: bool| match mate {
        true => situation.horizon.max(stop.duration()),
        false => stop.duration(),
    };
    let first = first_contact(stop, situation.world, situation.movers, until(true))?;
    let mate = |contact: &Contact| match contact.with {
        Touched::Mover(i) => situation.movers[i].side == Side::Mate,
        _ => true,
    };
    if first.time <= until(false) || mate(&first) {
        return Some(first);
    }
    // Somebody runs into a robot that stands; a mate may be touched later still.
    situation.movers.iter().enumerate().filter(|(_, m)| m.side == Side::Mate).find_map(|(i, mover)| {
        let time = meets(stop, mover, 0.0, until(true))?;
        Some(Contact { time, with: Touched::Mover(i) })
    })
}

/// Has the robot brake where it could no longer stop in time after following `answer` for one period, and braking at once meets
/// a collision later or not at all. The movers are those that a stop has to avoid. Returns whether it did.
pub fn stop_in_time(situation: &Situation<'_>, answer: &mut Answer) -> bool {
    if matches!(answer.safety, Safety::Brake | Safety::Escape) {
        return false;
    }
    let mut stop = Trajectory::default();
    stop_after(&answer.trajectory, situation.period, situation.limits, &mut stop);
    let Some(later) = collision(&stop, situation) else { return false };
    brake(situation.state, situation.limits, &mut stop);
    let now = collision(&stop, situation);
    let better = now.is_none_or(|now| now.time > later.time);
    if better {
        (answer.trajectory, answer.contact, answer.safety) = (stop, now, Safety::Brake);
    }
    better
}
