//! The cell model of a problem (Fang 2009, §4.5.1): numbered squares, free or not,
//! and the straight lines between their centres.

use env_model::{CellGrid, Point, World};
use planner_api::{PlanError, Problem};

use crate::dice::Dice;
use crate::population::Gene;

/// Draws in a window before it counts as full of obstacles.
const DRAWS: usize = 16;

/// Buffers of [`Cells`], kept from call to call.
#[derive(Debug, Clone, Default)]
pub struct CellBuffers {
    blocked: Vec<bool>,
    free: Vec<Gene>,
    entries: [Vec<(usize, f64)>; 2],
}

/// Grid, occupancy and ends of one problem.
#[derive(Debug)]
pub struct Cells<'p> {
    world: &'p World,
    start: Point,
    goal: Point,
    /// The grid.
    pub grid: CellGrid,
    blocked: &'p [bool],
    free: &'p [Gene],
    /// Tests of a segment or a cell against the world so far.
    pub checks: u64,
}

impl<'p> Cells<'p> {
    /// Numbers `along` cells along the longer side of the world's extent and
    /// finds the free ones: those that no inflated obstacle touches.
    ///
    /// # Errors
    /// [`PlanError::GridTooCoarse`] when start or goal sees no free cell near by.
    pub fn new(problem: &Problem<'p>, along: usize, buffers: &'p mut CellBuffers) -> Result<Self, PlanError> {
        let world = problem.world;
        let grid = CellGrid::along_longer_side(&world.extent(), along);
        let CellBuffers { blocked, free, entries: [entries, exits] } = buffers;
        let mut checks = grid.occupy(world, blocked);
        problem.join(&grid, blocked, ("cells", along), [entries, exits], &mut checks)?;
        free.clear();
        free.extend((0..grid.len()).filter(|c| !blocked[*c]).map(|c| c as Gene));
        Ok(Self { world, start: problem.start, goal: problem.goal, grid, blocked, free, checks })
    }

    /// The genes that every chromosome begins and ends with.
    pub fn ends(&self) -> [Gene; 2] {
        [self.start, self.goal].map(|p| self.grid.cell_at(p) as Gene)
    }

    /// Where gene `i` stands: a cell's centre; the first and the last stand on
    /// start and goal themselves.
    pub fn point(&self, genes: &[Gene], i: usize) -> Point {
        if i == 0 {
            self.start
        } else if i + 1 == genes.len() {
            self.goal
        } else {
            self.grid.centre(genes[i] as usize)
        }
    }

    /// Appends the path to `path`.
    pub fn write_path(&self, genes: &[Gene], path: &mut Vec<Point>) {
        path.extend((0..genes.len()).map(|i| self.point(genes, i)));
    }

    /// Whether the straight line from gene `i` to gene `j` is free. Exact.
    pub fn sees(&mut self, genes: &[Gene], i: usize, j: usize) -> bool {
        self.checks += 1;
        self.world.segment_free(self.point(genes, i), self.point(genes, j))
    }

    /// D, the length of the path.
    pub fn length(&self, genes: &[Gene]) -> f64 {
        (1..genes.len()).map(|i| (self.point(genes, i) - self.point(genes, i - 1)).norm()).sum()
    }

    /// Any free cell.
    pub fn draw(&self, dice: &mut Dice) -> Gene {
        self.free[dice.below(self.free.len())]
    }

    /// A free cell at most `radius` rows and columns from `centre`; `None` when
    /// none of a few draws is free.
    pub fn draw_near(&self, centre: (usize, usize), radius: usize, dice: &mut Dice) -> Option<Gene> {
        let window = |at: usize, cells: usize| (at.saturating_sub(radius), (at + radius).min(cells - 1));
        let (left, right) = window(centre.0, self.grid.columns());
        let (low, high) = window(centre.1, self.grid.rows());
        (0..DRAWS).find_map(|_| {
            let (column, row) = (left + dice.below(right - left + 1), low + dice.below(high - low + 1));
            let cell = self.grid.cell(column, row);
            (!self.blocked[cell]).then_some(cell as Gene)
        })
    }
}

/// A grid of unit squares over [0, 10] × [0, 6] round given obstacles, for tests.
#[cfg(test)]
pub(crate) mod tests {
    use env_model::{Obstacle, Scene, scene::Field};

    use super::*;

    pub fn world(obstacles: Vec<Obstacle>) -> World {
        World::new(&Scene {
            name: "cells".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.5, 0.5],
            goal: [9.5, 5.5],
            field: Some(Field { min: [0.0, 0.0], max: [10.0, 6.0] }),
            obstacles,
        })
        .unwrap()
    }

    /// Calls `check` with the cells of a world whose row 2 is blocked between columns 3 and 5.
    pub fn with_bar(check: impl FnOnce(&mut Cells<'_>)) {
        let bar = env_model::Shape::Polygon(vec![[3.2, 2.2], [5.8, 2.2], [5.8, 2.8], [3.2, 2.8]]);
        let world = world(vec![bar.into()]);
        let problem = Problem::new(&world, Point::new(0.5, 0.5), Point::new(9.5, 5.5)).unwrap();
        let mut buffers = CellBuffers::default();
        check(&mut Cells::new(&problem, 10, &mut buffers).unwrap());
    }

    #[test]
    fn draws_are_free_and_in_their_window() {
        with_bar(|cells| {
            assert_eq!((cells.ends(), cells.free.len()), ([0, 59], 57));
            let mut dice = Dice::new(1);
            for _ in 0..200 {
                let any = cells.draw(&mut dice) as usize;
                let (column, row) = cells.grid.position(cells.draw_near((4, 1), 1, &mut dice).unwrap() as usize);
                assert!(!cells.blocked[any] && (3..=5).contains(&column) && row <= 1);
            }
            assert_eq!(cells.draw_near((4, 2), 0, &mut dice), None, "a window full of obstacle");
        });
    }

    #[test]
    fn lines_are_tested_exactly_between_centres() {
        with_bar(|cells| {
            // Cells 12 and 32 are the centres (2.5, 1.5) and (2.5, 3.5), left of the bar.
            assert!(cells.sees(&[0, 12, 32, 59], 1, 2));
            assert!(!cells.sees(&[0, 14, 34, 59], 1, 2), "through the bar");
            let genes = [0, 2, 59];
            assert_eq!(cells.length(&genes), 2.0 + (49.0_f64 + 25.0).sqrt());
        });
    }

    #[test]
    fn a_grid_coarser_than_the_gaps_is_an_error() {
        let walls = [-0.4, 0.1].map(|x| {
            let (a, b) = (x + 0.5, x + 0.7);
            env_model::Shape::Polygon(vec![[a, 0.0], [b, 0.0], [b, 6.0], [a, 6.0]]).into()
        });
        let world = world(walls.to_vec());
        let problem = Problem::new(&world, Point::new(0.4, 3.0), Point::new(9.5, 5.5)).unwrap();
        let error = Cells::new(&problem, 10, &mut CellBuffers::default()).unwrap_err();
        assert!(matches!(error, PlanError::GridTooCoarse { key: "cells", value: 10, end: "start", .. }), "{error}");
        assert!(Cells::new(&problem, 100, &mut CellBuffers::default()).is_ok());
    }
}
