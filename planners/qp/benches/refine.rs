//! Refinement of the swarm's plan on the paper's scene, by each solver.

use std::fs;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Refiner, Run};
use planner_pso::Pso;
use planner_qp::{Qp, Settings, Solver};

const SOLVERS: [(&str, Solver); 2] = [("clarabel", Solver::Clarabel), ("structured", Solver::Structured)];

/// Plans that are prepared outside the timing, in turn.
const SEEDS: u64 = 16;

fn paper() -> Scene {
    let path = format!("{}/../../tests/reference/paper.toml", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).expect("a reference scene");
    Scene::from_toml(&path, &text).expect("a valid scene")
}

/// The swarm of `pso-qp`.
fn swarm() -> Pso {
    let settings = planner_pso::Settings { side_classes: 256, ..planner_pso::Settings::default() };
    Pso::new(settings).expect("valid settings")
}

/// The refinement alone.
fn qp(c: &mut Criterion) {
    let scene = paper();
    let world = World::new(&scene).expect("a valid scene");
    let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
    let mut swarm = swarm();
    let plans: Vec<Plan> =
        (0..SEEDS).map(|seed| swarm.plan(&problem, &mut Run::new(seed)).expect("a plan").0).collect();
    let mut group = c.benchmark_group("qp");
    for (name, solver) in SOLVERS {
        let mut qp = Qp::new(Settings { solver, ..Settings::default() }).expect("valid settings");
        let mut next = plans.iter().cycle();
        group.bench_function(name, |b| {
            b.iter_batched_ref(
                || next.next().expect("a cycle never ends").clone(),
                |plan| qp.refine(black_box(&problem), &mut Run::new(0), plan),
                BatchSize::SmallInput,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, qp);
criterion_main!(benches);
