//! Sites by square cells, to find those in a strip at any angle.

use env_model::{Aabb, Point, Vector};

/// Sites a cell, in the mean.
const CROWD: f64 = 2.0;

/// A grid over the centres of sites.
#[derive(Debug, Default)]
pub(crate) struct Cells {
    /// Lower left corner.
    corner: Point,
    /// Cells a unit of length.
    scale: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's sites end in `sites`, row by row; begins with a 0.
    ends: Vec<u32>,
    sites: Vec<u32>,
}

/// A rectangle: `middle` plus at most `half[0]` along `axis` and `half[1]` across, either way.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Strip {
    /// Its centre.
    pub middle: Point,
    /// Unit vector.
    pub axis: Vector,
    /// Half its length and half its width.
    pub half: [f64; 2],
}

impl Cells {
    /// Sorts `centres`, numbered from `first`, into cells.
    pub fn fill(&mut self, first: usize, centres: impl ExactSizeIterator<Item = Point> + Clone) {
        let bounds = centres.clone().fold(Aabb::EMPTY, Aabb::including);
        let count = centres.len();
        let size = bounds.size();
        let side = (size.x.max(size.y) * 1e-3).max((size.x * size.y * CROWD / count as f64).sqrt());
        self.corner = bounds.min;
        self.scale = if side > 0.0 { 1.0 / side } else { 0.0 };
        self.columns = (size.x * self.scale) as usize + 1;
        self.rows = (size.y * self.scale) as usize + 1;
        // Counting sort: counts move to where the cells begin, filling turns these into where they end.
        self.ends.clear();
        self.ends.resize(self.columns * self.rows + 1, 0);
        for centre in centres.clone() {
            let cell = self.cell(centre);
            self.ends[cell + 1] += 1;
        }
        for i in 1..self.ends.len() {
            self.ends[i] += self.ends[i - 1];
        }
        self.sites.clear();
        self.sites.resize(count, 0);
        // The last cell's end is the total already; every other slot begins a cell.
        for (number, centre) in centres.enumerate() {
            let cell = self.cell(centre);
            let place = self.ends[cell];
            self.sites[place as usize] = (first + number) as u32;
            self.ends[cell] += 1;
        }
        self.ends.rotate_right(1);
        self.ends[0] = 0;
    }

    fn cell(&self, p: Point) -> usize {
        let v = (p - self.corner) * self.scale;
        (v.y as usize).min(self.rows - 1) * self.columns + (v.x as usize).min(self.columns - 1)
    }

    /// Visits at least every site whose centre lies in `strip`.
    pub fn visit(&self, strip: &Strip, mut visit: impl FnMut(usize)) {
        let Strip { middle, axis, half: [length, width] } = *strip;
        let middle = middle - self.corner;
        let high = length * axis.y.abs() + width * axis.x.abs();
        let row = |y: f64| (y * self.scale).max(0.0) as usize;
        let side = 1.0 / self.scale;
        if middle.y + high < 0.0 || self.scale == 0.0 && self.rows == 0 {
            return;
        }
        for row in row(middle.y - high)..=row(middle.y + high).min(self.rows - 1) {
            // Where a slab |(q − middle)·n| ≤ h crosses the row of heights y₀ to y₁ about the middle's.
            let y = [0.0, 1.0].map(|up| (row as f64 + up) * side - middle.y);
            let mut span = [f64::NEG_INFINITY, f64::INFINITY];
            for (normal, h) in [(axis, length), (Vector::new(-axis.y, axis.x), width)] {
                if normal.x.abs() > 1e-9 {
                    let rise = [y[0] * normal.y, y[1] * normal.y];
                    let ends = [-h - rise[0].max(rise[1]), h - rise[0].min(rise[1])].map(|e| e / normal.x);
                    span = [span[0].max(ends[0].min(ends[1])), span[1].min(ends[0].max(ends[1]))];
                }
            }
            let column = |x: f64| ((x + middle.x) * self.scale).max(0.0) as usize;
            if span[0] > span[1] || span[1] + middle.x < 0.0 {
                continue;
            }
            let (from, to) = (column(span[0]), column(span[1]).min(self.columns - 1));
            if from <= to {
                let begin = self.ends[row * self.columns + from] as usize;
                let end = self.ends[row * self.columns + to + 1] as usize;
                self.sites[begin..end].iter().for_each(|&site| visit(site as usize));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_misses_no_site() {
        // A portable scatter: the fractional parts of multiples of irrationals.
        let part = |i: usize, x: f64| (i as f64 * x).fract();
        let centres: Vec<Point> =
            (0..700).map(|i| Point::new(30.0 * part(i, 0.754_877_666), 9.0 * part(i, 0.569_840_291) - 40.0)).collect();
        let mut cells = Cells::default();
        cells.fill(5, centres.iter().copied());
        let (mut found, mut visited) = (0, 0);
        for i in 0..400 {
            let (sin, cos) = (7.0 * part(i, 0.618_034)).sin_cos();
            let axis = Vector::new(cos, sin);
            let middle = Point::new(34.0 * part(i, 0.414) - 2.0, 13.0 * part(i, 0.732) - 42.0);
            let half = [8.0 * part(i, 0.236), 3.0 * part(i, 0.317)];
            let mut seen = vec![0; centres.len()];
            cells.visit(&Strip { middle, axis, half }, |site| seen[site - 5] += 1);
            for (centre, seen) in centres.iter().zip(seen) {
                let d = centre - middle;
                let inside = d.dot(&axis).abs() <= half[0] && (d.x * axis.y - d.y * axis.x).abs() <= half[1];
                assert!(seen <= 1 && (seen == 1 || !inside), "{centre} by {middle}, {axis}, {half:?}");
                (found, visited) = (found + usize::from(inside), visited + seen);
            }
        }
        assert!(found > 5_000 && visited < 4 * found, "{found} of {visited}");
    }

    #[test]
    fn sites_in_one_place_or_on_one_line_are_no_trouble() {
        for spread in [Vector::zeros(), Vector::x(), Vector::y()] {
            let centres: Vec<Point> = (0..100).map(|i| Point::origin() + spread * f64::from(i)).collect();
            let mut cells = Cells::default();
            cells.fill(0, centres.iter().copied());
            let mut seen = 0;
            let strip = Strip { middle: Point::new(50.0, 50.0), axis: Vector::x(), half: [51.0, 51.0] };
            cells.visit(&strip, |_| seen += 1);
            assert_eq!(seen, 100);
        }
    }
}
