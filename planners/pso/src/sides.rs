//! The side classes that personal bests have been in: which side of each
//! obstacle's centre a path passes.
//!
//! All final personal bests usually lie in one class, often not the best one;
//! classes collapse within 10 to 20 iterations. So they are collected from the
//! initial swarm on, each with its cheapest member, for refinement to choose.

use env_model::{Columns, Point};

use crate::swarm::Swarm;
use crate::terrain::Terrain;

/// A bounded list of distinct classes; when full, the oldest makes room.
#[derive(Debug, Clone, Default)]
pub struct SideClasses {
    capacity: usize,
    words: usize,
    /// Column below each obstacle's centre, the share of the way to the next, the centre's y'.
    gauges: Vec<(usize, f64, f64)>,
    keys: Vec<u64>,
    costs: Vec<f64>,
    heights: Vec<f64>,
    /// Where the next class goes once the list is full.
    oldest: usize,
    key: Vec<u64>,
}

impl SideClasses {
    /// Forgets everything and prepares for the obstacles of `terrain`.
    pub fn begin(&mut self, capacity: usize, terrain: &Terrain, columns: &Columns) {
        self.capacity = capacity;
        self.keys.clear();
        self.costs.clear();
        self.heights.clear();
        self.oldest = 0;
        self.gauges.clear();
        if capacity == 0 {
            return;
        }
        let length = columns.frame().length();
        for Point { coords } in terrain.centres() {
            let at = coords.x.clamp(0.0, length) / columns.spacing();
            let below = (at as usize).min(columns.count());
            self.gauges.push((below, at - below as f64, coords.y));
        }
        self.words = self.gauges.len().div_ceil(64);
        self.key.clear();
        self.key.resize(self.words, 0);
        // All at once, so that a second call allocates nothing however many classes it meets.
        self.keys.reserve(capacity * self.words);
        self.costs.reserve(capacity);
        self.heights.reserve(capacity * columns.count());
    }

    /// Notes the classes of the particles whose personal best improved in the last pass.
    pub fn collect(&mut self, swarm: &Swarm) {
        if self.capacity == 0 {
            return;
        }
        for lane in 0..swarm.particles {
            if swarm.improved[lane] != 0.0 {
                self.note(swarm, lane);
            }
        }
    }

    fn note(&mut self, swarm: &Swarm, lane: usize) {
        // Height at column i of the path, 0 at start and goal.
        let height = |i: usize| {
            if i == 0 || i > swarm.dims { 0.0 } else { swarm.best[(i - 1) * swarm.stride + lane] }
        };
        self.key.fill(0);
        for (bit, &(below, share, centre)) in self.gauges.iter().enumerate() {
            let y = height(below) + share * (height(below + 1) - height(below));
            if y > centre {
                self.key[bit / 64] |= 1 << (bit % 64);
            }
        }
        let cost = swarm.best_cost[lane];
        let (words, dims) = (self.words, swarm.dims);
        let known = (0..self.costs.len()).find(|&c| self.keys[c * words..(c + 1) * words] == self.key);
        let slot = match known {
            Some(c) if self.costs[c] <= cost => return,
            Some(c) => c,
            None if self.costs.len() < self.capacity => {
                self.keys.extend_from_slice(&self.key);
                self.costs.push(cost);
                self.heights.resize(self.heights.len() + dims, 0.0);
                self.costs.len() - 1
            }
            None => {
                let c = self.oldest;
                self.oldest = (c + 1) % self.capacity;
                self.keys[c * words..(c + 1) * words].copy_from_slice(&self.key);
                c
            }
        };
        self.costs[slot] = cost;
        for d in 0..dims {
            self.heights[slot * dims + d] = swarm.best[d * swarm.stride + lane];
        }
    }

    /// The cheapest member of each class: its m heights.
    pub fn members(&self, dims: usize) -> impl Iterator<Item = &[f64]> + '_ {
        self.heights.chunks_exact(dims)
    }
}
