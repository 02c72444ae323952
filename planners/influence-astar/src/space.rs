//! The search space: a rectangle of cells (Wang & Zhu 2018, §2.2).

use env_model::CellGrid;

/// Columns `left` to `right` and rows `low` to `high`, both ends included.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Space {
    left: usize,
    right: usize,
    low: usize,
    high: usize,
}

impl Space {
    /// All cells.
    pub fn whole(grid: &CellGrid) -> Self {
        Self { left: 0, right: grid.columns() - 1, low: 0, high: grid.rows() - 1 }
    }

    /// The smallest rectangle that holds `cells`, of which there is at least one.
    pub fn round(grid: &CellGrid, cells: impl IntoIterator<Item = usize>) -> Self {
        let nothing = Self { left: usize::MAX, right: 0, low: usize::MAX, high: 0 };
        cells.into_iter().map(|cell| grid.position(cell)).fold(nothing, |space, (column, row)| Self {
            left: space.left.min(column),
            right: space.right.max(column),
            low: space.low.min(row),
            high: space.high.max(row),
        })
    }

    /// Every side `cells` further out, as far as the grid goes.
    pub fn widened(&self, grid: &CellGrid, cells: usize) -> Self {
        let whole = Self::whole(grid);
        Self {
            left: self.left.saturating_sub(cells),
            right: (self.right + cells).min(whole.right),
            low: self.low.saturating_sub(cells),
            high: (self.high + cells).min(whole.high),
        }
    }

    /// Whether the cell in `column`, `row` belongs to it.
    pub fn contains(&self, (column, row): (usize, usize)) -> bool {
        (self.left..=self.right).contains(&column) && (self.low..=self.high).contains(&row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use env_model::{Aabb, Point};

    #[test]
    fn rectangles_widen_to_the_border() {
        let grid = CellGrid::covering(&Aabb { min: Point::new(0.0, 0.0), max: Point::new(10.0, 6.0) }, 10, 6);
        let space = Space::round(&grid, [grid.cell(7, 1), grid.cell(2, 3)]);
        assert_eq!(space, Space { left: 2, right: 7, low: 1, high: 3 });
        assert_eq!(space.widened(&grid, 2), Space { left: 0, right: 9, low: 0, high: 5 });
        assert_eq!(space.widened(&grid, 1), Space { left: 1, right: 8, low: 0, high: 4 });
        assert_eq!(space.widened(&grid, 1000), Space::whole(&grid));
        assert!(space.contains((2, 1)) && space.contains((7, 3)) && !space.contains((8, 3)) && !space.contains((7, 0)));
    }
}
