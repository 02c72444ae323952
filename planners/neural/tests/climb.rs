//! Paths over the activity.

use env_model::generate::{Generator, generate};
use env_model::scene::Field;
use env_model::{CellGrid, Obstacle, Point, Scene, Shape, World};
use planner_api::{Budget, Plan, PlanError, Planner, Problem, Run, Status};
use planner_neural::{Network, Neural, NeuralSettings};

fn scene(size: [f64; 2], start: [f64; 2], goal: [f64; 2], obstacles: Vec<Obstacle>) -> Scene {
    Scene {
        name: "field".into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start,
        goal,
        field: Some(Field { min: [0.0, 0.0], max: size }),
        obstacles,
    }
}

fn polygon(corners: &[[f64; 2]]) -> Obstacle {
    Shape::Polygon(corners.to_vec()).into()
}

fn plan_in(scene: &Scene, cells: usize, run: &mut Run<'_>) -> Result<(Plan, Status), PlanError> {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let settings = NeuralSettings { cells, ..NeuralSettings::default() };
    let (plan, status) = Neural::new(settings).unwrap().plan(&problem, run)?;
    assert!(world.path_free(&plan.path));
    Ok((plan, status))
}

fn plan(scene: &Scene, cells: usize) -> (Plan, Status) {
    plan_in(scene, cells, &mut Run::new(1)).unwrap()
}

#[test]
fn from_every_cell_the_activity_leads_up_to_the_goal() {
    let settings = NeuralSettings::default();
    for index in 0..3 {
        let scene = generate(Generator::Scrum, None, 9, index).unwrap();
        let world = World::new(&scene).unwrap();
        let grid = CellGrid::along_longer_side(&world.extent(), 60);
        let mut network = Network::default();
        network.lay(&world, &grid, &settings, || true);
        let goal = grid.cell_at(scene.goal());
        network.excite(goal, &settings);
        assert!((0..1000).any(|k| network.sweep(k % 2 == 0, &settings) <= settings.tolerance));
        let active: Vec<usize> = (0..grid.len()).filter(|c| network.activity()[*c] > 0.0).collect();
        assert!(active.len() > grid.len() / 2);
        for cell in active {
            let mut at = cell;
            while let Some(next) = network.uphill(at) {
                assert!(network.activity()[next] > network.activity()[at]);
                at = next;
            }
            assert_eq!(at, goal, "the climb from {cell} stops");
        }
    }
}

#[test]
fn in_the_open_it_goes_straight_or_diagonally() {
    let straight = plan(&scene([10.0, 6.0], [1.5, 2.5], [8.5, 2.5], Vec::new()), 10).0;
    assert_eq!(straight.path, (1..=8).map(|x| Point::new(f64::from(x) + 0.5, 2.5)).collect::<Vec<_>>());
    assert_eq!(straight.cost, 7.0);
    let diagonal = plan(&scene([10.0, 10.0], [1.5, 1.5], [8.5, 8.5], Vec::new()), 10).0;
    assert_eq!(diagonal.path, (1..=8).map(|x| Point::new(f64::from(x) + 0.5, f64::from(x) + 0.5)).collect::<Vec<_>>());
}

#[test]
fn it_leaves_a_trap_and_cuts_no_corner() {
    // A U of unit cells, open towards the start: in its mouth the goal is near and out of reach.
    let u = polygon(&[[3.0, 2.0], [7.0, 2.0], [7.0, 7.0], [3.0, 7.0], [3.0, 6.0], [6.0, 6.0], [6.0, 3.0], [3.0, 3.0]]);
    let (plan, status) = plan(&scene([10.0, 9.0], [4.5, 4.5], [8.5, 4.5], vec![u]), 10);
    assert_eq!(status, Status::Solved);
    // The shortest way in moves, either way round: out of the mouth to (2.5, 3.5), 1 + √2; down past its
    // lower lip, whose corner may not be cut, to (2.5, 1.5), 2; below it to (7.5, 1.5), 5; up to the goal, √2 + 2.
    let by_hand = 10.0 + 2.0 * 2.0_f64.sqrt();
    // Twelve rounded lengths.
    assert!((plan.cost - by_hand).abs() < 1e-12, "{} is not {by_hand}: {:?}", plan.cost, plan.path);
}

#[test]
fn a_closed_room_has_no_way_in() {
    let ring =
        polygon(&[[6.0, 1.0], [9.0, 1.0], [9.0, 4.0], [6.0, 4.0], [6.0, 3.0], [8.0, 3.0], [8.0, 2.0], [6.0, 2.0]]);
    let lid = polygon(&[[5.5, 1.5], [6.0, 1.5], [6.0, 3.5], [5.5, 3.5]]);
    let (plan, status) = plan(&scene([10.0, 5.0], [1.5, 2.5], [7.0, 2.5], vec![ring, lid]), 20);
    assert_eq!((status, plan.path.len(), plan.cost), (Status::NotFound, 0, f64::INFINITY));
}

#[test]
fn where_activity_leaves_the_range_of_numbers_the_goal_is_not_felt() {
    // One row of 400 cells. Activity falls by 5 + √24 = 9.9 a cell, from 0.9: it is a normal
    // number for log(10³⁰⁸/2.2)/log(9.9) = 309 cells.
    let along = |cells: f64| plan(&scene([400.0, 1.0], [0.5 + cells, 0.5], [0.5, 0.5], Vec::new()), 400);
    let (near, status) = along(305.0);
    assert_eq!((status, near.path.len()), (Status::Solved, 306));
    assert_eq!(along(313.0).1, Status::NotFound);
}

#[test]
fn ends_beside_obstacles_join_by_free_cells_in_sight() {
    // Start's and goal's cells are blocked in part: the path joins the grid by neighbours, the start by
    // the most active one that it sees (not the one straight ahead, which is behind the disc).
    let beside = |x: f64, y: f64, radius: f64| Obstacle::disc(Point::new(x, y), radius);
    let obstacles = vec![beside(1.75, 2.75, 0.2), beside(8.7, 2.7, 0.4)];
    let (plan, status) = plan(&scene([10.0, 6.0], [1.2, 2.7], [8.2, 2.2], obstacles), 10);
    assert_eq!(status, Status::Solved);
    assert_eq!((plan.path[0], plan.path[plan.path.len() - 1]), (Point::new(1.2, 2.7), Point::new(8.2, 2.2)));
    assert_eq!(plan.path[1].x, 2.5, "{}", plan.path[1]);
    // The same with a wall on either side of the goal: no free cell in sight.
    let left = polygon(&[[7.5, 0.0], [8.1, 0.0], [8.1, 6.0], [7.5, 6.0]]);
    let right = polygon(&[[8.3, 0.0], [8.9, 0.0], [8.9, 6.0], [8.3, 6.0]]);
    let narrow = scene([10.0, 6.0], [1.2, 2.7], [8.2, 2.2], vec![left, right]);
    let error = plan_in(&narrow, 10, &mut Run::new(1)).unwrap_err();
    assert!(matches!(error, PlanError::GridTooCoarse { key: "cells", value: 10, end: "goal", .. }), "{error}");
}

#[test]
fn a_budget_of_evaluations_counts_neurons() {
    let scene = scene([10.0, 6.0], [1.5, 2.5], [8.5, 2.5], Vec::new());
    let limited = |evaluations: u64| {
        let budget = Budget { evaluations: Some(evaluations), ..Budget::default() };
        plan_in(&scene, 10, &mut Run::new(1).with_budget(budget)).unwrap()
    };
    let (none, status) = limited(59);
    assert_eq!((status, none.path.len(), none.counters.iterations), (Status::BudgetSpent, 0, 0), "a grid of 60");
    let (two, status) = limited(150);
    assert_eq!((status, two.counters.iterations, two.counters.evaluations), (Status::BudgetSpent, 2, 120));
    assert_eq!(two.path.len(), 8, "the second sweep has brought activity to the start");
}
