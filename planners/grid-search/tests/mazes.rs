//! Mazes drawn as text: lengths worked by hand, and an oracle that shares nothing with the search.

use std::f64::consts::SQRT_2;
use std::ops::ControlFlow;

use env_model::{CellGrid, Obstacle, Point, Scene, Shape, World, path_length};
use planner_api::{CellState, Frame, Observer, Plan, PlanError, Planner, Problem, Run, Status, View};
use planner_grid_search::{GridSearch, Settings};

/// A drawing: `#` a wall, `S` and `G` the ends, the upper row first. Cells are unit
/// squares, walls square polygons exactly on them, the robot a point.
struct Maze {
    world: World,
    start: Point,
    goal: Point,
    rows: Vec<Vec<u8>>,
}

impl Maze {
    fn new(drawing: &[&str]) -> Self {
        let rows: Vec<Vec<u8>> = drawing.iter().rev().map(|row| row.bytes().collect()).collect();
        let cells = || (0..rows.len()).flat_map(|y| (0..rows[y].len()).map(move |x| (x, y)));
        let find = |what: u8| {
            let (x, y) = cells().find(|(x, y)| rows[*y][*x] == what).unwrap();
            [x as f64 + 0.5, y as f64 + 0.5]
        };
        let wall = |(x, y): (usize, usize)| {
            let (x, y) = (x as f64, y as f64);
            Obstacle::from(Shape::Polygon(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]))
        };
        let scene = Scene {
            name: "maze".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: find(b'S'),
            goal: find(b'G'),
            field: Some(env_model::scene::Field { min: [0.0, 0.0], max: [rows[0].len() as f64, rows.len() as f64] }),
            obstacles: cells().filter(|(x, y)| rows[*y][*x] == b'#').map(wall).collect(),
        };
        Self { world: World::new(&scene).unwrap(), start: scene.start(), goal: scene.goal(), rows }
    }

    fn cells(&self) -> usize {
        self.rows.len().max(self.rows[0].len())
    }

    fn plan(&self, planner: &mut GridSearch) -> (Plan, Status) {
        self.plan_with(planner, Run::new(1))
    }

    fn plan_with(&self, planner: &mut GridSearch, mut run: Run<'_>) -> (Plan, Status) {
        let problem = Problem::new(&self.world, self.start, self.goal).unwrap();
        planner.plan(&problem, &mut run).unwrap()
    }

    /// Length of the shortest way by relaxing every move until nothing changes.
    fn relaxed(&self) -> f64 {
        let (height, width) = (self.rows.len() as isize, self.rows[0].len() as isize);
        let free = |x: isize, y: isize| {
            (0..width).contains(&x) && (0..height).contains(&y) && self.rows[y as usize][x as usize] != b'#'
        };
        let at = |x: isize, y: isize| (y * width + x) as usize;
        let cell = |p: Point| at(p.x as isize, p.y as isize);
        let mut distance = vec![f64::INFINITY; (height * width) as usize];
        distance[cell(self.start)] = 0.0;
        loop {
            let before = distance.clone();
            for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|(x, y)| free(*x, *y)) {
                for (dx, dy) in (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy))) {
                    if free(x + dx, y) && free(x, y + dy) && free(x + dx, y + dy) {
                        let step = ((dx * dx + dy * dy) as f64).sqrt();
                        let by = distance[at(x + dx, y + dy)] + step;
                        distance[at(x, y)] = distance[at(x, y)].min(by);
                    }
                }
            }
            if distance == before {
                return distance[cell(self.goal)];
            }
        }
    }
}

fn settings(cells: usize) -> Settings {
    Settings { cells }
}

fn on_the_grid(cells: usize) -> [GridSearch; 2] {
    [GridSearch::astar(settings(cells)).unwrap(), GridSearch::dijkstra(settings(cells)).unwrap()]
}

/// Mazes with the straight and diagonal moves of their shortest way, counted by hand.
const MAZES: [(&[&str], f64, f64); 4] = [
    // 3 up, 5 right above the trap, one diagonal past its corner, 2 down.
    (&[".......", ".####..", "....#..", "S...#.G", "....#..", ".####..", "......."], 10.0, 1.0),
    // Right, right, diagonally between two free cells, up; with corner cutting 1 + 2√2 would do.
    (&["..#G", ".#..", "S..."], 3.0, 1.0),
    // A serpentine: every bend goes round a corner.
    (&["S....", "####.", ".....", ".####", "....G"], 16.0, 0.0),
    // Diagonally down below a box, 5 right, diagonally up.
    (&["..####..", ".#....#.", "S.####.G", "........"], 5.0, 2.0),
];

#[test]
fn mazes_have_the_lengths_counted_by_hand() {
    for (drawing, straight, diagonal) in MAZES {
        let maze = Maze::new(drawing);
        let length = straight + SQRT_2 * diagonal;
        // Sums of at most 20 rounded steps, each good to 2 ulp of 20.
        assert!((maze.relaxed() - length).abs() < 1e-13, "{drawing:?}: miscounted, {}", maze.relaxed());
        for mut planner in on_the_grid(maze.cells()) {
            let (plan, status) = maze.plan(&mut planner);
            assert_eq!((plan.cost, status), (length, Status::Solved), "{drawing:?}: exactly");
            assert!((path_length(&plan.path) - length).abs() < 1e-13, "{drawing:?}: {:?}", plan.path);
        }
        let (plan, status) = maze.plan(&mut GridSearch::theta_star(settings(maze.cells())).unwrap());
        assert_eq!(status, Status::Solved);
        assert!(plan.cost <= length && (path_length(&plan.path) - plan.cost).abs() < 1e-13, "{drawing:?}");
    }
}

#[test]
fn walls_that_touch_at_a_corner_are_closed() {
    let maze = Maze::new(&["S#.", "#..", "..G"]);
    let theta_star = GridSearch::theta_star(settings(3)).unwrap();
    for mut planner in on_the_grid(3).into_iter().chain([theta_star]) {
        let (plan, status) = maze.plan(&mut planner);
        assert_eq!(status, Status::NotFound);
        assert!(plan.path.is_empty() && plan.cost == f64::INFINITY);
        assert_eq!(plan.counters.iterations, 2, "the start and its cell");
    }
}

#[test]
fn random_mazes_cost_what_relaxation_finds_and_astar_expands_less() {
    let mut state = 5_u64;
    let (mut solved, mut expansions) = (0, [0, 0]);
    for _ in 0..60 {
        let mut rows = vec![vec![b'.'; 23]; 17];
        for cell in rows.iter_mut().flatten() {
            if planner_api::seed::splitmix64(&mut state) % 10 < 3 {
                *cell = b'#';
            }
        }
        rows[0][0] = b'S';
        rows[16][22] = b'G';
        let rows: Vec<&str> = rows.iter().map(|row| std::str::from_utf8(row).unwrap()).collect();
        let maze = Maze::new(&rows);
        let expected = maze.relaxed();
        for (k, mut planner) in on_the_grid(23).into_iter().enumerate() {
            let (plan, status) = maze.plan(&mut planner);
            assert_eq!(status == Status::Solved, expected.is_finite());
            // At most a hundred moves, each rounded to 1e-14.
            assert!(plan.cost == expected || (plan.cost - expected).abs() < 1e-12, "{} {expected}", plan.cost);
            if status == Status::Solved {
                expansions[k] += plan.counters.iterations;
                solved += k;
            }
        }
    }
    assert!(solved > 15, "only {solved} mazes have a way");
    assert!(expansions[0] * 10 < expansions[1] * 9, "A* and Dijkstra expand {expansions:?}");
}

/// A pitch without obstacles, its sides a whole number of cells.
fn empty(columns: usize, rows: usize, size: f64) -> (CellGrid, impl Fn(usize, usize) -> World) {
    let max = [columns as f64 * size, rows as f64 * size];
    let field = env_model::scene::Field { min: [0.0, 0.0], max };
    let grid = CellGrid::along_longer_side(&field.into(), columns.max(rows));
    let world = move |from: usize, to: usize| {
        let [start, goal] = [from, to].map(|cell| [grid.centre(cell).x, grid.centre(cell).y]);
        let (name, unit) = ("empty".into(), "m".into());
        World::new(&Scene { name, unit, robot_radius: 0.0, start, goal, field: Some(field), obstacles: vec![] })
            .unwrap()
    };
    (grid, world)
}

#[test]
fn an_empty_grid_costs_the_octile_distance_exactly() {
    for size in [1.0, 0.1, 1e-6] {
        let (grid, world) = empty(31, 20, size);
        for (from, to) in [(0, 619), (0, 30), (619, 0), (35, 580), (310, 311), (40, 70), (5, 253)] {
            let world = world(from, to);
            let problem = Problem::new(&world, grid.centre(from), grid.centre(to)).unwrap();
            for mut planner in on_the_grid(31) {
                let (plan, _) = planner.plan(&problem, &mut Run::new(1)).unwrap();
                assert_eq!(plan.cost, grid.size() * grid.octile(from, to), "{from} → {to}, cells of {size}");
                assert!(plan.path.len() <= 3, "one bend: {:?}", plan.path);
            }
            let mut theta_star = GridSearch::theta_star(settings(31)).unwrap();
            let (plan, _) = theta_star.plan(&problem, &mut Run::new(1)).unwrap();
            assert_eq!(plan.path, [problem.start, problem.goal], "nothing in the way: straight");
        }
    }
}

#[test]
fn equal_ways_are_equal_to_the_last_bit() {
    let (grid, world) = empty(101, 60, 0.1);
    let (from, to) = (grid.cell(3, 2), grid.cell(90, 47));
    let world = world(from, to);
    let problem = Problem::new(&world, grid.centre(from), grid.centre(to)).unwrap();
    let (plan, _) = GridSearch::astar(settings(101)).unwrap().plan(&problem, &mut Run::new(1)).unwrap();
    // 87 moves, and no cell beside the way: rounding would make some of the
    // thousands of equally short ways look better and have their cells expanded.
    assert_eq!(plan.counters.iterations, 1 + 87 + 1);
}

/// The last frame's cells.
#[derive(Default)]
struct Last {
    values: Vec<f64>,
    states: Vec<CellState>,
    blocked: usize,
    path: Vec<Point>,
}

impl Observer for Last {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        let View::Cells(cells) = frame.view else { panic!("{frame:?}") };
        assert_eq!((cells.states.len(), cells.blocked.len()), (cells.grid.len(), cells.grid.len()));
        self.values = cells.values.to_vec();
        self.states = cells.states.to_vec();
        self.blocked = cells.blocked.iter().filter(|b| **b).count();
        self.path = cells.path.to_vec();
        ControlFlow::Continue(())
    }
}

#[test]
fn observers_see_the_search() {
    let maze = Maze::new(&["S#..", ".#..", ".#..", "...G"]);
    let mut last = Last::default();
    let (plan, _) =
        maze.plan_with(&mut GridSearch::dijkstra(settings(4)).unwrap(), Run::new(1).with_observer(&mut last));
    assert_eq!(last.blocked, 3);
    assert_eq!(last.path, plan.path);
    // From the upper left corner down, right, and up again on the far side of the wall.
    assert_eq!(last.values[12], 0.0);
    assert_eq!(last.values[0..3], [3.0, 4.0, 5.0]);
    assert_eq!(last.values[13], f64::INFINITY, "a wall");
    assert_eq!((last.states[12], last.states[13]), (CellState::Closed, CellState::Untouched));
    assert_eq!(last.states[15], CellState::Untouched, "farther than the goal");
}

#[test]
fn what_is_reached_when_the_budget_ends_is_returned() {
    // The goal is off its cell's centre: other cells are nearer to the start and are
    // expanded between its discovery and its turn.
    let maze =
        Maze { goal: Point::new(6.9, 3.9), ..Maze::new(&["S......", ".......", ".......", "......G", "......."]) };
    let mut planner = GridSearch::dijkstra(settings(7)).unwrap();
    let (whole, _) = maze.plan(&mut planner);
    let with = |iterations: u64| {
        let budget = planner_api::Budget { iterations: Some(iterations), ..Default::default() };
        Run::new(1).with_budget(budget)
    };
    let (cut, status) = maze.plan_with(&mut planner, with(whole.counters.iterations - 1));
    assert_eq!((&cut.path, status), (&whole.path, Status::BudgetSpent), "found, not proved");
    assert_eq!(maze.plan_with(&mut planner, with(whole.counters.iterations)), (whole, Status::Solved));
}

#[test]
fn a_grid_coarser_than_the_gaps_is_an_error_by_name() {
    let maze = Maze::new(&["#.#.#.#", ".#.#.#.", "S.#.#.G"]);
    for mut planner in on_the_grid(2) {
        let problem = Problem::new(&maze.world, maze.start, maze.goal).unwrap();
        let error = planner.plan(&problem, &mut Run::new(1)).unwrap_err();
        assert!(matches!(error, PlanError::GridTooCoarse { key: "cells", value: 2, end: "start", .. }), "{error}");
        assert!(error.to_string().starts_with("cells = 2: "), "{error}");
    }
}

#[test]
fn bad_settings_are_errors_by_name() {
    for cells in [0, 2049] {
        for error in [GridSearch::astar, GridSearch::dijkstra, GridSearch::theta_star].map(|new| new(settings(cells))) {
            let error = error.unwrap_err();
            assert_eq!((error.key, error.value), ("cells", cells.to_string()));
        }
    }
    assert!(toml::from_str::<Settings>("cell = 10").unwrap_err().to_string().contains("unknown field `cell`"));
    assert_eq!(toml::from_str::<Settings>("").unwrap(), Settings::default());
}
