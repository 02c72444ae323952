//! Proof that a scene can be solved: a grid search that never errs on the hopeful side.
//!
//! A cell is free when the clearance at its centre is at least half its diagonal:
//! clearance changes by no more than the way one goes, so then the whole square is
//! free. A chain of free cells that share sides therefore contains a path, and so
//! does the way from an end to the centre of its own free cell. Narrow gaps may be
//! missed; a found chain is a proof. The search prefers cells near the goal and
//! looks at clearances only where it goes.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use crate::{Point, World};

/// Whether free cells of side `cell` lead from `start` to `goal` inside [`World::extent`].
pub(super) fn connected(world: &World, start: Point, goal: Point, cell: f64) -> bool {
    let extent = world.extent();
    let size = extent.size();
    // Half the diagonal, rounded up by more than the rounding of the grid's coordinates.
    let reach = std::f64::consts::FRAC_1_SQRT_2 * (1.0 + 1e-9) * cell;
    let (columns, rows) = ((size.x / cell).ceil() as u64, (size.y / cell).ceil() as u64);
    let cell_of = |p: Point| {
        let column = ((p.x - extent.min.x) / cell) as u64;
        let row = ((p.y - extent.min.y) / cell) as u64;
        (column.min(columns - 1), row.min(rows - 1))
    };
    let free = |(column, row): (u64, u64)| {
        let x = extent.min.x + (column as f64 + 0.5) * cell;
        let y = extent.min.y + (row as f64 + 0.5) * cell;
        world.point_clearance(Point::new(x, y)) >= reach
    };
    let target = cell_of(goal);
    let entry = |at: (u64, u64)| {
        let (dx, dy) = (at.0.abs_diff(target.0), at.1.abs_diff(target.1));
        Reverse((dx * dx + dy * dy, at))
    };
    let first = cell_of(start);
    if !free(first) || !free(target) {
        return false;
    }
    let mut seen = vec![false; (columns * rows) as usize];
    let mut open = BinaryHeap::from([entry(first)]);
    seen[(first.1 * columns + first.0) as usize] = true;
    while let Some(Reverse((_, at))) = open.pop() {
        if at == target {
            return true;
        }
        let (column, row) = at;
        let neighbours =
            [(column.wrapping_sub(1), row), (column + 1, row), (column, row.wrapping_sub(1)), (column, row + 1)];
        for next in neighbours {
            if next.0 >= columns || next.1 >= rows {
                continue;
            }
            let known = &mut seen[(next.1 * columns + next.0) as usize];
            if !*known {
                *known = true;
                if free(next) {
                    open.push(entry(next));
                }
            }
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, Scene};

    /// A column of discs of radius 0.5 at x = 0 from y = −5 to 5, with a gap of `gap` at the origin.
    fn fence(gap: f64) -> World {
        let discs = (0..6).flat_map(|i| {
            let y = 0.5 + 0.5 * gap + f64::from(i);
            [Point::new(0.0, y), Point::new(0.0, -y)]
        });
        let scene = Scene {
            name: "fence".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [-2.0, 0.3],
            goal: [2.0, -0.3],
            field: Some(crate::scene::Field { min: [-3.0, -5.0], max: [3.0, 5.0] }),
            obstacles: discs.map(|c| Obstacle::disc(c, 0.5)).collect(),
        };
        World::new(&scene).unwrap()
    }

    #[test]
    fn goes_through_gaps_that_a_cell_fits_through_and_no_others() {
        let (a, b) = (Point::new(-2.0, 0.3), Point::new(2.0, -0.3));
        assert!(connected(&fence(0.2), a, b, 0.05));
        assert!(!connected(&fence(0.0), a, b, 0.05), "touching discs");
        assert!(!connected(&fence(-0.1), a, b, 0.05), "overlapping discs");
        assert!(!connected(&fence(0.2), a, b, 0.4), "conservative: the cell is wider than the gap");
        assert!(!connected(&fence(0.2), Point::new(0.0, 1.0), b, 0.05), "start in a disc");
    }
}
