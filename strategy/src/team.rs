//! A whole team: tasks by robot in, motions out, one robot after the other by priority.

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, brake, first_contact};
use env_model::{Point, World};
use planner_api::{Budget, ControlError, Counters, Run, SettingError, Situation, seed::splitmix64};
use planner_control::{Answer, Guard, Safety};

use crate::Cooperation;
use crate::league::ROBOT_RADIUS;
use crate::roles::Role;

/// What the team believes of the world in a frame. Own and opposing robots in a fixed order; one that is not seen has
/// numbers that are not finite.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    /// Seconds since the beginning.
    pub time: f64,
    /// Own robots, when the answers take effect.
    pub own: &'a [State],
    /// Opponents, at the same time.
    pub opponents: &'a [State],
    /// The ball, if it is seen.
    pub ball: Option<State>,
}

/// What one robot is to do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Task {
    /// What it is: plays say so, rules heed it.
    pub role: Role,
    /// Where it is to stand.
    pub goal: Point,
    /// What it may do now: its own limits, or those of the rules.
    pub limits: Limits,
    /// Which of the worlds handed to [`Team::plan`] it moves in: what the rules keep it out of.
    pub world: usize,
    /// Whether it is to brake and stand, wherever it is.
    pub halt: bool,
}

impl Task {
    /// Anybody's, in the first world.
    pub fn new(goal: Point, limits: Limits) -> Self {
        Self { role: Role::Field, goal, limits, world: 0, halt: false }
    }
}

/// How a team plans.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TeamSettings {
    /// Seconds between two frames, > 0.
    pub period: f64,
    /// Prediction's horizon in seconds, > 0.
    pub horizon: f64,
    /// Distance beyond contact to keep, in metres, ≥ 0.
    pub margin: f64,
    /// How mates are predicted.
    pub cooperation: Cooperation,
    /// By how much a new way must be quicker than the one under way, 0 to 1.
    pub hysteresis: f64,
    /// Whether robots brake while they still can stop in time.
    pub emergency_brake: bool,
}

impl TeamSettings {
    fn validate(&self) -> Result<(), SettingError> {
        let Self { period, horizon, margin, hysteresis, .. } = *self;
        let positive = |x: f64| x.is_finite() && x > 0.0;
        SettingError::check(positive(period), "period", period, "a finite number above 0 s")?;
        SettingError::check(positive(horizon), "horizon", horizon, "a finite number above 0 s")?;
        SettingError::check(margin.is_finite() && margin >= 0.0, "margin", margin, "a finite number, at least 0 m")?;
        SettingError::check((0.0..=1.0).contains(&hysteresis), "hysteresis", hysteresis, "0 to 1")
    }
}

/// Why a robot of a team could not be planned for. It brakes; see [`Team::plan`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TeamError {
    /// Its numbers, or its controller.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The view has fewer own robots than the team.
    #[error("no pose; the view has {poses} own robots, the team has {robots}")]
    NoPose {
        /// How many there are.
        poses: usize,
        /// How many were expected.
        robots: usize,
    },
    /// There are fewer tasks than robots.
    #[error("no task; there are {tasks} tasks for {robots} robots")]
    NoTask {
        /// How many there are.
        tasks: usize,
        /// How many were expected.
        robots: usize,
    },
    /// Its task names a world that there is not.
    #[error("world {world}; expected one of {worlds}, counted from 0")]
    NoWorld {
        /// What the task says.
        world: usize,
        /// How many there are.
        worlds: usize,
    },
    /// A pose or a task beyond the last robot.
    #[error("there is no such robot; the team has {robots}, counted from 0")]
    NoRobot {
        /// How many there are.
        robots: usize,
    },
}

/// Who made an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// The controller and its guard.
    Controller,
    /// The controller's way was no longer safe to follow: there was no time left to stop later.
    EmergencyBrake,
    /// The task said to halt; no controller was asked.
    Halt,
    /// The robot was in [`Team::errors`]; the controller was asked only if it is the one who erred.
    Error,
}

/// A robot's way is kept only where it is still on it: within these, in metres and m/s.
const ON_TRACK: [f64; 2] = [0.01, 0.05];
/// A goal that moved by less is the same goal, in metres: so far from it a robot may stand.
const SAME_GOAL: f64 = 0.01;
/// A way is kept only within the limits of now, but for this, relative: rounding.
const WITHIN_LIMITS: f64 = 1e-6;
/// Seconds for which an opponent that is not seen is taken to go on as it went when it was seen last: vision loses
/// robots for a few frames; who is away for longer has left the field, or is somewhere else.
const LOST: f64 = 1.0;
/// What a robot is taken to be able to do until it was once told usable limits, in m/s and m/s²: any can do that.
const CAUTIOUS: [f64; 2] = [1.0, 1.0];

/// Where something was seen last, and goes on from.
#[derive(Debug, Clone, Copy)]
struct Sighting {
    state: State,
    /// Seconds since.
    age: f64,
}

/// Controllers of a team's robots, with what each remembers.
pub struct Team {
    settings: TeamSettings,
    guards: Vec<Guard>,
    /// Where own robots are: as seen, or else as ordered.
    own: Vec<State>,
    opponents: Vec<Sighting>,
    /// The last usable limits.
    limits: Vec<Limits>,
    answers: Vec<Answer>,
    /// Answers of the frame before, seen from now.
    before: Vec<Answer>,
    /// Everybody's way to stop, from now.
    stops: Vec<Trajectory>,
    scratch: Answer,
    frame: u64,
    /// What went wrong in the last frame, by robot.
    pub errors: Vec<(usize, TeamError)>,
    /// Who made the answers of the last frame.
    pub origins: Vec<Origin>,
    /// Work of the last frame's calls.
    pub work: Counters,
    /// Time of each call of a controller in the last frame, in the clock's unit; a robot whose controller was not asked
    /// has none.
    pub call_times: Vec<f64>,
}

impl Team {
    /// A team whose robots have these controllers.
    ///
    /// # Errors
    /// [`SettingError`] names a setting outside its range.
    pub fn new(settings: TeamSettings, guards: Vec<Guard>) -> Result<Self, SettingError> {
        settings.validate()?;
        let n = guards.len();
        let unknown = Answer { trajectory: Trajectory::new(nowhere()), goal: nowhere().position, ..Answer::default() };
        let cautious = Limits::new(CAUTIOUS[0], CAUTIOUS[1]).expect("both are above 0");
        Ok(Self {
            settings,
            guards,
            own: vec![nowhere(); n],
            opponents: Vec::new(),
            limits: vec![cautious; n],
            answers: vec![unknown.clone(); n],
            before: vec![unknown; n],
            stops: vec![Trajectory::default(); n],
            scratch: Answer::default(),
            frame: 0,
            errors: Vec::new(),
            origins: Vec::new(),
            work: Counters::default(),
            call_times: Vec::new(),
        })
    }

    /// Gives a robot another controller, from the next frame on. Its motion goes on: the next answer starts from it.
    ///
    /// # Panics
    /// If there is no such robot.
    pub fn swap(&mut self, robot: usize, guard: Guard) {
        self.guards[robot] = guard;
    }

    /// The answers of the last frame.
    pub fn answers(&self) -> &[Answer] {
        &self.answers
    }

    /// The answers of the frame before, seen from the last one's time: what robots would have gone on to do.
    pub fn before(&self) -> &[Answer] {
        &self.before
    }

    /// Plans for all robots, those first in the order of `tasks` before the others. All randomness comes from `seed`;
    /// `budget` is asked once a robot, `clock` before and after it.
    ///
    /// Every robot has an answer, whatever the input. One whose input is unusable brakes and is named in
    /// [`Team::errors`]; the others plan as ever:
    /// - a robot that is not seen is taken to be where it was ordered to be, for as long as it is not seen: it brakes
    ///   from there, and its mates keep clear of that. If it has never been seen nobody knows where it is: its answer
    ///   stands, and has a position that is not a number;
    /// - a robot without usable limits brakes with the last ones that were, or at 1 m/s²;
    /// - an opponent that is not seen is taken to go on with the velocity that it had, for one second.
    pub fn plan(
        &mut self,
        view: &View<'_>,
        tasks: &[Task],
        worlds: &[World],
        seed: u64,
        budget: &dyn Fn() -> Budget,
        clock: &dyn Fn() -> f64,
    ) -> &[Answer] {
        self.errors.clear();
        self.origins.clear();
        self.call_times.clear();
        self.work = Counters::default();
        std::mem::swap(&mut self.answers, &mut self.before);
        self.see(view, tasks);
        let robots = self.guards.len();
        for i in 0..robots {
            let mut run = Run::new(stream(seed, self.frame, i as u64)).with_budget(budget());
            let mut answer = std::mem::take(&mut self.scratch);
            let began = clock();
            let (origin, asked) = self.one(i, view, tasks, worlds, &mut run, &mut answer);
            if asked {
                self.call_times.push(clock() - began);
            }
            self.origins.push(origin);
            self.scratch = std::mem::replace(&mut self.answers[i], answer);
            self.work.iterations += run.spent.iterations;
            self.work.evaluations += run.spent.evaluations;
            self.work.collision_checks += run.spent.collision_checks;
        }
        for i in robots..view.own.len().max(tasks.len()) {
            self.errors.push((i, TeamError::NoRobot { robots }));
        }
        self.frame += 1;
        &self.answers
    }

    /// Where everybody is now, and how own robots would stop.
    fn see(&mut self, view: &View<'_>, tasks: &[Task]) {
        let period = self.settings.period;
        for i in 0..self.guards.len() {
            self.before[i].trajectory.advance(period);
            self.own[i] = seen(view.own, i).unwrap_or(self.before[i].trajectory.start());
            if let Some(limits) = tasks.get(i).and_then(|task| usable(task.limits).ok()) {
                self.limits[i] = limits;
            }
            brake(self.own[i], self.limits[i], &mut self.stops[i]);
        }
        let opponents = view.opponents.len().max(self.opponents.len());
        self.opponents.resize(opponents, Sighting { state: nowhere(), age: 0.0 });
        for (i, sighting) in self.opponents.iter_mut().enumerate() {
            match seen(view.opponents, i) {
                Some(state) => *sighting = Sighting { state, age: 0.0 },
                None if sighting.age > LOST => sighting.state = nowhere(),
                None => {
                    sighting.age += period;
                    sighting.state.position += sighting.state.velocity * period;
                }
            }
        }
    }

    /// Robot `i`'s answer: who made it, and whether the controller was asked.
    fn one(
        &mut self,
        i: usize,
        view: &View<'_>,
        tasks: &[Task],
        worlds: &[World],
        run: &mut Run<'_>,
        answer: &mut Answer,
    ) -> (Origin, bool) {
        let horizon = self.settings.horizon;
        let later = |j: usize| if j < i { &self.answers[j].trajectory } else { &self.stops[j] };
        let movers = movers(&self.settings, i, &self.own, &self.opponents, &self.limits, later);
        let task = tasks.get(i);
        let situation = self.situation(i, view, tasks, worlds, &movers);
        let halts = task.is_some_and(|task| task.halt);
        match situation {
            Ok(situation) if !halts => {
                let result = self.guards[i].answer(&situation, run, answer);
                if result.is_ok() && keeps(&self.before[i], answer, &situation, self.settings.hysteresis) {
                    answer.trajectory.copy_from(&self.before[i].trajectory);
                    // A goal that creeps away counts from where the way leads; `keeps` saw that nothing is touched.
                    (answer.goal, answer.contact) = (self.before[i].goal, None);
                }
                let braked = answer.safety == Safety::Brake;
                if self.settings.emergency_brake {
                    self.guards[i].stop_in_time(&situation, answer);
                }
                let origin = match result {
                    Err(error) => {
                        self.errors.push((i, error.into()));
                        Origin::Error
                    }
                    Ok(()) if !braked && answer.safety == Safety::Brake => Origin::EmergencyBrake,
                    Ok(()) => Origin::Controller,
                };
                (origin, true)
            }
            other => {
                answer.trajectory.copy_from(&self.stops[i]);
                (answer.safety, answer.goal) = (Safety::Brake, answer.trajectory.end().position);
                let world = task.and_then(|task| worlds.get(task.world)).filter(|_| self.own[i].finite().is_ok());
                answer.contact = world.and_then(|world| first_contact(&answer.trajectory, world, &movers, horizon));
                let origin = match other {
                    Ok(_) => Origin::Halt,
                    Err(error) => {
                        self.errors.push((i, error));
                        Origin::Error
                    }
                };
                (origin, false)
            }
        }
    }

    /// What robot `i` faces.
    fn situation<'a>(
        &self,
        i: usize,
        view: &View<'_>,
        tasks: &[Task],
        worlds: &'a [World],
        movers: &'a [Mover<'a>],
    ) -> Result<Situation<'a>, TeamError> {
        let TeamSettings { period, horizon, .. } = self.settings;
        let robots = self.guards.len();
        let state = *view.own.get(i).ok_or(TeamError::NoPose { poses: view.own.len(), robots })?;
        let task = tasks.get(i).ok_or(TeamError::NoTask { tasks: tasks.len(), robots })?;
        let world = worlds.get(task.world).ok_or(TeamError::NoWorld { world: task.world, worlds: worlds.len() })?;
        let limits = usable(task.limits)?;
        Ok(Situation::new(world, movers, state, task.goal, limits, horizon, period)?)
    }
}

/// At rest where nobody knows.
fn nowhere() -> State {
    State::at_rest(Point::new(f64::NAN, f64::NAN))
}

fn seen(states: &[State], i: usize) -> Option<State> {
    states.get(i).and_then(|state| state.finite().ok())
}

/// The limits, if they are some: their fields may have been changed since they were checked.
fn usable(limits: Limits) -> Result<Limits, ControlError> {
    Ok(Limits::new(limits.speed, limits.acceleration)?)
}

/// The seed of one call. Each step scatters all bits, so that neighbouring seeds, frames and robots share no streams.
fn stream(seed: u64, frame: u64, robot: u64) -> u64 {
    [seed, frame, robot].into_iter().fold(0, |mixed, part| splitmix64(&mut (mixed ^ part)))
}

/// What robot `i` sees move; a mate that plans with it as `way` says.
fn movers<'m>(
    settings: &TeamSettings,
    i: usize,
    own: &[State],
    opponents: &[Sighting],
    limits: &[Limits],
    way: impl Fn(usize) -> &'m Trajectory,
) -> Vec<Mover<'m>> {
    let radius = 2.0 * ROBOT_RADIUS;
    let mates = own.iter().enumerate().filter(|(j, _)| *j != i).map(|(j, mate)| {
        let path = match settings.cooperation {
            Cooperation::Independent => Path::Velocity(mate.velocity),
            Cooperation::Priority => Path::Trajectory(way(j)),
        };
        Mover::disc(mate.position, radius, path, Side::Mate).with_braking(limits[j].acceleration)
    });
    let opponents = opponents
        .iter()
        .map(|o| Mover::disc(o.state.position, radius, Path::Velocity(o.state.velocity), Side::Opponent));
    // Who is nowhere cannot be avoided; nothing else can be wrong with a mover.
    mates.chain(opponents).map(|m| m.with_margin(settings.margin)).filter(|m| m.check().is_ok()).collect()
}

/// Whether the way under way, `old`, is as good as the new one, still free, and within the limits of now: what keeps a
/// robot from changing its mind between two ways that are alike. A robot above a limit that was lowered gets a new way.
fn keeps(old: &Answer, new: &Answer, situation: &Situation<'_>, hysteresis: f64) -> bool {
    let arrives = |answer: &Answer| matches!(answer.safety, Safety::Ok | Safety::Adapted);
    if hysteresis == 0.0 || !arrives(old) || !arrives(new) || (old.goal - new.goal).norm() > SAME_GOAL {
        return false;
    }
    let (is, was) = (situation.state, old.trajectory.start());
    let (peaks, limits) = (old.trajectory.peaks(), situation.limits);
    let allowed = peaks.speed <= limits.speed * (1.0 + WITHIN_LIMITS)
        && peaks.acceleration <= limits.acceleration * (1.0 + WITHIN_LIMITS);
    let on_track =
        (is.position - was.position).norm() <= ON_TRACK[0] && (is.velocity - was.velocity).norm() <= ON_TRACK[1];
    on_track
        && allowed
        && new.trajectory.duration() > (1.0 - hysteresis) * old.trajectory.duration()
        && first_contact(&old.trajectory, situation.world, situation.movers, situation.horizon).is_none()
}

/// A guard round a controller built by name. It does not brake by itself: the team does.
///
/// # Errors
/// [`planner_catalogue::BuildError`] names what is wrong with kind or settings.
pub fn guard(kind: &str, settings: &str) -> Result<Guard, planner_catalogue::BuildError> {
    Ok(Guard::new(planner_catalogue::build_controller_str(kind, settings)?.controller))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::stream;

    #[test]
    fn neighbouring_calls_share_no_stream() {
        // Also as the simulation hands seeds on, with a pattern over them.
        for pattern in [0, 0x5eed_0f7e_a3b1_2c4d] {
            let seeds = (0..64u64).chain([256, 512, 1 << 16, 1 << 32, u64::MAX]);
            let calls = seeds.flat_map(|s| (0..300).flat_map(move |f| (0..16).map(move |r| (s ^ pattern, f, r))));
            let streams: Vec<u64> = calls.map(|(seed, frame, robot)| stream(seed, frame, robot)).collect();
            // 331 200 of 2⁶⁴: by chance two would coincide once in 3·10⁸ grids.
            assert_eq!(streams.iter().collect::<BTreeSet<_>>().len(), streams.len());
        }
    }
}
