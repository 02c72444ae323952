//! From stops with times to a motion that a robot can follow.

use env_model::motion::{Limits, State, Trajectory, bang_bang};
use planner_api::Situation;
use planner_control::Foresight;

use crate::search::Stop;

/// How many of the stops ahead are tried for one leg, spread over all.
const TRIES: usize = 8;

/// Legs from stop to stop. Its buffers are reused.
#[derive(Debug, Default)]
pub struct Retime {
    leg: Trajectory,
    candidate: Trajectory,
}

impl Retime {
    /// The motion along `way`, into `out`, as long as it is free; whether it reaches the last stop.
    ///
    /// From where it is the robot goes at once to the farthest stop that it can reach free (string pulling in time):
    /// as fast as it can, or so slowly that it keeps the stop's time, or, standing, after a wait that does. There it
    /// stops, which all but the last robot of a queue never comes to do, since it plans anew before.
    pub fn run(
        &mut self,
        situation: &Situation<'_>,
        foresight: &mut Foresight,
        way: &[Stop],
        out: &mut Trajectory,
    ) -> bool {
        out.begin(situation.state);
        let mut at = 0;
        while at + 1 < way.len() {
            let ahead = way.len() - 1 - at;
            let tries = ahead.min(TRIES);
            // The farthest first, the next one last.
            let stops = (0..tries).map(|k| way.len() - 1 - k * (ahead - 1) / (tries - 1).max(1));
            let Some(reached) = stops.into_iter().find(|to| self.leg(situation, foresight, way, *to, out)) else {
                return false;
            };
            out.copy_from(&self.candidate);
            at = reached;
        }
        !way.is_empty()
    }

    /// Whether a leg from the end of `out` to the stop `to` is free; then `out` with it is in `candidate`.
    fn leg(
        &mut self,
        situation: &Situation<'_>,
        foresight: &mut Foresight,
        way: &[Stop],
        to: usize,
        out: &Trajectory,
    ) -> bool {
        let limits = situation.limits;
        let Stop { point, arrive, depart } = way[to];
        let (from, now) = (out.end(), out.duration());
        bang_bang(from, point, limits, &mut self.leg);
        let early = arrive - now - self.leg.duration();
        let mut free = |this: &mut Self, wait: f64| {
            this.candidate.copy_from(out);
            this.candidate.push(wait, env_model::Vector::zeros());
            this.candidate.append(&this.leg, f64::INFINITY);
            let until = if to + 1 == way.len() { f64::INFINITY } else { this.candidate.duration().max(depart) };
            // Whatever comes sooner than `until` spoils the leg.
            foresight.contact(situation, &this.candidate, until.min(f64::MAX)) >= until
        };
        if free(self, 0.0) {
            return true;
        }
        if early <= 0.0 {
            return false;
        }
        if from.velocity.norm() == 0.0 && free(self, early) {
            return true;
        }
        bang_bang(from, point, slowed(from, point, limits, arrive - now), &mut self.leg);
        free(self, 0.0)
    }
}

/// Limits with a speed at which the way from rest takes `time`: d = v(T − v/a).
fn slowed(from: State, to: env_model::Point, mut limits: Limits, time: f64) -> Limits {
    let (d, a) = ((to - from.position).norm(), limits.acceleration);
    let root = (a * time * a * time - 4.0 * a * d).max(0.0).sqrt();
    // v = (aT − √(a²T² − 4ad))/2 without cancellation.
    let speed = 2.0 * d / (time + root / a);
    if speed > 0.0 {
        limits.speed = limits.speed.min(speed);
    }
    limits
}
