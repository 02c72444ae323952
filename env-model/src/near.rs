//! Which obstacles a segment enters: the structure fits their number.
//!
//! | obstacles | structure |
//! |---|---|
//! | up to 64 | words of bits, one bit an obstacle ([`Slabs`]) |
//! | more, discs evenly spread | a grid of the small discs ([`Buckets`]), a tree of all else |
//! | more, other shapes or clusters | a tree ([`Bvh`]) |

use crate::buckets::Buckets;
use crate::bvh::Bvh;
use crate::probe::{Disc, Probe};
use crate::slabs::Slabs;
use crate::{Aabb, Inflated, Point};

/// Discs of up to this many median radii go to the grid. Larger ones, which would
/// widen every query, go to the tree.
const SMALL: f64 = 4.0;

/// The structure over a world's obstacles.
#[derive(Debug, Clone)]
pub enum Near {
    /// No more than [`Slabs::MOST`].
    Few(Box<Few>),
    /// The small discs, and the indices of all else.
    Many(Buckets, Bvh),
    /// The tree over all obstacles, which the world has anyway.
    Tree,
}

/// Up to 64 obstacles. Bit k stands for item k of the world's tree, so that ascending
/// bits are the order in which the tree visits.
#[derive(Debug, Clone)]
pub struct Few {
    slabs: Slabs,
    /// The bits of obstacles that are no discs.
    others: u64,
    discs: [Disc; Slabs::MOST],
    boxes: Vec<Aabb>,
}

impl Near {
    /// The structure for `obstacles`, their `boxes` and the tree over these.
    pub fn new(obstacles: &[Inflated], boxes: &[Aabb], tree: &Bvh, slack: f64) -> Self {
        if obstacles.len() <= Slabs::MOST {
            return Self::Few(Box::new(Few::new(obstacles, boxes, tree, slack)));
        }
        let mut radii: Vec<f64> = obstacles.iter().filter_map(Inflated::as_disc).map(|(_, r)| r).collect();
        if radii.len() <= Slabs::MOST {
            return Self::Tree;
        }
        let middle = radii.len() / 2;
        let largest = SMALL * *radii.select_nth_unstable_by(middle, f64::total_cmp).1;
        let (mut discs, mut rest, mut margin) = (Vec::with_capacity(radii.len()), Vec::new(), 0.0_f64);
        for (i, obstacle) in obstacles.iter().enumerate() {
            match obstacle.as_disc().filter(|(_, r)| *r <= largest) {
                Some((centre, radius)) => {
                    discs.push(Disc::new(centre, radius - slack));
                    margin = margin.max(radius);
                }
                None => rest.push(i as u32),
            }
        }
        match Buckets::new(&discs, margin + slack) {
            Some(buckets) => Self::Many(buckets, Bvh::over(boxes, rest)),
            None => Self::Tree,
        }
    }
}

impl Few {
    fn new(obstacles: &[Inflated], boxes: &[Aabb], tree: &Bvh, slack: f64) -> Self {
        let boxes: Vec<Aabb> = tree.items().iter().map(|&i| boxes[i as usize]).collect();
        let mut few = Self { slabs: Slabs::new(&boxes), others: 0, discs: [Disc::NONE; Slabs::MOST], boxes };
        for (bit, &i) in tree.items().iter().enumerate() {
            match obstacles[i as usize].as_disc() {
                Some((centre, radius)) => few.discs[bit] = Disc::new(centre, radius - slack),
                None => few.others |= 1 << bit,
            }
        }
        few
    }

    /// The obstacles whose boxes may meet `region`, as bits.
    #[inline]
    pub fn meeting(&self, region: &Aabb) -> u64 {
        self.slabs.meeting(region)
    }

    /// Whether the segment `a b` enters one of the discs among `near`, or an item among
    /// them for which `other` says so.
    pub fn any_entered(&self, near: u64, a: Point, b: Point, other: impl FnMut(usize) -> bool) -> bool {
        let probe = Probe::new(a, b);
        bits(near & !self.others).any(|k| probe.enters(&self.discs[k])) || bits(near & self.others).any(other)
    }

    /// Calls `visit` for every item whose box, which may meet `region`, `touches`, until it returns `true`.
    /// Returns whether it did.
    pub fn any(&self, region: &Aabb, touches: impl Fn(&Aabb) -> bool, visit: impl FnMut(usize) -> bool) -> bool {
        bits(self.meeting(region)).filter(|&k| touches(&self.boxes[k])).any(visit)
    }
}

/// The places of the ones, ascending.
#[inline]
fn bits(mut word: u64) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let bit = word.trailing_zeros() as usize;
        (word != 0).then(|| {
            word &= word - 1;
            bit
        })
    })
}
