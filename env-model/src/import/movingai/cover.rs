//! Blocked cells as few rectangles that leave no gap between them.
//!
//! Obstacles are open sets, so rectangles that merely share a side would let a
//! point robot through along it. The union of the rectangles made here is
//! the whole interior of the blocked region: not only the blocked cells, but the
//! sides between two of them and the corners between four lie inside a
//! rectangle. The space round the map counts as blocked, so that nothing slips
//! along the border of the field either.

use crate::{CellGrid, Shape};

/// A box of cells: columns from `left` to `right`, rows from `low` to `high`, the last ones included.
/// −1 and the number of columns or rows are one cell outside the map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Rectangle {
    pub left: isize,
    pub right: isize,
    pub low: isize,
    pub high: isize,
}

impl Rectangle {
    fn cells(&self) -> isize {
        (self.right - self.left + 1) * (self.high - self.low + 1)
    }

    fn all(&self, mut test: impl FnMut(isize, isize) -> bool) -> bool {
        (self.low..=self.high).all(|row| (self.left..=self.right).all(|column| test(column, row)))
    }
}

/// Which cells are blocked; those round the map are.
struct Blocked<'a> {
    grid: &'a CellGrid,
    blocked: &'a [bool],
    columns: isize,
    rows: isize,
}

impl<'a> Blocked<'a> {
    fn new(grid: &'a CellGrid, blocked: &'a [bool]) -> Self {
        Self { grid, blocked, columns: grid.columns() as isize, rows: grid.rows() as isize }
    }

    fn at(&self, column: isize, row: isize) -> bool {
        let inside = (0..self.columns).contains(&column) && (0..self.rows).contains(&row);
        !inside || self.blocked[self.grid.cell(column as usize, row as usize)]
    }

    /// `seed` grown left and right, then up and down, as far as all its cells are blocked.
    fn widest(&self, seed: Rectangle) -> Rectangle {
        let mut r = seed;
        while r.left >= 0 && (Rectangle { left: r.left - 1, right: r.left - 1, ..r }).all(|x, y| self.at(x, y)) {
            r.left -= 1;
        }
        while r.right < self.columns
            && (Rectangle { left: r.right + 1, right: r.right + 1, ..r }).all(|x, y| self.at(x, y))
        {
            r.right += 1;
        }
        self.tallest_of(r)
    }

    /// `seed` grown up and down as far as all its cells are blocked.
    fn tallest_of(&self, seed: Rectangle) -> Rectangle {
        let mut r = seed;
        while r.low >= 0 && (Rectangle { low: r.low - 1, high: r.low - 1, ..r }).all(|x, y| self.at(x, y)) {
            r.low -= 1;
        }
        while r.high < self.rows && (Rectangle { low: r.high + 1, high: r.high + 1, ..r }).all(|x, y| self.at(x, y)) {
            r.high += 1;
        }
        r
    }

    /// A rectangle round `seed` that cannot grow: the larger one of those grown first sideways and first upright.
    fn largest(&self, seed: Rectangle) -> Rectangle {
        let (wide, tall) = (self.widest(seed), self.widest(self.tallest_of(seed)));
        if wide.cells() >= tall.cells() { wide } else { tall }
    }
}

/// Rectangles, none of which can grow, whose open union is the interior of the blocked region, the space
/// round the map included as far as they reach into it: one cell. Greedy, from the lower left.
pub(super) fn rectangles(grid: &CellGrid, blocked: &[bool]) -> Vec<Rectangle> {
    let region = Blocked::new(grid, blocked);
    // Places by twice their coordinates: middles of cells are odd, corners even, middles of sides mixed.
    let (width, height) = (2 * grid.columns() + 1, 2 * grid.rows() + 1);
    let mut covered = vec![false; width * height];
    let mut found = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let ((left, right), (low, high)) = (around(x), around(y));
            let seed = Rectangle { left, right, low, high };
            if covered[y * width + x] || !seed.all(|column, row| region.at(column, row)) {
                continue;
            }
            let grown = region.largest(seed);
            let (columns, rows) = (places(grown.left, grown.right, width), places(grown.low, grown.high, height));
            for row in rows {
                covered[row * width..][columns.clone()].fill(true);
            }
            found.push(grown);
        }
    }
    found
}

/// First and last of the one or two cells that meet at twice a coordinate.
fn around(twice: usize) -> (isize, isize) {
    let twice = twice as isize;
    ((twice + 1) / 2 - 1, twice / 2)
}

/// Twice the coordinates strictly inside the cells from `first` to `last`, of `count` there are.
fn places(first: isize, last: isize, count: usize) -> std::ops::Range<usize> {
    ((2 * first + 1).max(0) as usize)..((2 * last + 2) as usize).min(count)
}

/// The corners, as columns and rows to their left and below, where two blocked cells touch and the
/// two others are free.
pub(super) fn pinches(grid: &CellGrid, blocked: &[bool]) -> Vec<[usize; 2]> {
    let corners = (1..grid.rows()).flat_map(|row| (1..grid.columns()).map(move |column| [column, row]));
    let is_pinch = |[column, row]: &[usize; 2]| {
        let at = |left: usize, down: usize| blocked[grid.cell(column - left, row - down)];
        at(0, 0) == at(1, 1) && at(1, 0) == at(0, 1) && at(0, 0) != at(1, 0)
    };
    corners.filter(is_pinch).collect()
}

/// The rectangle as a shape in scene units.
pub(super) fn polygon(r: &Rectangle) -> Shape {
    let [left, right, low, high] = [r.left, r.right + 1, r.low, r.high + 1].map(|side| side as f64);
    Shape::Polygon(vec![[left, low], [right, low], [right, high], [left, high]])
}

/// What closes a pinch: a square on its point that reaches 1/16 of a cell into either free cell.
///
/// The two free cells lie in the wedges x + y ≥ 0 and ≤ 0 round the corner; a shortest path between
/// corners and centres of cells enters such a wedge by its far sides alone, so it never
/// comes nearer to the corner than x + y = 1: the plug lengthens none.
pub(super) fn plug([column, row]: [usize; 2]) -> Shape {
    const REACH: f64 = 1.0 / 16.0;
    let (x, y) = (column as f64, row as f64);
    Shape::Polygon(vec![[x - REACH, y], [x, y - REACH], [x + REACH, y], [x, y + REACH]])
}
