//! The swarm against plain code, against itself, and against the environment model.

use env_model::geometry::point_segment_distance;
use env_model::{Point, Scene};

use super::*;
use crate::choices::{RandomNumbers, Rule, VelocityLimit};
use crate::rules::rule;

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
    let discs: Vec<(Point, f64)> =
        world.obstacles().iter().map(|o| o.as_disc().unwrap()).map(|(c, r)| (columns.frame().to_local(c), r)).collect();
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
    lanes.seed(&mut { seed }, n.next_multiple_of(BLOCK));

    let stride = n.next_multiple_of(BLOCK);
    let (mut first, mut second) = (vec![0.0; m * stride], vec![0.0; m * stride]);
    lanes.uniform(&mut first);
    let x: Vec<Vec<f64>> = (0..n).map(|i| (0..m).map(|d| (2.0 * first[d * stride + i] - 1.0) * h).collect()).collect();
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
        let w = 0.9 + (0.4 - 0.9) * t as f64 / (settings.iterations - 1) as f64;
        Width::Scalar.run(UniformPairs { lanes: &mut lanes, rows: [&mut first, &mut second] });
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
    Scene::from_toml("lu-sun-2012.toml", include_str!("../../../../configs/scenes/lu-sun-2012.toml")).unwrap()
}

fn run(width: Width, settings: &Settings, world: &World, columns: &Columns, seed: u64) -> Swarm {
    let settings = &settings.clone().filled();
    let mut terrain = Terrain::default();
    terrain.compile(world, columns, settings.bounds.unwrap_or_default());
    let mut swarm = Swarm::default();
    let mut rule = rule(settings);
    let ground = Ground { width, settings, world, columns, terrain: &terrain };
    swarm.initialise(ground, rule.as_mut(), seed);
    for t in 0..settings.iterations {
        swarm.iterate(ground, rule.as_mut(), t);
    }
    swarm
}

#[test]
fn agrees_bit_for_bit_with_a_plain_transcription() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    for (particles, columns_count) in [(20, 20), (7, 5), (1, 1), (33, 40)] {
        let settings = Settings { particles, columns: columns_count, iterations: 100, ..Settings::default() }.filled();
        let columns = Columns::new(scene.start(), scene.goal(), columns_count);
        for seed in 0..5 {
            let swarm = run(Width::widest(), &settings, &world, &columns, seed);
            let plain = reference(&settings, &world, &columns, seed);
            assert_eq!(swarm.global_cost.to_bits(), plain.global_cost.to_bits());
            assert_eq!(swarm.global, plain.global);
            assert_eq!(swarm.best_cost[..particles], plain.best_cost);
        }
    }
}

const BOUNDS: [Bounds; 6] =
    [Bounds::None, Bounds::Clip, Bounds::Stop, Bounds::Rebound, Bounds::Reflect, Bounds::Invisible];
const TOPOLOGIES: [Topology; 4] = [Topology::Global, Topology::Ring, Topology::VonNeumann, Topology::Random];

#[test]
fn vector_width_changes_nothing() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    let columns = Columns::new(scene.start(), scene.goal(), 20);
    let check = |settings: &Settings| {
        let wide = run(Width::widest(), settings, &world, &columns, 3);
        let narrow = run(Width::Scalar, settings, &world, &columns, 3);
        assert_eq!(wide.x, narrow.x, "{settings:?}");
        assert_eq!(wide.best, narrow.best);
        assert_eq!(wide.global_cost.to_bits(), narrow.global_cost.to_bits());
    };
    for bounds in BOUNDS {
        for topology in TOPOLOGIES {
            let velocity_limit = Some(VelocityLimit::Fraction(1.0));
            let (bounds, topology) = (Some(bounds), Some(topology));
            let inertia = Settings { bounds, topology, iterations: 50, ..Settings::default() };
            for random_numbers in [RandomNumbers::PerDimension, RandomNumbers::PerParticle] {
                check(&Settings { velocity_limit, random_numbers: Some(random_numbers), ..inertia.clone() });
            }
            for rule in [Rule::Quantum, Rule::Spso2011] {
                check(&Settings { rule, ..inertia.clone() });
            }
        }
        let (bounds, rule) = (Some(bounds), Rule::Comprehensive);
        check(&Settings { rule, bounds, iterations: 50, ..Settings::default() });
    }
}

/// Nothing of one run, not even of another size, is left in the next.
#[test]
fn a_used_swarm_is_as_good_as_new() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    let columns = Columns::new(scene.start(), scene.goal(), 9);
    for rule_name in [Rule::Inertia, Rule::Quantum, Rule::Spso2011, Rule::Comprehensive] {
        let settings = Settings { rule: rule_name, columns: 9, iterations: 40, ..Settings::default() }.filled();
        let fresh = run(Width::widest(), &settings, &world, &columns, 8);
        let mut terrain = Terrain::default();
        terrain.compile(&world, &columns, settings.bounds.unwrap_or_default());
        let ground =
            Ground { width: Width::widest(), settings: &settings, world: &world, columns: &columns, terrain: &terrain };
        let (mut swarm, mut rule) = (Swarm::default(), rule(&settings));
        for seed in [7, 8] {
            swarm.initialise(ground, rule.as_mut(), seed);
            for t in 0..settings.iterations {
                swarm.iterate(ground, rule.as_mut(), t);
            }
        }
        assert_eq!(swarm.x, fresh.x, "{rule_name:?}");
        assert_eq!(swarm.v, fresh.v);
        assert_eq!(swarm.global, fresh.global);
    }
}

/// Particles outside the rectangle neither count as evaluated nor enter the bests.
#[test]
fn invisible_walls_hide_what_is_outside() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    let columns = Columns::new(scene.start(), scene.goal(), 20);
    let settings = Settings { rule: Rule::Comprehensive, iterations: 12, ..Settings::default() };
    let swarm = run(Width::widest(), &settings, &world, &columns, 1);
    let h = columns.half_width();
    let inside = |i: &usize| (0..swarm.dims).all(|d| (-h..=h).contains(&swarm.x[d * swarm.stride + i]));
    let seen = (0..swarm.particles).filter(inside).count();
    assert!((1..swarm.particles).contains(&seen), "{seen} inside: the scene no longer tests anything");
    assert_eq!(swarm.evaluated, seen as u64);
    for i in 0..swarm.particles {
        assert_eq!(swarm.cost[i].is_finite(), inside(&i));
        assert!((0..swarm.dims).all(|d| (-h..=h).contains(&swarm.best[d * swarm.stride + i])));
    }
}

/// Costs of the last pass against the environment model's own distances,
/// with every shape, a field and every rule of motion.
#[test]
fn fitness_counts_fields_capsules_and_polygons() {
    let file = include_str!("../../../../configs/scenes/mixed-shapes.toml");
    let scene = Scene::from_toml("mixed-shapes.toml", file).unwrap();
    let world = World::new(&scene).unwrap();
    let (mut hits, mut outside, mut free) = (0, 0, 0);
    for bounds in BOUNDS {
        for topology in TOPOLOGIES {
            let settings = Settings {
                bounds: Some(bounds),
                topology: Some(topology),
                columns: 12,
                iterations: 30,
                velocity_limit: Some(VelocityLimit::Fraction(2.0)),
                ..Settings::default()
            };
            let columns = Columns::new(scene.start(), scene.goal(), settings.columns);
            let swarm = run(Width::widest(), &settings, &world, &columns, 9);
            let mut path = Vec::new();
            for i in (0..swarm.particles).filter(|&i| swarm.cost[i].is_finite()) {
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
