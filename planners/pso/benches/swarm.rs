//! A whole run of the swarm, 400 iterations: the paper's on every vector unit, other shapes, other rules.

use std::fs;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_pso::{Pso, Rule, Settings, Width};

fn scene(name: &str) -> Scene {
    let path = format!("{}/../../{name}", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).expect("a scene");
    Scene::from_toml(&path, &text).expect("a valid scene")
}

/// Each call has a seed of its own: times are means over seeds.
fn measure(c: &mut Criterion, group: &str, label: &dyn ToString, scene: &Scene, mut pso: Pso) {
    let world = World::new(scene).expect("a valid scene");
    let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
    let (mut plan, mut seed) = (Plan::new(), 0);
    let mut group = c.benchmark_group(group);
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
        measure(c, "swarm/paper", &width.name(), &paper, pso);
    }
    measure(c, "swarm/shapes", &"mixed", &scene("configs/scenes/mixed-shapes.toml"), planner(Settings::default()));
    for rule in [Rule::Constriction, Rule::Quantum, Rule::Spso2011, Rule::Comprehensive] {
        let pso = planner(Settings { rule, ..Settings::default() });
        measure(c, "swarm/rules", &format!("{rule:?}"), &paper, pso);
    }
}

criterion_group!(benches, plan);
criterion_main!(benches);
