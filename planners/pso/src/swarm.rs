//! The swarm's state, its bests, and the order of an iteration.

use aligned_vec::{AVec, ConstAlign};
use env_model::{Columns, World};

use crate::border::{Advance, Border};
use crate::choices::{Bounds, Topology};
use crate::lanes::{BLOCK, Lanes, UniformPairs};
use crate::neighbours::Neighbours;
use crate::pass::Pass;
use crate::rules::{UpdateRule, Weights};
use crate::settings::Settings;
use crate::terrain::Terrain;
use crate::width::Width;

/// Numbers aligned to the widest vectors: one that straddles two cache lines costs two accesses.
pub type Lane = AVec<f64, ConstAlign<64>>;

/// Positions, velocities and bests. Matrices are m rows (dimensions) of
/// `stride` lanes (particles).
#[derive(Debug, Clone)]
pub struct Swarm {
    /// Real particles.
    pub particles: usize,
    /// Lanes, `particles` rounded up to whole vectors; the padding flies but is never looked at.
    pub stride: usize,
    /// Dimensions m.
    pub dims: usize,
    /// Heights.
    pub x: Lane,
    /// Velocities.
    pub v: Lane,
    /// Personal bests.
    pub best: Lane,
    /// Costs of the personal bests.
    pub best_cost: Lane,
    /// Global best heights.
    pub global: Vec<f64>,
    /// Their cost.
    pub global_cost: f64,
    /// The particle that found them.
    leader: usize,
    /// Smaller neighbourhoods than the whole swarm.
    pub neighbours: Neighbours,
    /// 1 in lanes whose personal best improved in the last pass, else 0.
    pub improved: Lane,
    /// Personal bests of the neighbourhoods' leaders, laid out like `x`; not kept without neighbourhoods.
    pub social: Lane,
    /// Costs of the last pass; +∞ where a particle was not to be evaluated. Where the personal
    /// best did not improve, collisions with capsules and polygons may be missing in it.
    pub cost: Lane,
    /// How many particles the last pass evaluated.
    pub evaluated: u64,
    /// Random numbers of the next step, as many rows of lanes as the rule takes.
    pub random: [Lane; 2],
    /// One generator a lane.
    pub rng: Lanes,
    /// A single generator, for choices among particles.
    pub choices: Lanes,
}

impl Default for Swarm {
    fn default() -> Self {
        // `ConstAlign` knows the alignment; the argument is a formality.
        let lane = || Lane::new(0);
        Self {
            particles: 0,
            stride: 0,
            dims: 0,
            x: lane(),
            v: lane(),
            best: lane(),
            best_cost: lane(),
            global: Vec::new(),
            global_cost: f64::INFINITY,
            leader: 0,
            neighbours: Neighbours::default(),
            improved: lane(),
            social: lane(),
            cost: lane(),
            evaluated: 0,
            random: [lane(), lane()],
            rng: Lanes::default(),
            choices: Lanes::default(),
        }
    }
}

/// What stays the same during a run.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// The vector unit in use.
    pub width: Width,
    /// The planner's settings, filled.
    pub settings: &'a Settings,
    /// The compiled scene.
    pub world: &'a World,
    /// The search model.
    pub columns: &'a Columns,
    /// The obstacles by column and strip.
    pub terrain: &'a Terrain,
}

impl Swarm {
    /// Places and evaluates the initial swarm: uniform on [−H, H]ᵐ, at rest unless `rule` sends it off.
    pub fn initialise(&mut self, ground: Ground<'_>, rule: &mut dyn UpdateRule, seed: u64) {
        let settings = ground.settings;
        self.particles = settings.particles;
        self.dims = settings.columns;
        self.stride = settings.particles.next_multiple_of(BLOCK);
        let (cells, numbers) = (self.dims * self.stride, rule.rows(self.dims) * self.stride);
        let [random1, random2] = &mut self.random;
        let matrices = [&mut self.x, &mut self.v, &mut self.best, &mut self.social].map(|m| (m, cells));
        for (matrix, size) in matrices.into_iter().chain([(random1, numbers), (random2, numbers)]) {
            matrix.clear();
            matrix.resize(size, 0.0);
        }
        for vector in [&mut self.cost, &mut self.best_cost] {
            vector.clear();
            vector.resize(self.stride, f64::INFINITY);
        }
        self.improved.clear();
        self.improved.resize(self.stride, 0.0);
        self.global.clear();
        self.global.resize(self.dims, 0.0);
        self.global_cost = f64::INFINITY;
        let mut state = seed;
        self.rng.seed(&mut state, self.stride);
        self.choices.seed(&mut state, 1);
        self.neighbours.link(settings.topology.unwrap_or_default(), self.particles, || self.choices.one());
        self.rng.uniform(&mut self.x);
        let border = Border::of(ground);
        for x in self.x.iter_mut() {
            *x = (2.0 * *x - 1.0) * border.half_width;
        }
        rule.begin(self, border);
        self.evaluate(ground, None);
    }

    /// Moves, evaluates and updates the bests: iteration `t`, counted from 0.
    pub fn iterate(&mut self, ground: Ground<'_>, rule: &mut dyn UpdateRule, t: u64) {
        let [first, second] = &mut self.random;
        if !first.is_empty() {
            ground.width.run(UniformPairs { lanes: &mut self.rng, rows: [first, second] });
        }
        let motion = rule.steer(self, t).map(|weights| (weights, Border::of(ground)));
        if motion.is_none() {
            self.advance(ground);
        }
        self.evaluate(ground, motion);
    }

    /// Moves the particles with the velocities they have.
    pub fn advance(&mut self, ground: Ground<'_>) {
        ground.width.run(Advance { border: Border::of(ground), swarm: self });
    }

    /// Evaluates, on the way moving the particles if told to, and updates the bests.
    pub fn evaluate(&mut self, ground: Ground<'_>, motion: Option<(Weights, Border)>) {
        let hidden = ground.settings.bounds.unwrap_or_default() == Bounds::Invisible;
        if ground.terrain.others.is_empty() {
            ground.width.run(Pass::<false> { swarm: self, ground, motion });
        } else {
            ground.width.run(Pass::<true> { swarm: self, ground, motion });
        }
        let evaluated = |cost: &&f64| !hidden || **cost < f64::INFINITY;
        self.evaluated = self.cost[..self.particles].iter().filter(evaluated).count() as u64;

        let before = self.global_cost;
        let any = self.improved[..self.particles].iter().any(|&improved| improved != 0.0);
        if any {
            self.find_leader();
        }
        let topology = ground.settings.topology.unwrap_or_default();
        let redraw = topology == Topology::Random && self.global_cost == before;
        if redraw {
            self.neighbours.link(topology, self.particles, || self.choices.one());
        }
        if topology != Topology::Global && (any || redraw) {
            self.gather_social();
        }
    }

    /// The best of all; ties go to the earlier one, then to the lower index.
    fn find_leader(&mut self) {
        let before = self.global_cost;
        for (i, &cost) in self.best_cost[..self.particles].iter().enumerate() {
            if cost < self.global_cost {
                (self.global_cost, self.leader) = (cost, i);
            }
        }
        if self.global_cost < before {
            for d in 0..self.dims {
                self.global[d] = self.best[d * self.stride + self.leader];
            }
        }
    }

    fn gather_social(&mut self) {
        self.neighbours.lead(&self.best_cost[..self.particles]);
        for (social, best) in self.social.chunks_exact_mut(self.stride).zip(self.best.chunks_exact(self.stride)) {
            for (social, &leader) in social.iter_mut().zip(&self.neighbours.leaders) {
                *social = best[leader as usize];
            }
        }
    }

    /// The particle whose personal best attracts particle `i`.
    pub fn leader_of(&self, i: usize) -> usize {
        self.neighbours.leaders.get(i).map_or(self.leader, |&leader| leader as usize)
    }

    /// Copies a matrix to rows of particles, for observers.
    pub fn transpose(&self, matrix: &[f64], rows: &mut Vec<f64>) {
        rows.clear();
        for i in 0..self.particles {
            rows.extend((0..self.dims).map(|d| matrix[d * self.stride + i]));
        }
    }
}

/// Which of particles `a` and `b` has the lower cost; ties go to the lower index.
pub fn better(costs: &[f64], a: usize, b: usize) -> usize {
    if costs[b] < costs[a] || (costs[b] == costs[a] && b < a) { b } else { a }
}

#[cfg(test)]
mod reference;
#[cfg(test)]
mod tests;
