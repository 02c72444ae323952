//! Settings, readings and what observers see.

use std::ops::ControlFlow;

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Shape, World};
use planner_api::{
    Budget, CellState, Frame, Observer, Plan, PlanError, Planner, Problem, Run, SettingError, Status, View,
};
use planner_influence_astar::{Heuristic, InfluenceAstar, Obstacles, SearchSpace, Settings};

fn scene(obstacles: Vec<Obstacle>) -> Scene {
    Scene {
        name: "pitch".into(),
        unit: "cells".into(),
        robot_radius: 0.0,
        start: [10.2, 18.3],
        goal: [50.4, 18.6],
        field: Some(Field { min: [0.0, 0.0], max: [61.0, 36.0] }),
        obstacles,
    }
}

fn disc(x: f64, y: f64, label: Option<&str>) -> Obstacle {
    Obstacle { label: label.map(Into::into), ..Obstacle::disc(Point::new(x, y), 0.4) }
}

fn solve_with(settings: Settings, scene: &Scene, mut run: Run<'_>) -> Result<(Plan, Status), PlanError> {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    InfluenceAstar::new(settings).unwrap().plan(&problem, &mut run)
}

fn solve(settings: Settings, scene: &Scene) -> (Plan, Status) {
    solve_with(settings, scene, Run::new(0)).unwrap()
}

#[test]
fn bad_settings_are_errors_by_name() {
    let good = Settings::default;
    let nan = f64::NAN;
    let cases = [
        ("a", Settings { a: -0.1, ..good() }),
        ("a", Settings { a: nan, ..good() }),
        ("b", Settings { b: f64::INFINITY, ..good() }),
        ("b", Settings { a: 0.0, b: 0.0, ..good() }),
        ("columns", Settings { columns: 0, ..good() }),
        ("rows", Settings { rows: 1001, ..good() }),
        ("dis", Settings { dis: 0.0, ..good() }),
        ("dis", Settings { dis: nan, ..good() }),
        ("delta", Settings { delta: -5.0, ..good() }),
        ("kernel", Settings { kernel: vec![100.0, nan], ..good() }),
        ("kernel", Settings { kernel: vec![60.0, 100.0], ..good() }),
        ("kernel", Settings { kernel: vec![-1.0], ..good() }),
        ("theta", Settings { theta: nan, ..good() }),
        ("theta", Settings { theta: f64::INFINITY, ..good() }),
        ("eta", Settings { eta: nan, ..good() }),
        // Too small: quanta of them would be infinite, or the other way round nothing.
        ("a", Settings { a: 1e-310, b: 0.0, ..good() }),
        ("a", Settings { a: 1e-10, b: 0.0, ..good() }),
        ("a", Settings { a: 1e-12, ..good() }),
        ("a", Settings { a: 1e-9, b: 1e6, ..good() }),
        ("b", Settings { a: 0.0, b: 1e-310, ..good() }),
        ("delta", Settings { a: 0.0, b: 1.0, delta: 1e-310, kernel: Vec::new(), ..good() }),
        ("kernel", Settings { kernel: vec![100.0, 1e-310], ..good() }),
        ("dis", Settings { dis: 1e-305, b: 0.0, ..good() }),
        ("dis", Settings { a: 0.0, b: 1.0, dis: 1e-310, ..good() }),
        ("dis", Settings { dis: 1e7, ..good() }),
        ("eta", Settings { eta: 1.5, ..good() }),
        ("widening", Settings { widening: 0, ..good() }),
    ];
    for (key, settings) in cases {
        let error: SettingError = InfluenceAstar::new(settings.clone()).map(drop).unwrap_err();
        assert_eq!(error.key, key, "{settings:?}");
    }
    assert_eq!(good().validate(), Ok(()));
    assert_eq!(Settings { kernel: Vec::new(), b: 0.0, ..good() }.validate(), Ok(()));
}

#[test]
fn the_smallest_and_the_largest_settings_find_paths_of_the_same_worth() {
    let pitch = scene(vec![disc(30.5, 18.5, None), disc(40.5, 9.5, None)]);
    let base = Settings { search_space: SearchSpace::Pitch, heuristic: Heuristic::Ring, ..Settings::default() };
    // L in cells and W in levels, to a millionth: paths may tie, sums of equal ones round differently.
    let measure = |settings: Settings| {
        let (plan, status) = solve(settings.clone(), &pitch);
        assert_eq!(status, Status::Solved, "{settings:?}");
        [plan.terms[0].1 / settings.dis, plan.terms[1].1 / settings.delta].map(|sum| (sum * 1e6).round())
    };
    let shortest = measure(Settings { a: 1.0, b: 0.0, ..base.clone() });
    for (a, dis) in [(1e-9, 30.0), (1e-9, 1e-6), (1e6, 1e6)] {
        assert_eq!(measure(Settings { a, b: 0.0, dis, ..base.clone() }), shortest, "a = {a}, dis = {dis}");
    }
    let safest = measure(Settings { a: 0.0, b: 1.0, ..base.clone() });
    for (b, dis) in [(1e-9, 30.0), (1.0, 1e-6), (1e6, 1e6)] {
        assert_eq!(measure(Settings { a: 0.0, b, dis, ..base.clone() }), safest, "b = {b}, dis = {dis}");
    }
    // The least a that counts decides as ties do at a = 0: risks differ by 5 or not at all, a·L by less than 1e-5.
    assert_eq!(measure(Settings { a: 1e-9, b: 1.0, ..base.clone() }), safest);
    // Levels alone, as small and as large as can be.
    let levels = |b, delta| measure(Settings { a: 0.0, b, delta, kernel: Vec::new(), ..base.clone() });
    assert_eq!(levels(1e-9, 1e-9), levels(1.0, 5.0));
    assert_eq!(levels(1e6, 1e6), levels(1.0, 5.0));
}

#[test]
fn opponents_are_the_defenders_where_any_are_named() {
    let pitch = Settings { search_space: SearchSpace::Pitch, ..Settings::default() };
    let mixed = scene(vec![disc(30.5, 18.5, Some("team-mate 4")), disc(30.5, 30.5, Some("opponent 4"))]);
    let (plan, status) = solve(pitch.clone(), &mixed);
    // The team-mate blocks its cell but frightens nobody: the path passes next to it.
    let near = plan.path.iter().map(|p| (p - Point::new(30.5, 18.5)).norm()).fold(f64::INFINITY, f64::min);
    assert!(status == Status::Solved && near < 2.0, "{near}");
    let unnamed = scene(vec![disc(30.5, 18.5, None), disc(30.5, 30.5, None)]);
    let (plan, _) = solve(pitch, &unnamed);
    let near = plan.path.iter().map(|p| (p - Point::new(30.5, 18.5)).norm()).fold(f64::INFINITY, f64::min);
    assert!(near > 2.5, "all are defenders: {near}");
}

#[test]
fn the_middles_of_capsules_and_of_polygons_boxes_defend() {
    let at = |shape: Shape| {
        let (plan, _) = solve(
            Settings { obstacles: Obstacles::Soft, search_space: SearchSpace::Pitch, ..Settings::default() },
            &scene(vec![shape.into()]),
        );
        plan.terms
    };
    let centre = [30.5, 25.5];
    let expected = at(Shape::Disc { centre, radius: 0.4 });
    assert_eq!(at(Shape::Capsule { from: [28.5, 24.5], to: [32.5, 26.5], radius: 0.2 }), expected);
    assert_eq!(at(Shape::Polygon(vec![[29.5, 24.5], [31.5, 25.0], [30.0, 26.5]])), expected);
}

#[test]
fn ends_in_blocked_cells_and_grids_too_coarse() {
    // Discs beside both ends: their cells are blocked, those next to them are not.
    let ends = scene(vec![disc(10.7, 18.8, None), disc(50.9, 18.1, None)]);
    let (plan, status) = solve(Settings { b: 0.0, search_space: SearchSpace::Pitch, ..Settings::default() }, &ends);
    assert_eq!((status, plan.path[0], plan.path[plan.path.len() - 1]), (Status::Solved, ends.start(), ends.goal()));
    let moves: f64 = plan.path[1..plan.path.len() - 1].windows(2).map(|w| (w[1] - w[0]).norm()).sum();
    let legs =
        (plan.path[1] - plan.path[0]).norm() + (plan.path[plan.path.len() - 1] - plan.path[plan.path.len() - 2]).norm();
    // Cells are 1 × 1, so L is 30 times the path's length; rounding of some fifty lengths.
    assert!((plan.terms[0].1 - 30.0 * (moves + legs)).abs() < 1e-9, "legs count where ends are out of their cells");

    // Walled in but for a slit one cell wide, through which no middle of a cell of side 12 can be seen.
    let wall = |from: [f64; 2], to: [f64; 2]| Obstacle::from(Shape::Capsule { from, to, radius: 0.1 });
    let cage = scene(vec![
        wall([7.9, 16.0], [12.0, 16.0]),
        wall([12.0, 16.0], [12.0, 20.0]),
        wall([9.1, 20.0], [12.0, 20.0]),
        wall([7.9, 16.0], [7.9, 20.0]),
    ]);
    let coarse = Settings { columns: 5, rows: 3, ..Settings::default() };
    match solve_with(coarse, &cage, Run::new(0)) {
        Err(PlanError::GridTooCoarse { key: "columns", value: 5, size, end: "start", .. }) => assert_eq!(size, 12.2),
        other => panic!("{other:?}"),
    }
    assert_eq!(solve(Settings::default(), &cage).1, Status::Solved, "cells of side 1 pass the slit");
}

#[test]
fn no_way_through_is_not_found_and_a_rectangle_without_one_is_widened() {
    let wall = |to: f64| scene(vec![Shape::Capsule { from: [30.0, 0.0], to: [30.0, to], radius: 0.5 }.into()]);
    let (plan, status) = solve(Settings::default(), &wall(36.0));
    assert_eq!((status, plan.path.len(), plan.cost, plan.terms.len()), (Status::NotFound, 0, f64::INFINITY, 0));
    // Start and goal are in one row, so the rectangle holds no way round.
    let (plan, status) = solve(Settings { theta: f64::MAX, ..Settings::default() }, &wall(30.0));
    assert_eq!(status, Status::Solved);
    assert!(plan.path.iter().any(|p| p.y > 30.0));
}

#[test]
fn a_spent_budget_returns_the_best_so_far() {
    let pitch = scene(vec![disc(30.5, 18.5, None)]);
    let settings = Settings { search_space: SearchSpace::Rectangle, theta: 0.0, eta: 0.0, ..Settings::default() };
    let (full, _) = solve(settings.clone(), &pitch);
    let budget = Budget { iterations: Some(full.counters.iterations - 1), ..Budget::default() };
    let (cut, status) = solve_with(settings, &pitch, Run::new(0).with_budget(budget)).unwrap();
    assert_eq!(status, Status::BudgetSpent);
    assert!(!cut.path.is_empty() && cut.cost >= full.cost, "an earlier rectangle had a path");
    assert_eq!(cut.counters.iterations, full.counters.iterations - 1);
}

/// Checks every view and remembers the last.
#[derive(Default)]
struct Watch {
    closed: usize,
    path: Vec<Point>,
}

impl Observer for Watch {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        let View::Cells(view) = frame.view else { panic!("shows cells") };
        let n = 61 * 36;
        assert_eq!((view.grid.len(), view.blocked.len(), view.states.len(), view.values.len()), (n, n, n, n));
        assert_eq!((view.quantity, view.borders.len()), ("risk", 2));
        self.closed = view.states.iter().filter(|s| **s == CellState::Closed).count();
        assert!(view.states.iter().zip(view.blocked).all(|(s, b)| !b || *s == CellState::Untouched));
        self.path = view.path.to_vec();
        ControlFlow::Continue(())
    }
}

#[test]
fn observers_see_risk_borders_states_and_path() {
    let pitch = scene(vec![disc(30.5, 18.5, None), disc(40.5, 9.5, None)]);
    let settings = Settings { search_space: SearchSpace::Pitch, heuristic: Heuristic::Ring, ..Settings::default() };
    let mut watch = Watch::default();
    let (plan, status) = solve_with(settings, &pitch, Run::new(0).with_observer(&mut watch)).unwrap();
    assert_eq!(status, Status::Solved);
    assert_eq!(watch.path, plan.path);
    // A consistent heuristic reopens nothing: every iteration closes another cell.
    assert_eq!(watch.closed as u64, plan.counters.iterations);
}
