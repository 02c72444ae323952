//! A whole team: tasks by robot in, motions out, one robot after the other by priority.

use env_model::motion::{Limits, Mover, Path, Side, State, Trajectory, brake, first_contact};
use env_model::{Point, World};
use planner_api::{Budget, ControlError, Counters, Run, Situation, seed::splitmix64};
use planner_control::{Answer, Guard, Safety};

use crate::Cooperation;
use crate::league::ROBOT_RADIUS;
use crate::roles::Role;

/// What the team believes of the world in a frame. Own and opposing robots in a fixed order.
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
    /// Seconds between two frames.
    pub period: f64,
    /// Prediction's horizon in seconds.
    pub horizon: f64,
    /// Distance beyond contact to keep, in metres.
    pub margin: f64,
    /// How mates are predicted.
    pub cooperation: Cooperation,
    /// By how much a new way must be quicker than the one under way, 0 to 1.
    pub hysteresis: f64,
    /// Whether robots brake while they still can stop in time.
    pub emergency_brake: bool,
}

/// A robot's way is kept only where it is still on it: within these, in metres and m/s.
const ON_TRACK: [f64; 2] = [0.01, 0.05];
/// A goal that moved by less is the same goal, in metres.
const SAME_GOAL: f64 = 0.01;

/// Controllers of a team's robots, with what each remembers.
pub struct Team {
    settings: TeamSettings,
    guards: Vec<Guard>,
    answers: Vec<Answer>,
    /// Answers of the frame before, seen from now.
    before: Vec<Answer>,
    /// Everybody's way to stop, from now.
    stops: Vec<Trajectory>,
    scratch: Answer,
    frame: u64,
    /// What went wrong in the last frame, by robot.
    pub errors: Vec<(usize, ControlError)>,
    /// Work of the last frame's calls.
    pub work: Counters,
    /// Time of the last frame's calls, in the clock's unit.
    pub call_times: Vec<f64>,
}

impl Team {
    /// A team whose robots have these controllers.
    pub fn new(settings: TeamSettings, guards: Vec<Guard>) -> Self {
        let n = guards.len();
        Self {
            settings,
            guards,
            answers: vec![Answer::default(); n],
            before: vec![Answer::default(); n],
            stops: vec![Trajectory::default(); n],
            scratch: Answer::default(),
            frame: 0,
            errors: Vec::new(),
            work: Counters::default(),
            call_times: Vec::new(),
        }
    }

    /// Gives a robot another controller, from the next frame on. Its motion goes on: the next answer starts from it.
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
    /// `budget` is asked once a call, `clock` before and after it.
    ///
    /// A robot whose numbers are unusable brakes, or goes on braking from where it was last known to be, and is
    /// named in [`Team::errors`]; the others plan as if it were not there.
    pub fn plan(
        &mut self,
        view: &View<'_>,
        tasks: &[Task],
        worlds: &[World],
        seed: u64,
        budget: &dyn Fn() -> Budget,
        clock: &dyn Fn() -> f64,
    ) -> &[Answer] {
        let first = self.frame == 0;
        self.errors.clear();
        self.call_times.clear();
        self.work = Counters::default();
        std::mem::swap(&mut self.answers, &mut self.before);
        for (before, (way, (state, task))) in
            self.before.iter_mut().zip(self.stops.iter_mut().zip(view.own.iter().zip(tasks)))
        {
            before.trajectory.advance(self.settings.period);
            brake(*state, task.limits, way);
        }
        for i in 0..tasks.len() {
            let mut state = seed ^ (self.frame << 8 | i as u64);
            let mut run = Run::new(splitmix64(&mut state)).with_budget(budget());
            let mut answer = std::mem::take(&mut self.scratch);
            let began = clock();
            self.one(i, view, tasks, worlds, first, &mut run, &mut answer);
            self.call_times.push(clock() - began);
            self.scratch = std::mem::replace(&mut self.answers[i], answer);
            self.work.iterations += run.spent.iterations;
            self.work.evaluations += run.spent.evaluations;
            self.work.collision_checks += run.spent.collision_checks;
        }
        self.frame += 1;
        &self.answers
    }

    #[allow(clippy::too_many_arguments, reason = "one robot's part of `plan`")]
    fn one(
        &mut self,
        i: usize,
        view: &View<'_>,
        tasks: &[Task],
        worlds: &[World],
        first: bool,
        run: &mut Run<'_>,
        answer: &mut Answer,
    ) {
        let TeamSettings { period, horizon, .. } = self.settings;
        let later = |j: usize| if j < i { &self.answers[j].trajectory } else { &self.stops[j] };
        let movers = movers(&self.settings, i, view, tasks, later);
        let task = &tasks[i];
        let world = &worlds[task.world];
        let situation = Situation::new(world, &movers, view.own[i], task.goal, task.limits, horizon, period);
        let result = match situation {
            Ok(Situation { state, limits, .. }) if task.halt => {
                brake(state, limits, &mut answer.trajectory);
                answer.safety = Safety::Brake;
                answer.goal = answer.trajectory.end().position;
                answer.contact = first_contact(&answer.trajectory, world, &movers, horizon);
                Ok(())
            }
            Ok(situation) => {
                let result = self.guards[i].answer(&situation, run, answer);
                if !first && result.is_ok() && keeps(&self.before[i], answer, &situation, self.settings.hysteresis) {
                    answer.trajectory.copy_from(&self.before[i].trajectory);
                    answer.contact = None;
                }
                if self.settings.emergency_brake {
                    self.guards[i].stop_in_time(&situation, answer);
                }
                result
            }
            Err(error) => {
                // From where it was last known to be.
                let last = self.before[i].trajectory.start();
                let known = State::finite(last).unwrap_or(State::at_rest(Point::origin()));
                brake(known, task.limits, &mut answer.trajectory);
                (answer.safety, answer.goal, answer.contact) = (Safety::Brake, known.position, None);
                Err(error)
            }
        };
        if let Err(error) = result {
            self.errors.push((i, error));
        }
    }
}

/// What robot `i` sees move; a mate that plans with it as `way` says.
fn movers<'m>(
    settings: &TeamSettings,
    i: usize,
    view: &View<'_>,
    tasks: &[Task],
    way: impl Fn(usize) -> &'m Trajectory,
) -> Vec<Mover<'m>> {
    let radius = 2.0 * ROBOT_RADIUS;
    let mates = view.own.iter().enumerate().filter(|(j, _)| *j != i).map(|(j, mate)| {
        let path = match settings.cooperation {
            Cooperation::Independent => Path::Velocity(mate.velocity),
            Cooperation::Priority => Path::Trajectory(way(j)),
        };
        let mate = Mover::disc(mate.position, radius, path, Side::Mate);
        match tasks.get(j) {
            Some(task) => mate.with_braking(task.limits.acceleration),
            None => mate,
        }
    });
    let opponents =
        view.opponents.iter().map(|o| Mover::disc(o.position, radius, Path::Velocity(o.velocity), Side::Opponent));
    // Who is nowhere cannot be avoided.
    mates.chain(opponents).map(|m| m.with_margin(settings.margin)).filter(|m| m.check().is_ok()).collect()
}

/// Whether the way under way, `old`, is as good as the new one, and still free: what keeps a robot from changing its
/// mind between two ways that are alike.
fn keeps(old: &Answer, new: &Answer, situation: &Situation<'_>, hysteresis: f64) -> bool {
    let arrives = |answer: &Answer| matches!(answer.safety, Safety::Ok | Safety::Adapted);
    if hysteresis == 0.0 || !arrives(old) || !arrives(new) || (old.goal - new.goal).norm() > SAME_GOAL {
        return false;
    }
    let (is, was) = (situation.state, old.trajectory.start());
    let on_track =
        (is.position - was.position).norm() <= ON_TRACK[0] && (is.velocity - was.velocity).norm() <= ON_TRACK[1];
    on_track
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
