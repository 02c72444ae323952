//! One JSON line for each frame of a run: what an animation needs.
//!
//! Every line holds `stage`, `iteration`, `evaluations`, `best_cost` (null while
//! infinite; so are other numbers that are infinite or none). Points are `[x, y]` in
//! scene units. A path in sight adds `path`, `[[x, y], …]`. A swarm adds
//!
//! - `frame`: `origin` and `axis` = (cos θ, sin θ) of the local frame X'RY': the
//!   local point (x', y') lies at origin + x'·axis + y'·(−sin θ, cos θ);
//! - `x`: the m columns' x'; `half_width`: H = L/4 of the paper's rectangle;
//! - `positions`, `velocities`, `personal_bests`: n rows of m heights y';
//! - `personal_costs` (n), `global_best` (m), `global_cost`.
//!
//! A search, an activity or a trail on cells adds
//!
//! - `grid`: `origin` (the lower left corner), `size` of a cell, `columns`, `rows`; cells are
//!   numbered row by row from the lower left;
//! - `blocked`: the numbers of the cells that cannot be entered; `open`, `closed`: of those
//!   that wait to be expanded and those that have been;
//! - `quantity` and `values`: what is known of each cell (`"risk"`, `"activity"`, `"pheromone"`,
//!   `"distance"`); left out where there is nothing;
//! - `borders`: segments `[[x, y], [x, y]]` between regions; `path`: the best path so far.
//!
//! Trees add `trees`, each with `nodes` (points) and `parents` (indices of nodes; a root is its
//! own). A population adds `paths`, their `fitness` (larger is better), `path` (the best so far)
//! and `grid` where chromosomes number cells. A field of forces adds `grid`, `forces`
//! (`[fx, fy]` at each cell's centre), `trail` (points) and `stuck` (a point, or null).
//!
//! Cells and trees grow by the frame, and all of them together with its square. So frames of a
//! stage, numbered from 0, hold them up to 256, then every 2nd to 512, every 4th to 1024, and so
//! on, and the last of a stage always; the other lines have only the four fields of every line.

use std::io::{self, Write};
use std::ops::ControlFlow;

use env_model::{CellGrid, Point};
use planner_api::{
    CellState, CellsView, ForcesView, Frame, Observer, PopulationView, Problem, SwarmView, TreeView, View,
};
use serde_json::{Map, Value, json};

/// Writes frames as they come.
pub struct Tracer<W: Write> {
    out: W,
    /// The stage that is running, and its frames with cells or trees so far.
    stage: (&'static str, u64),
    /// A line whose state is written only if it proves to be the last of its stage.
    pending: Option<(Map<String, Value>, Held)>,
    origin: [f64; 2],
    axis: [f64; 2],
    outcome: io::Result<()>,
}

impl<W: Write> Tracer<W> {
    /// A tracer of runs on `problem`.
    pub fn new(out: W, problem: &Problem<'_>) -> Self {
        let d = problem.goal - problem.start;
        let axis = d / d.norm();
        Self {
            out,
            stage: ("", 0),
            pending: None,
            origin: [problem.start.x, problem.start.y],
            axis: [axis.x, axis.y],
            outcome: Ok(()),
        }
    }

    /// Ends the trace; the first error of writing, if there was one.
    pub fn finish(mut self) -> io::Result<()> {
        std::mem::replace(&mut self.outcome, Ok(()))?;
        self.settle(true)?;
        self.out.flush()
    }

    /// Writes the line that waits, with its state if it was the last of its stage.
    fn settle(&mut self, last: bool) -> io::Result<()> {
        let Some((mut line, held)) = self.pending.take() else { return Ok(()) };
        if last {
            held.insert(&mut line);
        }
        self.write(&line)
    }

    fn write(&mut self, line: &Map<String, Value>) -> io::Result<()> {
        serde_json::to_writer(&mut self.out, line)?;
        self.out.write_all(b"\n")
    }

    fn line(&mut self, frame: &Frame<'_>) -> io::Result<()> {
        self.settle(frame.stage != self.stage.0)?;
        if frame.stage != self.stage.0 {
            self.stage = (frame.stage, 0);
        }
        let number = self.stage.1;
        let mut line = Map::new();
        line.insert("stage".into(), frame.stage.into());
        line.insert("iteration".into(), frame.iteration.into());
        line.insert("evaluations".into(), frame.evaluations.into());
        line.insert("best_cost".into(), finite(frame.best_cost));
        if matches!(frame.view, View::Cells(_) | View::Trees(_)) {
            self.stage.1 += 1;
        }
        if !is_kept(number)
            && let Some(held) = Held::of(&frame.view)
        {
            self.pending = Some((line, held));
            return Ok(());
        }
        match frame.view {
            View::Path(path) => {
                line.insert("path".into(), points(path));
            }
            View::Swarm(swarm) => self.swarm(&mut line, &swarm),
            View::Cells(view) => cells(&mut line, &view),
            View::Trees(trees) => {
                line.insert("trees".into(), trees.iter().map(tree).collect());
            }
            View::Population(view) => population(&mut line, &view),
            View::Forces(view) => forces(&mut line, &view),
            _ => {}
        }
        self.write(&line)
    }

    fn swarm(&self, line: &mut Map<String, Value>, swarm: &SwarmView<'_>) {
        let m = swarm.columns.count();
        let rows = |values: &[f64]| values.chunks(m).map(|row| json!(row)).collect::<Value>();
        line.insert("frame".into(), json!({ "origin": self.origin, "axis": self.axis }));
        line.insert("x".into(), (1..=m).map(|i| json!(swarm.columns.x(i))).collect());
        line.insert("half_width".into(), swarm.columns.half_width().into());
        line.insert("positions".into(), rows(swarm.positions));
        line.insert("velocities".into(), rows(swarm.velocities));
        line.insert("personal_bests".into(), rows(swarm.personal_bests));
        line.insert("personal_costs".into(), swarm.personal_costs.iter().copied().map(finite).collect());
        line.insert("global_best".into(), json!(swarm.global_best));
        line.insert("global_cost".into(), finite(swarm.global_cost));
    }
}

/// Whether the `number`-th frame of a stage is written with its state.
fn is_kept(number: u64) -> bool {
    number.is_multiple_of(number.div_ceil(256).next_power_of_two())
}

/// A copy of cells or trees, for the time until it is known whether another frame follows.
enum Held {
    Cells {
        grid: CellGrid,
        blocked: Vec<bool>,
        states: Vec<CellState>,
        values: Vec<f64>,
        quantity: &'static str,
        borders: Vec<(Point, Point)>,
        path: Vec<Point>,
    },
    Trees(Vec<(Vec<Point>, Vec<u32>)>),
}

impl Held {
    fn of(view: &View<'_>) -> Option<Self> {
        match view {
            View::Cells(view) => Some(Self::Cells {
                grid: *view.grid,
                blocked: view.blocked.to_vec(),
                states: view.states.to_vec(),
                values: view.values.to_vec(),
                quantity: view.quantity,
                borders: view.borders.to_vec(),
                path: view.path.to_vec(),
            }),
            View::Trees(trees) => {
                Some(Self::Trees(trees.iter().map(|t| (t.nodes.to_vec(), t.parents.to_vec())).collect()))
            }
            _ => None,
        }
    }

    fn insert(&self, line: &mut Map<String, Value>) {
        match self {
            Self::Cells { grid, blocked, states, values, quantity, borders, path } => {
                cells(line, &CellsView { grid, blocked, states, values, quantity, borders, path });
            }
            Self::Trees(held) => {
                let views = held.iter().map(|(nodes, parents)| TreeView { nodes, parents });
                line.insert("trees".into(), views.map(|view| tree(&view)).collect());
            }
        }
    }
}

fn point(p: Point) -> Value {
    json!([finite(p.x), finite(p.y)])
}

fn points(points: &[Point]) -> Value {
    points.iter().copied().map(point).collect()
}

fn grid(grid: &CellGrid) -> Value {
    let origin = point(grid.aabb().min);
    json!({ "origin": origin, "size": grid.size(), "columns": grid.columns(), "rows": grid.rows() })
}

fn cells(line: &mut Map<String, Value>, view: &CellsView<'_>) {
    line.insert("grid".into(), grid(view.grid));
    line.insert("blocked".into(), (0..view.blocked.len()).filter(|c| view.blocked[*c]).collect());
    for (name, state) in [("open", CellState::Open), ("closed", CellState::Closed)] {
        line.insert(name.into(), (0..view.states.len()).filter(|c| view.states[*c] == state).collect());
    }
    if !view.values.is_empty() {
        line.insert("quantity".into(), view.quantity.into());
        line.insert("values".into(), view.values.iter().copied().map(finite).collect());
    }
    line.insert("borders".into(), view.borders.iter().map(|(a, b)| json!([point(*a), point(*b)])).collect());
    line.insert("path".into(), points(view.path));
}

fn tree(view: &TreeView<'_>) -> Value {
    json!({ "nodes": points(view.nodes), "parents": view.parents })
}

fn population(line: &mut Map<String, Value>, view: &PopulationView<'_>) {
    line.insert("paths".into(), view.paths.iter().map(points).collect());
    line.insert("fitness".into(), view.fitness.iter().copied().map(finite).collect());
    line.insert("path".into(), points(view.best));
    if let Some(cells) = view.grid {
        line.insert("grid".into(), grid(cells));
    }
}

fn forces(line: &mut Map<String, Value>, view: &ForcesView<'_>) {
    line.insert("grid".into(), grid(view.grid));
    line.insert("forces".into(), view.forces.iter().map(|f| json!([finite(f.x), finite(f.y)])).collect());
    line.insert("trail".into(), points(view.trail));
    line.insert("stuck".into(), view.stuck.map_or(Value::Null, point));
}

/// JSON has no infinity: null.
fn finite(value: f64) -> Value {
    if value.is_finite() { value.into() } else { Value::Null }
}

impl<W: Write> Observer for Tracer<W> {
    fn frame(&mut self, frame: &Frame<'_>) -> ControlFlow<()> {
        self.outcome = self.line(frame);
        if self.outcome.is_ok() { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::Arena;
    use crate::testing::scene;
    use env_model::{Aabb, Vector};
    use planner_api::Candidates;

    fn traced(views: &[View<'_>]) -> Vec<Value> {
        let arena = Arena::new(scene("one")).unwrap();
        let mut out = Vec::new();
        let mut tracer = Tracer::new(&mut out, &arena.problem().unwrap());
        for view in views {
            let frame = Frame { stage: "s", iteration: 1, evaluations: 2, best_cost: f64::INFINITY, view: *view };
            assert!(tracer.frame(&frame).is_continue());
        }
        tracer.finish().unwrap();
        String::from_utf8(out).unwrap().lines().map(|l| serde_json::from_str(l).unwrap()).collect()
    }

    #[test]
    fn long_searches_are_thinned_to_their_end() {
        let nodes = [Point::new(0.0, 0.0), Point::new(1.0, 0.0)];
        let trees = [TreeView { nodes: &nodes, parents: &[0, 0] }];
        let extent = Aabb { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
        let grid = CellGrid::covering(&extent, 1, 1);
        let search = CellsView {
            grid: &grid,
            blocked: &[],
            states: &[CellState::Closed],
            values: &[],
            quantity: "",
            borders: &[],
            path: &[],
        };
        let arena = Arena::new(scene("one")).unwrap();
        let mut out = Vec::new();
        let mut tracer = Tracer::new(&mut out, &arena.problem().unwrap());
        for (stage, view) in [("grow", View::Trees(&trees)), ("search", View::Cells(search))] {
            for iteration in 0..1100 {
                let frame = Frame { stage, iteration, evaluations: 0, best_cost: 1.0, view };
                assert!(tracer.frame(&frame).is_continue());
            }
        }
        tracer.finish().unwrap();
        let lines: Vec<Value> =
            String::from_utf8(out).unwrap().lines().map(|l| serde_json::from_str(l).unwrap()).collect();
        assert_eq!(lines.len(), 2200, "every frame has its line");
        let expected: Vec<u64> = (0..=256)
            .chain((258..=512).step_by(2))
            .chain((516..=1024).step_by(4))
            .chain((1032..=1096).step_by(8))
            .chain([1099])
            .collect();
        for (stage, key) in [("grow", "trees"), ("search", "closed")] {
            let of = lines.iter().filter(|l| l["stage"] == stage);
            assert_eq!(
                of.clone().map(|l| l["iteration"].as_u64().unwrap()).collect::<Vec<_>>(),
                (0..1100).collect::<Vec<_>>()
            );
            let full: Vec<u64> =
                of.filter(|l| l.get(key).is_some()).map(|l| l["iteration"].as_u64().unwrap()).collect();
            assert_eq!(full, expected, "{stage}");
        }
    }

    #[test]
    fn every_view_has_its_line() {
        let extent = Aabb { min: Point::new(0.0, -1.0), max: Point::new(2.0, 1.0) };
        let cells = CellGrid::covering(&extent, 2, 2);
        let ends = [Point::new(0.0, 0.0), Point::new(10.0, 0.5)];
        let mut paths = Candidates::default();
        paths.push(ends);
        let trees = [TreeView { nodes: &ends, parents: &[0, 0] }];
        let views = [
            View::Cells(CellsView {
                grid: &cells,
                blocked: &[false, true, false, true],
                states: &[CellState::Open, CellState::Untouched, CellState::Closed, CellState::Untouched],
                values: &[0.5, f64::INFINITY, 1.0, 2.0],
                quantity: "risk",
                borders: &[(ends[0], ends[1])],
                path: &ends,
            }),
            View::Trees(&trees),
            View::Population(PopulationView { paths: &paths, fitness: &[0.25], grid: Some(&cells), best: &ends }),
            View::Forces(ForcesView { grid: &cells, forces: &[Vector::new(1.0, 0.0)], trail: &ends, stuck: None }),
        ];
        let lines = traced(&views);
        let path = json!([[0.0, 0.0], [10.0, 0.5]]);
        let head = json!({ "stage": "s", "iteration": 1, "evaluations": 2, "best_cost": null });
        let grid = json!({ "origin": [0.0, -1.0], "size": 1.0, "columns": 2, "rows": 2 });
        let bodies = [
            json!({ "grid": grid, "blocked": [1, 3], "open": [0], "closed": [2], "quantity": "risk",
                    "values": [0.5, null, 1.0, 2.0], "borders": [path], "path": path }),
            json!({ "trees": [{ "nodes": path, "parents": [0, 0] }] }),
            json!({ "paths": [path], "fitness": [0.25], "path": path, "grid": grid }),
            json!({ "grid": grid, "forces": [[1.0, 0.0]], "trail": path, "stuck": null }),
        ];
        for (line, mut expected) in lines.iter().zip(bodies) {
            expected.as_object_mut().unwrap().extend(head.as_object().unwrap().clone());
            assert_eq!(line, &expected);
        }
        assert_eq!(lines.len(), 4);
    }
}
