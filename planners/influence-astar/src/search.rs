//! A* with reopening (Hart, Nilsson & Raphael 1968).
//!
//! Among open cells of equal f the one with the larger g goes first, then the
//! lower number: the same order on any machine. A closed cell to which a cheaper
//! way is found becomes open again, which an inconsistent h needs.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use planner_api::CellState;

use crate::cost::{Cost, Moves};
use crate::estimate::Estimate;
use crate::map::{Joint, Map};

/// What a search moves in.
#[derive(Clone, Copy)]
pub(crate) struct Terrain<'a> {
    pub map: &'a Map,
    /// Cells that cannot be entered or are outside the search space.
    pub barred: &'a [bool],
    pub estimate: &'a Estimate,
}

impl Terrain<'_> {
    /// The goal's node, after those of the cells.
    fn goal(&self) -> usize {
        self.map.grid.len()
    }
}

/// One entry of the open list, least first: f, then larger g, then the node.
type Entry = Reverse<(Cost, Reverse<Cost>, usize)>;

/// At most eight neighbours and the goal.
const MOST_SUCCESSORS: usize = 9;

/// Open and closed lists. Nodes are the cells and, after them, the goal itself.
#[derive(Debug, Clone, Default)]
pub(crate) struct Search {
    cost: Vec<Cost>,
    parent: Vec<usize>,
    states: Vec<CellState>,
    open: BinaryHeap<Entry>,
    successors: Vec<(usize, Cost)>,
}

/// No parent: a cell where the path may start.
const ROOT: usize = usize::MAX;

impl Search {
    /// Opens the cells where the path may start.
    pub fn begin(&mut self, terrain: &Terrain<'_>) {
        let nodes = terrain.goal() + 1;
        self.open.clear();
        self.cost.clear();
        self.cost.resize(nodes, Cost::UNREACHED);
        self.parent.clear();
        self.parent.resize(nodes, ROOT);
        self.states.clear();
        self.states.resize(nodes, CellState::Untouched);
        self.successors.clear();
        self.successors.reserve(MOST_SUCCESSORS);
        for &Joint { cell, cost, .. } in &terrain.map.ends.starts {
            self.relax(terrain, cell, cost + terrain.map.risks[cell], ROOT);
        }
    }

    /// Takes the next node off the open list; `None` when the search is over:
    /// the goal was next, or nothing is left.
    pub fn next(&mut self, terrain: &Terrain<'_>) -> Option<usize> {
        loop {
            let Reverse((_, Reverse(cost), node)) = self.open.pop()?;
            // Cheaper ways have left older entries behind.
            if cost == self.cost[node] {
                return (node != terrain.goal()).then_some(node);
            }
        }
    }

    /// Lists the successors of `cell` with the costs of going there, and counts them.
    pub fn look_round(&mut self, terrain: &Terrain<'_>, cell: usize) -> u64 {
        let map = terrain.map;
        let Moves { straight, diagonal } = map.moves;
        let successors = &mut self.successors;
        successors.clear();
        map.grid.for_each_move(terrain.barred, cell, |to, is_diagonal| {
            let way = if is_diagonal { diagonal } else { straight };
            successors.push((to, way + map.risks[to]));
        });
        let joint = map.ends.goals.iter().find(|joint| joint.cell == cell);
        successors.extend(joint.map(|joint| (terrain.goal(), joint.cost)));
        successors.len() as u64
    }

    /// Closes `cell` and opens the successors listed to which it is a cheaper way.
    pub fn expand(&mut self, terrain: &Terrain<'_>, cell: usize) {
        self.states[cell] = CellState::Closed;
        for i in 0..self.successors.len() {
            let (to, step) = self.successors[i];
            self.relax(terrain, to, self.cost[cell] + step, cell);
        }
    }

    fn relax(&mut self, terrain: &Terrain<'_>, node: usize, cost: Cost, parent: usize) {
        if cost >= self.cost[node] {
            return;
        }
        self.cost[node] = cost;
        self.parent[node] = parent;
        self.states[node] = CellState::Open;
        let remaining = if node == terrain.goal() { 0 } else { terrain.estimate.at(terrain.map, node) };
        let total = Cost { objective: cost.objective + remaining, tie: cost.tie };
        self.open.push(Reverse((total, Reverse(cost), node)));
    }

    /// The least cost of reaching the goal so far.
    pub fn goal_cost(&self) -> Cost {
        self.cost.last().copied().unwrap_or(Cost::UNREACHED)
    }

    /// Writes the cells of the path to the goal, from the start; it must have been reached.
    pub fn trace(&self, cells: &mut Vec<usize>) {
        cells.clear();
        let mut node = self.parent[self.parent.len() - 1];
        while node != ROOT {
            cells.push(node);
            node = self.parent[node];
        }
        cells.reverse();
    }

    /// What has been done with each cell.
    pub fn states(&self) -> &[CellState] {
        &self.states[..self.states.len().saturating_sub(1)]
    }
}
