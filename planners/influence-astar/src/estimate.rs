//! Estimates of the cost from a cell to the goal, in quanta of the objective.

use crate::Heuristic;
use crate::cost::Moves;
use crate::map::{Joint, Map};

/// h, prepared for one search space; buffers are reused.
#[derive(Debug, Clone)]
pub(crate) struct Estimate {
    heuristic: Heuristic,
    /// (column, row) of the goal's own cell D.
    goal: (usize, usize),
    /// `"paper"`: h a step of the Manhattan distance.
    per_step: f64,
    /// `"ring"`: Σ of the least risk costs on the rings that a path from distance k has yet to enter.
    rings: Vec<u64>,
}

impl Estimate {
    pub fn new(heuristic: Heuristic) -> Self {
        Self { heuristic, goal: (0, 0), per_step: 0.0, rings: Vec::new() }
    }

    /// Prepares for the cells that are not `barred`.
    pub fn prepare(&mut self, map: &Map, barred: &[bool]) {
        let Map { grid, risks, moves, ends, .. } = map;
        self.goal = grid.position(ends.goal_cell);
        let open = || (0..grid.len()).filter(|cell| !barred[*cell]);
        match self.heuristic {
            Heuristic::None => {}
            Heuristic::Paper => {
                let sum: f64 = open().map(|cell| risks[cell].objective as f64).sum();
                self.per_step = moves.straight.objective as f64 + sum / open().count().max(1) as f64;
            }
            Heuristic::Ring => {
                self.rings.clear();
                self.rings.resize(grid.columns().max(grid.rows()) + 1, u64::MAX);
                for cell in open() {
                    let ring = chebyshev(grid.position(cell), self.goal);
                    self.rings[ring] = self.rings[ring].min(risks[cell].objective);
                }
                // Paths end on the innermost ring of cells that join the goal.
                let innermost = ends.goals.iter().map(|joint| chebyshev(grid.position(joint.cell), self.goal)).min();
                let mut sum = 0;
                for (ring, least) in self.rings.iter_mut().enumerate() {
                    let entered = if Some(ring) < innermost || *least == u64::MAX { 0 } else { *least };
                    *least = sum;
                    sum += entered;
                }
            }
        }
    }

    /// h of a cell.
    pub fn at(&self, map: &Map, cell: usize) -> u64 {
        let here = map.grid.position(cell);
        match self.heuristic {
            Heuristic::None => 0,
            Heuristic::Paper => {
                let steps = here.0.abs_diff(self.goal.0) + here.1.abs_diff(self.goal.1);
                (steps as f64 * self.per_step) as u64
            }
            Heuristic::Ring => {
                let length =
                    |joint: &Joint| octile(here, map.grid.position(joint.cell), &map.moves) + joint.cost.objective;
                let least = map.ends.goals.iter().map(length).min().unwrap_or(0);
                least + self.rings[chebyshev(here, self.goal)]
            }
        }
    }
}

fn chebyshev(a: (usize, usize), b: (usize, usize)) -> usize {
    a.0.abs_diff(b.0).max(a.1.abs_diff(b.1))
}

/// Least cost of the moves between two cells when nothing is in the way and nothing risky.
fn octile(a: (usize, usize), b: (usize, usize), moves: &Moves) -> u64 {
    let (dx, dy) = (a.0.abs_diff(b.0), a.1.abs_diff(b.1));
    (dx.max(dy) - dx.min(dy)) as u64 * moves.straight.objective + dx.min(dy) as u64 * moves.diagonal.objective
}
