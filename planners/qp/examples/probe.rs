//! Temporary probe.
use env_model::{Scene, World};
use planner_api::{Plan, Problem, Refiner, Run};
use planner_catalogue::build_str;
use planner_qp::{Qp, Settings};
use std::time::Instant;
fn main() {
    let mode = std::env::args().nth(1).unwrap_or("clarabel".into());
    let n: u64 = std::env::args().nth(2).map_or(50, |s| s.parse().unwrap());
    let path = "tests/reference/paper.toml";
    let scene = Scene::from_toml(path, &std::fs::read_to_string(path).unwrap()).unwrap();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut swarm = build_str("pso", "side_classes = 256").unwrap().planner;
    let settings: Settings =
        toml::from_str(&if mode == "clarabel" { String::new() } else { format!("solver = \"{mode}\"") }).unwrap();
    let mut qp = Qp::new(settings).unwrap();
    let (mut reached, mut iters, mut best) = (0, 0, f64::INFINITY);
    let (mut ts, mut tq) = (vec![], vec![]);
    for seed in 1000..1000 + n {
        let t = Instant::now();
        let mut plan = swarm.plan(&problem, &mut Run::new(seed)).unwrap().0;
        ts.push(t.elapsed().as_nanos() as f64 / 1e3);
        let t = Instant::now();
        let mut run = Run::new(0);
        qp.refine(&problem, &mut run, &mut plan).unwrap();
        tq.push(t.elapsed().as_nanos() as f64 / 1e3);
        iters += run.spent.iterations;
        if plan.cost <= 231.9504 {
            reached += 1;
        }
        best = best.min(plan.cost);
    }
    ts.sort_by(f64::total_cmp);
    tq.sort_by(f64::total_cmp);
    println!(
        "{mode}: reached {reached}/{n} best {best:.9} iters {:.2} swarm us med {:.0} min {:.0}; qp us med {:.1} min {:.1}",
        iters as f64 / n as f64,
        ts[ts.len() / 2],
        ts[0],
        tq[tq.len() / 2],
        tq[0]
    );
}
