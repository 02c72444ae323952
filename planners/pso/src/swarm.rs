//! The swarm's state, its bests, and the order of an iteration.

use aligned_vec::{AVec, ConstAlign};
use env_model::{Columns, World};
use pulp::Arch;

use crate::lanes::{BLOCK, Lanes, UniformPairs};
use crate::pass::{KeepBetter, Motion, Pass};
use crate::settings::{RandomNumbers, Settings, Topology};
use crate::terrain::Terrain;

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
    /// Lanes whose personal best improved in the last pass.
    pub improved: Vec<bool>,
    /// Social attractors of a ring topology, laid out like `x`.
    pub social: Lane,
    /// Costs of the last pass.
    pub cost: Lane,
    /// Random numbers of the next pass, laid out like `x`.
    pub random: [Lane; 2],
    rng: Lanes,
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
            improved: Vec::new(),
            social: lane(),
            cost: lane(),
            random: [lane(), lane()],
            rng: Lanes::default(),
        }
    }
}

/// What stays the same during a run.
#[derive(Clone, Copy)]
pub struct Ground<'a> {
    /// The vector unit in use.
    pub arch: Arch,
    /// The planner's settings.
    pub settings: &'a Settings,
    /// The compiled scene.
    pub world: &'a World,
    /// The search model.
    pub columns: &'a Columns,
    /// The obstacles by column and strip.
    pub terrain: &'a Terrain,
}

impl Swarm {
    /// Places and evaluates the initial swarm: uniform on [−H, H]ᵐ, velocity 0.
    pub fn initialise(&mut self, ground: Ground<'_>, seed: u64) {
        let settings = ground.settings;
        self.particles = settings.particles;
        self.dims = settings.columns;
        self.stride = settings.particles.next_multiple_of(BLOCK);
        let cells = self.dims * self.stride;
        let [random1, random2] = &mut self.random;
        for matrix in [&mut self.x, &mut self.v, &mut self.best, &mut self.social, random1, random2] {
            matrix.clear();
            matrix.resize(cells, 0.0);
        }
        for vector in [&mut self.cost, &mut self.best_cost] {
            vector.clear();
            vector.resize(self.stride, f64::INFINITY);
        }
        self.improved.clear();
        self.improved.resize(self.stride, false);
        self.global.clear();
        self.global.resize(self.dims, 0.0);
        self.global_cost = f64::INFINITY;
        self.rng.seed(seed, self.stride);
        self.rng.uniform(&mut self.x);
        let half_width = ground.columns.half_width();
        for x in self.x.iter_mut() {
            *x = (2.0 * *x - 1.0) * half_width;
        }
        self.pass(ground, None);
    }

    /// Moves, evaluates and updates the bests: iteration `t`, counted from 0.
    pub fn iterate(&mut self, ground: Ground<'_>, t: u64) {
        self.pass(ground, Some(Motion::of(ground, t)));
    }

    fn pass(&mut self, ground: Ground<'_>, motion: Option<Motion>) {
        if motion.is_some() {
            let numbers = match ground.settings.random_numbers {
                RandomNumbers::PerDimension => self.dims * self.stride,
                RandomNumbers::PerParticle => self.stride,
            };
            let [first, second] = &mut self.random;
            let rows = [&mut first[..numbers], &mut second[..numbers]];
            ground.arch.dispatch(UniformPairs { lanes: &mut self.rng, rows });
        }
        if ground.terrain.only_discs() {
            ground.arch.dispatch(Pass::<false> { swarm: self, ground, motion });
        } else {
            ground.arch.dispatch(Pass::<true> { swarm: self, ground, motion });
        }
        let mut leader = None;
        let mut any = false;
        for i in 0..self.particles {
            self.improved[i] = self.cost[i] < self.best_cost[i];
            any |= self.improved[i];
        }
        if !any {
            return;
        }
        ground.arch.dispatch(KeepBetter(self));
        for (i, &cost) in self.best_cost[..self.particles].iter().enumerate() {
            if cost < self.global_cost {
                (self.global_cost, leader) = (cost, Some(i));
            }
        }
        if let Some(leader) = leader {
            for d in 0..self.dims {
                self.global[d] = self.best[d * self.stride + leader];
            }
        }
        if ground.settings.topology == Topology::Ring {
            self.gather_ring();
        }
    }

    /// The best of each particle's ring neighbourhood; ties go to the lower index.
    fn gather_ring(&mut self) {
        let n = self.particles;
        for i in 0..n {
            let mut neighbours = [(i + n - 1) % n, i, (i + 1) % n];
            neighbours.sort_unstable();
            let leader = neighbours
                .into_iter()
                .fold(neighbours[0], |l, j| if self.best_cost[j] < self.best_cost[l] { j } else { l });
            for d in 0..self.dims {
                self.social[d * self.stride + i] = self.best[d * self.stride + leader];
            }
        }
    }

    /// Copies a matrix to rows of particles, for observers.
    pub fn transpose(&self, matrix: &[f64], rows: &mut Vec<f64>) {
        rows.clear();
        for i in 0..self.particles {
            rows.extend((0..self.dims).map(|d| matrix[d * self.stride + i]));
        }
    }
}

#[cfg(test)]
mod tests {
    use env_model::geometry::point_segment_distance;
    use env_model::{Point, Scene};

    use super::*;
    use crate::settings::{Bounds, VelocityLimit};

    /// The digest's pseudo-code, one particle and one number at a time, with
    /// distances from the environment model instead of the terrain's shortcuts.
    struct Reference {
        x: Vec<Vec<f64>>,
        best: Vec<Vec<f64>>,
        best_cost: Vec<f64>,
        global: Vec<f64>,
        global_cost: f64,
    }

    fn reference(settings: &Settings, world: &World, columns: &Columns, seed: u64) -> Reference {
        let (n, m, h) = (settings.particles, settings.columns, columns.half_width());
        let discs: Vec<(Point, f64)> = world
            .obstacles()
            .iter()
            .map(|o| o.as_disc().unwrap())
            .map(|(c, r)| (columns.frame().to_local(c), r))
            .collect();
        let cost = |y: &[f64]| -> f64 {
            let at = |i: usize| Point::new(columns.x(i), if i == 0 || i > m { 0.0 } else { y[i - 1] });
            (0..=m)
                .map(|i| {
                    let (dx, dy) = (columns.spacing(), at(i + 1).y - at(i).y);
                    let hit = discs.iter().any(|&(c, r)| point_segment_distance(c, at(i), at(i + 1)) < r);
                    (dx * dx + dy * dy).sqrt() * if hit { settings.penalty } else { 1.0 }
                })
                .fold(0.0, |sum, f| sum + f)
        };
        let mut lanes = Lanes::default();
        lanes.seed(seed, n.next_multiple_of(BLOCK));

        let stride = n.next_multiple_of(BLOCK);
        let (mut first, mut second) = (vec![0.0; m * stride], vec![0.0; m * stride]);
        lanes.uniform(&mut first);
        let x: Vec<Vec<f64>> =
            (0..n).map(|i| (0..m).map(|d| (2.0 * first[d * stride + i] - 1.0) * h).collect()).collect();
        let best_cost: Vec<f64> = x.iter().map(|y| cost(y)).collect();
        let mut r = Reference { best: x.clone(), x, best_cost, global: vec![], global_cost: f64::INFINITY };
        let mut v = vec![vec![0.0; m]; n];
        let lead = |r: &mut Reference| {
            for i in 0..n {
                if r.best_cost[i] < r.global_cost {
                    r.global_cost = r.best_cost[i];
                    r.global = r.best[i].clone();
                }
            }
        };
        lead(&mut r);
        let vmax = settings.max_speed(h);
        for t in 0..settings.iterations {
            let w = settings.inertia_at(t);
            Arch::Scalar.dispatch(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
            for i in 0..n {
                #[allow(clippy::needless_range_loop, reason = "the transcription keeps the paper's indices")]
                for d in 0..m {
                    let (r1, r2) = (first[d * stride + i], second[d * stride + i]);
                    let x = r.x[i][d];
                    v[i][d] = (w * v[i][d] + (2.0 * r1) * (r.best[i][d] - x)) + (2.0 * r2) * (r.global[d] - x);
                    v[i][d] = v[i][d].clamp(-vmax, vmax);
                    let y = x + v[i][d];
                    r.x[i][d] = y.clamp(-h, h);
                    if r.x[i][d] != y {
                        v[i][d] = 0.0;
                    }
                }
                let c = cost(&r.x[i]);
                if c < r.best_cost[i] {
                    r.best_cost[i] = c;
                    r.best[i] = r.x[i].clone();
                }
            }
            lead(&mut r);
        }
        r
    }

    fn scene() -> Scene {
        Scene::from_toml("lu-sun-2012.toml", include_str!("../../../configs/scenes/lu-sun-2012.toml")).unwrap()
    }

    fn run(arch: Arch, settings: &Settings, world: &World, columns: &Columns, seed: u64) -> Swarm {
        let mut terrain = Terrain::default();
        terrain.compile(world, columns, settings.bounds);
        let mut swarm = Swarm::default();
        let ground = Ground { arch, settings, world, columns, terrain: &terrain };
        swarm.initialise(ground, seed);
        for t in 0..settings.iterations {
            swarm.iterate(ground, t);
        }
        swarm
    }

    #[test]
    fn agrees_bit_for_bit_with_a_plain_transcription() {
        let scene = scene();
        let world = World::new(&scene).unwrap();
        for (particles, columns_count) in [(20, 20), (7, 5), (1, 1), (33, 40)] {
            let settings = Settings { particles, columns: columns_count, iterations: 100, ..Settings::default() };
            let columns = Columns::new(scene.start(), scene.goal(), columns_count);
            for seed in 0..5 {
                let swarm = run(Arch::new(), &settings, &world, &columns, seed);
                let plain = reference(&settings, &world, &columns, seed);
                assert_eq!(swarm.global_cost.to_bits(), plain.global_cost.to_bits());
                assert_eq!(swarm.global, plain.global);
                assert_eq!(swarm.best_cost[..particles], plain.best_cost);
            }
        }
    }

    #[test]
    fn vector_width_changes_nothing() {
        let scene = scene();
        let world = World::new(&scene).unwrap();
        let columns = Columns::new(scene.start(), scene.goal(), 20);
        for bounds in [Bounds::None, Bounds::Clip, Bounds::Stop, Bounds::Reflect] {
            for random_numbers in [RandomNumbers::PerDimension, RandomNumbers::PerParticle] {
                for topology in [Topology::Global, Topology::Ring] {
                    let settings = Settings {
                        bounds,
                        random_numbers,
                        topology,
                        velocity_limit: VelocityLimit::Fraction(1.0),
                        iterations: 50,
                        ..Settings::default()
                    };
                    let wide = run(Arch::new(), &settings, &world, &columns, 3);
                    let narrow = run(Arch::Scalar, &settings, &world, &columns, 3);
                    assert_eq!(wide.x, narrow.x);
                    assert_eq!(wide.best, narrow.best);
                    assert_eq!(wide.global_cost.to_bits(), narrow.global_cost.to_bits());
                }
            }
        }
    }

    /// Costs of the last pass against the environment model's own distances,
    /// with every shape, a field and every rule of motion.
    #[test]
    fn fitness_counts_fields_capsules_and_polygons() {
        let file = include_str!("../../../configs/scenes/mixed-shapes.toml");
        let scene = Scene::from_toml("mixed-shapes.toml", file).unwrap();
        let world = World::new(&scene).unwrap();
        let (mut hits, mut outside, mut free) = (0, 0, 0);
        for bounds in [Bounds::None, Bounds::Clip, Bounds::Stop, Bounds::Reflect] {
            for topology in [Topology::Global, Topology::Ring] {
                let settings = Settings {
                    bounds,
                    topology,
                    columns: 12,
                    iterations: 30,
                    velocity_limit: VelocityLimit::Fraction(2.0),
                    ..Settings::default()
                };
                let columns = Columns::new(scene.start(), scene.goal(), settings.columns);
                let swarm = run(Arch::new(), &settings, &world, &columns, 9);
                let mut path = Vec::new();
                for i in 0..swarm.particles {
                    let heights: Vec<f64> = (0..swarm.dims).map(|d| swarm.x[d * swarm.stride + i]).collect();
                    columns.write_path(&heights, &mut path);
                    let cost: f64 = path
                        .windows(2)
                        .map(|w| {
                            let hit = world.segment_clearance(w[0], w[1]) < 0.0;
                            outside += usize::from(world.field_clearance(w[0]) < 0.0);
                            hits += usize::from(hit);
                            free += usize::from(!hit);
                            (w[1] - w[0]).norm() * if hit { settings.penalty } else { 1.0 }
                        })
                        .sum();
                    // Lengths in the world frame and in the local one differ by their rounding.
                    assert!((swarm.cost[i] / cost - 1.0).abs() < 1e-12, "{bounds:?}, {topology:?}, particle {i}");
                }
            }
        }
        assert!(hits > 100 && outside > 50 && free > 100, "{hits} hits, {outside} outside, {free} free");
    }
}
