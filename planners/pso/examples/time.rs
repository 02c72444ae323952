//! Median time of a run of each update rule on the paper's scene.
use std::time::Instant;

use env_model::{Scene, World};
use planner_api::{Plan, Planner, Problem, Run};
use planner_pso::{Pso, Rule, Settings};

fn main() {
    let runs = std::env::args().nth(1).and_then(|n| n.parse().ok()).unwrap_or(1000u64);
    let file = include_str!("../../../configs/scenes/lu-sun-2012.toml");
    let scene = Scene::from_toml("lu-sun-2012.toml", file).expect("a good scene");
    let world = World::new(&scene).expect("a good scene");
    let problem = Problem::new(&world, scene.start(), scene.goal()).expect("free ends");
    for rule in [Rule::Inertia, Rule::Constriction, Rule::Quantum, Rule::Spso2011, Rule::Comprehensive] {
        let mut pso = Pso::new(Settings { rule, ..Settings::default() }).expect("defaults");
        let mut plan = Plan::new();
        let mut times: Vec<f64> = (0..runs)
            .map(|seed| {
                let begin = Instant::now();
                pso.plan_into(&problem, &mut Run::new(seed), &mut plan).expect("free ends");
                begin.elapsed().as_secs_f64() * 1e6
            })
            .collect();
        times.sort_by(f64::total_cmp);
        println!("{rule:?}, µs: least {:.1}, median {:.1}", times[0], times[times.len() / 2]);
    }
}
