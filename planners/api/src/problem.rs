//! What is to be planned.

use env_model::{CellGrid, Point, World};

use crate::PlanError;

/// A world, a start and a goal, both free. Borrowed: building one costs two point queries.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct Problem<'a> {
    /// The compiled scene.
    pub world: &'a World,
    /// Where the path begins.
    pub start: Point,
    /// Where it ends.
    pub goal: Point,
}

impl<'a> Problem<'a> {
    /// Checks that start and goal differ by more than the world's ε and are free.
    ///
    /// # Errors
    /// [`PlanError`] names the end, how deep it lies and in what. Escaping from
    /// an obstacle is the strategy layer's business.
    pub fn new(world: &'a World, start: Point, goal: Point) -> Result<Self, PlanError> {
        for (end, p) in [("start", start), ("goal", goal)] {
            let (x, y) = (p.x, p.y);
            if !(x.is_finite() && y.is_finite()) {
                return Err(PlanError::NotFinite { end, x, y });
            }
            let border = world.field_clearance(p);
            if border < -world.slack() {
                return Err(PlanError::OutsideField { end, x, y, depth: -border });
            }
            if let Some((d, obstacle)) = world.nearest_obstacle(p)
                && d < -world.slack()
            {
                return Err(PlanError::InsideObstacle { end, x, y, depth: -d, obstacle });
            }
        }
        if (goal - start).norm() <= world.epsilon() {
            return Err(PlanError::StartIsGoal { x: start.x, y: start.y });
        }
        Ok(Self { world, start, goal })
    }

    /// The cells by which start and goal join `grid`, with the straight distances
    /// to their centres: see [`CellGrid::entries`]. Adds the number of segment tests to `checks`.
    ///
    /// # Errors
    /// [`PlanError::GridTooCoarse`], naming the setting `key` = `value` that decides the
    /// cells' size, where an end sees no free cell.
    pub fn join(
        &self,
        grid: &CellGrid,
        blocked: &[bool],
        (key, value): (&'static str, usize),
        [from_start, to_goal]: [&mut Vec<(usize, f64)>; 2],
        checks: &mut u64,
    ) -> Result<(), PlanError> {
        for (end, p, entries) in [("start", self.start, from_start), ("goal", self.goal, to_goal)] {
            *checks += grid.entries(self.world, blocked, p, entries);
            if entries.is_empty() {
                return Err(PlanError::GridTooCoarse { key, value, size: grid.size(), end, x: p.x, y: p.y });
            }
        }
        Ok(())
    }
}
