//! Exact nearest neighbours among points that arrive one by one.
//!
//! A k-d tree with buckets: leaves hold up to 16 points; a full leaf splits its
//! wider side at the median. Up to 16 points are searched by brute force, which
//! nothing beats. Insertion and search are O(log n) for points in random order.
//!
//! Bentley, "Multidimensional binary search trees used for associative
//! searching", *Communications of the ACM* 18(9), 1975, 509–517.
//! Distances to a subtree's cell are updated plane by plane: Arya & Mount,
//! "Algorithms for fast vector quantization", *Data Compression Conference*,
//! 1993, 381–390.

use env_model::Point;

/// Points in a leaf.
const BUCKET: usize = 16;

/// A k-d tree over points that their order of insertion numbers from 0. Keeps its buffers.
#[derive(Debug, Clone, Default)]
pub(crate) struct KdTree {
    nodes: Vec<Node>,
    buckets: Vec<Bucket>,
    len: u32,
    /// Subtrees still to be searched, with the offset from the query to their cells.
    pending: Vec<(u32, [f64; 2])>,
}

#[derive(Debug, Clone, Copy)]
enum Node {
    Leaf {
        bucket: u32,
    },
    /// Coordinates below `at` are in `low`, the others in `low + 1`.
    Split {
        axis: u32,
        at: f64,
        low: u32,
    },
}

#[derive(Debug, Clone, Copy)]
struct Bucket {
    len: usize,
    ids: [u32; BUCKET],
    at: [[f64; BUCKET]; 2],
}

impl Bucket {
    /// Unused places lie at infinity, further than any bound.
    const EMPTY: Self = Self { len: 0, ids: [0; BUCKET], at: [[f64::INFINITY; BUCKET]; 2] };

    fn push(&mut self, id: u32, at: [f64; 2]) {
        self.ids[self.len] = id;
        (self.at[0][self.len], self.at[1][self.len]) = (at[0], at[1]);
        self.len += 1;
    }
}

impl KdTree {
    pub fn clear(&mut self) {
        self.nodes.clear();
        self.nodes.push(Node::Leaf { bucket: 0 });
        self.buckets.clear();
        self.buckets.push(Bucket::EMPTY);
        self.len = 0;
    }

    /// Makes room for `points` in an empty tree.
    pub fn reserve(&mut self, points: usize) {
        // A split leaves at least one point on each side, mostly half of them.
        let leaves = points.div_ceil(BUCKET / 4);
        self.buckets.reserve(leaves);
        self.nodes.reserve(2 * leaves);
        self.pending.reserve(leaves);
    }

    /// Adds a point; its number is that of the points before it.
    ///
    /// # Panics
    /// On more than 16 copies of one point, which no plane can part.
    pub fn push(&mut self, p: Point) {
        let p = [p.x, p.y];
        let mut node = 0;
        loop {
            match self.nodes[node] {
                Node::Split { axis, at, low } => node = low as usize + usize::from(p[axis as usize] >= at),
                Node::Leaf { bucket } if self.buckets[bucket as usize].len < BUCKET => {
                    self.buckets[bucket as usize].push(self.len, p);
                    self.len += 1;
                    return;
                }
                Node::Leaf { bucket } => self.split(node, bucket),
            }
        }
    }

    fn split(&mut self, node: usize, bucket: u32) {
        let full = self.buckets[bucket as usize];
        let sorted = full.at.map(|mut coordinates| {
            coordinates.sort_unstable_by(f64::total_cmp);
            coordinates
        });
        let spread = sorted.map(|c| c[BUCKET - 1] - c[0]);
        let axis = usize::from(spread[1] > spread[0]);
        let values = &sorted[axis];
        // Equal coordinates stay together: the plane is the first value from the median on that leaves some below it.
        let at = values[BUCKET / 2..].iter().copied().find(|v| *v > values[0]);
        let at = at.expect("points are distinct");
        let (mut low, mut high) = (Bucket::EMPTY, Bucket::EMPTY);
        for i in 0..BUCKET {
            let p = [full.at[0][i], full.at[1][i]];
            if p[axis] < at { &mut low } else { &mut high }.push(full.ids[i], p);
        }
        self.nodes[node] = Node::Split { axis: axis as u32, at, low: self.nodes.len() as u32 };
        self.nodes.push(Node::Leaf { bucket });
        self.nodes.push(Node::Leaf { bucket: self.buckets.len() as u32 });
        self.buckets[bucket as usize] = low;
        self.buckets.push(high);
    }

    /// The point nearest to `p` and its squared distance; the first inserted of
    /// equally near ones. `None` of an empty tree.
    pub fn nearest(&mut self, p: Point) -> Option<(u32, f64)> {
        let mut best = (u32::MAX, f64::INFINITY);
        self.search(p, f64::INFINITY, |id, d2, bound| {
            if d2 < best.1 || d2 == best.1 && id < best.0 {
                best = (id, d2);
                *bound = d2;
            }
        });
        (self.len > 0).then_some(best)
    }

    /// Calls `visit(number, squared distance)` for every point no further than
    /// `radius` from `p`, in an order that depends on nothing but the insertions.
    pub fn within(&mut self, p: Point, radius: f64, mut visit: impl FnMut(u32, f64)) {
        self.search(p, radius * radius, |id, d2, _| visit(id, d2));
    }

    /// Visits all points whose squared distance is at most a bound, which `visit` may lower.
    fn search(&mut self, p: Point, mut bound: f64, mut visit: impl FnMut(u32, f64, &mut f64)) {
        let Self { nodes, buckets, pending, .. } = self;
        let p = [p.x, p.y];
        pending.clear();
        pending.push((0, [0.0; 2]));
        while let Some((mut node, offset)) = pending.pop() {
            // Rounding is monotone, so this never exceeds the computed distance of a point in the cell.
            if offset[0] * offset[0] + offset[1] * offset[1] > bound {
                continue;
            }
            let bucket = loop {
                match nodes[node as usize] {
                    Node::Leaf { bucket } => break &buckets[bucket as usize],
                    Node::Split { axis, at, low } => {
                        let axis = axis as usize;
                        let beyond = p[axis] - at;
                        let is_high = u32::from(beyond >= 0.0);
                        let mut far = offset;
                        far[axis] = beyond;
                        pending.push((low + 1 - is_high, far));
                        node = low + is_high;
                    }
                }
            };
            let squares: [f64; BUCKET] = std::array::from_fn(|i| {
                let (dx, dy) = (bucket.at[0][i] - p[0], bucket.at[1][i] - p[1]);
                dx * dx + dy * dy
            });
            for (&id, &d2) in bucket.ids.iter().zip(&squares).take(bucket.len) {
                if d2 <= bound {
                    visit(id, d2, &mut bound);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn squared(a: Point, b: Point) -> f64 {
        (a - b).norm_squared()
    }

    fn filled(points: &[Point]) -> KdTree {
        let mut tree = KdTree::default();
        // Twice, so that what is left of an earlier filling would show.
        for _ in 0..2 {
            tree.clear();
            points.iter().for_each(|p| tree.push(*p));
        }
        tree
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]
        /// Coordinates on a lattice of 40 × 40 give many ties and equal coordinates.
        #[test]
        fn finds_what_brute_force_finds(
            cells in proptest::collection::hash_set((0..40i32, 0..40i32), 1..400),
            queries in proptest::collection::vec((-10..50i32, -10..50i32, 0..30i32), 20),
            scale in prop_oneof![Just(1.0), Just(0.1)],
        ) {
            let at = |x: i32, y: i32| Point::new(f64::from(x) * scale, f64::from(y) * scale);
            let points: Vec<Point> = cells.iter().map(|(x, y)| at(*x, *y)).collect();
            let mut tree = filled(&points);
            for (x, y, radius) in queries {
                let (q, radius) = (at(x, y), f64::from(radius) * scale);
                let brute = (0..points.len()).min_by(|a, b| squared(points[*a], q).total_cmp(&squared(points[*b], q)));
                let brute = brute.map(|i| (i as u32, squared(points[i], q)));
                prop_assert_eq!(tree.nearest(q), brute);
                let mut found = Vec::new();
                tree.within(q, radius, |id, d2| found.push((id, d2)));
                found.sort_unstable_by_key(|f| f.0);
                let all = (0..points.len()).map(|i| (i as u32, squared(points[i], q)));
                prop_assert_eq!(found, all.filter(|(_, d2)| *d2 <= radius * radius).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn points_in_sorted_order_and_on_one_line_are_no_trouble() {
        let points: Vec<Point> = (0..3000).map(|i| Point::new(1.0, f64::from(i))).collect();
        let mut tree = filled(&points);
        assert_eq!(tree.nearest(Point::new(5.0, 1234.2)), Some((1234, 16.0 + (1234.0_f64 - 1234.2).powi(2))));
        let mut count = 0;
        tree.within(Point::new(1.0, 100.0), 10.0, |_, _| count += 1);
        assert_eq!(count, 21);
    }

    #[test]
    fn an_empty_tree_has_no_nearest_point() {
        assert_eq!(filled(&[]).nearest(Point::new(0.0, 0.0)), None);
    }
}
