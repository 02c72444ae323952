//! A tree that knows the way from the root to each node, and can be rewired.
//!
//! cost(root) = 0, cost(v) = cost(parent(v)) + ‖v − parent(v)‖. Children are kept
//! in doubly linked lists, so a node changes its parent in O(1) and passes its
//! gain on to its descendants in O(their number).

use env_model::Point;

use crate::tree::Tree;

/// No node.
const NONE: u32 = u32::MAX;

#[derive(Debug, Clone, Default)]
pub(crate) struct CostTree {
    pub tree: Tree,
    nodes: Vec<Links>,
    /// Nodes whose children have not yet heard of a new cost.
    pending: Vec<u32>,
}

#[derive(Debug, Clone, Copy)]
struct Links {
    cost: f64,
    first_child: u32,
    next: u32,
    previous: u32,
}

impl CostTree {
    /// Forgets all nodes and begins anew with `root`.
    pub fn plant(&mut self, root: Point) {
        self.tree.plant(root);
        self.nodes.clear();
        self.nodes.push(Links { cost: 0.0, first_child: NONE, next: NONE, previous: NONE });
    }

    /// Adds a node, which must differ from all others.
    pub fn push(&mut self, point: Point, parent: u32) -> u32 {
        let node = self.tree.push(point, parent);
        self.nodes.push(Links { cost: self.cost_through(parent, node), first_child: NONE, next: NONE, previous: NONE });
        self.link(node, parent);
        node
    }

    /// Length of the way from the root.
    pub fn cost(&self, node: u32) -> f64 {
        self.nodes[node as usize].cost
    }

    /// Hangs `node` on `parent` and corrects the costs of `node` and of all below it.
    /// `parent` must not be below `node`; a parent that shortens the way to `node` never is.
    pub fn reparent(&mut self, node: u32, parent: u32) {
        self.unlink(node);
        self.tree.set_parent(node, parent);
        self.link(node, parent);
        self.nodes[node as usize].cost = self.cost_through(parent, node);
        self.pending.push(node);
        while let Some(node) = self.pending.pop() {
            let mut child = self.nodes[node as usize].first_child;
            while child != NONE {
                self.nodes[child as usize].cost = self.cost_through(node, child);
                self.pending.push(child);
                child = self.nodes[child as usize].next;
            }
        }
    }

    /// Computed anew from the points rather than by a difference, so that no rounding
    /// accumulates and that a gain never raises a cost: rounding is monotone.
    fn cost_through(&self, parent: u32, node: u32) -> f64 {
        self.cost(parent) + (self.tree.point(node) - self.tree.point(parent)).norm()
    }

    fn link(&mut self, node: u32, parent: u32) {
        let first = std::mem::replace(&mut self.nodes[parent as usize].first_child, node);
        self.nodes[node as usize].next = first;
        self.nodes[node as usize].previous = NONE;
        if first != NONE {
            self.nodes[first as usize].previous = node;
        }
    }

    fn unlink(&mut self, node: u32) {
        let Links { next, previous, .. } = self.nodes[node as usize];
        if previous == NONE {
            self.nodes[self.tree.parent(node) as usize].first_child = next;
        } else {
            self.nodes[previous as usize].next = next;
        }
        if next != NONE {
            self.nodes[next as usize].previous = previous;
        }
    }

    /// Checks that costs and lists of children are those that points and parents imply.
    #[cfg(test)]
    pub fn assert_consistent(&self) {
        let mut listed = 0;
        for node in 0..self.tree.len() as u32 {
            let parent = self.tree.parent(node);
            if node == 0 {
                assert_eq!((parent, self.cost(0)), (0, 0.0));
            } else {
                // Exactly: costs are computed by this very sum.
                assert_eq!(self.cost(node), self.cost_through(parent, node));
                let steps = (0..=self.tree.len()).scan(node, |at, _| {
                    *at = self.tree.parent(*at);
                    Some(*at)
                });
                assert!(steps.into_iter().any(|at| at == 0), "node {node} does not lead to the root");
            }
            let mut child = self.nodes[node as usize].first_child;
            while child != NONE {
                assert_eq!(self.tree.parent(child), node);
                listed += 1;
                child = self.nodes[child as usize].next;
            }
        }
        assert_eq!(listed + 1, self.tree.len(), "every node but the root is its parent's child once");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gain_reaches_all_descendants() {
        // A detour 0 → 1 → 2 → {3, 4 → 5}; a new way 0 → 6 to node 2.
        let mut tree = CostTree::default();
        tree.plant(Point::new(0.0, 0.0));
        let one = tree.push(Point::new(0.0, 3.0), 0);
        let two = tree.push(Point::new(4.0, 0.0), one);
        let three = tree.push(Point::new(4.0, 1.0), two);
        let four = tree.push(Point::new(6.0, 0.0), two);
        let five = tree.push(Point::new(6.0, 5.0), four);
        let six = tree.push(Point::new(1.0, 0.0), 0);
        assert_eq!([two, three, four, five].map(|n| tree.cost(n)), [8.0, 9.0, 10.0, 15.0]);
        tree.assert_consistent();
        tree.reparent(two, six);
        assert_eq!([one, two, three, four, five].map(|n| tree.cost(n)), [3.0, 4.0, 5.0, 6.0, 11.0]);
        tree.assert_consistent();
        let mut branch = Vec::new();
        tree.tree.append_branch(five, &mut branch);
        assert_eq!(branch, [[6.0, 5.0], [6.0, 0.0], [4.0, 0.0], [1.0, 0.0], [0.0, 0.0]].map(Point::from));
    }
}
