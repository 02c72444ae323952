//! The risk of every cell (Wang & Zhu 2018, §1.3).
//!
//! w(cell) = δ·level(centre) + Σ kernel[r(cell, f)] over the defenders f, where the
//! level is that of the [influence regions](crate::influence) and r is the
//! Chebyshev distance in cells from the defender's own cell: 0 in it, 1 on the ring
//! round it. Rings beyond the kernel add nothing. Several influences add up.
//!
//! The paper wants cells near a defender above all others; with these sums it is
//! so while the kernel's last value exceeds δ·(number of defenders), as in its
//! experiment (30 > 5 · 5).

use crate::{CellGrid, Point, influence};

/// Risk values on a cell grid; the buffer is reused.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RiskMap {
    values: Vec<f64>,
}

impl RiskMap {
    /// Computes the risk of every cell of `grid` for the player at `q`: `delta` a
    /// level, `kernel[r]` on ring r round each defender. O(cells · defenders).
    ///
    /// A defender outside the grid acts from where it stands: only those of its
    /// rings that reach the grid count.
    ///
    /// `go_on` is asked before each row; when it declines, the map is left half
    /// done: the remaining rows are 0 and the kernels missing. Pass `|| true` to finish.
    pub fn compute(
        &mut self,
        grid: &CellGrid,
        q: Point,
        defenders: &[Point],
        (delta, kernel): (f64, &[f64]),
        mut go_on: impl FnMut() -> bool,
    ) {
        self.values.clear();
        for row in (0..grid.rows()).take_while(|_| go_on()) {
            let cells = grid.cell(0, row)..grid.cell(0, row) + grid.columns();
            let level = |cell| influence::level(q, defenders, grid.centre(cell));
            self.values.extend(cells.map(|cell| delta * level(cell) as f64));
        }
        if self.values.len() < grid.len() {
            self.values.resize(grid.len(), 0.0);
            return;
        }
        for f in defenders {
            let at = (f - grid.aabb().min) / grid.size();
            let reach = kernel.len() as f64;
            // The columns and rows that the kernel covers, cut off at the grid; casts saturate.
            let span = |at: f64, count: usize| {
                let (from, to) = (at.floor() - reach, at.floor() + reach);
                (from.max(0.0) as usize)..((to + 1.0).max(0.0) as usize).min(count)
            };
            for row in span(at.y, grid.rows()) {
                for column in span(at.x, grid.columns()) {
                    let ring = (column as f64 - at.x.floor()).abs().max((row as f64 - at.y.floor()).abs());
                    self.values[grid.cell(column, row)] += kernel.get(ring as usize).unwrap_or(&0.0);
                }
            }
        }
    }

    /// The risk of every cell, in the grid's numbering.
    pub fn values(&self) -> &[f64] {
        &self.values
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aabb;

    const KERNEL: [f64; 3] = [100.0, 60.0, 30.0];

    fn grid() -> CellGrid {
        CellGrid::covering(&Aabb { min: Point::new(0.0, 0.0), max: Point::new(10.0, 6.0) }, 10, 6)
    }

    fn risk(defenders: &[Point]) -> Vec<f64> {
        let mut map = RiskMap::default();
        map.compute(&grid(), Point::new(0.5, 2.5), defenders, (5.0, &KERNEL), || true);
        map.values().to_vec()
    }

    #[test]
    fn one_defender_worked_by_hand() {
        // q in column 0, f in column 5 of the same row: the bisector is x = 3, so
        // columns 3 and up have level 1.
        let values = risk(&[Point::new(5.5, 2.5)]);
        let row = |r: usize| values[10 * r..10 * r + 10].to_vec();
        assert_eq!(row(2), [0.0, 0.0, 0.0, 35.0, 65.0, 105.0, 65.0, 35.0, 5.0, 5.0]);
        assert_eq!(row(1), [0.0, 0.0, 0.0, 35.0, 65.0, 65.0, 65.0, 35.0, 5.0, 5.0]);
        assert_eq!(row(0), [0.0, 0.0, 0.0, 35.0, 35.0, 35.0, 35.0, 35.0, 5.0, 5.0]);
        assert_eq!(row(5), [0.0, 0.0, 0.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0, 5.0]);
    }

    #[test]
    fn influences_add_up_and_reach_in_from_outside() {
        let (a, b) = (Point::new(5.5, 2.5), Point::new(6.5, 3.5));
        let both = risk(&[a, b]);
        for (cell, sum) in both.iter().enumerate() {
            assert_eq!(*sum, risk(&[a])[cell] + risk(&[b])[cell]);
        }
        // One cell beyond the right border: rings 1 and 2 reach columns 9 and 8.
        let outside = risk(&[Point::new(10.5, 2.5)]);
        assert_eq!(outside[25..30], [0.0, 5.0, 5.0, 35.0, 65.0]);
        let far = risk(&[Point::new(500.0, 2.5), Point::new(0.5, -1e30)]);
        assert!(far.iter().all(|w| *w == 0.0));
    }

    #[test]
    fn near_defenders_every_cell_outweighs_all_others_with_five_of_them() {
        let defenders: [Point; 5] = [[1.5, 0.5], [4.5, 4.5], [8.5, 1.5], [9.5, 5.5], [6.5, 3.5]].map(Point::from);
        let values = risk(&defenders);
        let near = |cell: usize| {
            let (c, r) = grid().position(cell);
            let ring = |f: &Point| c.abs_diff(f.x as usize).max(r.abs_diff(f.y as usize));
            defenders.iter().any(|f| ring(f) < KERNEL.len())
        };
        let least = (0..60).filter(|c| near(*c)).map(|c| values[c]).fold(f64::INFINITY, f64::min);
        let most = (0..60).filter(|c| !near(*c)).map(|c| values[c]).fold(0.0, f64::max);
        assert!(least > most && most > 0.0, "{least} {most}");
    }
}
