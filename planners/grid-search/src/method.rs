//! What tells A*, Dijkstra's algorithm and Theta* apart.

use env_model::World;

use crate::graph::Graph;
use crate::length::Length;
use crate::search::Reached;

/// How far a node is from the goal at least, and by which way it is reached.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Method {
    /// Hart, Nilsson & Raphael 1968 with the octile distance, which is exact on an empty grid.
    AStar,
    /// Dijkstra 1959: nothing is known of the rest of the way.
    Dijkstra,
    /// Nash et al. 2007, the basic variant: a node hangs on its predecessor's parent
    /// where it sees it. Sight is the world's exact test of a segment, so a path may
    /// cross cells that an obstacle only grazes.
    ThetaStar,
}

impl Method {
    /// Lower bound h on the way from `node` to the goal, consistent: h(a) ≤ c(a, b) + h(b).
    pub fn remaining(self, graph: &Graph, node: usize) -> Length {
        if node == graph.goal() {
            return Length::default();
        }
        match self {
            Self::Dijkstra => Length::default(),
            Self::ThetaStar => Length::real((graph.point(graph.goal()) - graph.point(node)).norm()),
            Self::AStar => {
                let size = graph.grid.size();
                let by = |(last, distance): &(usize, f64)| {
                    let (straight, diagonal) = octile_moves(graph, node, *last);
                    Length { rest: *distance, straight, diagonal }
                };
                let ways = graph.last_cells().iter().map(by);
                ways.min_by(|a, b| a.value(size).total_cmp(&b.value(size))).unwrap_or_default()
            }
        }
    }

    /// The parent and the length by which an edge of length `edge` from `node` reaches
    /// `to`; `None` when that is no shorter than what `reached` has. Counts tests of sight.
    pub fn link(
        self,
        graph: &Graph,
        world: &World,
        reached: &Reached,
        (node, to, edge): (usize, usize, Length),
        checks: &mut u64,
    ) -> Option<(usize, Length)> {
        let size = graph.grid.size();
        let shorter = |length: &Length| length.value(size) < reached.distance(to);
        if self != Self::ThetaStar {
            return Some((node, reached.length(node) + edge)).filter(|(_, length)| shorter(length));
        }
        let p = graph.point(to);
        let through = |via: usize| (via, Length::real(reached.distance(via) + (p - graph.point(via)).norm()));
        // The straight way from the parent is never longer than the way through `node`:
        // where it gains nothing, sight need not be tested.
        let parent = reached.parent(node);
        let straight = through(parent);
        if !shorter(&straight.1) {
            return None;
        }
        *checks += 1;
        if world.segment_free(graph.point(parent), p) {
            return Some(straight);
        }
        Some(through(node)).filter(|(_, length)| shorter(length))
    }
}

/// Straight and diagonal moves of the octile distance between two cells.
fn octile_moves(graph: &Graph, a: usize, b: usize) -> (u32, u32) {
    let ((ac, ar), (bc, br)) = (graph.grid.position(a), graph.grid.position(b));
    let (dx, dy) = (ac.abs_diff(bc) as u32, ar.abs_diff(br) as u32);
    (dx.max(dy) - dx.min(dy), dx.min(dy))
}
