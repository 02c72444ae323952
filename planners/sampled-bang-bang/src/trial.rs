//! Trying one way.

use env_model::Point;
use env_model::motion::{State, Trajectory, bang_bang, brake};
use planner_api::{Run, Situation};
use planner_control::Foresight;

use crate::way::{Way, Worth, at_least};

/// The best so far.
#[derive(Debug, Clone, Copy)]
pub struct Best {
    pub way: Way,
    pub worth: Worth,
}

/// One call: what is asked, and the best answer so far, whose motion is in `out`.
pub struct Call<'c, 's, 'r> {
    pub situation: &'c Situation<'s>,
    pub run: &'c mut Run<'r>,
    pub out: &'c mut Trajectory,
    pub best: Option<Best>,
}

impl Call<'_, '_, '_> {
    /// Whether something reaches the goal free.
    pub fn arrives(&self) -> bool {
        matches!(self.best, Some(Best { worth: Worth::Arrives(_), .. }))
    }

    /// Whether `worth` would be the best.
    fn improves(&self, worth: Worth) -> bool {
        self.best.is_none_or(|b| worth < b.worth)
    }

    /// A contact no later than this is of no interest.
    fn bar(&self) -> f64 {
        match self.best.map(|b| b.worth) {
            Some(Worth::Arrives(_) | Worth::Rests(_) | Worth::Dares(_)) => f64::MAX,
            Some(Worth::Touches(t)) => -t,
            Some(Worth::Risks(_)) | None => 0.0,
        }
    }
}

/// The buffers that a trial needs.
#[derive(Debug, Default)]
pub struct Trial {
    pub foresight: Foresight,
    /// The motion towards the intermediate destination.
    leg: Trajectory,
    /// The motion on from it.
    rest: Trajectory,
    candidate: Trajectory,
}

impl Trial {
    /// Straight to the goal with a share of the speed limit.
    pub fn direct(&mut self, share: f64, call: &mut Call<'_, '_, '_>) {
        let Situation { state, goal, mut limits, .. } = *call.situation;
        limits.speed *= share;
        bang_bang(state, goal, limits, &mut self.candidate);
        self.judge(Way::Direct(share), Worth::Arrives(self.candidate.duration()), call);
    }

    /// By way of `via`, switching at `switches`, or no further than that.
    pub fn via(&mut self, via: Point, switches: &[f64], call: &mut Call<'_, '_, '_>) {
        bang_bang(call.situation.state, via, call.situation.limits, &mut self.leg);
        for &switch in switches {
            if switch < self.leg.duration() {
                self.through(via, switch, call);
            }
        }
        self.rest(via, call);
        call.run.spent.iterations += 1;
    }

    /// As hard as possible to a stop.
    pub fn brake(&mut self, call: &mut Call<'_, '_, '_>) {
        brake(call.situation.state, call.situation.limits, &mut self.leg);
        self.rest(self.leg.end().position, call);
    }

    fn through(&mut self, via: Point, switch: f64, call: &mut Call<'_, '_, '_>) {
        let Situation { state, goal, limits, .. } = *call.situation;
        let turn = self.leg.state(switch);
        if !call.improves(Worth::Arrives(switch + at_least(turn, goal, limits))) {
            return;
        }
        bang_bang(turn, goal, limits, &mut self.rest);
        self.candidate.begin(state);
        self.candidate.append(&self.leg, switch);
        self.candidate.append(&self.rest, f64::INFINITY);
        self.judge(Way::Through { via, switch }, Worth::Arrives(self.candidate.duration()), call);
    }

    /// The leg, and no further.
    fn rest(&mut self, at: Point, call: &mut Call<'_, '_, '_>) {
        let Situation { goal, limits, .. } = *call.situation;
        let worth = Worth::Rests(self.leg.duration() + at_least(State::at_rest(at), goal, limits));
        if call.improves(worth) {
            self.candidate.copy_from(&self.leg);
            self.judge(Way::Rest(at), worth, call);
        }
    }

    /// Keeps the candidate where it is the best; it is worth `free` where it touches nothing.
    fn judge(&mut self, way: Way, free: Worth, call: &mut Call<'_, '_, '_>) {
        if !call.improves(free) {
            return;
        }
        call.run.spent.evaluations += 1;
        let time = self.foresight.contact(call.situation, &self.candidate, call.bar());
        let worth = if time.is_infinite() { free } else { Worth::Touches(-time) };
        if !call.improves(worth) {
            return;
        }
        let worth = match worth {
            _ if !self.foresight.can_stop(call.situation, &self.candidate) => Worth::Risks(-time),
            Worth::Arrives(t) | Worth::Rests(t)
                if !self.foresight.can_stop_for_all(call.situation, &self.candidate) =>
            {
                Worth::Dares(t)
            }
            worth => worth,
        };
        if call.improves(worth) {
            call.best = Some(Best { way, worth });
            call.out.copy_from(&self.candidate);
        }
    }
}
