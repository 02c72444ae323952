//! Lines along a field of directions, evenly apart.
//!
//! A simple form of Jobard & Lefer, *Creating evenly-spaced streamlines of arbitrary density*
//! (1997): a line starts at a cell whose neighbourhood has none, is followed both ways in steps
//! of a quarter cell along the bilinear interpolation of the directions, and ends where it would
//! enter another line's cell, at the border, or where directions cancel out.

use crate::snapshot::Mesh;

/// Length of a step, in cells.
const STEP: f64 = 0.25;
/// Most steps one way.
const MOST: usize = 600;
/// Steps inside one cell after which a line turns on the spot.
const LINGER: usize = 16;

/// The lines, in cells: the middle of the lowest left cell is (0, 0).
pub fn streamlines(mesh: &Mesh, directions: &[[i8; 2]]) -> Vec<Vec<(f64, f64)>> {
    if mesh.count() == 0 || directions.len() < mesh.count() {
        return Vec::new();
    }
    let apart = (mesh.columns.max(mesh.rows) / 30).max(1) as isize;
    let mut visited = vec![false; mesh.count()];
    let mut lines = Vec::new();
    for seed in 0..mesh.count() {
        let (column, row) = ((seed % mesh.columns) as isize, (seed / mesh.columns) as isize);
        let near = |reach: isize| {
            let square = move |d: isize| (-reach..=reach).map(move |e| (d, e));
            (-reach..=reach).flat_map(square).filter_map(|(dx, dy)| cell(mesh, (column + dx) as f64, (row + dy) as f64))
        };
        if directions[seed] == [0, 0] || near(apart).any(|c| visited[c]) {
            continue;
        }
        let start = (column as f64, row as f64);
        let mut line = follow(mesh, directions, &visited, start, -1.0);
        line.reverse();
        line.push(start);
        line.extend(follow(mesh, directions, &visited, start, 1.0));
        for c in line.iter().filter_map(|(x, y)| cell(mesh, *x, *y)) {
            visited[c] = true;
        }
        // Shorter ones are specks.
        if line.len() as f64 * STEP >= 1.5 {
            lines.push(line);
        }
    }
    lines
}

/// The cell round a point.
fn cell(mesh: &Mesh, x: f64, y: f64) -> Option<usize> {
    let (column, row) = (x.round(), y.round());
    let inside = column >= 0.0 && row >= 0.0 && column < mesh.columns as f64 && row < mesh.rows as f64;
    inside.then(|| row as usize * mesh.columns + column as usize)
}

/// Steps from `start`, which is left out, along (`sign` = 1) or against the directions.
fn follow(mesh: &Mesh, directions: &[[i8; 2]], visited: &[bool], start: (f64, f64), sign: f64) -> Vec<(f64, f64)> {
    let (mut x, mut y) = start;
    let mut line = Vec::new();
    let (mut last, mut lingering) = (None, 0);
    while line.len() < MOST {
        let Some((dx, dy)) = direction(mesh, directions, x, y) else { break };
        (x, y) = (x + sign * STEP * dx, y + sign * STEP * dy);
        let here = cell(mesh, x, y);
        if here.is_none_or(|c| visited[c]) {
            break;
        }
        lingering = if here == last { lingering + 1 } else { 0 };
        last = here;
        if lingering > LINGER {
            line.truncate(line.len() + 1 - LINGER);
            break;
        }
        line.push((x, y));
    }
    line
}

/// The unit direction at a point; `None` in and beside cells without force, and where directions cancel out.
fn direction(mesh: &Mesh, directions: &[[i8; 2]], x: f64, y: f64) -> Option<(f64, f64)> {
    if directions[cell(mesh, x, y)?] == [0, 0] {
        return None;
    }
    let corner = |v: f64, count: usize| (v.max(0.0) as usize).min(count.saturating_sub(2));
    let (i, j) = (corner(x, mesh.columns), corner(y, mesh.rows));
    let (u, v) = ((x - i as f64).clamp(0.0, 1.0), (y - j as f64).clamp(0.0, 1.0));
    let at = |column: usize, row: usize| {
        let [dx, dy] = directions[row.min(mesh.rows - 1) * mesh.columns + column.min(mesh.columns - 1)];
        (f64::from(dx), f64::from(dy))
    };
    let corners =
        [(i, j, (1.0 - u) * (1.0 - v)), (i + 1, j, u * (1.0 - v)), (i, j + 1, (1.0 - u) * v), (i + 1, j + 1, u * v)];
    let (dx, dy) = corners.iter().fold((0.0, 0.0), |(x, y), (column, row, weight)| {
        let (dx, dy) = at(*column, *row);
        (x + weight * dx, y + weight * dy)
    });
    let length = dx.hypot(dy);
    (length > 20.0).then_some((dx / length, dy / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(columns: usize, rows: usize) -> Mesh {
        Mesh { min: [0.0, 0.0], size: 1.0, columns, rows, every: 1, whole: None }
    }

    #[test]
    fn a_uniform_field_gives_parallel_lines() {
        let mesh = mesh(40, 20);
        let lines = streamlines(&mesh, &vec![[100, 0]; mesh.count()]);
        // An empty row lies between lines: 0, 2, 4, …, 18.
        assert_eq!(lines.len(), 10);
        for line in &lines {
            let (first, last) = (line[0], line[line.len() - 1]);
            assert!(first.1 == last.1 && first.0 < 0.3 && last.0 > 39.0, "{first:?} {last:?}");
        }
    }

    #[test]
    fn lines_end_in_sinks_and_at_walls() {
        let mesh = mesh(41, 41);
        let towards = |cell: usize| {
            let (dx, dy) = (20.0 - (cell % 41) as f64, 20.0 - (cell / 41) as f64);
            let length = dx.hypot(dy).max(1e-9);
            [(100.0 * dx / length).round() as i8, (100.0 * dy / length).round() as i8]
        };
        let mut field: Vec<[i8; 2]> = (0..mesh.count()).map(towards).collect();
        for row in 5..10 {
            field[row * 41 + 5..row * 41 + 10].fill([0, 0]);
        }
        let lines = streamlines(&mesh, &field);
        assert!(lines.len() > 10);
        let distance = |p: &(f64, f64)| (p.0 - 20.0).hypot(p.1 - 20.0);
        for line in &lines {
            assert!(distance(&line[line.len() - 1]) < distance(&line[0]), "inwards");
            for (x, y) in line {
                let inside = (5.0..=9.0).contains(x) && (5.0..=9.0).contains(y);
                assert!(!inside, "({x}, {y}) is in the hole");
            }
        }
        assert!(lines.iter().any(|l| distance(&l[l.len() - 1]) < 2.0), "one reaches the sink");
    }

    #[test]
    fn odd_meshes_are_harmless() {
        assert!(streamlines(&mesh(0, 5), &[]).is_empty());
        assert!(streamlines(&mesh(3, 3), &[[100, 0]]).is_empty(), "too few directions");
        streamlines(&mesh(1, 9), &[[0, 100]; 9]);
    }
}
