//! Where ants can walk: the moves between free cells, how near the goal is, and the ends.

use env_model::{Aabb, CellGrid, Point};
use planner_api::{PlanError, Problem};

/// No cell.
pub(crate) const NONE: u32 = u32::MAX;

#[derive(Debug, Clone)]
pub(crate) struct Map {
    pub grid: CellGrid,
    pub blocked: Vec<bool>,
    /// The cells that moves lead to, in the order of [`env_model::grid::MOVES`]; [`NONE`] where there is none,
    /// and everywhere for a blocked cell.
    pub moves: Vec<[u32; 8]>,
    /// η^β of every cell.
    pub nearness: Vec<f64>,
    /// The cells by which a path leaves the start, with their distance in scene units.
    pub entries: Vec<(usize, f64)>,
    /// The cells from which it reaches the goal, with theirs.
    pub exits: Vec<(usize, f64)>,
}

impl Map {
    pub fn new() -> Self {
        let nowhere = Aabb { min: Point::origin(), max: Point::new(1.0, 1.0) };
        Self {
            grid: CellGrid::covering(&nowhere, 1, 1),
            blocked: Vec::new(),
            moves: Vec::new(),
            nearness: Vec::new(),
            entries: Vec::new(),
            exits: Vec::new(),
        }
    }

    /// Divides the world into cells. Adds the number of tests to `checks`.
    ///
    /// η is in cell sides; at the goal itself, which a cell's centre may hit, the
    /// distance counts as half a cell.
    ///
    /// # Errors
    /// An end sees no free cell.
    pub fn rebuild(
        &mut self,
        problem: &Problem<'_>,
        cells: usize,
        beta: f64,
        checks: &mut u64,
    ) -> Result<(), PlanError> {
        let world = problem.world;
        let grid = CellGrid::along_longer_side(&world.extent(), cells);
        *checks += grid.occupy(world, &mut self.blocked);
        problem.join(&grid, &self.blocked, ("cells", cells), [&mut self.entries, &mut self.exits], checks)?;
        self.moves.clear();
        self.nearness.clear();
        for cell in 0..grid.len() {
            let moves = if self.blocked[cell] { [None; 8] } else { grid.moves(&self.blocked, cell) };
            self.moves.push(moves.map(|to| to.map_or(NONE, |to| to as u32)));
            let distance = (problem.goal - grid.centre(cell)).norm() / grid.size();
            self.nearness.push(libm::pow(1.0 / distance.max(0.5), beta));
        }
        self.grid = grid;
        Ok(())
    }

    /// The last leg from `cell` to the goal, where there is one.
    pub fn exit(&self, cell: usize) -> Option<f64> {
        self.exits.iter().find(|(exit, _)| *exit == cell).map(|(_, distance)| *distance)
    }
}
