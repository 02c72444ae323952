//! A made-up campaign of moving scenes: robots change places on a circle along bows, which some bow too little.

use std::f64::consts::{PI, TAU};

use env_model::Scene;
use eval::results::{
    Manifest, Moving, MovingTrace, Optimum, PlannerInfo, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
    TraceOf,
};
use strategy::{Compute, Event, League, Metrics, RobotRecord, Settings, Trace, TraceBody, league};

use crate::Random;

/// How a made-up planner drives.
struct Manner {
    label: &'static str,
    /// How far it bows out, as a share of the way, and by how much that differs from robot to robot.
    bow: f64,
    spread: f64,
    /// Seconds that it takes.
    duration: f64,
    /// Median time of a call, µs.
    call_us: f64,
}

const fn manner(label: &'static str, bow: f64, spread: f64, duration: f64, call_us: f64) -> Manner {
    Manner { label, bow, spread, duration, call_us }
}

const MANNERS: [Manner; 6] = [
    manner("bang-bang", 0.24, 0.03, 3.7, 180.0),
    manner("orca", 0.3, 0.02, 4.6, 9.0),
    manner("space-time-a-star", 0.2, 0.06, 4.1, 2100.0),
    manner("dynamic-window", 0.12, 0.1, 4.9, 60.0),
    manner("replan-frozen: tangent", 0.02, 0.06, 3.9, 14.0),
    manner("replan-frozen: pso-qp with a very long label", 0.0, 0.04, 5.2, 2600.0),
];

const PERIOD: f64 = 1.0 / 60.0;
const RADIUS: f64 = 2.7;
/// The mean lower bound: 5.4 m at 3 m/s and 3 m/s².
const LEAST: f64 = 2.8;

/// Where a robot is that bows out on its way.
fn place(start: [f64; 2], goal: [f64; 2], bow: f64, share: f64) -> [f64; 2] {
    let s = share * share * (3.0 - 2.0 * share);
    let across = [start[1] - goal[1], goal[0] - start[0]];
    let out = bow * libm::sin(PI * s);
    [0, 1].map(|k| start[k] + s * (goal[k] - start[k]) + out * across[k])
}

/// Contacts of the trace's bodies, one for each time that two come together.
fn events(trace: &Trace) -> Vec<Event> {
    let mut events = Vec::new();
    for a in 0..trace.bodies.len() {
        let robots = |b: &usize| trace.bodies[a].side != "ball" && trace.bodies[*b].side == "own";
        for b in (0..a).filter(robots) {
            let reach = trace.bodies[a].radius + trace.bodies[b].radius;
            let gap = |f: &Vec<[f64; 2]>| libm::hypot(f[a][0] - f[b][0], f[a][1] - f[b][1]);
            for (k, pair) in trace.frames.windows(2).enumerate() {
                if gap(&pair[0]) > reach && gap(&pair[1]) <= reach {
                    let closing = (gap(&pair[0]) - gap(&pair[1])) / PERIOD;
                    let at = [0, 1].map(|c| 0.5 * (pair[1][a][c] + pair[1][b][c]));
                    let time_s = (k + 1) as f64 * PERIOD;
                    events.push(Event { time_s, bodies: [b, a], at, closing, foul: closing > 1.5 });
                }
            }
        }
    }
    events.sort_by(|x, y| x.time_s.total_cmp(&y.time_s));
    events
}

/// One simulation of `robots` among `opponents`.
fn simulation(m: &Manner, settings: &Settings, random: &mut Random) -> (Moving, Trace) {
    let n = settings.robots;
    let at = |angle: f64| [RADIUS * libm::cos(angle), RADIUS * libm::sin(angle)];
    let mut vary = |by: f64| by * (2.0 * random.next() - 1.0);
    let mut robots = Vec::new();
    let mut ways = Vec::new();
    for i in 0..n {
        let start = at(TAU * i as f64 / n as f64).map(|v| v + vary(0.1));
        let goal = start.map(|v| -v);
        ways.push((start, goal, m.bow + vary(m.spread), m.duration * (1.0 + vary(0.1))));
        let arrival_s = Some(ways[i].3);
        robots.push(RobotRecord {
            start,
            goal,
            arrival_s,
            least_s: LEAST,
            travelled: 5.4 * (1.0 + m.bow),
            collisions: 0,
        });
    }
    let drift: Vec<[f64; 4]> = (0..settings.opponents).map(|_| [vary(2.0), vary(2.0), vary(0.4), vary(0.4)]).collect();
    let body = |side: &str, radius| TraceBody { side: side.to_owned(), radius };
    let mut bodies = vec![body("own", league::ROBOT_RADIUS); n];
    bodies.extend(vec![body("opponent", league::ROBOT_RADIUS); drift.len()]);
    bodies.push(body("ball", league::BALL_RADIUS));
    let duration = ways.iter().map(|w| w.3).fold(0.0, f64::max) + 0.2;
    let frame = |k: usize| {
        let t = k as f64 * PERIOD;
        let own = ways.iter().map(|(start, goal, bow, takes)| place(*start, *goal, *bow, (t / takes).min(1.0)));
        let others = drift.iter().map(|[x, y, vx, vy]| [x + t * vx, y + t * vy]);
        own.chain(others).chain([[0.4 - 0.1 * t, 1.3]]).collect()
    };
    let mut trace = Trace {
        period_s: PERIOD,
        bodies,
        frames: (0..(duration / PERIOD) as usize).map(frame).collect(),
        events: Vec::new(),
    };
    trace.events = events(&trace);
    for event in &trace.events {
        event.bodies.iter().for_each(|b| {
            if let Some(r) = robots.get_mut(*b) {
                r.collisions += 1;
            }
        });
    }
    let fouls = trace.events.iter().filter(|e| e.foul).count() as u32;
    let collisions = trace.events.len() as u32;
    let stuck = collisions > 5;
    let arrived = if stuck { n - 1 } else { n };
    let frames = trace.frames.len() as u64;
    let call = |scale: f64| [1.0, 2.2, 3.5, 6.0].map(|q| scale * m.call_us * q * (1.0 + 0.1 * m.spread));
    let metrics = Metrics {
        duration_s: duration,
        robots: n,
        arrived,
        arrival_s: (!stuck).then(|| ways.iter().map(|w| w.3).sum::<f64>() / n as f64),
        least_s: LEAST,
        collisions,
        violations: 0,
        violation_s: 0.0,
        fouls,
        length_ratio: Some(1.0 + m.bow * m.bow * 4.0),
        least_clearance: Some(if collisions > 0 { -0.01 } else { 0.04 + vary(0.02) }),
        switches_per_s: 2.0 * m.spread,
        stuck_s: if stuck { 1.5 } else { 0.0 },
        formation_error: None,
        calls: frames * n as u64,
        brakes: u64::from(collisions) * 7,
        emergency_brakes: u64::from(collisions) * 5,
        escapes: u64::from(collisions) * 2,
        halts: 0,
        errors: 0,
        work: [0; 3],
    };
    let misses = if 8.0 * m.call_us > 16_000.0 { frames / 3 } else { 0 };
    let compute =
        Compute { call_us: call(1.0), frame_us: call(n as f64), misses, total_us: frames as f64 * 8.0 * m.call_us };
    (Moving { metrics, compute, robots }, trace)
}

/// The campaign: a circle swap, and one among opponents.
pub fn campaign(repeats: u32, manifest: Manifest) -> Results {
    let mut random = Random(11);
    let scenes = [("circle-swap", 8, 0), ("crossing", 6, 4)];
    let (mut runs, mut traces, mut results) = (Vec::new(), Vec::new(), Vec::new());
    for (name, robots, opponents) in scenes {
        let settings = Settings { robots, opponents, ..Settings::default() };
        for m in &MANNERS {
            let mut kept: Vec<MovingTrace> = Vec::new();
            for repeat in 0..repeats {
                let (moving, trace) = simulation(m, &settings, &mut random);
                let clean = moving.metrics.is_clean();
                let of = if clean { TraceOf::Median } else { TraceOf::FirstFailure };
                let seed = 40 + u64::from(repeat);
                if kept.iter().all(|k| k.of != of) {
                    let (scene, planner) = (name.to_owned(), m.label.to_owned());
                    kept.push(MovingTrace { scene, planner, repeat, seed, of, faithful: true, trace });
                }
                runs.push(RunRecord {
                    status: RunStatus::Solved,
                    valid: clean,
                    length: moving.metrics.arrival_s,
                    gap: moving.metrics.time_ratio().filter(|_| clean).map(|r| r - 1.0),
                    clearance_min: moving.metrics.least_clearance,
                    time_us: moving.compute.total_us * (1.0 + 0.01 * f64::from(repeat % 5)),
                    moving: Some(moving),
                    ..RunRecord::empty(name, m.label, repeat, seed)
                });
            }
            traces.append(&mut kept);
        }
        let scene = Scene {
            name: name.to_owned(),
            unit: "m".to_owned(),
            robot_radius: league::ROBOT_RADIUS,
            start: [0.0, 0.0],
            goal: [1.0, 0.0],
            field: Some(League::DivisionA.field()),
            obstacles: Vec::new(),
        };
        let reason = Subject::Simulation.no_optimum().map(str::to_owned);
        let optimum = Optimum { length: None, path: Vec::new(), reason };
        results.push(SceneResult { scene, optimum, set: SceneSet::Test, simulation: Some(settings) });
    }
    Results {
        name: "circle-swap".to_owned(),
        seed: 1,
        repeats,
        subject: Subject::Simulation,
        protocol: String::new(),
        planners: MANNERS.iter().map(|m| PlannerInfo::plain(m.label, m.label, "horizon_s = 2.0\n")).collect(),
        scenes: results,
        runs,
        snapshots: Vec::new(),
        traces,
        manifest,
    }
}
