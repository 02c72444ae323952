//! The swarm: particles in lanes, one fused pass of moving and evaluating an iteration.

use env_model::{Columns, World};
use pulp::{Arch, Simd, WithSimd};

use crate::lanes::{Generators, Lanes};
use crate::settings::{Bounds, RandomNumbers, Settings, Topology};
use crate::terrain::Terrain;

/// Lanes are padded to a multiple of this; padding lanes fly but are never looked at.
const PAD: usize = 4;

/// Positions, velocities and bests. Matrices are m rows (dimensions) of
/// `stride` lanes (particles).
#[derive(Debug, Clone, Default)]
pub struct Swarm {
    /// Real particles.
    pub particles: usize,
    /// Lanes, `particles` rounded up.
    pub stride: usize,
    /// Dimensions m.
    pub dims: usize,
    /// Heights.
    pub x: Vec<f64>,
    /// Velocities.
    pub v: Vec<f64>,
    /// Personal bests.
    pub best: Vec<f64>,
    /// Costs of the personal bests.
    pub best_cost: Vec<f64>,
    /// Global best heights.
    pub global: Vec<f64>,
    /// Their cost.
    pub global_cost: f64,
    /// Lanes whose personal best improved in the last pass.
    pub improved: Vec<bool>,
    /// Social attractors of a ring topology, laid out like `x`.
    social: Vec<f64>,
    rng: Lanes,
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

/// What a pass needs to know.
#[derive(Clone, Copy)]
struct Rules {
    w: f64,
    c1: f64,
    c2: f64,
    vmax: f64,
    half_width: f64,
    penalty: f64,
    bounds: Bounds,
    random: RandomNumbers,
    ring: bool,
    /// The first pass places the particles instead of moving them.
    place: bool,
}

impl Swarm {
    /// Places and evaluates the initial swarm: uniform on [−H, H]ᵐ, velocity 0.
    pub fn initialise(&mut self, ground: Ground<'_>, seed: u64) {
        let settings = ground.settings;
        self.particles = settings.particles;
        self.dims = settings.columns;
        self.stride = settings.particles.next_multiple_of(PAD);
        let cells = self.dims * self.stride;
        for matrix in [&mut self.x, &mut self.v, &mut self.best, &mut self.social] {
            matrix.clear();
            matrix.resize(cells, 0.0);
        }
        self.best_cost.clear();
        self.best_cost.resize(self.stride, f64::INFINITY);
        self.improved.clear();
        self.improved.resize(self.stride, false);
        self.global.clear();
        self.global.resize(self.dims, 0.0);
        self.global_cost = f64::INFINITY;
        self.rng.seed(seed, self.stride);
        self.pass(ground, Rules { place: true, ..Rules::of(ground, 0) });
    }

    /// Moves, evaluates and updates the bests: iteration `t`, counted from 0.
    pub fn iterate(&mut self, ground: Ground<'_>, t: u64) {
        self.pass(ground, Rules::of(ground, t));
    }

    fn pass(&mut self, ground: Ground<'_>, rules: Rules) {
        ground.arch.dispatch(Pass { swarm: self, ground, rules });
        let old = self.global_cost;
        let mut leader = None;
        for (i, &cost) in self.best_cost[..self.particles].iter().enumerate() {
            if cost < self.global_cost {
                (self.global_cost, leader) = (cost, Some(i));
            }
        }
        if let Some(leader) = leader {
            debug_assert!(self.global_cost < old);
            for d in 0..self.dims {
                self.global[d] = self.best[d * self.stride + leader];
            }
        }
        if rules.ring && self.improved.contains(&true) {
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

impl Rules {
    fn of(ground: Ground<'_>, t: u64) -> Self {
        let (settings, half_width) = (ground.settings, ground.columns.half_width());
        let (c1, c2) = settings.weights();
        Self {
            w: settings.inertia_at(t),
            c1,
            c2,
            vmax: settings.max_speed(half_width),
            half_width,
            penalty: settings.penalty,
            bounds: settings.bounds,
            random: settings.random_numbers,
            ring: settings.topology == Topology::Ring,
            place: false,
        }
    }
}

/// One pass over all lanes, W at a time, W being the width of the vector unit found at run time.
struct Pass<'a> {
    swarm: &'a mut Swarm,
    ground: Ground<'a>,
    rules: Rules,
}

impl WithSimd for Pass<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Self { swarm, ground, rules } = self;
        let mut lane = 0;
        if S::F64_LANES >= 8 {
            while lane + 8 <= swarm.stride {
                chunk::<8>(swarm, &ground, &rules, lane);
                lane += 8;
            }
        }
        while lane < swarm.stride {
            chunk::<PAD>(swarm, &ground, &rules, lane);
            lane += PAD;
        }
    }
}

/// `a < b ? a : b`, one instruction where `f64::min` takes three; no operand is NaN.
#[inline(always)]
fn min(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

#[inline(always)]
fn max(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// All ones when `condition` holds: masks combine with integer operations, which vectorise.
#[inline(always)]
fn mask(condition: bool) -> u64 {
    if condition { u64::MAX } else { 0 }
}

/// `a` where the mask is all ones, `b` where it is zero.
#[inline(always)]
fn select(mask: u64, a: f64, b: f64) -> f64 {
    f64::from_bits((a.to_bits() & mask) | (b.to_bits() & !mask))
}

#[inline(always)]
fn load<const W: usize>(row: &[f64], at: usize) -> [f64; W] {
    row[at..at + W].try_into().expect("W lanes")
}

/// Moves and evaluates lanes `first` … `first + W − 1`.
#[inline(always)]
fn chunk<const W: usize>(swarm: &mut Swarm, ground: &Ground<'_>, rules: &Rules, first: usize) {
    let terrain = ground.terrain;
    let (dims, stride, dx) = (swarm.dims, swarm.stride, terrain.dx);
    let dx2 = dx * dx;
    // Slices in locals: the compiler then knows that no store moves them.
    let Swarm { x, v, best, best_cost, global, improved, social, rng: lanes, .. } = swarm;
    let (x, v, best) = (x.as_mut_slice(), v.as_mut_slice(), best.as_mut_slice());
    let (global, social) = (global.as_slice(), social.as_slice());
    let mut rng: Generators<W> = lanes.load(first);
    let shared = match rules.random {
        RandomNumbers::PerParticle if !rules.place => Some(rng.uniform_pair()),
        _ => None,
    };
    let mut left = [0.0; W];
    let mut left_hit = [0u64; W];
    let mut cost = [0.0; W];
    #[allow(clippy::needless_range_loop, reason = "strips, one more than columns")]
    for j in 0..=dims {
        let mut right = [0.0; W];
        if j < dims {
            let at = j * stride + first;
            if rules.place {
                right = rng.uniform().map(|u| (2.0 * u - 1.0) * rules.half_width);
            } else {
                let pair = shared.unwrap_or_else(|| rng.uniform_pair());
                let attractor = if rules.ring { load(social, at) } else { [global[j]; W] };
                let velocity;
                (right, velocity) = fly(rules, pair, load(x, at), load(v, at), load(best, at), attractor);
                v[at..at + W].copy_from_slice(&velocity);
            }
            x[at..at + W].copy_from_slice(&right);
        }

        // Which lanes are inside an obstacle, or off the field, at the right column.
        let mut right_hit = [0u64; W];
        for gap in terrain.gaps_right_of(j) {
            for k in 0..W {
                right_hit[k] |= mask((right[k] - gap.cy).abs() < gap.half);
            }
        }
        if terrain.has_field && j < dims {
            let (lo, hi) = terrain.inside[j];
            for k in 0..W {
                right_hit[k] |= mask(right[k] < lo) | mask(right[k] > hi);
            }
        }

        let mut dy = [0.0; W];
        let mut len2 = [0.0; W];
        let mut hit = [0u64; W];
        for k in 0..W {
            dy[k] = right[k] - left[k];
            len2[k] = dx2 + dy[k] * dy[k];
            hit[k] = left_hit[k] | right_hit[k];
        }
        for disc in terrain.strip(j) {
            for k in 0..W {
                let fy = disc.cy - left[k];
                let along = disc.fx * dx + fy * dy[k];
                let across = disc.fx * dy[k] - fy * dx;
                hit[k] |= mask(along > 0.0) & mask(along < len2[k]) & mask(across * across < disc.r2 * len2[k]);
            }
        }
        if terrain.has_others(j) {
            for k in 0..W {
                hit[k] |= mask(terrain.hits_other(ground.world, ground.columns, j, left[k], right[k]));
            }
        }
        for k in 0..W {
            let length = len2[k].sqrt();
            cost[k] += select(hit[k], rules.penalty * length, length);
        }
        left = right;
        left_hit = right_hit;
    }
    lanes.store(first, &rng);

    let old: [f64; W] = load(best_cost, first);
    let mut better = [0u64; W];
    let mut any = 0;
    for k in 0..W {
        better[k] = mask(cost[k] < old[k]);
        any |= better[k];
    }
    for k in 0..W {
        improved[first + k] = better[k] != 0;
    }
    if any == 0 {
        return;
    }
    for k in 0..W {
        best_cost[first + k] = select(better[k], cost[k], old[k]);
    }
    for d in 0..dims {
        let at = d * stride + first;
        let (new, mut kept): ([f64; W], [f64; W]) = (load(x, at), load(best, at));
        for k in 0..W {
            kept[k] = select(better[k], new[k], kept[k]);
        }
        best[at..at + W].copy_from_slice(&kept);
    }
}

/// Equations (1) and (2) of the paper, velocity limit and bounds: (new position, new velocity).
#[inline(always)]
fn fly<const W: usize>(
    rules: &Rules,
    (r1, r2): ([f64; W], [f64; W]),
    x: [f64; W],
    v: [f64; W],
    own: [f64; W],
    social: [f64; W],
) -> ([f64; W], [f64; W]) {
    let (h, vmax) = (rules.half_width, rules.vmax);
    let mut new_x = [0.0; W];
    let mut new_v = [0.0; W];
    for k in 0..W {
        let pull = (rules.w * v[k] + (rules.c1 * r1[k]) * (own[k] - x[k])) + (rules.c2 * r2[k]) * (social[k] - x[k]);
        new_v[k] = max(min(pull, vmax), -vmax);
        new_x[k] = x[k] + new_v[k];
    }
    if rules.bounds == Bounds::None {
        return (new_x, new_v);
    }
    let mut clipped = [0.0; W];
    for k in 0..W {
        clipped[k] = max(min(new_x[k], h), -h);
    }
    match rules.bounds {
        Bounds::None | Bounds::Clip => {}
        Bounds::Stop => {
            for k in 0..W {
                new_v[k] = select(mask(clipped[k] == new_x[k]), new_v[k], 0.0);
            }
        }
        Bounds::Reflect => {
            for k in 0..W {
                new_v[k] = select(mask(clipped[k] == new_x[k]), new_v[k], -new_v[k]);
                clipped[k] = max(min(2.0 * clipped[k] - new_x[k], h), -h);
            }
        }
    }
    (clipped, new_v)
}

#[cfg(test)]
mod tests {
    use env_model::geometry::point_segment_distance;
    use env_model::{Obstacle, Point, Scene};

    use super::*;
    use crate::settings::VelocityLimit;

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
        lanes.seed(seed, n.next_multiple_of(4));
        let mut rngs: Vec<Generators<1>> = (0..n).map(|i| lanes.load::<1>(i)).collect();
        let x: Vec<Vec<f64>> =
            rngs.iter_mut().map(|g| (0..m).map(|_| (2.0 * g.uniform()[0] - 1.0) * h).collect()).collect();
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
            for i in 0..n {
                #[allow(clippy::needless_range_loop, reason = "the transcription keeps the paper's indices")]
                for d in 0..m {
                    let (r1, r2) = rngs[i].uniform_pair();
                    let x = r.x[i][d];
                    v[i][d] = (w * v[i][d] + (2.0 * r1[0]) * (r.best[i][d] - x)) + (2.0 * r2[0]) * (r.global[d] - x);
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
        Scene {
            name: "paper".into(),
            unit: "cm".into(),
            robot_radius: 0.0,
            start: [200.0, 150.0],
            goal: [400.0, 260.0],
            field: None,
            obstacles: [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]]
                .map(|c| Obstacle::disc(c.into(), 16.0))
                .to_vec(),
        }
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
}
