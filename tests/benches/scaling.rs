//! `cargo bench --bench scaling`: how times grow with the size of the problem.
//!
//! Writes `docs/growth.csv` and `docs/growth.svg`, and prints the exponents;
//! `-- --plot` draws the picture from the table as it is. Worlds are uniform
//! random discs at constant density, crossed from corner to corner, with a wall
//! close round them for random trees, which else go round them all; the swarm
//! and the convex refinement grow on the scene of the 2012 paper.

use std::fs;
use std::hint::black_box;
use std::time::{Duration, Instant};

use env_model::{Scene, World};
use planner_api::{Plan, Problem, Run, Status};
use planner_catalogue::{BuildError, build_str};
use touchline_tests::growth::{Curve, Panel, Point, exponent_of, from_csv, svg, to_csv};
use touchline_tests::random::{self, Robots};
use touchline_tests::report::{flag, in_repository, print_table, time, write};
use touchline_tests::scenes;
use touchline_tests::statistics::median;

const CSV: &str = "docs/growth.csv";
const SVG: &str = "docs/growth.svg";

const TANGENT: &str = "tangent: exact shortest path";
const CONNECT: &str = "rrt-connect: first path";
const BUILD: &str = "world: compile the scene";
const SEGMENT: &str = "collision: one segment";
const SWARM: &str = "pso: 400 iterations";
const CLARABEL: &str = "qp: clarabel";
const STRUCTURED: &str = "qp: structured";

const fn curve(name: &'static str, fit_from: f64, fit_to: f64) -> Curve {
    Curve { name, fit_from, fit_to }
}

const PANELS: &[Panel] = &[
    Panel {
        size: "discs",
        axis: "discs at constant density",
        ticks: &[10.0, 100.0, 1e3, 1e4, 1e5],
        curves: &[
            curve(TANGENT, 100.0, 1e4),
            curve(CONNECT, 100.0, 1e4),
            curve(BUILD, 100.0, 1e5),
            curve(SEGMENT, 100.0, 1e5),
        ],
    },
    Panel {
        size: "columns",
        axis: "columns, paper’s scene",
        ticks: &[5.0, 10.0, 20.0, 50.0, 100.0, 200.0],
        curves: &[curve(SWARM, 20.0, 200.0), curve(CLARABEL, 20.0, 200.0), curve(STRUCTURED, 20.0, 200.0)],
    },
    Panel {
        size: "particles",
        axis: "particles, paper’s scene",
        ticks: &[10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1e3],
        curves: &[curve(SWARM, 20.0, 1e3)],
    },
];

/// Median time of a call, µs: at least three calls, 0.1 s of them where they are short.
fn measure(mut call: impl FnMut()) -> f64 {
    const ENOUGH: Duration = Duration::from_millis(100);
    const BATCH: Duration = Duration::from_micros(20);
    call();
    let begin = Instant::now();
    call();
    let batch = BATCH.as_nanos() / begin.elapsed().as_nanos().max(1) + 1;
    let (mut times, begin) = (Vec::new(), Instant::now());
    while times.len() < 3 || begin.elapsed() < ENOUGH {
        let begin = Instant::now();
        for _ in 0..batch {
            call();
        }
        times.push(begin.elapsed().as_secs_f64() * 1e6 / batch as f64);
    }
    median(&times)
}

/// Median over `scenes` of the time of a planner; `None` where the catalogue has no such setting.
fn plan(kind: &str, settings: &str, scenes: &[Scene]) -> Option<f64> {
    let mut planner = match build_str(kind, settings) {
        Ok(built) => built.planner,
        Err(BuildError::At { .. }) => {
            println!("{kind}, {settings}: left out, there is no such setting");
            return None;
        }
        Err(error) => panic!("{kind}, {settings}: {error}"),
    };
    let time = |scene: &Scene| {
        let world = scenes::world(scene);
        let problem = Problem::new(&world, scene.start(), scene.goal()).expect("a free start and goal");
        let (mut plan, mut seed) = (Plan::new(), 0);
        measure(|| {
            seed += 1;
            let status = planner.plan_into(black_box(&problem), &mut Run::new(seed), &mut plan);
            let status = status.expect("a problem that it supports");
            // The swarm's path may collide; what stops early measures nothing.
            assert!(status == Status::Solved || kind == "pso", "{kind} in {}: {status:?}", scene.name);
        })
    };
    Some(median(&scenes.iter().map(time).collect::<Vec<_>>()))
}

/// The table, and a line for each time as it comes.
#[derive(Default)]
struct Table(Vec<Point>);

impl Table {
    fn add(&mut self, curve: &str, size: &str, count: usize, scenes: usize, time_us: Option<f64>) {
        let Some(time_us) = time_us else { return };
        println!("{curve}: {count} {size}, {}", time(time_us));
        let (curve, size) = (curve.to_owned(), size.to_owned());
        self.0.push(Point { curve, size, count: count as f64, time_us, scenes });
    }

    fn over_discs(&mut self) {
        for count in [10, 30, 100, 300, 1_000, 3_000, 10_000, 30_000, 100_000] {
            let seeds = if count <= 1_000 { 9 } else { 5 };
            let scenes: Vec<Scene> = (0..seeds).map(|seed| random::discs(count, seed)).collect();
            let number = scenes.len();
            if count <= 10_000 {
                self.add(TANGENT, "discs", count, number, plan("tangent", "", &scenes));
                // Trees would go round the square; no limit that a large world would reach.
                let walled: Vec<Scene> = scenes.iter().cloned().map(random::walled).collect();
                self.add(CONNECT, "discs", count, number, plan("rrt-connect", "samples = 10000000", &walled));
            }
            let build = |scene| measure(|| drop(black_box(World::new(black_box(scene)))));
            let builds: Vec<f64> = scenes.iter().map(build).collect();
            self.add(BUILD, "discs", count, number, Some(median(&builds)));
            let Robots { world, segments, .. } = Robots::new(count);
            let all = measure(|| {
                for (a, b) in &segments {
                    black_box(world.segment_free(black_box(*a), black_box(*b)));
                }
            });
            self.add(SEGMENT, "discs", count, 1, Some(all / segments.len() as f64));
        }
    }

    fn over_columns(&mut self) {
        let paper = [scenes::paper()];
        for count in [5, 10, 20, 50, 100, 200] {
            self.add(SWARM, "columns", count, 1, plan("pso", &format!("columns = {count}"), &paper));
            for (curve, solver) in [(CLARABEL, ""), (STRUCTURED, ", solver = \"structured\"")] {
                let refine = format!("refine = [{{ kind = \"qp\", columns = {count}{solver} }}]");
                self.add(curve, "columns", count, 1, plan("straight-line", &refine, &paper));
            }
        }
    }

    fn over_particles(&mut self) {
        let paper = [scenes::paper()];
        for count in [10, 20, 50, 100, 200, 500, 1_000] {
            self.add(SWARM, "particles", count, 1, plan("pso", &format!("particles = {count}"), &paper));
        }
    }
}

fn main() {
    if !flag("--plot") {
        let mut table = Table::default();
        table.over_discs();
        table.over_columns();
        table.over_particles();
        write(CSV, &to_csv(&table.0));
    }
    let text = fs::read_to_string(in_repository(CSV)).expect("the table of this run or an earlier one");
    let points = from_csv(&text).unwrap_or_else(|line| panic!("{CSV}: {line}"));
    write(SVG, &svg("How times grow with the size of the problem", PANELS, &points));
    let mut rows = Vec::new();
    for panel in PANELS {
        for curve in panel.curves {
            let Some(p) = exponent_of(&points, panel, curve) else { continue };
            let range = format!("{} to {} {}", curve.fit_from, curve.fit_to, panel.size);
            rows.push([curve.name.to_owned(), range, format!("{p:.2}")]);
        }
    }
    print_table(["work", "range", "exponent"], &rows);
}
