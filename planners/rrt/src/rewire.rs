//! The two steps that make a tree RRT*: the best parent for a new node, and the
//! new node as parent of its neighbours (Karaman & Frazzoli 2011, Algorithm 6,
//! lines 9–16).

use env_model::{Point, World};

use crate::cost_tree::CostTree;

/// A node near the new one.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Neighbour {
    pub node: u32,
    pub distance: f64,
    /// Length of the way to the new node through this one; +∞ where that is known to be blocked.
    pub through: f64,
}

/// The parent that makes the way to `at` shortest, where `nearest` is known to be
/// a possible one and `through_nearest` the length of that way.
///
/// Candidates are tested in ascending order of length until one is free, so most
/// are never tested (*delayed collision checking*: Perez, Karaman, Shkolnik,
/// Frazzoli, Teller & Walter, IROS 2011). Equal lengths go to the older node.
pub(crate) fn best_parent(
    world: &World,
    tree: &CostTree,
    near: &mut [Neighbour],
    at: Point,
    (nearest, through_nearest): (u32, f64),
    checks: &mut u64,
) -> u32 {
    loop {
        let best = near
            .iter_mut()
            .filter(|n| n.through < through_nearest)
            .min_by(|a, b| a.through.total_cmp(&b.through).then(a.node.cmp(&b.node)));
        let Some(best) = best else { return nearest };
        *checks += 1;
        if world.segment_free(tree.tree.point(best.node), at) {
            return best.node;
        }
        best.through = f64::INFINITY;
    }
}

/// Hangs every neighbour on `new` to which the way through it is free and shorter.
pub(crate) fn rewire(world: &World, tree: &mut CostTree, near: &[Neighbour], new: u32, checks: &mut u64) {
    let at = tree.tree.point(new);
    for neighbour in near {
        let shorter = tree.cost(new) + neighbour.distance < tree.cost(neighbour.node);
        if !shorter {
            continue;
        }
        *checks += 1;
        if world.segment_free(at, tree.tree.point(neighbour.node)) {
            tree.reparent(neighbour.node, new);
        }
    }
}
