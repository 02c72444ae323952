//! Best-first search: the open list, and what is known of every node.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use env_model::World;
use planner_api::CellState;

use crate::graph::Graph;
use crate::length::Length;
use crate::method::Method;

/// The shortest known way to every node.
#[derive(Debug, Clone, Default)]
pub(crate) struct Reached {
    parents: Vec<u32>,
    lengths: Vec<Length>,
    distances: Vec<f64>,
    states: Vec<CellState>,
}

impl Reached {
    fn reset(&mut self, nodes: usize) {
        refill(&mut self.parents, nodes, 0);
        refill(&mut self.lengths, nodes, Length::default());
        refill(&mut self.distances, nodes, f64::INFINITY);
        refill(&mut self.states, nodes, CellState::Untouched);
    }

    /// The node before this one; the start is its own.
    pub fn parent(&self, node: usize) -> usize {
        self.parents[node] as usize
    }

    pub fn length(&self, node: usize) -> Length {
        self.lengths[node]
    }

    /// [`Reached::length`] in scene units; +∞ for a node never reached.
    pub fn distance(&self, node: usize) -> f64 {
        self.distances[node]
    }

    /// Every node's distance.
    pub fn distances(&self) -> &[f64] {
        &self.distances
    }

    /// What has been done with every node.
    pub fn states(&self) -> &[CellState] {
        &self.states
    }

    /// Writes the nodes from the root of the tree to `node`.
    pub fn write_chain(&self, mut node: usize, chain: &mut Vec<usize>) {
        chain.clear();
        chain.push(node);
        while self.parent(node) != node {
            node = self.parent(node);
            chain.push(node);
        }
        chain.reverse();
    }
}

fn refill<T: Clone>(buffer: &mut Vec<T>, count: usize, value: T) {
    buffer.clear();
    buffer.resize(count, value);
}

/// An entry of the open list. Ties in f go to the node nearer to the goal (the
/// search runs straight on where many paths are equally short), then to the lower number.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Entry {
    estimate: f64,
    remaining: f64,
    node: u32,
}

impl Eq for Entry {}

impl Ord for Entry {
    fn cmp(&self, other: &Self) -> Ordering {
        self.estimate
            .total_cmp(&other.estimate)
            .then(self.remaining.total_cmp(&other.remaining))
            .then(self.node.cmp(&other.node))
    }
}

impl PartialOrd for Entry {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// A search that can be taken a step at a time.
#[derive(Debug, Clone)]
pub(crate) struct Search {
    method: Method,
    pub reached: Reached,
    open: BinaryHeap<Reverse<Entry>>,
}

impl Search {
    pub fn new(method: Method) -> Self {
        Self { method, reached: Reached::default(), open: BinaryHeap::new() }
    }

    /// Opens the start.
    pub fn begin(&mut self, graph: &Graph) {
        self.reached.reset(graph.nodes());
        self.open.clear();
        let start = graph.start();
        self.open(graph, start, start, Length::default());
    }

    /// Takes the open node with the least f off the list.
    pub fn next(&mut self) -> Option<usize> {
        loop {
            let node = self.open.pop()?.0.node as usize;
            // An entry that a shorter way has made obsolete comes after its node was closed.
            if self.reached.states[node] != CellState::Closed {
                return Some(node);
            }
        }
    }

    /// Closes `node` and opens its successors where they are reached by a shorter way
    /// than before. Returns the number of successors; counts tests of sight in `checks`.
    /// With a consistent estimate a closed node has its shortest way already.
    pub fn expand(&mut self, graph: &Graph, world: &World, node: usize, checks: &mut u64) -> u64 {
        self.reached.states[node] = CellState::Closed;
        let mut generated = 0;
        graph.for_each_successor(node, |to, edge| {
            generated += 1;
            if self.reached.states[to] != CellState::Closed
                && let Some((parent, length)) = self.method.link(graph, world, &self.reached, (node, to, edge), checks)
            {
                self.open(graph, to, parent, length);
            }
        });
        generated
    }

    fn open(&mut self, graph: &Graph, node: usize, parent: usize, length: Length) {
        let size = graph.grid.size();
        let remaining = self.method.remaining(graph, node);
        self.reached.parents[node] = parent as u32;
        self.reached.lengths[node] = length;
        self.reached.distances[node] = length.value(size);
        self.reached.states[node] = CellState::Open;
        self.open.push(Reverse(Entry {
            // From the sums of moves, so that ties are exact.
            estimate: (length + remaining).value(size),
            remaining: remaining.value(size),
            node: node as u32,
        }));
    }
}
