//! `cargo bench`: the times that this project promises, each beside its mark.
//!
//! Criterion measures and compares with the run before; at the end one table
//! holds every median against its mark. `cargo bench -- tangent` measures the rows
//! whose names contain `tangent`, `cargo bench -- --quick` measures roughly.
//!
//! Planners are warm (their buffers have grown), worlds are built, and each call
//! has a seed of its own: a time is that of `plan_into` or of one query.

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::Criterion;
use env_model::{Point, Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_catalogue::build_str;
use planner_pso::{Pso, Width};
use touchline_tests::random::{self, Robots};
use touchline_tests::report::{cpu, print_table, time, vector_units};
use touchline_tests::scenes;
use touchline_tests::statistics::median;

/// What is promised, µs.
#[derive(Clone, Copy, Default)]
struct Promise {
    mark: Option<f64>,
    stretch: Option<f64>,
}

/// Rows measured so far.
struct Marks {
    criterion: Criterion,
    rows: Vec<(String, f64, Promise)>,
}

const SAMPLES: usize = 50;

impl Marks {
    /// Measures `pass`, which makes `calls` calls.
    fn measure(&mut self, name: &str, promise: Promise, calls: usize, mut pass: impl FnMut()) {
        let slow = {
            let begin = Instant::now();
            pass();
            begin.elapsed() > Duration::from_millis(100)
        };
        let samples = if slow { 10 } else { SAMPLES };
        let mut times = Vec::new();
        let mut group = self.criterion.benchmark_group("marks");
        group.sample_size(samples).bench_function(name, |bencher| {
            bencher.iter_custom(|passes| {
                let begin = Instant::now();
                for _ in 0..passes {
                    pass();
                }
                let whole = begin.elapsed();
                times.push(whole.as_secs_f64() * 1e6 / (passes as f64 * calls as f64));
                whole / calls as u32
            });
        });
        group.finish();
        // The samples come last, after the warm-up (`--quick` takes fewer, so the median has some of that in it);
        // none where the name is filtered out.
        let samples = &times[times.len().saturating_sub(samples)..];
        if !samples.is_empty() {
            self.rows.push((name.to_owned(), median(samples), promise));
        }
    }

    /// Measures a planner of the catalogue over `scenes`: the mean over them.
    fn plan(&mut self, name: &str, promise: Promise, kind: &str, settings: &str, scenes: &[Scene]) {
        let planner = build_str(kind, settings).unwrap_or_else(|error| panic!("{name}: {error}")).planner;
        self.call(name, promise, planner, scenes);
    }

    /// The same with a planner that has been built.
    fn call(&mut self, name: &str, promise: Promise, mut planner: Box<dyn Planner>, scenes: &[Scene]) {
        let worlds: Vec<World> = scenes.iter().map(scenes::world).collect();
        let problems: Vec<Problem<'_>> =
            worlds.iter().zip(scenes).map(|(world, scene)| problem(world, scene)).collect();
        let (mut plan, mut seed) = (Plan::new(), 0);
        self.measure(name, promise, problems.len(), || {
            for problem in &problems {
                seed += 1;
                let status = planner.plan_into(black_box(problem), &mut Run::new(seed), &mut plan);
                black_box(status.expect("a free start and goal"));
            }
        });
    }

    fn table(&self) {
        println!("\n{}, {}; median times\n", cpu(), vector_units().join(" "));
        let bound = |us: Option<f64>| us.map_or("–".to_owned(), |us| format!("≤ {}", time(us)));
        let rows: Vec<[String; 5]> = self
            .rows
            .iter()
            .map(|(name, measured, Promise { mark, stretch })| {
                let ratio = mark.map_or("–".to_owned(), |mark| format!("{:.2}", measured / mark));
                [name.clone(), time(*measured), bound(*mark), bound(*stretch), ratio]
            })
            .collect();
        print_table(["work", "measured", "mark", "stretch", "measured/mark"], &rows);
    }
}

fn problem<'a>(world: &'a World, scene: &Scene) -> Problem<'a> {
    Problem::new(world, scene.start(), scene.goal()).expect("a free start and goal")
}

fn promise(mark: f64, stretch: f64) -> Promise {
    Promise { mark: Some(mark), stretch: Some(stretch) }
}

/// The swarm's marks depend on the vector unit: 1.1 times a hand-written kernel's time with AVX-512.
fn swarm_promise(width: &str) -> Promise {
    match width {
        "AVX-512" => promise(1.1 * 136.0, 120.0),
        "AVX2" => promise(260.0, 220.0),
        "SSE 4.2" | "NEON" => promise(510.0, 420.0),
        _ => Promise::default(),
    }
}

fn planners(marks: &mut Marks) {
    let paper = [scenes::paper()];
    for width in Width::all() {
        let swarm = Pso::new(planner_pso::Settings::default()).expect("valid settings").on(width);
        let name = format!("pso: 20 × 400, paper, {}", width.name());
        marks.call(&name, swarm_promise(width.name()), Box::new(swarm), &paper);
    }
    let clarabel = Promise { mark: Some(1200.0), stretch: None };
    marks.plan("pso-qp: clarabel, paper", clarabel, "pso-qp", "", &paper);
    let structured = Promise { mark: None, stretch: Some(230.0) };
    marks.plan("pso-qp: structured, paper", structured, "pso-qp", "qp = { solver = \"structured\" }", &paper);
    marks.plan("rrt-connect: paper", promise(5.0, 3.0), "rrt-connect", "", &paper);
    for kind in ["rrt-star", "informed-rrt-star"] {
        let name = format!("{kind}: 20 000 samples, paper");
        marks.plan(&name, Promise::default(), kind, "samples = 20000", &paper);
    }
    marks.plan("tangent: paper", promise(1.0, 0.5), "tangent", "", &paper);
    let walls: [f64; 2] = [8.0, 4.0];
    let dense: [f64; 2] = [60.0, 25.0];
    let names = ["wall-00", "wall-01", "wall-02", "wall-03", "wall-04", "dense-0", "dense-1"];
    for name in names {
        let [mark, stretch] = if name.starts_with("wall") { walls } else { dense };
        let scene = [scenes::reference(name)];
        marks.plan(&format!("tangent: {name}"), promise(mark, stretch), "tangent", "", &scene);
    }
    for (count, seeds, mark, stretch) in [(1_000, 4, 900.0, 300.0), (10_000, 2, 600_000.0, 50_000.0)] {
        let scenes: Vec<Scene> = (0..seeds).map(|seed| random::discs(count, seed)).collect();
        marks.plan(&format!("tangent: {count} random discs"), promise(mark, stretch), "tangent", "", &scenes);
    }
}

fn collision(marks: &mut Marks) {
    for (count, free) in [(22, promise(0.012, 0.008)), (100_000, promise(0.15, 0.08))] {
        let Robots { world, segments, .. } = Robots::new(count);
        let mut each = |name: &str, promise: Promise, query: &dyn Fn(Point, Point) -> f64| {
            marks.measure(&format!("{name}: {count} discs"), promise, segments.len(), || {
                for (a, b) in &segments {
                    black_box(query(black_box(*a), black_box(*b)));
                }
            });
        };
        each("segment_free", free, &|a, b| f64::from(u8::from(world.segment_free(a, b))));
        each("segment_clearance", Promise::default(), &|a, b| world.segment_clearance(a, b));
        each("point_clearance", Promise::default(), &|a, _| world.point_clearance(a));
    }
    // 21 robots and two defence areas, which are polygons.
    let game = scenes::world(&scenes::games(1)[0]);
    let Robots { segments, .. } = Robots::new(22);
    marks.measure("segment_free: a game of ssl-a", Promise::default(), segments.len(), || {
        for (a, b) in &segments {
            black_box(game.segment_free(black_box(*a), black_box(*b)));
        }
    });
}

fn main() {
    let criterion = Criterion::default()
        .warm_up_time(Duration::from_secs(1))
        .measurement_time(Duration::from_secs(3))
        .configure_from_args();
    let mut marks = Marks { criterion, rows: Vec::new() };
    planners(&mut marks);
    collision(&mut marks);
    marks.criterion.final_summary();
    marks.table();
}
