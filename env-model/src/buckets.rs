//! Many discs of similar size in the square cells of a grid.
//!
//! Every disc is stored once, in the cell of its centre, row by row, so that the cells
//! of a row that a query meets are one stretch of memory. A query is widened by the
//! largest radius: Ericson, *Real-Time Collision Detection* (2005), §7.1. Long segments
//! visit row by row the cells that they pass.

use std::ops::RangeInclusive;

use crate::probe::{Disc, Probe, clamped_index};
use crate::{Aabb, Point};

/// Discs a cell, on average over the box of the centres: the best between the rows that a query
/// meets, each a few cache misses, and the discs that it tests in vain.
const LOAD: f64 = 1.0;

/// The most discs in a disc's cell, on average over the discs. Where there are more, the
/// discs stand in clusters, which a tree tells apart better.
const CROWDED: usize = 8;

/// Rows up to which a query takes its whole box, not only what the segment passes.
const FEW_ROWS: usize = 2;

/// Segments longer than this many grids take their whole box too: rounding grows with the
/// length, and no more than this fits into ε, 1e-9 of the scene.
const LONG: f64 = 1e5;

/// The grid and its discs.
#[derive(Debug, Clone)]
pub struct Buckets {
    /// The middle of the first cell.
    origin: Point,
    /// Cells a scene unit.
    scale: f64,
    columns: usize,
    /// The last column and row.
    last: [f64; 2],
    /// Where a cell's discs begin; one more at the end.
    starts: Vec<u32>,
    discs: Vec<Disc>,
    /// What a query is widened by.
    margin: f64,
    /// The longest segment whose rows are told apart.
    longest: f64,
}

impl Buckets {
    /// Sorts `discs` into cells, O(n). `margin` is at least their largest radius and a rounding error.
    /// `None` where they stand in clusters or there are none.
    pub fn new(discs: &[Disc], margin: f64) -> Option<Self> {
        let centres = Aabb::of_points(discs.iter().map(|d| &d.centre));
        let size = centres.size();
        let per_disc = LOAD / discs.len() as f64;
        // On a line there is no area to share.
        let side = (size.x * size.y * per_disc).sqrt().max(size.amax() * per_disc).max(2.0 * margin);
        if !side.is_finite() {
            return None;
        }
        let cells = |length: f64| (length / side).round() as usize + 1;
        let (columns, rows) = (cells(size.x), cells(size.y));
        let mut grid = Self {
            origin: centres.min,
            scale: side.recip(),
            columns,
            last: [columns, rows].map(|n| (n - 1) as f64),
            starts: vec![0; columns * rows + 1],
            discs: Vec::new(),
            margin,
            longest: LONG * (size.amax() + margin),
        };
        // Counting sort: numbers, then the ends, then every disc in front of its cell's end.
        let cells: Vec<u32> = discs.iter().map(|d| grid.cell(d)).collect();
        for &cell in &cells {
            grid.starts[cell as usize] += 1;
        }
        if grid.starts.iter().map(|&n| n as usize * n as usize).sum::<usize>() > CROWDED * discs.len() {
            return None;
        }
        let mut end = 0;
        for start in &mut grid.starts {
            end += *start;
            *start = end;
        }
        grid.discs = discs.to_vec();
        for (disc, &cell) in discs.iter().zip(&cells) {
            let start = &mut grid.starts[cell as usize];
            *start -= 1;
            grid.discs[*start as usize] = *disc;
        }
        Some(grid)
    }

    fn cell(&self, disc: &Disc) -> u32 {
        (self.row(disc.centre.y) * self.columns + self.column(disc.centre.x)) as u32
    }

    // The index never falls as the coordinate rises, so that rounding cannot part what is near.
    #[inline]
    fn column(&self, x: f64) -> usize {
        clamped_index((x - self.origin.x) * self.scale, self.last[0])
    }

    #[inline]
    fn row(&self, y: f64) -> usize {
        clamped_index((y - self.origin.y) * self.scale, self.last[1])
    }

    // Apart from its caller, whose way for few obstacles needs no stack.
    /// Whether the segment `a b`, whose box is `region`, enters a disc.
    #[inline(never)]
    pub fn any_entered(&self, a: Point, b: Point, region: &Aabb) -> bool {
        let m = self.margin;
        let (left, right) = (self.column(region.min.x - m), self.column(region.max.x + m));
        let (first, last) = (self.row(region.min.y - m), self.row(region.max.y + m));
        let probe = Probe::new(a, b);
        if last - first > FEW_ROWS && region.size().amax() < self.longest {
            return self.any_entered_along(a, b, &probe, first..=last);
        }
        (first..=last).any(|row| self.any_entered_in(row, left, right, &probe))
    }

    /// In every row, the columns that the segment passes where it is within the margin of the row.
    fn any_entered_along(&self, a: Point, b: Point, probe: &Probe, mut rows: RangeInclusive<usize>) -> bool {
        let slope = (b.x - a.x) / (b.y - a.y);
        let side = self.scale.recip();
        let x_at = |y: f64| a.x + (y.max(a.y.min(b.y)).min(a.y.max(b.y)) - a.y) * slope;
        rows.any(|row| {
            let middle = self.origin.y + row as f64 * side;
            let reach = 0.5 * side + self.margin;
            let (x0, x1) = (x_at(middle - reach), x_at(middle + reach));
            let (left, right) = (self.column(x0.min(x1) - self.margin), self.column(x0.max(x1) + self.margin));
            self.any_entered_in(row, left, right, probe)
        })
    }

    #[inline]
    fn any_entered_in(&self, row: usize, left: usize, right: usize, probe: &Probe) -> bool {
        let at = row * self.columns;
        let (from, to) = (self.starts[at + left] as usize, self.starts[at + right + 1] as usize);
        self.discs[from..to].iter().any(|disc| probe.enters(disc))
    }
}
