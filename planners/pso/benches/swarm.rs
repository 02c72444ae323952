//! A whole run of the swarm: the paper's, on every vector unit, and how it grows.
//!
//! Runs of 400 iterations; divide by 401 for an iteration.

use std::fs;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_pso::{Pso, Rule, Settings, Width};

fn scene(name: &str) -> Scene {
    let path = format!("{}/../../{name}", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).expect("a scene");
    Scene::from_toml(&path, &text).expect("a valid scene")
}

/// Each call has a seed of its own: times are means over seeds.
fn measure(c: &mut Criterion, group: &str, label: &dyn ToString, scene: &Scene, mut pso: Pso, heights: Option<u64>) {
    let world = World::new(scene).expect("a valid scene");
    let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
    let (mut plan, mut seed) = (Plan::new(), 0);
    let mut group = c.benchmark_group(group);
    if let Some(heights) = heights {
        group.throughput(Throughput::Elements(heights));
    }
    group.bench_function(BenchmarkId::from_parameter(label.to_string()), |b| {
        b.iter(|| {
            seed += 1;
            pso.plan_into(black_box(&problem), &mut Run::new(seed), &mut plan)
        });
    });
    group.finish();
}

fn planner(settings: Settings) -> Pso {
    Pso::new(settings).expect("valid settings")
}

fn plan(c: &mut Criterion) {
    let paper = scene("tests/reference/paper.toml");
    for width in Width::all() {
        let pso = planner(Settings::default()).on(width);
        measure(c, "swarm/paper", &width.name(), &paper, pso, None);
    }
    measure(
        c,
        "swarm/shapes",
        &"mixed",
        &scene("configs/scenes/mixed-shapes.toml"),
        planner(Settings::default()),
        None,
    );
    for rule in [Rule::Constriction, Rule::Quantum, Rule::Spso2011, Rule::Comprehensive] {
        let pso = planner(Settings { rule, ..Settings::default() });
        measure(c, "swarm/rules", &format!("{rule:?}"), &paper, pso, None);
    }
    let size = |particles: usize, columns: usize| {
        let heights = 401 * (particles * columns) as u64;
        (planner(Settings { particles, columns, ..Settings::default() }), Some(heights))
    };
    for columns in [5, 10, 20, 50, 100, 200] {
        let (pso, heights) = size(20, columns);
        measure(c, "swarm/columns", &columns, &paper, pso, heights);
    }
    for particles in [10, 20, 40, 100, 200, 500, 1000] {
        let (pso, heights) = size(particles, 20);
        measure(c, "swarm/particles", &particles, &paper, pso, heights);
    }
}

criterion_group!(benches, plan);
criterion_main!(benches);
