//! Writes reports of made-up campaigns, to look at the page without running planners:
//! `cargo run -p eval --example report_demo -- DIR`.
//!
//! The paths and numbers resemble those of the 2012 scene but are drawn at random.

mod behaviour;
mod moving;

use std::f64::consts::PI;
use std::path::Path;

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, World, path_length};
use eval::report::svg::{PathLayer, scene_svg};
use eval::report::{Language, html};
use eval::results::{
    Manifest, Optimum, PlannerInfo, Progress, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
};
use planner_api::seed::splitmix64;

/// Uniform numbers in [0, 1); quality hardly matters here.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        (splitmix64(&mut self.0) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// How a made-up planner behaves.
struct Manner {
    label: &'static str,
    /// How far it bows out and how much it wavers, as shares of the distance.
    bump: f64,
    noise: f64,
    evaluations: u64,
    time_us: f64,
    points: usize,
}

const fn manner(label: &'static str, bump: f64, noise: f64, evaluations: u64, time_us: f64, points: usize) -> Manner {
    Manner { label, bump, noise, evaluations, time_us, points }
}

const MANNERS: [Manner; 7] = [
    manner("straight-line", 0.0, 0.0, 1, 0.08, 2),
    manner("random-search", 0.3, 0.1, 8020, 900.0, 22),
    manner("pso", 0.06, 0.012, 8020, 780.0, 22),
    manner("pso-no-limit", 0.3, 0.035, 8020, 790.0, 22),
    manner("pso-qp", 0.003, 0.0, 8052, 2600.0, 62),
    manner("pso-qp-final", 0.02, 0.001, 8030, 1500.0, 62),
    manner("tangent", 0.0, 0.0, 0, 11.0, 400),
];

/// Corners of a good path: round each disc of the paper, or a bow on a pitch; `slack` moves them off.
fn corners(scene: &Scene, slack: f64) -> Vec<Point> {
    let (a, b) = (scene.start(), scene.goal());
    let mut corners = vec![a];
    if scene.unit == "cm" {
        let round: [(f64, f64, &[f64]); 3] =
            [(240.0, 160.0, &[125.0, 105.0, 85.0]), (280.0, 200.0, &[-80.0, -65.0]), (320.0, 230.0, &[-65.0, -52.0])];
        for (x, y, angles) in round {
            for angle in angles {
                let r = 17.0 + 60.0 * slack;
                let (sin, cos) = (libm::sin(angle * PI / 180.0), libm::cos(angle * PI / 180.0));
                corners.push(Point::new(x + r * cos, y + r * sin));
            }
        }
    } else {
        let across = env_model::Vector::new((b - a).y, -(b - a).x);
        for k in 1..8 {
            let s = f64::from(k) / 8.0;
            corners.push(a + (b - a) * s + across * (0.12 + slack) * libm::sin(PI * s));
        }
    }
    corners.push(b);
    corners
}

fn path(scene: &Scene, m: &Manner, random: &mut Random) -> Vec<Point> {
    if m.points == 2 {
        return vec![scene.start(), scene.goal()];
    }
    let slack = m.bump * random.next();
    let corners = corners(scene, slack);
    let total = path_length(&corners);
    let at = |s: f64| {
        let mut left = s * total;
        for w in corners.windows(2) {
            let piece = (w[1] - w[0]).norm();
            if left <= piece {
                return w[0] + (w[1] - w[0]) * (left / piece);
            }
            left -= piece;
        }
        scene.goal()
    };
    let size = (scene.goal() - scene.start()).norm();
    (0..m.points)
        .map(|k| {
            let s = k as f64 / (m.points - 1) as f64;
            let end = k == 0 || k + 1 == m.points;
            let wobble = if end { 0.0 } else { size * m.noise * (random.next() - 0.5) };
            at(s) + env_model::Vector::new(-0.4, 0.9) * wobble
        })
        .collect()
}

fn record(scene: &Scene, world: &World, m: &Manner, repeat: u32, random: &mut Random) -> RunRecord {
    let path = path(scene, m, random);
    let length = path_length(&path);
    let valid = world.path_free(&path);
    let clearance = path.windows(2).map(|w| world.segment_clearance(w[0], w[1])).fold(f64::INFINITY, f64::min);
    let mut progress = Vec::new();
    let mut excess = 900.0 * (0.5 + random.next());
    let mut at = if m.evaluations > 100 { 20 } else { m.evaluations };
    while at <= m.evaluations.max(1) {
        progress.push(Progress { evaluations: at, time_us: 0.1 * at as f64, cost: length * (1.0 + excess) });
        excess *= if excess > 1.0 && random.next() < 0.25 { 0.01 } else { 0.55 + 0.4 * random.next() };
        at = (at as f64 * (1.1 + 0.3 * random.next())) as u64 + 1;
    }
    if let Some(last) = progress.last_mut() {
        last.cost = if valid { length } else { length * if m.points == 2 { 1.0 } else { 150.0 } };
    }
    RunRecord {
        scene: scene.name.clone(),
        planner: m.label.to_owned(),
        repeat,
        seed: 4_503_599_627_370_496 + u64::from(repeat) * 7_919,
        status: if valid { RunStatus::Solved } else { RunStatus::NotFound },
        valid,
        length: Some(length),
        gap: None,
        clearance_min: Some(clearance),
        turning: Some(0.8 + m.noise * 100.0 * random.next()),
        iterations: m.evaluations / 20,
        evaluations: m.evaluations,
        collision_checks: m.evaluations * 21,
        time_us: m.time_us * (1.0 + 0.2 * random.next() + if random.next() < 0.05 { 1.5 } else { 0.0 }),
        cpu_us: m.time_us,
        error: None,
        cost: Some(length),
        terms: Vec::new(),
        path,
        progress,
        overhead_us: None,
        moving: None,
        tuning: None,
    }
}

fn campaign(name: &str, scenes: Vec<Scene>, known: bool, repeats: u32) -> Result<Results, Box<dyn std::error::Error>> {
    let mut random = Random(7);
    let (mut runs, mut results) = (Vec::new(), Vec::new());
    for (i, scene) in scenes.into_iter().enumerate() {
        let world = World::new(&scene)?;
        let best = path(&scene, &MANNERS[6], &mut random);
        let optimum = if known && i != 3 {
            Optimum { length: Some(path_length(&best)), path: best, reason: None }
        } else {
            Optimum {
                length: None,
                path: Vec::new(),
                reason: Some("obstacle 2 is a polygon, which the exact planner does not treat yet".into()),
            }
        };
        let first = runs.len();
        for m in &MANNERS {
            for repeat in 0..repeats {
                let mut run = record(&scene, &world, m, repeat, &mut random);
                if m.label == "random-search" && repeat % 11 == 3 {
                    (run.status, run.valid, run.gap, run.length) = (RunStatus::Error, false, None, None);
                    run.error = Some("columns = 0; expected at least 1".into());
                    run.path.clear();
                }
                runs.push(run);
            }
        }
        // Nothing may be shorter than the optimum, made up or not.
        let lengths = runs[first..].iter().filter(|r: &&RunRecord| r.valid).filter_map(|r| r.length);
        let least = lengths.fold(f64::INFINITY, f64::min);
        let optimum = Optimum { length: optimum.length.map(|o| o.min(least) * (1.0 - 2e-7)), ..optimum };
        for run in &mut runs[first..] {
            run.gap = optimum.length.zip(run.length).filter(|_| run.valid).map(|(o, l)| l / o - 1.0);
        }
        results.push(SceneResult { scene, optimum, set: SceneSet::Test, simulation: None });
    }
    let planner = |m: &Manner| {
        let kind = m.label.split("-no").next().unwrap_or("pso");
        let settings = "particles = 20\niterations = 400\ncolumns = 20\nbounds = \"stop\"\nvelocity_limit = 0.5\ninertia = { from = 0.9, to = 0.4 }\n";
        PlannerInfo::plain(m.label, kind, settings)
    };
    Ok(Results {
        name: name.to_owned(),
        seed: 1,
        repeats,
        subject: Subject::Paths,
        protocol: String::new(),
        planners: MANNERS.iter().map(planner).collect(),
        scenes: results,
        runs,
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest: Manifest {
            version: "0.1.0".into(),
            profile: "release".into(),
            platform: "linux x86_64".into(),
            cpu: "Made-up Processor 3.0 GHz".into(),
            cores: 2,
            jobs: 1,
            started: "2026-01-01T12:00:00Z".into(),
            finished: "2026-01-01T12:00:11Z".into(),
            identity: "0123456789abcdef0123456789abcdef".into(),
            ..Manifest::default()
        },
    })
}

fn paper() -> Scene {
    let disc = |x, y| Obstacle::disc(Point::new(x, y), 16.0);
    Scene {
        name: "lu-sun-2012".into(),
        unit: "cm".into(),
        robot_radius: 0.0,
        start: [200.0, 150.0],
        goal: [400.0, 260.0],
        field: None,
        obstacles: vec![disc(240.0, 160.0), disc(280.0, 200.0), disc(320.0, 230.0)],
    }
}

fn pitch(i: u32, random: &mut Random) -> Scene {
    let mut within = |lo: f64, hi: f64| lo + (hi - lo) * random.next();
    let mut obstacles: Vec<Obstacle> = (0..8 + 3 * i)
        .map(|k| {
            let mut disc = Obstacle::disc(Point::new(within(-3.0, 3.0), within(-2.4, 2.4)), 0.09);
            disc.label = Some(format!("opponent {k}"));
            disc
        })
        .collect();
    obstacles.push(Shape::Capsule { from: [-0.6, 0.5], to: [0.3, 0.9], radius: 0.12 }.into());
    obstacles.push(Shape::Polygon(vec![[3.5, -1.0], [4.5, -1.0], [4.5, 1.0], [3.5, 1.0]]).into());
    obstacles.push(
        Shape::Polygon(vec![[-1.8, -1.9], [-0.8, -1.9], [-0.8, -1.1], [-1.2, -1.1], [-1.2, -1.6], [-1.8, -1.6]]).into(),
    );
    let scene = Scene {
        name: format!("wall-s2-{i:02}"),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-3.9, -0.4],
        goal: [3.2, 1.4],
        field: Some(Field { min: [-4.5, -3.0], max: [4.5, 3.0] }),
        obstacles,
    };
    let free = corners(&scene, 0.02);
    let world = |o: &Obstacle| World::new(&Scene { obstacles: vec![o.clone()], ..scene.clone() });
    let away = |o: &Obstacle| world(o).is_ok_and(|w| free.windows(2).all(|p| w.segment_clearance(p[0], p[1]) > 0.1));
    let obstacles = scene.obstacles.iter().filter(|o| away(o)).cloned().collect();
    Scene { obstacles, ..scene }
}

/// Everything that can go wrong, on two machines, with variants, a tuning scene and isolation.
fn troubled(mut results: Results) -> Results {
    let statuses = [RunStatus::Error, RunStatus::Crashed, RunStatus::Timeout, RunStatus::OutOfMemory];
    let failing = results.runs.iter_mut().filter(|r| r.planner == "random-search" && r.repeat % 3 == 0);
    for (k, run) in failing.enumerate() {
        run.status = statuses[k % statuses.len()];
        (run.valid, run.gap, run.length, run.cost) = (false, None, None, None);
        run.error = Some(format!("process ended: {}, with a message as long as <they> get", run.status.name()));
        run.path.clear();
        run.progress.clear();
    }
    results.runs.retain(|r| !(r.planner == "tangent" && r.repeat > 5));
    for run in &mut results.runs {
        run.overhead_us = Some(180.0 + 900.0 * f64::from(run.repeat % 7 == 0));
        run.terms = vec![("length".to_owned(), 3.25), ("risk".to_owned(), 0.5)];
    }
    results.scenes[1].set = SceneSet::Tuning;
    for (planner, ms) in results.planners.iter_mut().filter(|p| p.label.starts_with("pso")).zip([1.0, 10.0]) {
        (planner.group, planner.varied) = ("pso".to_owned(), format!("velocity_limit=0.5, {ms} ms"));
        planner.budget.time_ms = Some(ms);
    }
    let part = |shard: &str| Manifest { shard: shard.to_owned(), ..results.manifest.clone() };
    results.manifest.shards = vec![part("1/2"), part("2/2")];
    (results.manifest.isolated, results.manifest.resumed) = (true, 3);
    results
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args().nth(1).unwrap_or_else(|| "report-demo".to_owned());
    let folder = Path::new(&folder);
    std::fs::create_dir_all(folder)?;
    let one = campaign("lu-sun-2012", vec![paper()], true, 30)?;
    let mut random = Random(3);
    let several = campaign("walls", (0..5).map(|i| pitch(i, &mut random)).collect(), true, 30)?;
    let without = campaign("no-optimum", vec![paper()], false, 30)?;
    let large = campaign(
        "large",
        (0..20)
            .map(|i| pitch(i % 5, &mut random))
            .enumerate()
            .map(|(i, s)| Scene { name: format!("scene-{i}"), ..s })
            .collect(),
        true,
        30,
    )?;
    let simulated = moving::campaign(30, one.manifest.clone());
    // One scene, and every run of one planner failed.
    let mut lone = moving::campaign(8, one.manifest.clone());
    lone.scenes.truncate(1);
    lone.runs.retain(|r| r.scene == lone.scenes[0].scene.name);
    lone.traces.retain(|k| k.scene == lone.scenes[0].scene.name);
    let tuned = behaviour::campaign(20, one.manifest.clone());
    let troubled = troubled(campaign("troubled", (0..4).map(|i| pitch(i, &mut random)).collect(), true, 20)?);
    for (file, page) in [
        ("moving.html", html(&simulated, Language::English)),
        ("moving-one.html", html(&lone, Language::English)),
        ("moving-zh.html", html(&simulated, Language::Chinese)),
        ("behaviour.html", html(&tuned, Language::English)),
        ("behaviour-zh.html", html(&tuned, Language::Chinese)),
        ("troubled.html", html(&troubled, Language::English)),
        ("troubled-zh.html", html(&troubled, Language::Chinese)),
        ("paper.html", html(&one, Language::English)),
        ("paper-zh.html", html(&one, Language::Chinese)),
        ("walls.html", html(&several, Language::English)),
        ("no-optimum.html", html(&without, Language::English)),
        ("large.html", html(&large, Language::English)),
    ] {
        std::fs::write(folder.join(file), &page)?;
        println!("{file}: {:.2} MB", page.len() as f64 / 1e6);
    }
    for (file, results) in [("plan.svg", &one), ("plan-pitch.svg", &several)] {
        let run = |label| results.runs_of(label, Some(&results.scenes[0].scene.name)).next();
        let layers: Vec<PathLayer<'_>> = ["straight-line", "pso", "tangent"]
            .into_iter()
            .filter_map(run)
            .enumerate()
            .map(|(series, r)| PathLayer { label: &r.planner, points: &r.path, valid: r.valid, series })
            .collect();
        let scene = &results.scenes[0];
        std::fs::write(folder.join(file), scene_svg(&scene.scene, Some(&scene.optimum.path), &layers))?;
    }
    Ok(())
}
