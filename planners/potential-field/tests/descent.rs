//! Where the descent arrives, and the faults that it is known for.

use std::ops::ControlFlow;

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, World};
use planner_api::{Budget, Frame, Observer, Plan, Planner, Problem, Run, Status, View};
use planner_potential_field::{PotentialField, PotentialFieldSettings, Repulsion};

/// A field 12 × 5 round the origin: its diagonal is 13, so ρ0 is 0.65 and a step 0.026.
fn scene(start: [f64; 2], goal: [f64; 2], obstacles: Vec<Obstacle>) -> Scene {
    Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start,
        goal,
        field: Some(Field { min: [-6.0, -2.5], max: [6.0, 2.5] }),
        obstacles,
    }
}

const REACH: f64 = 0.65;
const STEP: f64 = 0.026;

fn plan_with(settings: PotentialFieldSettings, scene: &Scene, run: &mut Run<'_>) -> (Plan, Status) {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let (plan, status) = PotentialField::new(settings).unwrap().plan(&problem, run).unwrap();
    assert!(world.path_free(&plan.path));
    (plan, status)
}

fn plan(scene: &Scene) -> (Plan, Status) {
    plan_with(PotentialFieldSettings::default(), scene, &mut Run::new(1))
}

fn stuck(plan: &Plan) -> Point {
    let [("stuck_x", x), ("stuck_y", y)] = plan.terms[..] else { panic!("{:?}", plan.terms) };
    Point::new(x, y)
}

/// Where f changes its sign between `low` and `high`.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(f(low) * f(high) < 0.0);
    for _ in 0..100 {
        let mid = 0.5 * (low + high);
        if f(low) * f(mid) > 0.0 { low = mid } else { high = mid }
    }
    low
}

#[test]
fn without_obstacles_the_way_is_straight() {
    let (plan, status) = plan(&scene([-4.0, 0.5], [4.0, 0.5], Vec::new()));
    assert_eq!((status, plan.terms.len()), (Status::Solved, 0));
    // 8 m in steps of 0.026: 307 of them leave 0.018, which is the last.
    assert_eq!((plan.counters.iterations, plan.counters.evaluations, plan.path.len()), (308, 308, 309));
    // Each of 308 lengths is rounded once.
    assert!((plan.cost - 8.0).abs() < 308.0 * 8.0 * f64::EPSILON);
    assert_eq!(plan.path[308], Point::new(4.0, 0.5));
}

#[test]
fn it_slides_past_an_obstacle_beside_the_line() {
    let (plan, status) = plan(&scene([-4.0, 0.2], [4.0, 0.2], vec![Obstacle::disc(Point::origin(), 0.5)]));
    assert_eq!(status, Status::Solved);
    assert!(plan.path.iter().all(|p| p.coords.norm() > 0.5) && plan.cost > 8.0 && plan.cost < 9.0, "{}", plan.cost);
}

#[test]
fn head_on_it_stops_where_the_forces_cancel() {
    // On the axis of symmetry no force pushes sideways: attraction 1 (the cone)
    // against 0.1 (1/ρ − 1)/ρ², ρ in reaches.
    let rho = root(|r| 0.1 * (1.0 / r - 1.0) / (r * r) - 1.0, 0.1, 1.0);
    let (plan, status) = plan(&scene([-4.0, 0.0], [4.0, 0.0], vec![Obstacle::disc(Point::origin(), 0.5)]));
    assert_eq!((status, plan.path.len(), plan.cost), (Status::NotFound, 0, f64::INFINITY));
    let expected = Point::new(-0.5 - rho * REACH, 0.0);
    assert_eq!(stuck(&plan).y, 0.0);
    // Steps of fixed length go back and forth over the minimum.
    assert!((stuck(&plan) - expected).norm() <= STEP, "{} is not {expected}", stuck(&plan));
}

/// Keeps what the last frame shows.
#[derive(Default)]
struct Last {
    frames: u64,
    stuck: Option<Point>,
    trail: Vec<Point>,
}

impl Observer for Last {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        let View::Forces(view) = frame.view else { panic!("{:?}", frame.view) };
        assert_eq!((view.grid.columns(), view.forces.len()), (40, view.grid.len()));
        self.frames += 1;
        self.stuck = view.stuck;
        self.trail = view.trail.to_vec();
        ControlFlow::Continue(())
    }
}

#[test]
fn a_u_catches_it_and_observers_see_where() {
    let corners =
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, 0.8], [0.8, 0.8], [0.8, -0.8], [-1.0, -0.8]];
    let scene = scene([-4.0, 0.1], [4.0, 0.0], vec![Shape::Polygon(corners.to_vec()).into()]);
    for repulsion in [Repulsion::Khatib, Repulsion::GeCui] {
        let mut last = Last::default();
        let settings = PotentialFieldSettings { repulsion, ..PotentialFieldSettings::default() };
        let (plan, status) = plan_with(settings, &scene, &mut Run::new(1).with_observer(&mut last));
        assert_eq!((status, plan.path.len()), (Status::NotFound, 0));
        let at = stuck(&plan);
        assert!(at.x > -1.0 && at.x < 0.8 && at.y.abs() < 0.8, "{at} is not in the U");
        assert_eq!((last.stuck, last.trail.last(), last.trail[0]), (Some(at), Some(&at), scene.start()));
        assert_eq!(last.frames, plan.counters.iterations + 1);
        assert!(plan.counters.iterations < 1000, "noticed long before the steps run out");
    }
}

#[test]
fn a_goal_beside_an_obstacle_is_out_of_reach_but_for_ge_and_cui() {
    // The goal is half a reach before a disc, on the line. Khatib's forces cancel at
    // the distance d before it where d = 0.1 (1/ρ − 1)/ρ², ρ = 0.5 + d.
    let balance = |d: f64| 0.1 * (1.0 / (0.5 + d) - 1.0) / ((0.5 + d) * (0.5 + d)) - d;
    let d = root(balance, 0.0, 0.5) * REACH;
    assert!(d > 2.0 * STEP, "else the goal would be in reach after all: {d}");
    let scene = scene([-4.0, 0.0], [2.0, 0.0], vec![Obstacle::disc(Point::new(2.0 + 0.5 * REACH + 0.4, 0.0), 0.4)]);
    let (failed, status) = plan(&scene);
    assert_eq!(status, Status::NotFound);
    assert!((stuck(&failed) - Point::new(2.0 - d, 0.0)).norm() <= STEP, "{}", stuck(&failed));
    let settings = PotentialFieldSettings { repulsion: Repulsion::GeCui, ..PotentialFieldSettings::default() };
    let (_, status) = plan_with(settings, &scene, &mut Run::new(1));
    assert_eq!(status, Status::Solved);
}

#[test]
fn a_step_into_an_obstacle_is_halved_and_then_given_up() {
    // Nothing repels: the robot runs into the disc, 3.5 away, in steps of 1.3.
    let settings = PotentialFieldSettings { repulsion_gain: 0.0, step: 0.1, ..PotentialFieldSettings::default() };
    let scene = scene([-4.0, 0.0], [4.0, 0.0], vec![Obstacle::disc(Point::origin(), 0.5)]);
    let (plan, status) = plan_with(settings, &scene, &mut Run::new(1));
    assert_eq!(status, Status::NotFound);
    let left = -0.5 - stuck(&plan).x;
    // The last step that was refused was a 256th; touching is allowed within the world's slack of 7e-9.
    assert!(left > -1e-8 && left < 1.3 / 256.0 + 1e-8, "{left}");
    assert!(plan.counters.collision_checks > plan.counters.iterations);
}

#[test]
fn the_last_step_is_a_place_to_be_stuck_too() {
    let scene = scene([-4.0, 0.5], [4.0, 0.5], Vec::new());
    let settings = PotentialFieldSettings { steps: 10, ..PotentialFieldSettings::default() };
    let (plan, status) = plan_with(settings, &scene, &mut Run::new(1));
    assert_eq!((status, plan.counters.iterations), (Status::NotFound, 10));
    assert!((stuck(&plan).x - (-4.0 + 10.0 * STEP)).abs() < 1e-12, "ten rounded steps");
    let budget = Budget { iterations: Some(10), ..Budget::default() };
    let run = &mut Run::new(1).with_budget(budget);
    let (plan, status) = plan_with(PotentialFieldSettings::default(), &scene, run);
    assert_eq!(
        (status, plan.counters.iterations, plan.terms.len()),
        (Status::BudgetSpent, 10, 0),
        "a budget is no trap"
    );
}

#[test]
fn the_scale_of_a_scene_does_not_matter() {
    // Powers of two leave every digit as it is.
    let scaled = |factor: f64| {
        let disc = |x: f64, y: f64, r: f64| Obstacle::disc(Point::new(x, y) * factor, r * factor);
        let mut scene = scene(
            [-4.0 * factor, 0.3 * factor],
            [4.0 * factor, 0.1 * factor],
            vec![disc(-1.0, 0.0, 0.5), disc(1.5, 0.75, 0.5)],
        );
        scene.robot_radius = 0.125 * factor;
        scene.field = Some(Field { min: [-6.0 * factor, -2.5 * factor], max: [6.0 * factor, 2.5 * factor] });
        plan(&scene)
    };
    let (one, status) = scaled(1.0);
    assert_eq!(status, Status::Solved);
    for factor in [1.0 / 1_048_576.0, 1024.0] {
        let (other, _) = scaled(factor);
        assert_eq!(other.path, one.path.iter().map(|p| p * factor).collect::<Vec<_>>(), "× {factor}");
    }
}
