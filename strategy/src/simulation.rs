//! The closed loop: see, decide, plan, move, judge, every frame.

use std::time::{Duration, Instant};

use env_model::motion::{Limits, MotionError, State, Trajectory, bang_bang, least_time};
use env_model::{Point, SceneError, Vector};
use planner_api::{Budget, SettingError};
use planner_catalogue::BuildError;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::league::{BALL_RADIUS, ROBOT_RADIUS};
use crate::orders::Orders;
use crate::plays::{Conduct, Play, Setup, play};
use crate::record::Stopwatch;
use crate::referee::Referee;
use crate::rules::{Ball, Rules};
use crate::team::guard;
use crate::{
    Body, Metrics, Origin, Record, RobotRecord, Settings, Task, Team, TeamSettings, Trace, TraceBody, View, draw,
};

/// A robot has arrived where it is no further from its goal, in metres, and slower, in m/s. It is counted as if it went on
/// as quickly as it can until it stands there, so that nobody gains by this and nobody beats the least time.
const ARRIVED: [f64; 2] = [0.03, 0.1];
/// How much of the difference between where an own robot is seen and where its wheels have taken it is believed, each
/// frame: a constant-gain filter, which leaves a third of the noise.
const CORRECTION: f64 = 0.2;
/// A robot stands where it is slower, in m/s.
const STANDING: f64 = 0.05;
/// Looks ahead, in seconds, at which two plans are compared.
const LOOKS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];
/// Seconds between two pictures of a trace.
const PICTURES: f64 = 0.1;

/// Why a simulation could not begin, or go on.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs, reason = "the messages say it")]
pub enum SimulationError {
    #[error(transparent)]
    Setting(#[from] SettingError),
    #[error("planner {planner:?}: {source}")]
    Build { planner: String, source: BuildError },
    #[error(transparent)]
    Motion(#[from] MotionError),
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// Limits on one call of a controller; any may be absent.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct CallBudget {
    /// Iterations of the planner's outer loop.
    pub iterations: Option<u64>,
    /// Evaluations of the planner's own objective.
    pub evaluations: Option<u64>,
    /// Time.
    pub time: Option<Duration>,
}

impl CallBudget {
    /// The budget of a call that begins now.
    pub fn now(&self) -> Budget {
        Budget {
            iterations: self.iterations,
            evaluations: self.evaluations,
            deadline: self.time.map(|time| Instant::now() + time),
        }
    }
}

/// A simulation under way.
pub struct Simulation {
    settings: Settings,
    budget: CallBudget,
    limits: Limits,
    seed: u64,
    rng: ChaCha8Rng,
    play: Box<dyn Play>,
    team: Team,
    /// Own robots, then opponents.
    bodies: Vec<Body>,
    /// Where own robots are to stand in the end, the nearest legal points.
    goals: Vec<Point>,
    /// The same as the play says it.
    asked: Vec<Point>,
    /// Where own robots were when their wave began.
    starts: Vec<State>,
    /// Waves that are over, and since when the present one goes on.
    waves: usize,
    wave_began: f64,
    /// Ways of waves that are over.
    ways: Vec<RobotRecord>,
    ball: Option<State>,
    placement: Option<Point>,
    rules: Rules,
    tasks: Vec<Task>,
    conducts: Vec<Conduct>,
    believed: Vec<State>,
    /// Where own robots are, as vision and their wheels together tell.
    located: Vec<Point>,
    orders: Vec<Orders>,
    referee: Referee,
    frame: u64,
    next_swap: usize,
    /// When each own robot that is at its goal came to stand there.
    arrived: Vec<Option<f64>>,
    travelled: Vec<f64>,
    switches: u64,
    stuck: f64,
    /// Sum of distances to places in the formation, and how many.
    formation: (f64, u64),
    metrics: Metrics,
    first_error: Option<String>,
    stopwatch: Stopwatch,
    traced: bool,
    trace: Trace,
}

impl Simulation {
    /// The beginning of the simulation of `settings` with the controllers `planner`, a kind and its settings in TOML.
    ///
    /// # Errors
    /// [`SimulationError`] names what is wrong with the settings or the planner.
    pub fn new(
        settings: &Settings,
        planner: (&str, &str),
        budget: CallBudget,
        seed: u64,
    ) -> Result<Self, SimulationError> {
        settings.validate()?;
        let limits = Limits::new(settings.speed, settings.acceleration)?;
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut play = play(settings.play);
        let Setup { own, opponents, ball, placement } = play.setup(settings, &mut rng)?;
        let rules = Rules::new(settings.league, settings.command(), seen(ball, placement))?;
        let guards = (0..own.len()).map(|_| build(planner.0, planner.1)).collect::<Result<Vec<_>, _>>()?;
        let team_settings = TeamSettings {
            period: settings.period(),
            horizon: settings.horizon_s,
            margin: settings.margin,
            cooperation: settings.cooperation,
            hysteresis: settings.hysteresis,
            emergency_brake: settings.emergency_brake,
        };
        let bodies: Vec<Body> = own.iter().chain(&opponents).map(|state| Body::new(*state, limits)).collect();
        let body = |side: &str| TraceBody { side: side.to_owned(), radius: ROBOT_RADIUS };
        let round = TraceBody { side: "ball".to_owned(), radius: BALL_RADIUS };
        let sides: Vec<TraceBody> = own
            .iter()
            .map(|_| body("own"))
            .chain(opponents.iter().map(|_| body("opponent")))
            .chain(ball.map(|_| round))
            .collect();
        let n = own.len();
        let mut simulation = Self {
            budget,
            limits,
            // Not the simulator's own stream: a planner draws the same whatever the noise.
            seed: seed ^ 0x5eed_0f7e_a3b1_2c4d,
            rng,
            play,
            team: Team::new(team_settings, guards)?,
            referee: Referee::new(n, opponents.len()),
            goals: own.iter().map(|state| state.position).collect(),
            asked: Vec::new(),
            starts: own,
            waves: 0,
            wave_began: 0.0,
            ways: Vec::new(),
            ball,
            placement,
            rules,
            tasks: vec![Task::new(Point::origin(), limits); n],
            conducts: vec![Conduct::Drift; opponents.len()],
            believed: bodies.iter().map(|b| b.state).collect(),
            located: bodies[..n].iter().map(|b| b.state.position).collect(),
            orders: vec![Orders::default(); n],
            frame: 0,
            next_swap: 0,
            arrived: vec![None; n],
            travelled: vec![0.0; n],
            switches: 0,
            stuck: 0.0,
            formation: (0.0, 0),
            metrics: Metrics::default(),
            first_error: None,
            stopwatch: Stopwatch::new(1e6 * settings.period()),
            traced: true,
            trace: Trace { period_s: PICTURES, bodies: sides, ..Trace::default() },
            bodies,
            settings: settings.clone(),
        };
        simulation.direct(0.0);
        Ok(simulation)
    }

    /// The same without a trace, whose length grows with the time.
    #[must_use]
    pub fn without_trace(self) -> Self {
        Self { traced: false, ..self }
    }

    /// Seconds since the beginning.
    pub fn time(&self) -> f64 {
        self.frame as f64 * self.settings.period()
    }

    /// Whether it is over: all stand at their goals, or the time is up.
    pub fn is_over(&self) -> bool {
        let last = self.waves + 1 >= self.settings.waves;
        self.time() >= self.settings.duration_s || (last && self.wave_is_over(self.time()))
    }

    /// The team.
    pub fn team(&self) -> &Team {
        &self.team
    }

    /// Own robots, then opponents.
    pub fn bodies(&self) -> &[Body] {
        &self.bodies
    }

    /// Gives all own robots another controller from the next frame on.
    ///
    /// # Errors
    /// [`SimulationError::Build`]
    pub fn swap(&mut self, kind: &str, settings: &str) -> Result<(), SimulationError> {
        for robot in 0..self.starts.len() {
            self.team.swap(robot, build(kind, settings)?);
        }
        Ok(())
    }

    /// One frame. `clock` is read round every call of a controller, in microseconds.
    ///
    /// # Errors
    /// [`SimulationError::Build`] where a configured swap names a planner that cannot be built.
    pub fn step(&mut self, clock: &dyn Fn() -> f64) -> Result<(), SimulationError> {
        let (time, period, n) = (self.time(), self.settings.period(), self.starts.len());
        while let Some(swap) = self.settings.swap.get(self.next_swap).filter(|swap| swap.at_s <= time).cloned() {
            self.swap(&swap.planner, &swap.settings.to_string())?;
            self.next_swap += 1;
        }
        self.next_wave(time);
        self.picture(time);
        let latency = self.settings.latency_ms * 1e-3;
        self.observe(time, latency);
        self.direct(time);
        let (own, opponents) = self.believed.split_at(n);
        let view = View { time, own, opponents, ball: self.ball };
        let budget = self.budget;
        self.team.plan(&view, &self.tasks, self.rules.worlds(), self.seed, &|| budget.now(), clock);
        self.stopwatch.frame(&self.team.call_times);
        self.count(period);
        for (orders, answer) in self.orders.iter_mut().zip(self.team.answers()) {
            orders.give(time, time + latency, &answer.trajectory);
        }
        self.advance(time, period);
        self.play.carry(&self.bodies[..n], &mut self.ball);
        self.referee.judge(time, period, &self.bodies, &self.tasks, &self.rules);
        self.frame += 1;
        self.arrivals();
        Ok(())
    }

    /// Everything until it is over.
    ///
    /// # Errors
    /// As [`Simulation::step`].
    pub fn run(mut self, clock: &dyn Fn() -> f64) -> Result<Record, SimulationError> {
        while !self.is_over() {
            self.step(clock)?;
        }
        Ok(self.record())
    }

    /// What everybody is to do, from what is believed now.
    fn direct(&mut self, time: f64) {
        let (own, opponents) = self.believed.split_at(self.starts.len());
        let view = View { time, own, opponents, ball: self.ball };
        self.rules.update(self.settings.command(), seen(self.ball, self.placement));
        for task in &mut self.tasks {
            task.limits = self.limits;
        }
        self.play.direct(&view, &mut self.tasks);
        self.play.oppose(&view, &mut self.conducts);
        self.rules.apply(&mut self.tasks);
        let asked = self.play.goals();
        if asked != self.asked {
            self.goals.clear();
            self.goals.extend(asked.iter().zip(&self.tasks).map(|(goal, task)| self.rules.legal(task.role, *goal)));
            self.asked = asked.to_vec();
        }
    }

    /// Whether all have arrived, or had their time.
    fn wave_is_over(&self, time: f64) -> bool {
        let late = self.settings.waves > 1 && time - self.wave_began >= self.settings.wave_s;
        late || self.arrived.iter().all(Option::is_some)
    }

    /// Gives out new goals where those so far are done with.
    fn next_wave(&mut self, time: f64) {
        if !self.wave_is_over(time) || self.waves + 1 >= self.settings.waves {
            return;
        }
        self.ways.extend(self.wave());
        self.waves += 1;
        self.wave_began = time;
        self.arrived.fill(None);
        self.travelled.fill(0.0);
        let n = self.starts.len();
        self.starts.clear();
        self.starts.extend(self.bodies[..n].iter().map(|body| body.state));
        self.play.next_wave();
    }

    /// What the own robots' ways come to in this wave so far.
    fn wave(&self) -> Vec<RobotRecord> {
        let (began, limits) = (self.wave_began, self.rules.limits(self.limits));
        let way = |i: usize| RobotRecord {
            start: self.starts[i].position.into(),
            goal: self.goals[i].into(),
            arrival_s: self.arrived[i].map(|at| at - began),
            least_s: least_time(self.starts[i], self.goals[i], limits),
            travelled: self.travelled[i],
            collisions: self.referee.events.iter().filter(|e| e.time_s >= began && e.bodies.contains(&i)).count()
                as u32,
        };
        (0..self.starts.len()).map(way).collect()
    }

    /// What the team believes of the time `ahead` seconds from `now`, when its answers take effect.
    fn observe(&mut self, now: f64, ahead: f64) {
        let Settings { position_noise, velocity_noise, .. } = self.settings;
        for (i, body) in self.bodies.iter().enumerate() {
            let mut seen = body.state;
            if position_noise > 0.0 || velocity_noise > 0.0 {
                let [px, py, vx, vy] = std::array::from_fn(|_| draw::normal(&mut self.rng));
                seen.position += Vector::new(px, py) * position_noise;
                seen.velocity += Vector::new(vx, vy) * velocity_noise;
            }
            self.believed[i] = match self.orders.get(i) {
                // Own robots: the wheels tell how they have moved, vision where, and orders how they will.
                Some(orders) => {
                    if position_noise > 0.0 {
                        let moved = self.located[i] + (body.state.position - body.motion.start().position);
                        self.located[i] = moved + (seen.position - moved) * CORRECTION;
                    } else {
                        self.located[i] = body.state.position;
                    }
                    let (way, change) = orders.change(now, now + ahead);
                    State { position: self.located[i] + way, velocity: body.state.velocity + change }
                }
                None => State { position: seen.position + seen.velocity * ahead, ..seen },
            };
        }
    }

    /// Everybody moves for one frame.
    fn advance(&mut self, time: f64, period: f64) {
        let Settings { position_noise, velocity_noise, actuation_noise, .. } = self.settings;
        let exact = position_noise == 0.0 && velocity_noise == 0.0 && actuation_noise == 0.0;
        let n = self.starts.len();
        for (i, body) in self.bodies[..n].iter_mut().enumerate() {
            let before = body.state.position;
            if exact {
                body.follow(&self.orders[i], time, period);
            } else {
                body.track(&self.orders[i], time, period, actuation_noise, &mut self.rng);
            }
            let way: f64 = (0..8)
                .map(|k| f64::from(k) / 8.0 * period)
                .fold((0.0, before), |(sum, last), t| {
                    let p = body.motion.state(t + period / 8.0).position;
                    (sum + (p - last).norm(), p)
                })
                .0;
            self.travelled[i] += way;
        }
        let field = self.settings.league.field();
        let mut run = Trajectory::default();
        for (conduct, body) in self.conducts.iter().zip(&mut self.bodies[n..]) {
            match conduct {
                Conduct::RunTo(goal) => bang_bang(body.state, *goal, body.limits, &mut run),
                Conduct::Drift => {
                    for axis in 0..2 {
                        let (p, v) = (body.state.position[axis], body.state.velocity[axis]);
                        if (p <= field.min[axis] + ROBOT_RADIUS && v < 0.0)
                            || (p >= field.max[axis] - ROBOT_RADIUS && v > 0.0)
                        {
                            body.state.velocity[axis] = -v;
                        }
                    }
                    run.begin(body.state);
                }
            }
            body.run(&run, period);
        }
    }

    /// Counts what the answers of this frame are.
    fn count(&mut self, period: f64) {
        use planner_control::Safety;
        let team = &self.team;
        let metrics = &mut self.metrics;
        metrics.calls += team.call_times.len() as u64;
        if self.first_error.is_none() {
            self.first_error = team.errors.first().map(|(robot, error)| format!("robot {robot}: {error}"));
        }
        for (spent, work) in
            metrics.work.iter_mut().zip([team.work.iterations, team.work.evaluations, team.work.collision_checks])
        {
            *spent += work;
        }
        for (i, (answer, before)) in team.answers().iter().zip(team.before()).enumerate() {
            match team.origins[i] {
                Origin::Controller => metrics.brakes += u64::from(answer.safety == Safety::Brake),
                Origin::EmergencyBrake => {
                    metrics.brakes += 1;
                    metrics.emergency_brakes += 1;
                }
                Origin::Halt => metrics.halts += 1,
                Origin::Error => metrics.errors += 1,
            }
            metrics.escapes += u64::from(answer.safety == Safety::Escape);
            let apart = |t: &f64| {
                let [new, old] = [answer, before].map(|a| a.trajectory.state(*t).position);
                (new - old).norm() > ROBOT_RADIUS
            };
            self.switches += u64::from(self.frame > 0 && LOOKS.iter().any(apart));
            let body = &self.bodies[i];
            if let Some(place) = self.play.places().get(i) {
                self.formation.0 += (body.state.position - place).norm();
                self.formation.1 += 1;
            }
            let away = (body.state.position - self.goals[i]).norm() > ARRIVED[0];
            if away && body.state.velocity.norm() < STANDING {
                self.stuck += period;
            }
        }
    }

    fn arrivals(&mut self) {
        let time = self.time();
        for (i, since) in self.arrived.iter_mut().enumerate() {
            let State { position, velocity } = self.bodies[i].state;
            let there = (position - self.goals[i]).norm() <= ARRIVED[0] && velocity.norm() <= ARRIVED[1];
            let left = || least_time(self.bodies[i].state, self.goals[i], self.limits);
            *since = if there { since.or_else(|| Some(time + left())) } else { None };
        }
    }

    fn picture(&mut self, time: f64) {
        if self.traced && time + 1e-9 >= self.trace.frames.len() as f64 * PICTURES {
            let all = self.bodies.iter().map(|b| b.state).chain(self.ball);
            self.trace.frames.push(all.map(|state| state.position.into()).collect());
        }
    }

    /// What it came to so far.
    pub fn record(mut self) -> Record {
        self.picture(f64::INFINITY);
        let n = self.starts.len();
        let mut robots = std::mem::take(&mut self.ways);
        // A wave that the end cuts short says nothing, unless there is no other.
        if robots.is_empty() || self.wave_is_over(self.time()) {
            robots.extend(self.wave());
        }
        let mean = |values: &mut dyn Iterator<Item = f64>| {
            let (sum, count) = values.fold((0.0, 0), |(sum, count), v| (sum + v, count + 1));
            (count > 0).then(|| sum / f64::from(count))
        };
        let arrived: Vec<&RobotRecord> = robots.iter().filter(|r| r.arrival_s.is_some()).collect();
        let straight = |r: &RobotRecord| (Point::from(r.goal) - Point::from(r.start)).norm();
        let ways = &mut arrived.iter().filter(|r| straight(r) > 0.0).map(|r| r.travelled / straight(r));
        let events = std::mem::take(&mut self.referee.events);
        let duration_s = self.time();
        let metrics = Metrics {
            duration_s,
            robots: robots.len(),
            arrived: arrived.len(),
            arrival_s: mean(&mut robots.iter().filter_map(|r| r.arrival_s)).filter(|_| arrived.len() == robots.len()),
            least_s: mean(&mut robots.iter().map(|r| r.least_s)).unwrap_or(0.0),
            collisions: events.len() as u32,
            violations: self.referee.violations,
            violation_s: self.referee.violation_s / n as f64,
            fouls: events.iter().filter(|e| e.foul).count() as u32,
            length_ratio: mean(ways),
            least_clearance: Some(self.referee.least_clearance).filter(|c| c.is_finite()),
            switches_per_s: self.switches as f64 / (duration_s * n as f64),
            stuck_s: self.stuck / n as f64,
            formation_error: (self.formation.1 > 0).then(|| self.formation.0 / self.formation.1 as f64),
            ..self.metrics
        };
        self.trace.events = events;
        let (first_error, compute) = (self.first_error, self.stopwatch.compute());
        Record { metrics, robots, first_error, compute, trace: self.trace }
    }
}

fn build(kind: &str, settings: &str) -> Result<planner_control::Guard, SimulationError> {
    guard(kind, settings).map_err(|source| SimulationError::Build { planner: kind.to_owned(), source })
}

/// The ball as rules see it.
fn seen(ball: Option<State>, placement: Option<Point>) -> Option<Ball> {
    ball.map(|ball| Ball { at: ball.position, target: placement })
}

/// Simulates `settings` from beginning to end; see [`Simulation`].
///
/// # Errors
/// [`SimulationError`]
pub fn simulate(
    settings: &Settings,
    planner: (&str, &str),
    budget: CallBudget,
    seed: u64,
    clock: &dyn Fn() -> f64,
) -> Result<Record, SimulationError> {
    Simulation::new(settings, planner, budget, seed)?.run(clock)
}
