//! What several tests share: the paper's scene and paths of chosen sides.

#![allow(dead_code, reason = "each test uses a part")]

use env_model::{LocalFrame, Obstacle, Point, Scene, World};
use planner_api::{Plan, Problem, Refinement, Refiner, Run};
use planner_qp::{Qp, Settings};

/// A scene of these obstacles, without field.
pub fn scene(start: [f64; 2], goal: [f64; 2], obstacles: Vec<Obstacle>) -> Scene {
    Scene { name: "test".into(), unit: "cm".into(), robot_radius: 0.0, start, goal, field: None, obstacles }
}

/// Lu & Sun (2012), §4.
pub fn paper() -> Scene {
    let discs = [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]];
    scene([200.0, 150.0], [400.0, 260.0], discs.map(|c| Obstacle::disc(c.into(), 16.0)).to_vec())
}

/// A path, perhaps colliding, that passes each disc of the paper above (`true`) or below.
pub fn paper_path(above: [bool; 3]) -> Vec<Point> {
    let scene = paper();
    let frame = LocalFrame::new(scene.start(), scene.goal());
    let discs = [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]];
    let mut path = vec![scene.start()];
    for (c, up) in discs.into_iter().zip(above) {
        let p = frame.to_local(c.into());
        path.push(frame.to_world(Point::new(p.x, p.y + if up { 20.0 } else { -20.0 })));
    }
    path.push(scene.goal());
    path
}

/// Refines `path` without limits.
pub fn refine(scene: &Scene, settings: Settings, path: Vec<Point>) -> (Plan, Refinement) {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut plan = Plan { path, ..Plan::new() };
    let outcome = Qp::new(settings).unwrap().refine(&problem, &mut Run::new(1), &mut plan).unwrap();
    (plan, outcome)
}
