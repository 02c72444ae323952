//! What a search knows of the pitch: risk, occupancy, and where the path joins the cells.

use env_model::{Border, CellGrid, Core, Point, RiskMap, World};
use planner_api::{CellsView, Detail, PlanError, Problem, Run};

use crate::cost::{Cost, Moves, Scale};
use crate::search::Search;
use crate::{Obstacles, Settings};

/// A cell by which an end of the path joins the grid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Joint {
    pub cell: usize,
    /// What the straight leg between them counts in L: nothing in the end's own cell.
    pub length: f64,
    /// The same in quanta.
    pub cost: Cost,
}

/// The cells by which start and goal join the grid.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ends {
    pub starts: Vec<Joint>,
    pub goals: Vec<Joint>,
    /// The goal's own cell, which need not be among `goals`.
    pub goal_cell: usize,
}

/// The pitch in cells; buffers are reused.
#[derive(Debug, Clone)]
pub(crate) struct Map {
    pub grid: CellGrid,
    pub risk: RiskMap,
    /// The cost of entering each cell.
    pub risks: Vec<Cost>,
    pub moves: Moves,
    pub blocked: Vec<bool>,
    pub ends: Ends,
    /// Borders between the regions; only for observers.
    borders: Vec<(Point, Point)>,
    defenders: Vec<Point>,
    entries: [Vec<(usize, f64)>; 2],
}

impl Map {
    /// An empty map.
    pub fn new() -> Self {
        let nowhere = env_model::Aabb { min: Point::origin(), max: Point::origin() };
        Self {
            grid: CellGrid::covering(&nowhere, 1, 1),
            risk: RiskMap::default(),
            risks: Vec::new(),
            moves: Moves::default(),
            blocked: Vec::new(),
            ends: Ends::default(),
            borders: Vec::new(),
            defenders: Vec::new(),
            entries: Default::default(),
        }
    }

    /// Maps the problem; counts collision checks in `run`. Left half done when the run's time is over.
    ///
    /// # Errors
    /// [`PlanError::GridTooCoarse`] where an end sees no free cell.
    pub fn prepare(&mut self, settings: &Settings, problem: &Problem<'_>, run: &mut Run<'_>) -> Result<(), PlanError> {
        let world = problem.world;
        self.grid = CellGrid::covering(&world.extent(), settings.columns, settings.rows);
        let grid = &self.grid;
        list_defenders(world, &mut self.defenders);
        let shape = (settings.delta, &settings.kernel[..]);
        self.risk.compute(grid, problem.start, &self.defenders, shape, || run.in_time());
        if !run.in_time() {
            return Ok(());
        }
        let most = self.risk.values().iter().copied().fold(0.0, f64::max);
        let scale = Scale::new(settings, most);
        self.moves = Moves::new(&scale, settings.dis);
        self.risks.clear();
        self.risks.extend(self.risk.values().iter().map(|w| scale.risk(*w)));

        match settings.obstacles {
            Obstacles::Blocked => run.spent.collision_checks += grid.occupy(world, &mut self.blocked),
            Obstacles::Soft => {
                let outside = |cell| world.field_clearance(grid.centre(cell)) < -world.slack();
                self.blocked.clear();
                self.blocked.extend((0..grid.len()).map(outside));
            }
        }

        self.ends.goal_cell = grid.cell_at(problem.goal);
        let [starts, goals] = &mut self.entries;
        problem.join(
            grid,
            &self.blocked,
            decisive(settings, world),
            [starts, goals],
            &mut run.spent.collision_checks,
        )?;
        let ends = [(problem.start, &mut self.ends.starts), (problem.goal, &mut self.ends.goals)];
        for (entries, (p, joints)) in self.entries.iter().zip(ends) {
            let own = grid.cell_at(p);
            joints.clear();
            joints.extend(entries.iter().map(|&(cell, distance)| {
                let length = if cell == own { 0.0 } else { distance / grid.size() * settings.dis };
                Joint { cell, length, cost: scale.length(length) }
            }));
        }

        self.borders.clear();
        if run.detail() == Detail::State {
            let within = |f| Border::within(&world.extent(), problem.start, &self.defenders, f);
            self.borders.extend((0..self.defenders.len()).filter_map(within).map(|border| (border.from, border.to)));
        }
        Ok(())
    }

    /// What observers see of it.
    pub fn view<'a>(&'a self, search: &'a Search, path: &'a [Point]) -> CellsView<'a> {
        CellsView {
            grid: &self.grid,
            blocked: &self.blocked,
            states: search.states(),
            values: self.risk.values(),
            quantity: "risk",
            borders: &self.borders,
            path,
        }
    }
}

/// Where the defenders stand: see [`InfluenceAstar`](crate::InfluenceAstar).
fn list_defenders(world: &World, defenders: &mut Vec<Point>) {
    let is_opponent = |i: &usize| world.label(*i).is_some_and(|label| label.starts_with("opponent"));
    let all = 0..world.obstacles().len();
    let sides_told = all.clone().any(|i| is_opponent(&i));
    defenders.clear();
    defenders.extend(all.filter(|i| !sides_told || is_opponent(i)).map(|i| match &world.obstacles()[i].core {
        Core::Point(centre) => *centre,
        Core::Segment(a, b) => a + (b - a) * 0.5,
        Core::Polygon(polygon) => env_model::Aabb::of_points(polygon.corners()).centre(),
    }));
}

/// The dimension that decides the side of the cells, and its value.
fn decisive(settings: &Settings, world: &World) -> (&'static str, usize) {
    let Settings { columns, rows, .. } = *settings;
    let size = world.extent().size();
    let wide = size.x * rows as f64 >= size.y * columns as f64;
    if wide { ("columns", columns) } else { ("rows", rows) }
}
