//! The planner's side of the contract: statuses, budgets, frames.

use std::f64::consts::FRAC_PI_4;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, World};
use planner_api::{Budget, Frame, Observer, Plan, Planner, Problem, Run, Status, View};
use planner_tangent::{NoOptimum, Settings, Tangent, optimum};

/// Start (0, 0), goal (10, 0), discs of radius 1 at `centres`.
fn scene(centres: &[[f64; 2]]) -> Scene {
    Scene {
        name: "test".into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start: [0.0, 0.0],
        goal: [10.0, 0.0],
        field: None,
        obstacles: centres.iter().map(|&c| Obstacle::disc(c.into(), 1.0)).collect(),
    }
}

fn with(mut scene: Scene, shape: Shape) -> Scene {
    scene.obstacles.push(shape.into());
    scene
}

fn square(x: f64, y: f64) -> Shape {
    Shape::Polygon(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]])
}

/// Runs the planner and asks for the optimum.
fn solve(scene: &Scene, run: &mut Run<'_>) -> (Plan, Status, Result<f64, NoOptimum>) {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let (plan, status) = Tangent::new(Settings::default()).unwrap().plan(&problem, run).unwrap();
    if !plan.path.is_empty() {
        assert_eq!((plan.path[0], *plan.path.last().unwrap()), (scene.start(), scene.goal()));
    }
    if status == Status::Solved {
        assert_eq!(world.first_violation(&plan.path), None);
        assert!(world.path_free(&plan.path));
    }
    (plan, status, optimum(&problem).map(|o| o.length))
}

#[test]
fn shapes_out_of_the_way_do_not_matter() {
    let discs = scene(&[[5.0, 0.1]]);
    let (plan, status, best) = solve(&discs, &mut Run::new(1));
    assert_eq!(status, Status::Solved);
    let other = with(with(discs, square(5.0, 4.0)), Shape::Capsule { from: [1.0, 3.0], to: [9.0, 3.0], radius: 1.0 });
    let (again, status, same) = solve(&other, &mut Run::new(1));
    assert_eq!(status, Status::Solved);
    // ε grows with the scene's box, from 1.0e-8 to 1.1e-8.
    assert!((best.unwrap() - same.unwrap()).abs() < 1e-8 && (plan.cost - again.cost).abs() < 1e-8);
}

#[test]
fn shapes_in_the_way_are_gone_round() {
    // A point robot over the corners (4, 1) and (6, 1) of a block: two legs and a side. The planner's polygon
    // gives way by a part of ε = 1e-8.
    let block = Shape::Polygon(vec![[4.0, -3.0], [6.0, -3.0], [6.0, 1.0], [4.0, 1.0]]);
    let (plan, status, best) = solve(&with(scene(&[]), block.clone()), &mut Run::new(1));
    let expected = 2.0 * 17.0_f64.sqrt() + 2.0;
    assert_eq!(status, Status::Solved);
    assert!((plan.cost - expected).abs() < 2e-8, "{}", plan.cost);
    assert!(best.unwrap() <= plan.cost);
    // A robot of radius 1/2: corners become arcs. Tangent from (0, 0) to the circle at (4, 1).
    let mut robot = with(scene(&[]), block);
    robot.robot_radius = 0.5;
    let leg = (17.0_f64 - 0.25).sqrt();
    let rise = (1.0_f64 / 4.0).atan() + (0.5 / 17.0_f64.sqrt()).asin();
    let (plan, _, best) = solve(&robot, &mut Run::new(1));
    assert!((plan.cost - (2.0 * leg + 2.0 + 2.0 * 0.5 * rise)).abs() < 2e-8, "{}", plan.cost);
    assert!(best.unwrap() <= plan.cost);
    // Over a capsule whose axis is on the line: tangents of √15 that rise by asin(1/4).
    let capsule = Shape::Capsule { from: [4.0, 0.0], to: [6.0, 0.0], radius: 1.0 };
    let (plan, _, _) = solve(&with(scene(&[]), capsule), &mut Run::new(1));
    let expected = 2.0 * 15.0_f64.sqrt() + 2.0 + 2.0 * (0.25_f64).asin();
    assert!((plan.cost - expected).abs() < 2e-8, "{}", plan.cost);
    // A capsule without length is a disc.
    let dot = Shape::Capsule { from: [5.0, 0.1], to: [5.0, 0.1], radius: 1.0 };
    let (dotted, status, best) = solve(&with(scene(&[]), dot), &mut Run::new(1));
    assert_eq!((status, best.is_ok()), (Status::Solved, true));
    assert_eq!(dotted.cost, solve(&scene(&[[5.0, 0.1]]), &mut Run::new(1)).0.cost);
}

#[test]
fn the_field_decides_the_side() {
    let mut scene = scene(&[[5.0, 0.1]]);
    let field = |low: f64| Some(Field { min: [-1.0, low], max: [11.0, 5.0] });
    // The arc's lowest point is at −0.9; above it is longer.
    scene.field = field(-0.900_001);
    let (below, status, best) = solve(&scene, &mut Run::new(1));
    assert_eq!((status, best.is_ok()), (Status::Solved, true));
    assert!(below.path.iter().any(|p| p.y < -0.8));
    scene.field = field(-0.899_9);
    let (above, status, best) = solve(&scene, &mut Run::new(1));
    assert_eq!(status, Status::Solved);
    assert!(above.path.iter().all(|p| p.y > -0.01) && above.cost > below.cost);
    assert!(best.unwrap() <= above.cost);
    // Another disc between the first and the upper border: closed.
    scene.obstacles.push(Obstacle::disc(Point::new(5.0, 3.0), 2.1));
    let (_, status, best) = solve(&scene, &mut Run::new(1));
    assert_eq!((status, best), (Status::Infeasible, Err(NoOptimum::Infeasible)));
}

#[test]
fn a_closed_ring_is_infeasible_whatever_else_there_is() {
    let ring: Vec<[f64; 2]> =
        (0..8).map(|i| f64::from(i) * FRAC_PI_4).map(|a| [2.4 * a.cos(), 2.4 * a.sin()]).collect();
    let (plan, status, best) = solve(&with(scene(&ring), square(8.0, -0.5)), &mut Run::new(1));
    assert_eq!((status, best), (Status::Infeasible, Err(NoOptimum::Infeasible)));
    assert!(plan.path.is_empty() && plan.cost.is_infinite());
}

#[test]
fn touching_ends_are_no_trouble() {
    // Start and goal on borders, the discs touching one another as well; and
    // nearly ε/2 (6e-9) inside, which a problem grants.
    for depth in [0.0, 4e-9, -4e-9] {
        let discs = scene(&[[1.0 - depth, 0.0], [3.0, 0.0], [9.0 + depth, 0.0]]);
        let (plan, status, best) = solve(&discs, &mut Run::new(1));
        assert_eq!(status, Status::Solved);
        // A quarter of the first disc, the common tangent of all three, a quarter of the last.
        // Moving the ends' discs by 4e-9 moves their borders by as much.
        assert!((plan.cost - (std::f64::consts::PI + 8.0)).abs() < 5e-8, "{}", plan.cost);
        assert!(best.unwrap() <= plan.cost);
    }
}

/// A lattice of discs, shifted row by row, and a wall across, so that the way is much longer than straight.
fn forest() -> Scene {
    let mut scene = scene(&[]);
    scene.goal = [61.0, 59.5];
    for i in 0..900 {
        let (row, column) = (f64::from(i / 30), f64::from(i % 30));
        let centre = Point::new(2.0 * column + 1.3 + (row * 0.618).fract(), 2.0 * row + 0.9 + (column * 0.755).fract());
        scene.obstacles.push(Obstacle::disc(centre, 0.55 + 0.3 * (f64::from(i) * 0.57).fract()));
    }
    with(scene, Shape::Capsule { from: [22.0, 40.0], to: [40.0, 22.0], radius: 0.5 })
}

#[test]
fn budgets_are_kept() {
    let scene = forest();
    let full = {
        let mut run = Run::new(1);
        let (plan, status, _) = solve(&scene, &mut run);
        assert_eq!(status, Status::Solved);
        plan.counters
    };
    for part in [0, 1, 2, full.iterations / 2, full.iterations - 1, full.iterations] {
        let mut run = Run::new(1).with_budget(Budget { iterations: Some(part), ..Budget::default() });
        let (plan, status, _) = solve(&scene, &mut run);
        assert_eq!(status == Status::Solved, part == full.iterations, "{part} iterations");
        assert_eq!(plan.path.is_empty(), status == Status::BudgetSpent);
        assert_eq!(plan.counters.iterations, part);
    }
    for part in (0..40).chain([full.evaluations / 2]) {
        let mut run = Run::new(1).with_budget(Budget { evaluations: Some(part), ..Budget::default() });
        let (plan, status, _) = solve(&scene, &mut run);
        assert_eq!((status, plan.counters.evaluations), (Status::BudgetSpent, part));
    }
}

#[test]
fn a_deadline_is_kept_within_a_step() {
    let scene = forest();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut planner = Tangent::new(Settings::default()).unwrap();
    let mut over: Vec<Duration> = (0..15)
        .map(|_| {
            let deadline = Instant::now() + Duration::from_micros(300);
            let mut run = Run::new(1).with_budget(Budget { deadline: Some(deadline), ..Budget::default() });
            planner.plan(&problem, &mut run).unwrap();
            Instant::now().saturating_duration_since(deadline)
        })
        .collect();
    over.sort();
    // The median, because the machine may be busy.
    assert!(over[7] < Duration::from_millis(1), "{over:?}");
}

#[test]
fn used_and_fresh_planners_agree_bit_for_bit() {
    let mut used = Tangent::new(Settings::default()).unwrap();
    for scene in [forest(), scene(&[[5.0, 0.1]]), forest(), scene(&[])] {
        let world = World::new(&scene).unwrap();
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        let mut fresh = Tangent::new(Settings::default()).unwrap();
        assert_eq!(
            used.plan(&problem, &mut Run::new(1)).unwrap(),
            fresh.plan(&problem, &mut Run::new(2)).unwrap(),
            "the seed does not matter either"
        );
    }
}

#[derive(Default)]
struct Film {
    frames: Vec<(u64, f64, Vec<Point>)>,
    stop_after: Option<usize>,
}

impl Observer for Film {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        let View::Trees([tree]) = frame.view else { panic!("{frame:?}") };
        assert_eq!(frame.stage, "tangent");
        assert_eq!(tree.nodes.len(), tree.parents.len());
        assert!(tree.parents.iter().enumerate().all(|(i, &parent)| (parent as usize) < i.max(1)));
        self.frames.push((frame.iteration, frame.best_cost, tree.nodes.to_vec()));
        if self.stop_after == Some(self.frames.len()) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn frames_show_the_tree_as_it_grows() {
    let scene = forest();
    let mut film = Film::default();
    let (plan, _, _) = solve(&scene, &mut Run::new(1).with_observer(&mut film));
    let frames = &film.frames;
    assert_eq!(frames.len() as u64, plan.counters.iterations + 1);
    for (i, (iteration, cost, nodes)) in frames.iter().enumerate() {
        assert_eq!(*iteration, i as u64);
        assert_eq!(nodes[0], scene.start());
        assert!(i == 0 || nodes.starts_with(&frames[i - 1].2));
        assert_eq!(cost.is_finite(), i + 1 == frames.len());
    }
    assert_eq!(frames.last().unwrap().2.len() as u64, 2 * plan.counters.evaluations - 1);

    let mut film = Film { stop_after: Some(2), ..Film::default() };
    let (plan, status, _) = solve(&scene, &mut Run::new(1).with_observer(&mut film));
    assert_eq!((status, film.frames.len(), plan.path.len()), (Status::BudgetSpent, 2, 0));
}

#[test]
fn settings_are_checked() {
    for excess in [0.0, -1.0, f64::NAN, f64::INFINITY, 0.2] {
        let error = Tangent::new(Settings { excess }).unwrap_err();
        assert_eq!(error.key, "excess");
    }
    assert_eq!(toml::from_str::<Settings>("").unwrap(), Settings::default());
    assert_eq!(toml::from_str::<Settings>("excess = 1e-4").unwrap().excess, 1e-4);
    assert!(toml::from_str::<Settings>("exces = 1e-4").is_err());
}
