use env_model::Aabb;
use planner_api::Candidates;

use super::*;
use crate::testing::scene;

fn ruler() -> Ruler {
    Ruler::new(&scene("one"))
}

fn grid(columns: usize, rows: usize) -> CellGrid {
    let extent = Aabb { min: Point::new(0.0, -2.0), max: Point::new(10.0, 3.0) };
    CellGrid::covering(&extent, columns, rows)
}

fn frame(view: View<'_>) -> Frame<'_> {
    Frame { stage: "test", iteration: 3, evaluations: 4, best_cost: 1.0, view }
}

#[test]
fn points_come_back_within_half_a_step() {
    let ruler = ruler();
    for p in [Point::new(0.1, -0.7), Point::new(-123.4, 1e3), Point::new(10.0, 0.0)] {
        // A millionth of a step for the rounding of the map itself.
        let tolerance = (0.5 + 1e-6) * ruler.step;
        assert!((ruler.point(ruler.spot(p)) - p).abs().max() <= tolerance, "{p}");
    }
    // A picture is 500 units wide and shows at least the scene's box.
    assert!(ruler.step < 500.0 / 50.0 * scene("one").aabb().diagonal() / 500.0);
    assert_eq!(ruler.spot(Point::new(1e300, 0.0))[0], i32::MAX);
}

#[test]
fn marks_and_levels_of_cells() {
    let grid = grid(4, 2);
    let mut blocked = vec![false; 8];
    blocked[1] = true;
    let mut states = vec![CellState::Untouched; 8];
    (states[0], states[1], states[2]) = (CellState::Open, CellState::Closed, CellState::Closed);
    let values = [0.0, 127.0, 254.0, f64::INFINITY, 10.2, 0.0, 0.0, 50.0];
    let path = [Point::new(0.0, 0.0), Point::new(10.0, 0.0)];
    let view = CellsView {
        grid: &grid,
        blocked: &blocked,
        states: &states,
        values: &values,
        quantity: "risk",
        borders: &[(path[0], path[1])],
        path: &path,
    };
    let State::Cells { mesh, marks, heat: Some(heat), borders, path, .. } =
        state(&frame(View::Cells(view)), &ruler()).unwrap()
    else {
        panic!()
    };
    assert_eq!((mesh.columns, mesh.rows, mesh.size, mesh.every), (4, 2, 2.5, 1));
    assert_eq!(marks, "o#x.....");
    assert_eq!((heat.log, heat.min, heat.max), (false, 0.0, 254.0));
    assert_eq!(heat.levels, [0, 127, 254, NO_LEVEL, 10, 0, 0, 50]);
    assert_eq!((borders.len(), path.len()), (1, 2));
}

#[test]
fn wide_ranges_are_logarithmic() {
    let values = [0.0, 1e-4, 1e-3, 1e-2, 1.0, -5.0];
    let heat = Heat::of(&values, "activity").unwrap();
    assert_eq!((heat.log, heat.min, heat.max), (true, 1e-4, 1.0));
    // Four decades on 254 levels: 63.5 a decade.
    assert_eq!(heat.levels, [NO_LEVEL, 0, 64, 127, 254, NO_LEVEL]);
    let tiny = Heat::of(&[1e-300, 1e-200, 1.0], "activity").unwrap();
    assert_eq!((tiny.min, tiny.levels[0], tiny.levels[2]), (1e-140, 0, 254));
    assert_eq!(Heat::of(&[f64::NAN, f64::INFINITY], "risk"), None);
    assert_eq!(Heat::of(&[3.0, 3.0], "risk").unwrap().levels, [0, 0]);
    let huge = Heat::of(&[-f64::MAX, 0.0, f64::MAX], "risk").unwrap();
    assert_eq!(huge.levels, [0, 127, 254]);
}

#[test]
fn damaged_records_are_refused() {
    let grid = grid(4, 2);
    let values = [1.0; 8];
    let states = [CellState::Open; 8];
    let view = CellsView {
        grid: &grid,
        blocked: &[],
        states: &states,
        values: &values,
        quantity: "x",
        borders: &[],
        path: &[],
    };
    let whole = Snapshot {
        scene: "s".to_owned(),
        planner: "p".to_owned(),
        repeat: 0,
        seed: 1,
        stage: "test".to_owned(),
        iteration: 1,
        evaluations: 1,
        faithful: true,
        ruler: ruler(),
        state: state(&frame(View::Cells(view)), &ruler()).unwrap(),
        generations: Vec::new(),
    };
    assert_eq!(whole.check(), Ok(()));
    let damage = |change: &dyn Fn(&mut Mesh, &mut String, &mut Option<Heat>)| {
        let mut damaged = whole.clone();
        let State::Cells { mesh, marks, heat, .. } = &mut damaged.state else { panic!() };
        change(mesh, marks, heat);
        damaged.check().unwrap_err()
    };
    let said = damage(&|mesh, _, _| mesh.columns = 610_000_000);
    assert!(said.starts_with("of p in s: 610000000 × 2 cells; expected 1 to"), "{said}");
    damage(&|mesh, _, _| (mesh.columns, mesh.rows) = (usize::MAX, 2));
    damage(&|mesh, _, _| mesh.columns = 0);
    let said = damage(&|mesh, _, _| mesh.columns = 5);
    assert_eq!(said, "of p in s: 8 marks for 5 × 2 cells; expected 10");
    damage(&|_, marks, _| marks.truncate(7));
    damage(&|_, _, heat| heat.as_mut().unwrap().levels.push(0));
    let mut forces = whole.clone();
    let State::Cells { mesh, .. } = whole.state else { panic!() };
    forces.state = State::Forces { mesh, directions: vec![[0, 0]; 7], trail: Vec::new(), stuck: None };
    assert!(forces.check().is_err());
}

#[test]
fn large_grids_are_thinned() {
    let grid = grid(600, 301);
    let values: Vec<f64> = (0..grid.len()).map(|cell| grid.position(cell).0 as f64).collect();
    let view =
        CellsView { grid: &grid, blocked: &[], states: &[], values: &values, quantity: "x", borders: &[], path: &[] };
    let State::Cells { mesh, marks, heat: Some(heat), .. } = state(&frame(View::Cells(view)), &ruler()).unwrap() else {
        panic!()
    };
    assert_eq!((mesh.every, mesh.columns, mesh.rows, mesh.whole), (3, 200, 101, Some([600, 301])));
    assert!(marks.is_empty());
    assert_eq!(heat.levels.len(), mesh.count());
    assert_eq!((heat.min, heat.max), (1.0, 598.0), "the middle one of three");
}

#[test]
fn trees_are_cut_without_dangling() {
    let n = MOST_NODES + 5;
    let nodes: Vec<Point> = (0..n).map(|i| Point::new(i as f64, 0.0)).collect();
    let mut parents: Vec<u32> = (0..n).map(|i| i.saturating_sub(1) as u32).collect();
    parents[7] = n as u32 - 1; // rewired to a node that is cut off
    let view = [TreeView { nodes: &nodes, parents: &parents }];
    let State::Trees(trees) = state(&frame(View::Trees(&view)), &ruler()).unwrap() else { panic!() };
    assert_eq!((trees[0].nodes.len(), trees[0].parents.len(), trees[0].total), (MOST_NODES, MOST_NODES, n));
    assert_eq!((trees[0].parents[7], trees[0].parents[8]), (7, 7));
}

#[test]
fn forces_keep_their_direction() {
    let grid = grid(2, 2);
    let forces = [Vector::new(3e200, 4e200), Vector::zeros(), Vector::new(f64::NAN, 1.0), Vector::new(0.0, -1e-300)];
    let view = ForcesView { grid: &grid, forces: &forces, trail: &[], stuck: Some(Point::new(1.0, 1.0)) };
    let State::Forces { directions, stuck, .. } = state(&frame(View::Forces(view)), &ruler()).unwrap() else {
        panic!()
    };
    assert_eq!(directions, [[60, 80], [0, 0], [0, 0], [0, -100]]);
    assert!(stuck.is_some());
}

#[test]
fn a_population_survives_storing() {
    let mut paths = Candidates::default();
    (0..MOST_PATHS + 1).for_each(|k| paths.push([Point::new(0.0, k as f64), Point::new(f64::NAN, 0.0)]));
    let grid = grid(4, 2);
    let view = PopulationView { paths: &paths, fitness: &[], grid: Some(&grid), best: &[] };
    let state = state(&frame(View::Population(view)), &ruler()).unwrap();
    let State::Population { paths, total, .. } = &state else { panic!() };
    assert_eq!((paths.len(), paths[0].len(), *total), (MOST_PATHS, 1, MOST_PATHS + 1));
    let text = serde_json::to_string(&state).unwrap();
    assert_eq!(serde_json::from_str::<State>(&text).unwrap(), state);
}

#[test]
fn paths_alone_are_no_state() {
    assert_eq!(state(&frame(View::Path(&[])), &ruler()), None);
    assert!(!has_state(&View::Progress));
}
