//! Temporary.
use env_model::scene::{Field, Shape};
use env_model::{Columns, Obstacle, Scene, World};
use planner_api::*;
use planner_qp::*;
use rand::{RngExt, SeedableRng};
fn main() {
    let n: u64 = std::env::args().nth(1).map_or(500, |s| s.parse().unwrap());
    let s0: u64 = std::env::args().nth(2).map_or(0, |s| s.parse().unwrap());
    let mut counts = std::collections::BTreeMap::<String, u64>::new();
    let mut worst: f64 = 0.0;
    for seed in s0..s0 + n {
        let mut r = rand_chacha::ChaCha8Rng::seed_from_u64(seed);
        let mut u = |a: f64, b: f64| a + (b - a) * r.random::<f64>();
        let k = u(1.0, 9.0) as usize;
        let only_discs = u(0.0, 1.0) < 0.4;
        let obstacles: Vec<Obstacle> = (0..k).map(|_| {
            let (x, y) = (u(5.0, 75.0), u(-5.0, 65.0));
            let t = u(0.0, 5.0);
            if only_discs || t < 3.0 { Shape::Disc { centre: [x, y], radius: u(1.0, 12.0) } }
            else if t < 4.0 { Shape::Capsule { from: [x, y], to: [x + u(-12.0, 12.0), y + u(-12.0, 12.0)], radius: u(0.5, 6.0) } }
            else { Shape::Polygon((0..5).map(|i| { let a = std::f64::consts::TAU * i as f64 / 5.0; let d = u(2.0, 12.0); [x + d * a.cos(), y + d * a.sin()] }).collect()) }
        }.into()).collect();
        let field = (u(0.0, 1.0) < 0.5).then_some(Field { min: [-12.0, -14.0], max: [95.0, 80.0] });
        let robot_radius = if u(0.0, 1.0) < 0.5 { 0.0 } else { u(0.5, 2.0) };
        let scene = Scene { name: "t".into(), unit: "m".into(), robot_radius, start: [0.0, 0.0], goal: [80.0, 60.0], field, obstacles };
        let m = u(2.0, 25.0) as usize;
        let heights: Vec<f64> = (0..m).map(|_| u(-30.0, 30.0)).collect();
        let smooth = u(0.0, 1.0) < 0.4;
        let (ws, wr) = (u(0.0, 3.0), u(0.0, 3.0));
        let Ok(world) = World::new(&scene) else { continue };
        let Ok(problem) = Problem::new(&world, scene.start(), scene.goal()) else { continue };
        let mut path = Vec::new();
        Columns::new(scene.start(), scene.goal(), m).write_path(&heights, &mut path);
        let run = |solver| {
            let st = Settings { solver, objective: if smooth { Objective::Smooth } else { Objective::Shorten }, w_smooth: ws, w_reference: wr, classes: Classes::Final, ..Settings::default() };
            let mut plan = Plan { path: path.clone(), ..Plan::new() };
            let mut run = Run::new(0);
            let o = Qp::new(st).unwrap().refine(&problem, &mut run, &mut plan).unwrap();
            (o, plan.cost, run.spent.iterations)
        };
        eprintln!("seed {seed} smooth {smooth} m {m} discs {only_discs}");
        let (a, b) = (run(Solver::Clarabel), run(Solver::Structured));
        let key = if a.0 != b.0 { println!("MISMATCH seed {seed} smooth {smooth}: {a:?} {b:?}"); format!("{:?} {:?}", a.0, b.0) } else if matches!(a.0, Refinement::Repaired | Refinement::Improved) {
            let d = (a.1 - b.1) / a.1; worst = worst.max(d.abs());
            if d.abs() > 1e-8 { println!("DIFF seed {seed} smooth {smooth}: {a:?} {b:?} {d:.1e}"); "diff".into() } else { "same".into() }
        } else { "both none".into() };
        *counts.entry(key).or_default() += 1;
    }
    println!("{counts:?} worst {worst:.2e}");
}
