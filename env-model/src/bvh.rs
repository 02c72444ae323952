//! A bounding-volume hierarchy over boxes: the broad phase.
//!
//! Built once by splitting at the median of the longer axis of the centres, so
//! its depth is ⌈log₂(n / LEAF)⌉ whatever the input. Queries allocate nothing.

use crate::geometry::cross;
use crate::{Aabb, Point};

const LEAF: usize = 4;
/// Enough for 2³² boxes under median splits.
const STACK: usize = 40;

#[derive(Debug, Clone)]
struct Node {
    aabb: Aabb,
    /// First item of a leaf; index of the right child otherwise (the left one follows its parent).
    first: u32,
    /// Items of a leaf; 0 for an inner node.
    count: u32,
}

/// The hierarchy: items are the indices of the boxes it was built from.
#[derive(Debug, Clone, Default)]
pub struct Bvh {
    nodes: Vec<Node>,
    items: Vec<u32>,
}

impl Bvh {
    /// Builds the hierarchy, O(n log² n).
    pub fn build(boxes: &[Aabb]) -> Self {
        Self::over(boxes, (0..u32::try_from(boxes.len()).expect("fewer than 2³² boxes")).collect())
    }

    /// Builds the hierarchy over some of `boxes`.
    pub fn over(boxes: &[Aabb], items: Vec<u32>) -> Self {
        let mut nodes = Vec::with_capacity(items.len());
        let mut seeds: Vec<Seed> =
            items.into_iter().map(|item| Seed { centre: boxes[item as usize].centre(), item }).collect();
        if !seeds.is_empty() {
            split(boxes, &mut seeds, 0, &mut nodes);
        }
        Self { nodes, items: seeds.into_iter().map(|seed| seed.item).collect() }
    }

    /// The items in the order in which they are visited.
    pub fn items(&self) -> &[u32] {
        &self.items
    }

    /// Calls `visit` for every item whose box the segment `a b` may touch, until it returns `true`.
    /// Returns whether it did.
    pub fn any_along(&self, a: Point, b: Point, mut visit: impl FnMut(usize) -> bool) -> bool {
        self.any(touching(a, b), &mut visit)
    }

    /// Calls `visit` for every item whose box may touch the rectangle with the axis `a b` and
    /// `half_width` (perhaps +∞) to either side, until it returns `true`. Returns whether it did.
    pub fn any_beside(&self, a: Point, b: Point, half_width: f64, mut visit: impl FnMut(usize) -> bool) -> bool {
        let d = b - a;
        let (middle, along, across) = (a + d * 0.5, 0.5 * d.norm_squared(), half_width * d.norm());
        self.any(
            |aabb| {
                let c = aabb.centre();
                let (h, c) = (aabb.max - c, c - middle);
                d.dot(&c).abs() <= h.x * d.x.abs() + h.y * d.y.abs() + along
                    && cross(d, c).abs() <= h.x * d.y.abs() + h.y * d.x.abs() + across
            },
            &mut visit,
        )
    }

    /// Calls `visit` for every item whose box overlaps `region`, until it returns `true`.
    /// Returns whether it did.
    pub fn any_overlapping(&self, region: &Aabb, mut visit: impl FnMut(usize) -> bool) -> bool {
        self.any(|aabb| region.overlaps(aabb), &mut visit)
    }

    fn any(&self, touches: impl Fn(&Aabb) -> bool, visit: &mut impl FnMut(usize) -> bool) -> bool {
        let mut stack = [0u32; STACK];
        let mut top = usize::from(!self.nodes.is_empty());
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            if !touches(&node.aabb) {
                continue;
            }
            if node.count > 0 {
                let items = &self.items[node.first as usize..(node.first + node.count) as usize];
                if items.iter().any(|&i| visit(i as usize)) {
                    return true;
                }
            } else {
                stack[top] = node.first;
                stack[top + 1] = index + 1;
                top += 2;
            }
        }
        false
    }

    /// The least `clearance(item)` and its item, given that an item's clearance is at least the
    /// distance from `region` to its box when that distance is positive. Ties go to the lower index.
    pub fn least_clearance(&self, region: &Aabb, mut clearance: impl FnMut(usize) -> f64) -> Option<(f64, usize)> {
        let mut best: Option<(f64, usize)> = None;
        let mut stack = [0u32; STACK];
        let mut top = usize::from(!self.nodes.is_empty());
        let bound = |aabb: &Aabb| {
            let d2 = region.distance_squared(aabb);
            // 1e-12 absorbs the rounding of the square root: a tie is visited, not pruned.
            if d2 > 0.0 { d2.sqrt() * (1.0 - 1e-12) } else { f64::NEG_INFINITY }
        };
        while top > 0 {
            top -= 1;
            let index = stack[top];
            let node = &self.nodes[index as usize];
            if best.is_some_and(|(d, _)| bound(&node.aabb) > d) {
                continue;
            }
            if node.count > 0 {
                for &i in &self.items[node.first as usize..(node.first + node.count) as usize] {
                    let candidate = (clearance(i as usize), i as usize);
                    if best.is_none_or(|b| candidate < b) {
                        best = Some(candidate);
                    }
                }
            } else {
                let (left, right) = (index + 1, node.first);
                let left_is_nearer = bound(&self.nodes[left as usize].aabb) <= bound(&self.nodes[right as usize].aabb);
                (stack[top], stack[top + 1]) = if left_is_nearer { (right, left) } else { (left, right) };
                top += 2;
            }
        }
        best
    }
}

/// Whether the segment `a b` may touch a box: neither a side of either box nor the segment's line parts them.
pub fn touching(a: Point, b: Point) -> impl Fn(&Aabb) -> bool {
    let d = b - a;
    let reach = Aabb::of_points([&a, &b]);
    move |aabb| {
        let c = aabb.centre();
        let h = aabb.max - c;
        reach.overlaps(aabb) && cross(d, c - a).abs() <= h.x * d.y.abs() + h.y * d.x.abs()
    }
}

/// An item while the tree is built, beside what it is sorted by.
struct Seed {
    centre: Point,
    item: u32,
}

fn split(boxes: &[Aabb], seeds: &mut [Seed], offset: u32, nodes: &mut Vec<Node>) -> Aabb {
    let at = nodes.len();
    if seeds.len() <= LEAF {
        let aabb = seeds.iter().fold(Aabb::EMPTY, |b, seed| b.union(boxes[seed.item as usize]));
        nodes.push(Node { aabb, first: offset, count: seeds.len() as u32 });
        return aabb;
    }
    nodes.push(Node { aabb: Aabb::EMPTY, first: 0, count: 0 });
    let spread = Aabb::of_points(seeds.iter().map(|seed| &seed.centre)).size();
    let axis = usize::from(spread.y > spread.x);
    let middle = seeds.len() / 2;
    // The index breaks ties, so the tree depends on nothing but its input.
    seeds.select_nth_unstable_by(middle, |s, t| s.centre[axis].total_cmp(&t.centre[axis]).then(s.item.cmp(&t.item)));
    let (left, right) = seeds.split_at_mut(middle);
    let lower = split(boxes, left, offset, nodes);
    nodes[at].first = nodes.len() as u32;
    nodes[at].aabb = lower.union(split(boxes, right, offset + middle as u32, nodes));
    nodes[at].aabb
}
