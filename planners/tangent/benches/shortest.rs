//! Time to plan on the reference scenes, and among uniform random discs.

use std::fs;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use env_model::{Obstacle, Point, Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_tangent::{Settings, Tangent};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

fn reference(name: &str) -> Scene {
    let path = format!("{}/../../tests/reference/{name}.toml", env!("CARGO_MANIFEST_DIR"));
    Scene::from_toml(&path, &fs::read_to_string(&path).expect("a reference scene")).expect("a valid scene")
}

/// `count` discs at the density of the `dense-*` scenes: one in two square units.
fn uniform(count: usize) -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(count as u64);
    let side = (2.0 * count as f64).sqrt();
    let (start, goal) = (Point::new(0.5, 0.5), Point::new(side - 0.5, side - 0.5));
    let mut scene = reference("dense-0");
    (scene.start, scene.goal, scene.field) = (start.into(), goal.into(), None);
    scene.obstacles.clear();
    while scene.obstacles.len() < count {
        let mut uniform = |low: f64, high: f64| low + (high - low) * rng.random::<f64>();
        let (centre, r) = (Point::new(uniform(0.0, side), uniform(0.0, side)), uniform(0.2, 0.55));
        if (centre - start).norm() > r && (centre - goal).norm() > r {
            scene.obstacles.push(Obstacle::disc(centre, r));
        }
    }
    scene
}

fn plan(c: &mut Criterion) {
    let names = ["paper", "ssl22-00", "wall-00", "wall-01", "wall-02", "wall-03", "wall-04", "dense-0", "dense-1"];
    let mut scenes: Vec<_> = names.iter().map(|name| ((*name).to_owned(), reference(name))).collect();
    scenes.extend([1_000].map(|n| (format!("uniform-{n}"), uniform(n))));
    let mut group = c.benchmark_group("tangent");
    for (name, scene) in scenes {
        let world = World::new(&scene).expect("a valid scene");
        let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
        let mut planner = Tangent::new(Settings::default()).expect("valid settings");
        let mut plan = Plan::new();
        let mut run = Run::new(1);
        let status = planner.plan_into(&problem, &mut run, &mut plan);
        println!("{name}: {status:?} {:?} {} points", plan.counters, plan.path.len());
        group.bench_function(BenchmarkId::from_parameter(name), |b| {
            b.iter(|| planner.plan_into(black_box(&problem), &mut Run::new(1), &mut plan));
        });
    }
    group.finish();
}

criterion_group!(benches, plan);
criterion_main!(benches);
