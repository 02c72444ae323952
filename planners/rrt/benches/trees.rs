//! Time to the first path and to 20 000 samples, with the quality reached.

use std::fs;
use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use env_model::generate::{Generator, generate};
use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_rrt::{ConnectSettings, RrtConnect, RrtStar, StarSettings};

fn scenes() -> Vec<Scene> {
    let path = format!("{}/../../tests/reference/paper.toml", env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(&path).expect("a reference scene");
    let mut scenes = vec![Scene::from_toml(&path, &text).expect("a valid scene")];
    for generator in [Generator::Wall, Generator::Scrum, Generator::SslA] {
        scenes.push(generate(generator, None, 1, 0).expect("a scene"));
    }
    scenes
}

/// Each call has a seed of its own: times are means over seeds.
fn measure(c: &mut Criterion, name: &str, planner: &mut dyn Planner) {
    let mut group = c.benchmark_group(name);
    for scene in scenes() {
        let world = World::new(&scene).expect("a valid scene");
        let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
        let (mut plan, mut seed) = (Plan::new(), 0);
        group.bench_function(BenchmarkId::from_parameter(&scene.name), |b| {
            b.iter(|| {
                seed += 1;
                planner.plan_into(black_box(&problem), &mut Run::new(seed), &mut plan)
            });
        });
        println!("{}: length {} {:?}", scene.name, plan.cost, plan.counters);
    }
    group.finish();
}

fn plan(c: &mut Criterion) {
    let samples = StarSettings { samples: 20_000, ..StarSettings::default() };
    let connect = RrtConnect::new(ConnectSettings::default());
    measure(c, "rrt-connect", &mut connect.expect("valid settings"));
    for (name, settings) in [("defaults", StarSettings::default()), ("20000 samples", samples)] {
        let mut star = RrtStar::new(settings.clone()).expect("valid settings");
        measure(c, &format!("rrt-star, {name}"), &mut star);
        let mut informed = RrtStar::informed(settings).expect("valid settings");
        measure(c, &format!("informed-rrt-star, {name}"), &mut informed);
    }
}

criterion_group!(benches, plan);
criterion_main!(benches);
