//! What a planner's own picture needs of its last frame: small, owned, storable.
//!
//! Numbers are rounded for drawing, not for computing. Points are whole multiples of
//! [`Ruler::step`], a 2⁻¹⁵th of the scene's diagonal (a sixtieth of a picture unit); numbers on
//! cells are [`LEVELS`] levels between the least and the largest; forces keep their direction, to
//! a hundredth. Grids of more than [`MOST_CELLS`] cells are thinned, trees and populations cut,
//! and the snapshot says so.

use env_model::{CellGrid, Point, Scene, Vector};
use planner_api::{CellState, CellsView, ForcesView, Frame, PopulationView, SwarmView, TreeView, View};
use serde::{Deserialize, Serialize};

/// Levels that numbers on cells are rounded to.
pub const LEVELS: u8 = 255;
/// The level of a cell without a number, or with one that a logarithmic scale cannot show.
pub const NO_LEVEL: u8 = 255;
/// Grids are thinned to about this many cells.
pub const MOST_CELLS: usize = 40_000;
/// More than any thinned grid has, however narrow.
const BELIEVABLE: usize = 100 * MOST_CELLS;
/// Trees are cut after this many nodes.
pub const MOST_NODES: usize = 20_000;
/// At most this many particles or individuals are kept.
pub const MOST_PATHS: usize = 200;
/// Generations kept of a longer history.
pub const MOST_GENERATIONS: usize = 500;

/// The last frame of one stage of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Snapshot {
    /// Name of the scene.
    pub scene: String,
    /// Label of the planner.
    pub planner: String,
    /// The run that was replayed.
    pub repeat: u32,
    /// Its seed.
    pub seed: u64,
    /// Which stage of a composition: `"pso"`, `"qp"`, ….
    pub stage: String,
    /// Iterations done when the frame was shown.
    pub iteration: u64,
    /// Evaluations done then.
    pub evaluations: u64,
    /// Whether the replay returned the very path of the run; a deadline may have cut that one elsewhere.
    pub faithful: bool,
    /// What scales the points.
    pub ruler: Ruler,
    /// The state.
    pub state: State,
    /// Iteration, best and mean fitness, frame by frame, of populations; else empty.
    pub generations: Vec<(u64, f64, f64)>,
}

impl Snapshot {
    /// Whether there is a number for each cell; a damaged record may say anything.
    ///
    /// # Errors
    ///
    /// What does not fit.
    pub fn check(&self) -> Result<(), String> {
        let fail = |what: String| Err(format!("of {} in {}: {what}", self.planner, self.scene));
        let (mesh, lists) = match &self.state {
            State::Cells { mesh, marks, heat, .. } => {
                let marks = Some(marks.len()).filter(|n| *n > 0);
                (Some(mesh), vec![("marks", marks), ("levels", heat.as_ref().map(|h| h.levels.len()))])
            }
            State::Forces { mesh, directions, .. } => (Some(mesh), vec![("directions", Some(directions.len()))]),
            State::Population { mesh, .. } => (mesh.as_ref(), Vec::new()),
            State::Swarm { .. } | State::Trees(_) => (None, Vec::new()),
        };
        let Some(mesh) = mesh else { return Ok(()) };
        let (columns, rows) = (mesh.columns, mesh.rows);
        let Some(cells) = columns.checked_mul(rows).filter(|n| (1..=BELIEVABLE).contains(n)) else {
            return fail(format!("{columns} × {rows} cells; expected 1 to {BELIEVABLE} in all"));
        };
        for (name, length) in lists {
            if let Some(length) = length.filter(|n| *n != cells) {
                return fail(format!("{length} {name} for {columns} × {rows} cells; expected {cells}"));
            }
        }
        Ok(())
    }
}

/// A point in whole steps of a [`Ruler`].
pub type Spot = [i32; 2];
/// A polyline.
pub type Line = Vec<Spot>;

/// Turns points into whole numbers and back.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Ruler {
    /// Where both numbers are 0.
    pub origin: [f64; 2],
    /// Scene units a step.
    pub step: f64,
}

impl Ruler {
    /// The ruler of a scene.
    pub fn new(scene: &Scene) -> Self {
        let region = scene.aabb();
        Self { origin: [region.min.x, region.min.y], step: region.diagonal() / 32_768.0 }
    }

    /// The nearest spot; casts saturate, so points far away stay far away.
    pub fn spot(&self, p: Point) -> Spot {
        [0, 1].map(|k| ((p[k] - self.origin[k]) / self.step).round() as i32)
    }

    /// Where a spot lies.
    pub fn point(&self, [x, y]: Spot) -> Point {
        Point::new(self.origin[0] + f64::from(x) * self.step, self.origin[1] + f64::from(y) * self.step)
    }

    /// The points of a line.
    pub fn points(&self, line: &[Spot]) -> Vec<Point> {
        line.iter().map(|s| self.point(*s)).collect()
    }

    fn line(&self, points: &[Point]) -> Line {
        points.iter().filter(|p| p.x.is_finite() && p.y.is_finite()).map(|p| self.spot(*p)).collect()
    }
}

/// What a planner showed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// A particle swarm.
    Swarm {
        /// Corners of the search rectangle.
        rectangle: Line,
        /// The particles.
        particles: Vec<Line>,
        /// Their personal bests.
        bests: Vec<Line>,
        /// The best of all.
        best: Line,
        /// How many particles there were.
        total: usize,
    },
    /// A search, an activity or a trail on cells.
    Cells {
        /// The cells.
        mesh: Mesh,
        /// One [`mark`](CellMark) a cell; empty where the planner has none.
        marks: String,
        /// Blocked, expanded and waiting cells of the planner's own grid; `None` in older records.
        #[serde(default)]
        counts: Option<[usize; 3]>,
        /// A number for each cell.
        heat: Option<Heat>,
        /// Borders between regions.
        borders: Vec<[Spot; 2]>,
        /// The best path.
        path: Line,
    },
    /// Trees of points.
    Trees(Vec<Tree>),
    /// A population of candidate paths.
    Population {
        /// The individuals' paths.
        paths: Vec<Line>,
        /// The cells that chromosomes number.
        mesh: Option<Mesh>,
        /// The best path.
        best: Line,
        /// How many individuals there were.
        total: usize,
    },
    /// A field of forces and the robot's way in it.
    Forces {
        /// Where the field was sampled.
        mesh: Mesh,
        /// Directions in hundredths, [0, 0] where there is no force.
        directions: Vec<[i8; 2]>,
        /// Where the robot has been.
        trail: Line,
        /// Where it got stuck.
        stuck: Option<Spot>,
    },
}

/// Square cells, row by row from the lower left corner.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Mesh {
    /// Lower left corner, scene units.
    pub min: [f64; 2],
    /// Side of a cell, scene units.
    pub size: f64,
    /// Cells a row.
    pub columns: usize,
    /// Rows.
    pub rows: usize,
    /// Every `every`-th row and column of the planner's own grid is kept.
    pub every: usize,
    /// Columns and rows of the planner's own grid; `None` in older records, which lack them.
    #[serde(default)]
    pub whole: Option<[usize; 2]>,
}

impl Mesh {
    /// The grid, thinned if need be, and the planner's cell that each of its cells shows.
    fn of(grid: &CellGrid) -> (Self, Vec<usize>) {
        let every = ((grid.len() as f64 / MOST_CELLS as f64).sqrt().ceil() as usize).max(1);
        let (columns, rows) = (grid.columns().div_ceil(every), grid.rows().div_ceil(every));
        let min = grid.aabb().min;
        let size = grid.size() * every as f64;
        let middle = |k: usize, count: usize| (k * every + every / 2).min(count - 1);
        let cells = (0..columns * rows)
            .map(|cell| grid.cell(middle(cell % columns, grid.columns()), middle(cell / columns, grid.rows())));
        (
            Self { min: [min.x, min.y], size, columns, rows, every, whole: Some([grid.columns(), grid.rows()]) },
            cells.collect(),
        )
    }

    /// How many cells there are.
    pub fn count(&self) -> usize {
        self.columns.saturating_mul(self.rows)
    }
}

/// What is known of a cell, as a character of `marks`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CellMark {
    /// `.`: nothing.
    None,
    /// `#`: cannot be entered.
    Blocked,
    /// `o`: reached, waiting to be expanded.
    Open,
    /// `x`: expanded.
    Closed,
}

impl CellMark {
    fn character(self) -> char {
        match self {
            Self::None => '.',
            Self::Blocked => '#',
            Self::Open => 'o',
            Self::Closed => 'x',
        }
    }

    /// The mark that a byte of `marks` stands for.
    pub fn from_byte(byte: u8) -> Self {
        match byte {
            b'#' => Self::Blocked,
            b'o' => Self::Open,
            b'x' => Self::Closed,
            _ => Self::None,
        }
    }
}

/// Numbers on cells.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Heat {
    /// What they are: `"risk"`, `"activity"`, ….
    pub quantity: String,
    /// Whether levels are equal ratios instead of equal differences.
    pub log: bool,
    /// The number of level 0.
    pub min: f64,
    /// The number of the highest level.
    pub max: f64,
    /// One level a cell; [`NO_LEVEL`] where there is none.
    pub levels: Vec<u8>,
}

impl Heat {
    /// Rounds `values`; `None` unless some are finite. Scales are logarithmic where most
    /// positive numbers are below a thirtieth of the largest: else they would all look the same.
    fn of(values: &[f64], quantity: &str) -> Option<Self> {
        let finite = || values.iter().copied().filter(|v| v.is_finite());
        let mut positive: Vec<f64> = finite().filter(|v| *v > 0.0).collect();
        positive.sort_by(f64::total_cmp);
        let (mut min, max) = finite().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
        if min > max {
            return None;
        }
        let log = positive.get(positive.len() / 2).is_some_and(|median| *median < max / 30.0);
        if log {
            // Below 10⁻¹⁴⁰ an axis has no room for ratios any more.
            min = positive[0].max(1e-140).min(max);
        }
        let top = f64::from(LEVELS - 1);
        let level = |v: f64| {
            if !v.is_finite() || log && v <= 0.0 {
                return NO_LEVEL;
            }
            // Halves, since max − min may overflow.
            let share =
                if log { (v / min).ln() / (max / min).ln() } else { (0.5 * v - 0.5 * min) / (0.5 * max - 0.5 * min) };
            // A single value gives 0/0: the lowest level.
            (share.clamp(0.0, 1.0) * top).round() as u8
        };
        Some(Self { quantity: quantity.to_owned(), log, min, max, levels: values.iter().map(|v| level(*v)).collect() })
    }
}

/// A tree.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Tree {
    /// The nodes.
    pub nodes: Line,
    /// Their parents; a root is its own.
    pub parents: Vec<u32>,
    /// How many nodes there were.
    pub total: usize,
}

/// A copy of the frame's state; `None` where it shows no more than a path.
pub fn state(frame: &Frame<'_>, ruler: &Ruler) -> Option<State> {
    match frame.view {
        View::Swarm(view) => Some(swarm(&view, ruler)),
        View::Cells(view) => Some(cells(&view, ruler)),
        View::Trees(trees) => Some(State::Trees(trees.iter().map(|t| tree(t, ruler)).collect())),
        View::Population(view) => Some(population(&view, ruler)),
        View::Forces(view) => Some(forces(&view, ruler)),
        _ => None,
    }
}

/// Whether [`state`] has something to copy.
pub fn has_state(view: &View<'_>) -> bool {
    !matches!(view, View::Progress | View::Path(_))
}

fn swarm(view: &SwarmView<'_>, ruler: &Ruler) -> State {
    let columns = view.columns;
    let line = |heights: &[f64]| {
        let mut path = Vec::new();
        columns.write_path(heights, &mut path);
        ruler.line(&path)
    };
    let lines = |matrix: &[f64]| matrix.chunks_exact(columns.count()).take(MOST_PATHS).map(line).collect();
    let (length, h) = (columns.frame().length(), columns.half_width());
    let corners = [(0.0, -h), (length, -h), (length, h), (0.0, h)];
    State::Swarm {
        rectangle: corners.iter().map(|(x, y)| ruler.spot(columns.frame().to_world(Point::new(*x, *y)))).collect(),
        particles: lines(view.positions),
        bests: lines(view.personal_bests),
        best: line(view.global_best),
        total: view.positions.len() / columns.count(),
    }
}

fn cells(view: &CellsView<'_>, ruler: &Ruler) -> State {
    let (mesh, kept) = Mesh::of(view.grid);
    let mark = |cell: usize| {
        let state = view.states.get(cell).copied().unwrap_or_default();
        match state {
            _ if view.blocked.get(cell).copied().unwrap_or(false) => CellMark::Blocked,
            CellState::Untouched => CellMark::None,
            CellState::Open => CellMark::Open,
            CellState::Closed => CellMark::Closed,
        }
    };
    let count = |of| (0..view.grid.len()).filter(|cell| mark(*cell) == of).count();
    let bare = view.blocked.is_empty() && view.states.is_empty();
    let values: Vec<f64> = kept.iter().filter_map(|cell| view.values.get(*cell).copied()).collect();
    let finite = |(a, b): &&(Point, Point)| [a.x, a.y, b.x, b.y].iter().all(|v| v.is_finite());
    State::Cells {
        mesh,
        marks: if bare { String::new() } else { kept.iter().map(|cell| mark(*cell).character()).collect() },
        counts: Some([CellMark::Blocked, CellMark::Closed, CellMark::Open].map(count)),
        heat: Heat::of(&values, view.quantity),
        borders: view.borders.iter().filter(finite).map(|(a, b)| [ruler.spot(*a), ruler.spot(*b)]).collect(),
        path: ruler.line(view.path),
    }
}

fn tree(view: &TreeView<'_>, ruler: &Ruler) -> Tree {
    let total = view.nodes.len();
    let kept = total.min(MOST_NODES);
    // A node whose parent is cut off becomes a root: rewiring may hang an early node on a late one.
    let parent = |i: usize| view.parents.get(i).copied().filter(|p| (*p as usize) < kept).unwrap_or(i as u32);
    Tree {
        nodes: view.nodes[..kept].iter().map(|p| ruler.spot(*p)).collect(),
        parents: (0..kept).map(parent).collect(),
        total,
    }
}

fn population(view: &PopulationView<'_>, ruler: &Ruler) -> State {
    State::Population {
        paths: view.paths.iter().take(MOST_PATHS).map(|path| ruler.line(path)).collect(),
        mesh: view.grid.map(|grid| Mesh::of(grid).0),
        best: ruler.line(view.best),
        total: view.paths.len(),
    }
}

fn forces(view: &ForcesView<'_>, ruler: &Ruler) -> State {
    let (mesh, kept) = Mesh::of(view.grid);
    let direction = |cell: &usize| {
        let f = view.forces.get(*cell).copied().unwrap_or(Vector::zeros());
        // Divided by the larger part first: squares of large forces would overflow.
        let largest = f.x.abs().max(f.y.abs());
        if !(largest > 0.0 && largest.is_finite()) {
            return [0, 0];
        }
        let f = f / largest;
        let unit = f / f.norm();
        [unit.x, unit.y].map(|v| (100.0 * v).round() as i8)
    };
    State::Forces {
        mesh,
        directions: kept.iter().map(direction).collect(),
        trail: ruler.line(view.trail),
        stuck: view.stuck.map(|p| ruler.spot(p)),
    }
}

#[cfg(test)]
mod tests;
