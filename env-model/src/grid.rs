//! Square cells, numbered by sequence (Fang 2009, §4.5; Wang & Zhu 2018, §3).
//!
//! Cells are numbered row by row from the lower left corner, from 0. A move leads
//! from a cell's centre to that of one of its eight neighbours; a diagonal move
//! needs both cells that it passes between to be free (no corner cutting). Where
//! occupied cells are all those that an inflated obstacle touches, a move between
//! free cells stays inside free squares, so it is free without a further test.

use crate::geometry::segment_segment_distance;
use crate::{Aabb, Core, Inflated, Point, Vector, World};

/// Square cells over a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CellGrid {
    origin: Point,
    size: f64,
    columns: usize,
    rows: usize,
}

/// The eight moves (Δcolumn, Δrow), anticlockwise from the right; odd ones are diagonal.
pub const MOVES: [(isize, isize); 8] = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];

impl CellGrid {
    /// `columns` × `rows` square cells of side max(width/columns, height/rows),
    /// centred on `extent`, which they cover (Wang & Zhu 2018: 61 × 36).
    pub fn covering(extent: &Aabb, columns: usize, rows: usize) -> Self {
        let extents = extent.size();
        let size = (extents.x / columns as f64).max(extents.y / rows as f64);
        let half = Vector::new(0.5 * size * columns as f64, 0.5 * size * rows as f64);
        Self { origin: extent.centre() - half, size, columns, rows }
    }

    /// `cells` square cells along the longer side of `extent`, as many as cover the other.
    pub fn along_longer_side(extent: &Aabb, cells: usize) -> Self {
        let extents = extent.size();
        let size = extents.x.max(extents.y) / cells as f64;
        // A side that is a whole number of cells but for rounding takes that number.
        let along = |length: f64| ((length / size - 1e-9).ceil() as usize).max(1);
        Self::covering(extent, along(extents.x), along(extents.y))
    }

    /// Cells a row.
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Rows.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// Number of cells.
    pub fn len(&self) -> usize {
        self.columns * self.rows
    }

    /// Whether there is no cell.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Side of a cell, in scene units.
    pub fn size(&self) -> f64 {
        self.size
    }

    /// The box that the cells fill.
    pub fn aabb(&self) -> Aabb {
        let size = Vector::new(self.size * self.columns as f64, self.size * self.rows as f64);
        Aabb { min: self.origin, max: self.origin + size }
    }

    /// The number of the cell in `column`, `row`.
    pub fn cell(&self, column: usize, row: usize) -> usize {
        row * self.columns + column
    }

    /// (column, row) of a cell.
    pub fn position(&self, cell: usize) -> (usize, usize) {
        (cell % self.columns, cell / self.columns)
    }

    /// The cell that holds `p`; outside the grid, the nearest one.
    pub fn cell_at(&self, p: Point) -> usize {
        let d = (p - self.origin) / self.size;
        // Casts saturate: what lies below or left becomes 0.
        self.cell((d.x as usize).min(self.columns - 1), (d.y as usize).min(self.rows - 1))
    }

    /// The middle of a cell.
    pub fn centre(&self, cell: usize) -> Point {
        self.middle(self.position(cell))
    }

    fn middle(&self, (column, row): (usize, usize)) -> Point {
        self.origin + Vector::new((column as f64 + 0.5) * self.size, (row as f64 + 0.5) * self.size)
    }

    /// A cell's square.
    pub fn square(&self, cell: usize) -> Aabb {
        let (column, row) = self.position(cell);
        self.square_in(column, row)
    }

    fn square_in(&self, column: usize, row: usize) -> Aabb {
        let corner = |c: usize, r: usize| self.origin + Vector::new(c as f64 * self.size, r as f64 * self.size);
        Aabb { min: corner(column, row), max: corner(column + 1, row + 1) }
    }

    /// The cell one move away; `None` off the grid.
    pub fn step(&self, cell: usize, by: (isize, isize)) -> Option<usize> {
        self.offset(self.position(cell), by)
    }

    /// The cell `(dx, dy)` away from the cell in (column, row); `None` off the grid.
    fn offset(&self, (column, row): (usize, usize), (dx, dy): (isize, isize)) -> Option<usize> {
        let column = column.checked_add_signed(dx).filter(|c| *c < self.columns)?;
        let row = row.checked_add_signed(dy).filter(|r| *r < self.rows)?;
        Some(self.cell(column, row))
    }

    /// The cells that moves from `from` lead to, in the order of [`MOVES`]; `None` where
    /// a move would leave the grid, enter a blocked cell or cut the corner of one.
    pub fn moves(&self, blocked: &[bool], from: usize) -> [Option<usize>; 8] {
        let at = self.position(from);
        let free = MOVES.map(|by| self.offset(at, by).filter(|cell| !blocked[*cell]));
        let beside_free = |k: usize| free[k - 1].is_some() && free[(k + 1) % 8].is_some();
        std::array::from_fn(|k| free[k].filter(|_| k % 2 == 0 || beside_free(k)))
    }

    /// Calls `visit(cell, diagonal)` for every neighbour of `from` that a move
    /// may lead to: not blocked, and not cutting the corner of a blocked cell.
    /// The order is that of [`MOVES`].
    pub fn for_each_move(&self, blocked: &[bool], from: usize, mut visit: impl FnMut(usize, bool)) {
        for (k, to) in self.moves(blocked, from).into_iter().enumerate() {
            if let Some(to) = to {
                visit(to, k % 2 == 1);
            }
        }
    }

    /// Least cost of moves between two cells of an empty grid, in cell sides:
    /// max(|Δcolumn|, |Δrow|) + (√2 − 1)·min(|Δcolumn|, |Δrow|).
    pub fn octile(&self, a: usize, b: usize) -> f64 {
        let ((ac, ar), (bc, br)) = (self.position(a), self.position(b));
        let (dx, dy) = (ac.abs_diff(bc), ar.abs_diff(br));
        (dx.max(dy) - dx.min(dy)) as f64 + std::f64::consts::SQRT_2 * dx.min(dy) as f64
    }

    /// Writes the polyline from `start` through the centres of `cells` to `goal`, without
    /// the centres between two equal moves and without repeated points.
    pub fn write_path(&self, start: Point, cells: &[usize], goal: Point, path: &mut Vec<Point>) {
        let delta = |a: usize, b: usize| {
            let ((ac, ar), (bc, br)) = (self.position(a), self.position(b));
            (bc.wrapping_sub(ac), br.wrapping_sub(ar))
        };
        path.clear();
        path.push(start);
        for (i, &cell) in cells.iter().enumerate() {
            let p = self.centre(cell);
            let passed = i > 0 && i + 1 < cells.len() && delta(cells[i - 1], cell) == delta(cell, cells[i + 1]);
            if !passed && p != path[path.len() - 1] && p != goal {
                path.push(p);
            }
        }
        path.push(goal);
    }

    /// Marks the cells that the robot may not use: those whose square an inflated
    /// obstacle touches by more than the world's slack, and those whose centre is
    /// outside the field. Returns the number of cell–shape tests.
    pub fn occupy(&self, world: &World, blocked: &mut Vec<bool>) -> u64 {
        blocked.clear();
        blocked.resize(self.len(), false);
        if let Some(field) = world.inner_field() {
            let inside = |axis: usize, index: usize| {
                let middle = self.origin[axis] + (index as f64 + 0.5) * self.size;
                (middle - field.min[axis] >= -world.slack()) & (field.max[axis] - middle >= -world.slack())
            };
            for (row, cells) in blocked.chunks_exact_mut(self.columns).enumerate() {
                let row_inside = inside(1, row);
                for (column, blocked) in cells.iter_mut().enumerate() {
                    *blocked = !(row_inside & inside(0, column));
                }
            }
        }
        let mut tests = 0;
        let all = self.aabb();
        for obstacle in world.obstacles() {
            let near = obstacle.aabb();
            if !near.overlaps(&all) {
                continue;
            }
            let ((left, low), (right, high)) =
                (self.position(self.cell_at(near.min)), self.position(self.cell_at(near.max)));
            for row in low..=high {
                let cells = &mut blocked[row * self.columns..][left..=right];
                tests += cells.iter().map(|blocked| u64::from(!*blocked)).sum::<u64>();
                for (column, blocked) in (left..).zip(cells) {
                    *blocked = *blocked || touches(obstacle, &self.square_in(column, row), world.slack());
                }
            }
        }
        tests
    }

    /// The cells by which a path from (or to) `p` joins the grid, with the straight
    /// distance to their centres: the cell of `p`, or where it is blocked or `p`
    /// does not see its centre, all cells of the nearest square ring (at most
    /// three cells away) that are free and in sight. Returns the number of
    /// segment tests; `out` stays empty where there is no such cell.
    pub fn entries(&self, world: &World, blocked: &[bool], p: Point, out: &mut Vec<(usize, f64)>) -> u64 {
        out.clear();
        let mut tests = 0;
        let (column, row) = self.position(self.cell_at(p));
        for ring in 0..=3_isize {
            for dy in -ring..=ring {
                for dx in -ring..=ring {
                    if dx.abs().max(dy.abs()) != ring {
                        continue;
                    }
                    let Some(cell) = self.step(self.cell(column, row), (dx, dy)).filter(|c| !blocked[*c]) else {
                        continue;
                    };
                    tests += 1;
                    let centre = self.centre(cell);
                    if world.segment_free(p, centre) {
                        out.push((cell, (centre - p).norm()));
                    }
                }
            }
            if !out.is_empty() {
                break;
            }
        }
        tests
    }
}

/// Whether the inflated obstacle, an open set, reaches deeper than `slack` into the square.
fn touches(obstacle: &Inflated, square: &Aabb, slack: f64) -> bool {
    let reach = obstacle.radius - slack;
    // Most sides are far from most squares, which their boxes alone tell.
    let near =
        |square: &Aabb, reach: f64, a: Point, b: Point| Aabb::of_points([&a, &b]).inflated(reach).overlaps(square);
    match &obstacle.core {
        Core::Point(c) => square.distance_squared(&Aabb { min: *c, max: *c }) < reach * reach && reach > 0.0,
        Core::Segment(a, b) => near(square, reach, *a, *b) && segment_distance(square, *a, *b) < reach,
        Core::Polygon(polygon) => {
            polygon.contains(square.centre())
                || if reach > 0.0 {
                    polygon.sides().any(|(a, b)| near(square, reach, a, b) && segment_distance(square, a, b) < reach)
                } else {
                    // A point robot: sharing a border is not touching.
                    let inner = square.inflated(reach);
                    polygon.sides().any(|(a, b)| near(&inner, 0.0, a, b) && segment_distance(&inner, a, b) == 0.0)
                }
        }
    }
}

/// Distance between a square and the segment `a b`, 0 when they meet.
fn segment_distance(square: &Aabb, a: Point, b: Point) -> f64 {
    if square.depth_of(a) >= 0.0 || square.depth_of(b) >= 0.0 {
        return 0.0;
    }
    let (lo, hi) = (square.min, square.max);
    let corners = [lo, Point::new(hi.x, lo.y), hi, Point::new(lo.x, hi.y)];
    (0..4).map(|i| segment_segment_distance(a, b, corners[i], corners[(i + 1) % 4])).fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, Scene, Shape};

    fn world(obstacles: Vec<Obstacle>, robot_radius: f64) -> World {
        World::new(&Scene {
            name: "cells".into(),
            unit: "m".into(),
            robot_radius,
            start: [0.5, 0.5],
            goal: [9.5, 5.5],
            field: Some(crate::scene::Field { min: [0.0, 0.0], max: [10.0, 6.0] }),
            obstacles,
        })
        .unwrap()
    }

    fn square_field() -> Aabb {
        Aabb { min: Point::new(0.0, 0.0), max: Point::new(10.0, 6.0) }
    }

    #[test]
    fn cells_are_numbered_by_sequence() {
        let grid = CellGrid::along_longer_side(&square_field(), 10);
        assert_eq!((grid.columns(), grid.rows(), grid.size(), grid.len()), (10, 6, 1.0, 60));
        assert_eq!((grid.cell_at(Point::new(0.1, 0.1)), grid.cell_at(Point::new(3.5, 2.5))), (0, 23));
        assert_eq!(grid.cell_at(Point::new(-9.0, 99.0)), 50, "the nearest");
        assert_eq!((grid.position(23), grid.centre(23)), ((3, 2), Point::new(3.5, 2.5)));
        assert_eq!(grid.square(23), Aabb { min: Point::new(3.0, 2.0), max: Point::new(4.0, 3.0) });
        assert_eq!(grid.step(0, (-1, 0)), None);
        assert_eq!(grid.step(9, (1, 0)), None, "no wrapping to the next row");
        assert_eq!(grid.step(9, (0, 1)), Some(19));
        assert_eq!(grid.octile(0, 23), 1.0 + 2.0 * std::f64::consts::SQRT_2);
    }

    #[test]
    fn the_grid_of_2018_covers_any_pitch_with_squares() {
        let pitch = Aabb { min: Point::new(-52.5, -34.0), max: Point::new(52.5, 34.0) };
        let grid = CellGrid::covering(&pitch, 61, 36);
        assert_eq!(grid.size(), 68.0 / 36.0);
        assert_eq!(grid.aabb().centre(), pitch.centre());
        assert!(grid.aabb().min.x <= -52.5 && grid.aabb().max.x >= 52.5);
    }

    /// The cells that are blocked, found by the distance of many sample points.
    fn sampled(world: &World, grid: &CellGrid) -> Vec<bool> {
        let steps = 60;
        (0..grid.len())
            .map(|cell| {
                let square = grid.square(cell);
                (0..=steps * steps + 2 * steps).any(|k| {
                    let (i, j) = (k % (steps + 1), k / (steps + 1));
                    let along = |v: i32| f64::from(v) / f64::from(steps);
                    let p = square.min + square.size().component_mul(&Vector::new(along(i), along(j)));
                    world.nearest_obstacle(p).is_some_and(|(d, _)| d < -1e-3)
                })
            })
            .collect()
    }

    #[test]
    fn occupancy_is_that_of_dense_samples() {
        let shapes = [
            Shape::Disc { centre: [2.03, 2.98], radius: 0.7 },
            Shape::Disc { centre: [2.5, 0.5], radius: 0.1 },
            Shape::Capsule { from: [4.2, 1.1], to: [6.9, 2.3], radius: 0.15 },
            Shape::Polygon(vec![[5.2, 3.2], [9.6, 3.3], [9.4, 5.2], [8.7, 4.1], [5.3, 4.4]]),
        ];
        for robot_radius in [0.0, 0.2] {
            let world = world(shapes.iter().cloned().map(Obstacle::from).collect(), robot_radius);
            // Cells as large as the obstacles, then smaller ones. Where the sampled depth is
            // below a thousandth either answer would do; no cell here is that near.
            for cells in [10, 37] {
                let grid = CellGrid::along_longer_side(&square_field(), cells);
                let mut blocked = Vec::new();
                assert!(grid.occupy(&world, &mut blocked) > 0);
                for (cell, sampled) in sampled(&world, &grid).into_iter().enumerate() {
                    let outside = world.field_clearance(grid.centre(cell)) < 0.0;
                    assert!(blocked[cell] || !sampled, "cell {cell} of {cells}: sampled inside");
                    assert!(
                        sampled || outside || !blocked[cell] || near(&world, &grid.square(cell)),
                        "cell {cell} of {cells}"
                    );
                }
            }
        }
    }

    /// Whether some point of the square's border comes within the sampling's reach of an obstacle.
    fn near(world: &World, square: &Aabb) -> bool {
        let spacing = square.size().x / 60.0;
        let corners =
            [square.min, Point::new(square.max.x, square.min.y), square.max, Point::new(square.min.x, square.max.y)];
        (0..4).any(|i| world.segment_clearance(corners[i], corners[(i + 1) % 4]) < 1e-3 + spacing)
    }

    #[test]
    fn touching_a_cell_is_not_entering_it() {
        let square = Shape::Polygon(vec![[3.0, 2.0], [4.0, 2.0], [4.0, 3.0], [3.0, 3.0]]);
        let grid = CellGrid::along_longer_side(&square_field(), 10);
        let mut blocked = Vec::new();
        grid.occupy(&world(vec![square.into(), Obstacle::disc(Point::new(7.5, 3.5), 0.5)], 0.0), &mut blocked);
        let cells: Vec<usize> = (0..grid.len()).filter(|c| blocked[*c]).collect();
        assert_eq!(cells, [23, 37]);
    }

    #[test]
    fn moves_do_not_cut_corners() {
        let grid = CellGrid::along_longer_side(&square_field(), 10);
        let mut blocked = vec![false; grid.len()];
        blocked[grid.cell(3, 2)] = true;
        let mut moves = Vec::new();
        grid.for_each_move(&blocked, grid.cell(2, 2), |cell, diagonal| moves.push((grid.position(cell), diagonal)));
        assert_eq!(moves, [((2, 3), false), ((1, 3), true), ((1, 2), false), ((1, 1), true), ((2, 1), false)]);
    }

    #[test]
    fn paths_turn_at_centres() {
        let grid = CellGrid::along_longer_side(&square_field(), 10);
        let (start, goal) = (Point::new(0.5, 0.5), Point::new(4.7, 3.5));
        let mut path = Vec::new();
        // From the centre of cell 0 right twice, diagonally up twice and up.
        grid.write_path(start, &[0, 1, 2, 13, 24, 34], goal, &mut path);
        assert_eq!(path, [start, Point::new(2.5, 0.5), Point::new(4.5, 2.5), Point::new(4.5, 3.5), goal]);
        grid.write_path(start, &[0], goal, &mut path);
        assert_eq!(path, [start, goal]);
    }

    #[test]
    fn ends_in_blocked_cells_join_the_nearest_ring_in_sight() {
        let world = world(vec![Obstacle::disc(Point::new(5.9, 3.9), 0.3)], 0.0);
        let grid = CellGrid::along_longer_side(&square_field(), 10);
        let (mut blocked, mut entries) = (Vec::new(), Vec::new());
        grid.occupy(&world, &mut blocked);
        grid.entries(&world, &blocked, Point::new(2.25, 2.5), &mut entries);
        assert_eq!(entries, [(22, 0.25)], "its own cell");
        grid.entries(&world, &blocked, Point::new(5.1, 3.1), &mut entries);
        let cells: Vec<usize> = entries.iter().map(|e| e.0).collect();
        assert_eq!(cells, [24, 25, 26, 34, 44], "the far side of the disc is out of sight");
    }
}
