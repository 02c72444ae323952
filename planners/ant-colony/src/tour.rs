//! Tours: cutting loops out, lengths, trails.

use std::f64::consts::SQRT_2;

use crate::map::{Map, NONE};
use crate::trails::{Trails, edge};

/// Cuts loops out of tours.
#[derive(Debug, Clone, Default)]
pub(crate) struct Loops {
    /// Where each cell stands in the tour; means something only if the tour has the cell there.
    order: Vec<u32>,
}

impl Loops {
    pub fn reset(&mut self, cells: usize) {
        self.order.clear();
        self.order.resize(cells, 0);
    }

    /// From every cell on, goes straight to the latest cell of the tour that one move leads to.
    /// An ant never enters a cell twice, so its loops close from a neighbouring cell.
    pub fn cut(&mut self, map: &Map, tour: &mut Vec<u32>) {
        for (i, cell) in tour.iter().enumerate() {
            self.order[*cell as usize] = i as u32;
        }
        let (mut from, mut kept) = (0, 1);
        while from + 1 < tour.len() {
            let later = |to: &u32| {
                let i = self.order[*to as usize] as usize;
                // Cells that the ant has retreated from hold old numbers; the part before `kept` is overwritten.
                if i > from && tour.get(i) == Some(to) { i } else { 0 }
            };
            let moves = map.moves[tour[from] as usize];
            from = moves.iter().filter(|to| **to != NONE).map(later).fold(from + 1, usize::max);
            tour[kept] = tour[from];
            kept += 1;
        }
        tour.truncate(kept);
    }
}

/// The move and the next cell at every step of the tour.
fn steps<'a>(map: &'a Map, tour: &'a [u32]) -> impl Iterator<Item = (usize, usize, usize)> + 'a {
    tour.windows(2).filter_map(|w| {
        let k = map.moves[w[0] as usize].iter().position(|to| *to == w[1])?;
        Some((w[0] as usize, k, w[1] as usize))
    })
}

/// Length from start to goal in scene units: `first` leg, moves, last leg.
pub(crate) fn length(map: &Map, first: f64, tour: &[u32]) -> f64 {
    let diagonal = steps(map, tour).filter(|(_, k, _)| k % 2 == 1).count();
    let straight = tour.len() - 1 - diagonal;
    let last = map.exit(tour[tour.len() - 1] as usize).unwrap_or(f64::INFINITY);
    first + map.grid.size() * (straight as f64 + SQRT_2 * diagonal as f64) + last
}

/// Lays `amount` on every edge of the tour.
pub(crate) fn lay(map: &Map, tour: &[u32], trails: &mut Trails, amount: f64) {
    for (from, k, to) in steps(map, tour) {
        trails.lay(edge(from, k, to), amount);
    }
}

#[cfg(test)]
mod tests {
    use env_model::{Scene, World};
    use planner_api::Problem;

    use super::*;

    /// An empty pitch of 5 × 4 unit cells; from the middle of cell 0 to that of cell 4.
    fn map() -> Map {
        let scene = Scene {
            name: "empty".into(),
            unit: "m".into(),
            robot_radius: 0.0,
            start: [0.5, 0.5],
            goal: [4.5, 0.5],
            field: Some(env_model::scene::Field { min: [0.0, 0.0], max: [5.0, 4.0] }),
            obstacles: vec![],
        };
        let world = World::new(&scene).unwrap();
        let mut map = Map::new();
        let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
        map.rebuild(&problem, 5, 2.0, &mut 0).unwrap();
        map
    }

    #[test]
    fn nearness_is_a_power_of_the_distance() {
        let map = map();
        // 4 cells away, √(3² + 1²), and half a cell at least.
        assert_eq!(map.nearness[0], 1.0 / 16.0);
        assert!((map.nearness[6] - 0.1).abs() < 1e-15, "{}", map.nearness[6]);
        assert_eq!(map.nearness[4], 4.0);
    }

    #[test]
    fn loops_are_cut_where_they_close() {
        let map = map();
        let mut loops = Loops::default();
        loops.reset(map.grid.len());
        // Up the left side, right, down to cell 1 beside the start, and on to the goal:
        // 15 16 17
        // 10    12
        //  5     7
        //  0  1  2   3  4   (2 is entered from 7, 1 never)
        let mut tour = vec![0, 5, 10, 15, 16, 17, 12, 7, 2, 3, 4];
        loops.cut(&map, &mut tour);
        // 0 sees 5 only; 5 sees 10; 10 sees 15 and 16; 16 sees 17 and 12; 12 sees 7; 7 sees 2 and 3; 3 sees 4.
        assert_eq!(tour, [0, 5, 10, 16, 12, 7, 3, 4]);
        let mut closed = vec![0, 5, 10, 11, 12, 7, 6, 1, 2, 3, 4];
        loops.cut(&map, &mut closed);
        assert_eq!(closed, [0, 1, 2, 3, 4], "numbers left by the tour before mean nothing");
        assert_eq!(length(&map, 0.25, &tour), 0.25 + 4.0 + 3.0 * SQRT_2);
    }

    #[test]
    fn every_edge_of_a_tour_is_laid() {
        let (map, tour) = (map(), [0, 1, 7]);
        let mut trails = Trails::default();
        trails.reset(map.grid.len(), 1.0, 1.0);
        lay(&map, &tour, &mut trails, 0.5);
        trails.raise(1.0);
        assert_eq!(
            [edge(0, 0, 1), edge(1, 1, 7), edge(7, 5, 1), edge(1, 0, 2)].map(|e| trails.power(e)),
            [1.5, 1.5, 1.5, 1.0]
        );
    }
}
