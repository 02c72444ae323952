//! Costs and ties against an oracle that shares nothing with the planner but the
//! formula: relaxation of all cells until nothing changes (Bellman & Ford), on
//! moves counted and risks summed, by the definition of the level.

use std::f64::consts::SQRT_2;

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, World};
use planner_api::seed::splitmix64;
use planner_api::{Plan, Planner, Problem, Run, Status};
use planner_influence_astar::{Heuristic, InfluenceAstar, Obstacles, SearchSpace, Settings};

const COLUMNS: i32 = 13;
const ROWS: i32 = 9;

/// Start, goal and defenders in the middles of cells, all of different ones.
fn scene(seed: u64) -> Scene {
    let mut state = seed;
    let mut below = |limit: i32| (splitmix64(&mut state) % limit as u64) as i32;
    let mut taken: Vec<(i32, i32)> = Vec::new();
    while taken.len() < 6 {
        let cell = (below(COLUMNS), below(ROWS));
        if !taken.contains(&cell) {
            taken.push(cell);
        }
    }
    let middle = |(x, y): (i32, i32)| [f64::from(x) + 0.5, f64::from(y) + 0.5];
    Scene {
        name: "small".into(),
        unit: "cells".into(),
        robot_radius: 0.0,
        start: middle(taken[0]),
        goal: middle(taken[1]),
        field: Some(Field { min: [0.0, 0.0], max: [f64::from(COLUMNS), f64::from(ROWS)] }),
        obstacles: taken[2..].iter().map(|c| Obstacle::disc(middle(*c).into(), 0.4)).collect(),
    }
}

/// The defenders' middles, which are the first cells that they block.
fn defenders(scene: &Scene) -> Vec<Point> {
    let world = World::new(scene).unwrap();
    world.obstacles().iter().map(|o| o.as_disc().unwrap().0).collect()
}

fn risk(scene: &Scene, (x, y): (i32, i32), settings: &Settings) -> f64 {
    let p = Point::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
    defenders(scene)
        .iter()
        .map(|f| {
            let level = if (p - f).norm_squared() < (p - scene.start()).norm_squared() { settings.delta } else { 0.0 };
            let ring = (p.x - f.x).abs().max((p.y - f.y).abs()) as usize;
            level + settings.kernel.get(ring).unwrap_or(&0.0)
        })
        .sum()
}

/// (L, W) of a path that is least by (a·L + b·W, then W, or L at a = 0).
fn oracle(scene: &Scene, settings: &Settings) -> Option<(f64, f64)> {
    let cell = |p: Point| (p.x as i32, p.y as i32);
    let (start, goal) = (cell(scene.start()), cell(scene.goal()));
    let blocked: Vec<_> = match settings.obstacles {
        Obstacles::Blocked => defenders(scene).iter().map(|f| cell(*f)).collect(),
        Obstacles::Soft => Vec::new(),
    };
    let free = |(x, y): (i32, i32)| (0..COLUMNS).contains(&x) && (0..ROWS).contains(&y) && !blocked.contains(&(x, y));
    // Straight moves, diagonal moves, W: L from whole counts is the same however it was reached.
    type Sums = (i32, i32, f64);
    let length = |s: Sums| settings.dis * (f64::from(s.0) + SQRT_2 * f64::from(s.1));
    let less = |u: Sums, v: Sums| {
        let cost = |s| settings.a * length(s) + settings.b * s.2;
        // Far below the least difference of costs (whole risks, lengths apart by 10⁻²), far above rounding.
        let near = (cost(u) - cost(v)).abs() < 1e-7;
        if near { if settings.a > 0.0 { u.2 < v.2 } else { length(u) < length(v) } } else { cost(u) < cost(v) }
    };
    let index = |(x, y): (i32, i32)| (y * COLUMNS + x) as usize;
    let mut best: Vec<Option<Sums>> = vec![None; (COLUMNS * ROWS) as usize];
    best[index(start)] = Some((0, 0, risk(scene, start, settings)));
    let mut changed = true;
    while changed {
        changed = false;
        for y in 0..ROWS {
            for x in 0..COLUMNS {
                let Some(here) = best[index((x, y))] else { continue };
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                    let to = (x + dx, y + dy);
                    if (dx, dy) == (0, 0) || !free(to) || !free((x + dx, y)) || !free((x, y + dy)) {
                        continue;
                    }
                    let diagonal = dx * dy != 0;
                    let there = (
                        here.0 + i32::from(!diagonal),
                        here.1 + i32::from(diagonal),
                        here.2 + risk(scene, to, settings),
                    );
                    if best[index(to)].is_none_or(|known| less(there, known)) {
                        best[index(to)] = Some(there);
                        changed = true;
                    }
                }
            }
        }
    }
    best[index(goal)].map(|sums| (length(sums), sums.2))
}

fn small(heuristic: Heuristic, a: f64, obstacles: Obstacles) -> Settings {
    Settings {
        a,
        b: 1.0 - a,
        columns: COLUMNS as usize,
        rows: ROWS as usize,
        heuristic,
        obstacles,
        search_space: SearchSpace::Pitch,
        ..Settings::default()
    }
}

fn solve(settings: Settings, scene: &Scene) -> (Plan, Status) {
    let world = World::new(scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    InfluenceAstar::new(settings).unwrap().plan(&problem, &mut Run::new(0)).unwrap()
}

#[test]
fn optimal_with_the_least_of_the_other_term_among_ties() {
    for seed in 0..25 {
        let scene = scene(seed);
        for a in [0.0, 0.4, 1.0] {
            for obstacles in [Obstacles::Soft, Obstacles::Blocked] {
                let (length, risk) = oracle(&scene, &small(Heuristic::None, a, obstacles)).unwrap();
                for heuristic in [Heuristic::None, Heuristic::Ring] {
                    let (plan, _) = solve(small(heuristic, a, obstacles), &scene);
                    // The same counts and whole risks: exactly the same sums.
                    assert_eq!(plan.terms, [("length", length), ("risk", risk)], "seed {seed}, a = {a}, {heuristic:?}");
                    assert_eq!(plan.cost, a * length + (1.0 - a) * risk);
                }
                let (plan, _) = solve(small(Heuristic::Paper, a, obstacles), &scene);
                // Nothing is cheaper than the optimum but by rounding.
                assert!(plan.cost >= (a * length + (1.0 - a) * risk) * (1.0 - 1e-12), "the paper's h");
            }
        }
    }
}

#[test]
fn one_defender_worked_by_hand() {
    // Start in cell (1, 4), goal in (11, 4), the defender between them in (6, 4).
    let mut scene = scene(0);
    scene.start = [1.5, 4.5];
    scene.goal = [11.5, 4.5];
    scene.obstacles = vec![Obstacle::disc(Point::new(6.5, 4.5), 0.4)];
    // Shortest: straight on through the defender's cell, ten moves. Columns from
    // 4 on are nearer to the defender (the bisector is x = 4), 8 cells of level 1,
    // and columns 4 to 8 lie in the kernel: 30 + 60 + 100 + 60 + 30.
    let (plan, status) = solve(small(Heuristic::Ring, 1.0, Obstacles::Soft), &scene);
    assert_eq!(plan.terms, [("length", 300.0), ("risk", 8.0 * 5.0 + 280.0)]);
    assert_eq!(status, Status::NotFound, "the straight way collides");
    // Where the defender is an obstacle, a free cell must be passed on either side:
    // no corner may be cut, so the row is left and rejoined by two diagonal moves
    // that begin before column 5. Ten columns: 8 straight and 2 diagonal moves.
    let (plan, status) = solve(small(Heuristic::Ring, 1.0, Obstacles::Blocked), &scene);
    let [length, _] = plan.terms[..] else { panic!("two terms") };
    assert_eq!(length.1, 30.0 * (8.0 + 2.0 * SQRT_2));
    assert_eq!(status, Status::Solved);
    // Safest: round the kernel, whose rings end at rows 2 and 6: column 4 to 11 at level 1.
    let (plan, _) = solve(small(Heuristic::Ring, 0.0, Obstacles::Blocked), &scene);
    assert_eq!(plan.terms[1], ("risk", 8.0 * 5.0));
    assert_eq!(plan.terms[0], ("length", 30.0 * (4.0 + 6.0 * SQRT_2)));
}
