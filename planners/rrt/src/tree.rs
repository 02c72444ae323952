//! A tree of points with an index of nearest neighbours.

use env_model::Point;
use planner_api::TreeView;

use crate::nearest::KdTree;

/// Node i hangs on node `parents[i]`; node 0 is the root and its own parent. Keeps its buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct Tree {
    points: Vec<Point>,
    parents: Vec<u32>,
    pub index: KdTree,
}

/// Nodes that every tree has room for from its first use on: more than a first path in a game
/// takes but once in many thousands of calls, so that buffers do not grow in a later one.
const ROOM: usize = 256;

impl Tree {
    /// Forgets all nodes and begins anew with `root`.
    pub fn plant(&mut self, root: Point) {
        self.points.clear();
        self.parents.clear();
        self.index.clear();
        self.points.reserve(ROOM);
        self.parents.reserve(ROOM);
        self.index.reserve(ROOM);
        self.push(root, 0);
    }

    /// Adds a node, which must differ from all others.
    pub fn push(&mut self, point: Point, parent: u32) -> u32 {
        let node = self.points.len() as u32;
        self.points.push(point);
        self.parents.push(parent);
        self.index.push(point);
        node
    }

    pub fn len(&self) -> usize {
        self.points.len()
    }

    pub fn points(&self) -> &[Point] {
        &self.points
    }

    pub fn point(&self, node: u32) -> Point {
        self.points[node as usize]
    }

    pub fn parent(&self, node: u32) -> u32 {
        self.parents[node as usize]
    }

    pub fn set_parent(&mut self, node: u32, parent: u32) {
        self.parents[node as usize] = parent;
    }

    /// The node nearest to `p` and their distance.
    pub fn nearest(&mut self, p: Point) -> (u32, f64) {
        let (node, squared) = self.index.nearest(p).expect("a tree has a root");
        (node, squared.sqrt())
    }

    /// Where a step of length at most `step` from `from` to `target`, `distance` away, ends.
    pub fn steer(from: Point, target: Point, distance: f64, step: f64) -> Point {
        if distance <= step { target } else { from + (target - from) * (step / distance) }
    }

    /// Appends the points from `node` to the root.
    pub fn append_branch(&self, mut node: u32, path: &mut Vec<Point>) {
        loop {
            path.push(self.point(node));
            if node == 0 {
                return;
            }
            node = self.parent(node);
        }
    }

    pub fn view(&self) -> TreeView<'_> {
        TreeView { nodes: &self.points, parents: &self.parents }
    }
}
