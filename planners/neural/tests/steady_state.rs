//! The steady state against independent solutions of the same equations.

use env_model::scene::Field;
use env_model::{CellGrid, Obstacle, Scene, Shape, World};
use planner_neural::{Network, NeuralSettings};

/// A field of `columns` × `rows` unit cells, some of which are blocked.
fn world(columns: usize, rows: usize, blocked: &[(usize, usize)]) -> World {
    let square = |(c, r): &(usize, usize)| {
        let (x, y) = (*c as f64, *r as f64);
        Obstacle::from(Shape::Polygon(vec![[x, y], [x + 1.0, y], [x + 1.0, y + 1.0], [x, y + 1.0]]))
    };
    World::new(&Scene {
        name: "cells".into(),
        unit: "m".into(),
        robot_radius: 0.0,
        start: [0.5, 0.5],
        goal: [columns as f64 - 0.5, rows as f64 - 0.5],
        field: Some(Field { min: [0.0, 0.0], max: [columns as f64, rows as f64] }),
        obstacles: blocked.iter().map(square).collect(),
    })
    .unwrap()
}

/// Sweeps until nothing changes at all.
fn settled(world: &World, goal: (usize, usize), settings: &NeuralSettings) -> (CellGrid, Network) {
    let extent = world.extent();
    let cells = extent.size().x.max(extent.size().y) as usize;
    let grid = CellGrid::along_longer_side(&extent, cells);
    let mut network = Network::default();
    network.lay(world, &grid, settings, || true);
    network.excite(grid.cell(goal.0, goal.1), settings);
    // The last bit may flicker: a few units of it are rest enough.
    let rest = (0..10_000).any(|k| network.sweep(k % 2 == 0, settings) < 1e-15);
    assert!(rest, "no rest");
    (grid, network)
}

/// The right-hand side of the shunting equation, written from its formula on a map of blocked cells.
struct Equation<'a> {
    columns: usize,
    rows: usize,
    blocked: &'a [(usize, usize)],
    goal: (usize, usize),
    settings: &'a NeuralSettings,
}

impl Equation<'_> {
    fn n(&self) -> usize {
        self.columns * self.rows
    }

    fn blocked(&self, c: usize, r: usize) -> bool {
        self.blocked.contains(&(c, r))
    }

    /// wᵢⱼ = μ/dᵢⱼ for neighbours; 0 into blocked cells (their [x]⁺ is 0) and past their corners.
    fn weight(&self, i: usize, j: usize) -> f64 {
        let ((ic, ir), (jc, jr)) = ((i % self.columns, i / self.columns), (j % self.columns, j / self.columns));
        let (dx, dy) = (ic.abs_diff(jc), ir.abs_diff(jr));
        let cut = self.blocked(ic, jr) || self.blocked(jc, ir);
        if i == j || dx > 1 || dy > 1 || self.blocked(jc, jr) || (dx == 1 && dy == 1 && cut) {
            return 0.0;
        }
        self.settings.coupling / ((dx * dx + dy * dy) as f64).sqrt()
    }

    /// [I]⁺, [I]⁻.
    fn input(&self, i: usize) -> (f64, f64) {
        let at = (i % self.columns, i / self.columns);
        let e = self.settings.input;
        if at == self.goal {
            (e, 0.0)
        } else if self.blocked.contains(&at) {
            (0.0, e)
        } else {
            (0.0, 0.0)
        }
    }

    /// ẋ, and [I]⁺ + Σ w [x]⁺.
    fn rate(&self, x: &[f64], i: usize) -> (f64, f64) {
        let s = self.settings;
        let (excitation, inhibition) = self.input(i);
        let sum = excitation + (0..self.n()).map(|j| self.weight(i, j) * x[j].max(0.0)).sum::<f64>();
        (-s.decay * x[i] + (s.upper - x[i]) * sum - (s.lower + x[i]) * inhibition, sum)
    }

    /// Newton's method with the dense Jacobian.
    fn newton(&self) -> Vec<f64> {
        let n = self.n();
        let mut x = vec![0.0; n];
        for _ in 0..30 {
            let mut rows = Vec::with_capacity(n);
            for i in 0..n {
                let (rate, sum) = self.rate(&x, i);
                let mut row: Vec<f64> = (0..n)
                    .map(|j| if x[j] >= 0.0 { (self.settings.upper - x[i]) * self.weight(i, j) } else { 0.0 })
                    .collect();
                row[i] = -self.settings.decay - sum - self.input(i).1;
                row.push(-rate);
                rows.push(row);
            }
            for (x, step) in x.iter_mut().zip(gauss(rows)) {
                *x += step;
            }
        }
        x
    }
}

/// Solves the augmented system by elimination with row pivoting.
fn gauss(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for k in 0..n {
        let pivot = (k..n).max_by(|a, b| rows[*a][k].abs().total_cmp(&rows[*b][k].abs())).unwrap();
        rows.swap(k, pivot);
        let top = rows[k].clone();
        for row in &mut rows[k + 1..] {
            let factor = row[k] / top[k];
            for (v, t) in row.iter_mut().zip(&top).skip(k) {
                *v -= factor * t;
            }
        }
    }
    let mut x = vec![0.0; n];
    for k in (0..n).rev() {
        let known: f64 = (k + 1..n).map(|j| rows[k][j] * x[j]).sum();
        x[k] = (rows[k][n] - known) / rows[k][k];
    }
    x
}

const BLOCKED: [(usize, usize); 6] = [(2, 1), (2, 2), (3, 3), (5, 0), (5, 1), (0, 4)];

#[test]
fn it_solves_the_equations_as_newtons_method_does() {
    let odd =
        NeuralSettings { decay: 7.0, upper: 0.8, lower: 2.0, coupling: 1.2, input: 30.0, ..NeuralSettings::default() };
    for settings in [NeuralSettings::default(), odd] {
        let (columns, rows, goal) = (7, 6, (6, 0));
        let (_, network) = settled(&world(columns, rows, &BLOCKED), goal, &settings);
        let equation = Equation { columns, rows, blocked: &BLOCKED, goal, settings: &settings };
        for (i, (x, expected)) in network.activity().iter().zip(equation.newton()).enumerate() {
            // Newton's residual is 1e-15 of the terms, the least activity 1e-5: 1e-9 of it is a generous bound.
            assert!((x - expected).abs() <= 1e-9 * expected.abs(), "neuron {i}: {x} is not {expected}");
            assert!(*x <= settings.upper && *x >= -settings.lower);
        }
    }
}

#[test]
fn the_differential_equation_leads_to_the_same_state() {
    let settings = NeuralSettings::default();
    let (columns, rows, goal) = (7, 6, (6, 0));
    let (_, network) = settled(&world(columns, rows, &BLOCKED), goal, &settings);
    let equation = Equation { columns, rows, blocked: &BLOCKED, goal, settings: &settings };
    // Euler's method is stable and keeps signs for h < 1/(A + E + 6.83) = 0.0086. The slowest
    // mode decays at A − 6.83 = 3.17 or faster: after 3000 steps, 24 time units, by e⁻⁷⁶.
    let mut x = vec![0.0; equation.n()];
    for _ in 0..3000 {
        let rates: Vec<f64> = (0..x.len()).map(|i| equation.rate(&x, i).0).collect();
        for (x, rate) in x.iter_mut().zip(rates) {
            *x += 0.008 * rate;
        }
    }
    for (i, (x, expected)) in network.activity().iter().zip(&x).enumerate() {
        assert!((x - expected).abs() <= 1e-9 * expected.abs(), "neuron {i}: {x} is not {expected}");
    }
}

#[test]
fn in_a_corridor_it_falls_by_a_known_factor() {
    // One row: A x = μ B (x₋ + x₊) where x ≪ B, so x ~ λᵏ with λ + 1/λ = A/(μB) = 10: λ = 5 − √24.
    let (_, network) = settled(&world(40, 1, &[]), (0, 0), &NeuralSettings::default());
    let x = network.activity();
    let lambda = 5.0 - 24.0_f64.sqrt();
    for k in 12..30 {
        // The shunting term is a relative x < λ¹¹ ~ 1e-11 here; the far end is felt as λ²⁰.
        assert!((x[k + 1] / x[k] - lambda).abs() < 1e-10, "cell {k}: {}", x[k + 1] / x[k]);
    }
}

#[test]
fn with_little_decay_it_saturates() {
    // A < W = B μ (4 + 2√2): far from goal and walls A x = (B − x) W x/B has the solution B − AB/W.
    let settings = NeuralSettings { decay: 1.0, ..NeuralSettings::default() };
    let (grid, network) = settled(&world(60, 60, &[]), (0, 0), &settings);
    let plateau = 1.0 - 1.0 / (4.0 + 8.0_f64.sqrt());
    for (c, r) in [(25, 25), (30, 30), (35, 28)] {
        let x = network.activity()[grid.cell(c, r)];
        // A deviation is at most A/W = 1/6.8 of the largest among the neighbours: 1e-20 some 24 cells from a wall.
        assert!((x - plateau).abs() < 1e-12, "({c}, {r}): {x} is not {plateau}");
    }
}

#[test]
fn obstacles_do_not_let_it_through() {
    // A wall from side to side: nothing beyond it is active. Two squares that meet in a corner close a gap, too.
    let wall: Vec<_> = (0..5).map(|r| (3, r)).collect();
    let diagonal = [(3, 0), (3, 1), (4, 2), (4, 3), (4, 4)];
    for blocked in [&wall[..], &diagonal[..]] {
        let (grid, network) = settled(&world(8, 5, blocked), (7, 2), &NeuralSettings::default());
        for r in 0..5 {
            assert_eq!(network.activity()[grid.cell(1, r)], 0.0, "{blocked:?}");
            assert!(network.activity()[grid.cell(6, r)] > 0.0);
        }
        // At rest −DE/(A + E), a little more where the goal's side excites it.
        let x = network.activity()[grid.cell(blocked[0].0, blocked[0].1)];
        assert!((-100.0 / 110.0..-0.5).contains(&x), "{x}");
    }
}
