//! Shortest octile paths: straight moves of length 1, diagonal ones of √2, no corner cutting.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::f64::consts::SQRT_2;

use crate::CellGrid;

/// A length as numbers of straight and diagonal moves, so that no order of adding matters.
#[derive(Clone, Copy, PartialEq)]
struct Length {
    straight: u32,
    diagonal: u32,
}

impl Length {
    fn value(self) -> f64 {
        f64::from(self.straight) + SQRT_2 * f64::from(self.diagonal)
    }
}

/// Orders nodes of the open list; costs are never NaN.
#[derive(PartialEq)]
struct Estimate(f64, usize);

impl Eq for Estimate {}

impl PartialOrd for Estimate {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Estimate {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0).then(self.1.cmp(&other.1))
    }
}

/// Length of the shortest path, in cells, by A* with the octile distance (Hart, Nilsson &
/// Raphael 1968); `None` where there is none.
pub(super) fn length(grid: &CellGrid, blocked: &[bool], start: usize, goal: usize) -> Option<f64> {
    let mut best: Vec<Option<Length>> = vec![None; grid.len()];
    let mut closed = vec![false; grid.len()];
    let mut open = BinaryHeap::from([Reverse(Estimate(grid.octile(start, goal), start))]);
    best[start] = Some(Length { straight: 0, diagonal: 0 });
    while let Some(Reverse(Estimate(_, cell))) = open.pop() {
        if std::mem::replace(&mut closed[cell], true) {
            continue;
        }
        let so_far = best[cell]?;
        if cell == goal {
            return Some(so_far.value());
        }
        grid.for_each_move(blocked, cell, |to, diagonal| {
            let step = u32::from(diagonal);
            let length = Length { straight: so_far.straight + 1 - step, diagonal: so_far.diagonal + step };
            // Closed cells are final but for rounding of the heuristic, far below any difference of lengths.
            if !closed[to] && best[to].is_none_or(|known| length.value() < known.value()) {
                best[to] = Some(length);
                open.push(Reverse(Estimate(length.value() + grid.octile(to, goal), to)));
            }
        });
    }
    None
}
