//! What is searched: free cells, and start and goal joined to them.

use env_model::{CellGrid, Point};
use planner_api::{PlanError, Problem};

use crate::length::Length;

/// Nodes are the cells in the grid's numbering, then the start, then the goal.
#[derive(Debug, Clone)]
pub(crate) struct Graph {
    pub grid: CellGrid,
    pub blocked: Vec<bool>,
    ends: [Point; 2],
    from_start: Vec<(usize, f64)>,
    to_goal: Vec<(usize, f64)>,
}

impl Graph {
    pub fn new() -> Self {
        let nowhere = env_model::Aabb { min: Point::origin(), max: Point::new(1.0, 1.0) };
        Self {
            grid: CellGrid::covering(&nowhere, 1, 1),
            blocked: Vec::new(),
            ends: [Point::origin(); 2],
            from_start: Vec::new(),
            to_goal: Vec::new(),
        }
    }

    /// Divides the world into cells. Adds the number of tests to `checks`.
    ///
    /// # Errors
    /// An end sees no free cell.
    pub fn rebuild(&mut self, problem: &Problem<'_>, cells: usize, checks: &mut u64) -> Result<(), PlanError> {
        let world = problem.world;
        self.grid = CellGrid::along_longer_side(&world.extent(), cells);
        self.ends = [problem.start, problem.goal];
        *checks += self.grid.occupy(world, &mut self.blocked);
        let joints = [&mut self.from_start, &mut self.to_goal];
        problem.join(&self.grid, &self.blocked, ("cells", cells), joints, checks)
    }

    pub fn nodes(&self) -> usize {
        self.grid.len() + 2
    }

    pub fn start(&self) -> usize {
        self.grid.len()
    }

    pub fn goal(&self) -> usize {
        self.grid.len() + 1
    }

    /// Where a node is.
    pub fn point(&self, node: usize) -> Point {
        node.checked_sub(self.grid.len()).map_or_else(|| self.grid.centre(node), |end| self.ends[end])
    }

    /// The cells from which a last segment leads to the goal, with its length.
    pub fn last_cells(&self) -> &[(usize, f64)] {
        &self.to_goal
    }

    /// Upper bound on the successors of `node`.
    pub fn most_successors(&self, node: usize) -> u64 {
        if node == self.start() { self.from_start.len() as u64 } else { 9 }
    }

    /// Calls `visit` with every node that an edge from `node` leads to, and the edge's length.
    pub fn for_each_successor(&self, node: usize, mut visit: impl FnMut(usize, Length)) {
        if node == self.start() {
            for (cell, distance) in &self.from_start {
                visit(*cell, Length::real(*distance));
            }
            return;
        }
        self.grid.for_each_move(&self.blocked, node, |cell, diagonal| visit(cell, Length::of_move(diagonal)));
        if let Some((_, distance)) = self.to_goal.iter().find(|(cell, _)| *cell == node) {
            visit(self.goal(), Length::real(*distance));
        }
    }
}
