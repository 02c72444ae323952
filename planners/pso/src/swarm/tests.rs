//! The swarm against plain code, against itself, and against the environment model.

use env_model::scene::Field;
use env_model::{Scene, Shape};
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

use super::reference::{Reference, reference};
use super::*;
use crate::choices::{NoLimit, RandomNumbers, Rule, Schedule, VelocityLimit};
use crate::rules::rule;

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

/// Every unit of this machine against the plain code.
fn check_against_reference(settings: &Settings, world: &World, columns: &Columns, seed: u64) -> Reference {
    let plain = reference(settings, world, columns, seed);
    let (n, m) = (settings.particles, settings.columns);
    for width in Width::all() {
        let swarm = run(width, settings, world, columns, seed);
        let name = width.name();
        assert_eq!(swarm.global_cost.to_bits(), plain.global_cost.to_bits(), "{name}, {settings:?}");
        assert_eq!(swarm.global, plain.global, "{name}, {settings:?}");
        assert_eq!(swarm.best_cost[..n], plain.best_cost, "{name}, {settings:?}");
        for (matrix, plain) in [(&swarm.x, &plain.x), (&swarm.v, &plain.v), (&swarm.best, &plain.best)] {
            for (i, d) in (0..n).flat_map(|i| (0..m).map(move |d| (i, d))) {
                assert_eq!(matrix[d * swarm.stride + i], plain[i][d], "{name}, particle {i}, {settings:?}");
            }
        }
    }
    plain
}

#[test]
fn agrees_bit_for_bit_with_plain_code_on_the_papers_scene() {
    let scene = scene();
    let world = World::new(&scene).unwrap();
    for (particles, count) in [(20, 20), (7, 5), (1, 1), (33, 40)] {
        let settings = Settings { particles, columns: count, iterations: 100, ..Settings::default() }.filled();
        let columns = Columns::new(scene.start(), scene.goal(), count);
        for seed in 0..3 {
            check_against_reference(&settings, &world, &columns, seed);
        }
    }
}

/// A scene of up to 30 discs, some with a field, some with capsules and polygons; its ends are free.
fn random_scene(rng: &mut impl Rng) -> Scene {
    let mut between = |low: f64, high: f64| low + (high - low) * ((rng.next_u64() >> 11) as f64 / 2f64.powi(53));
    let point = |between: &mut dyn FnMut(f64, f64) -> f64| [between(-5.0, 5.0), between(-3.0, 3.0)];
    let start = [between(-4.0, -2.0), between(-2.0, 2.0)];
    let goal = [between(2.0, 4.0), between(-2.0, 2.0)];
    let mut shapes: Vec<Shape> = Vec::new();
    for _ in 0..between(0.0, 31.0) as usize {
        shapes.push(Shape::Disc { centre: point(&mut between), radius: between(0.05, 0.6) });
    }
    if between(0.0, 1.0) < 0.3 {
        for _ in 0..between(1.0, 3.0) as usize {
            shapes.push(Shape::Capsule {
                from: point(&mut between),
                to: point(&mut between),
                radius: between(0.0, 0.2),
            });
        }
        for _ in 0..between(0.0, 3.0) as usize {
            let ([x, y], r) = (point(&mut between), between(0.2, 0.8));
            // An arrowhead: not convex.
            shapes.push(Shape::Polygon(vec![[x - r, y - r], [x + r, y], [x - r, y + r], [x - 0.3 * r, y]]));
        }
    }
    let robot_radius = if between(0.0, 1.0) < 0.5 { 0.09 } else { 0.0 };
    let half = [between(4.2, 6.0), between(2.2, 4.0)];
    let field = (between(0.0, 1.0) < 0.4).then(|| Field { min: half.map(|h| -h), max: half });
    let mut scene =
        Scene { name: "random".into(), unit: "m".into(), robot_radius, start, goal, field, obstacles: Vec::new() };
    for shape in shapes {
        scene.obstacles.push(shape.into());
        let inflated = scene.inflated(scene.obstacles.len() - 1).unwrap();
        if [scene.start(), scene.goal()].into_iter().any(|end| inflated.point_clearance(end) < 1e-3) {
            scene.obstacles.pop();
        }
    }
    scene
}

/// Ten thousand random swarms: whatever the settings, particles and columns, every
/// unit gives the bits of the plain code.
#[test]
fn agrees_bit_for_bit_with_plain_code_on_random_swarms() {
    let mut rng = Xoshiro256PlusPlus::seed_from_u64(1);
    let (mut hidden, mut penalised, mut free) = (0, 0, 0);
    for _ in 0..1250 {
        let scene = random_scene(&mut rng);
        let world = World::new(&scene).unwrap();
        for _ in 0..8 {
            let mut between = |low: f64, high: f64| low + (high - low) * (rng.next_u64() >> 11) as f64 / 2f64.powi(53);
            // Small swarms are quick, and as good at finding faults; some are large.
            let large = between(0.0, 1.0) < 0.1;
            let speed = between(-0.5, 2.0);
            let settings = Settings {
                particles: between(1.0, if large { 71.0 } else { 25.0 }) as usize,
                columns: between(1.0, if large { 41.0 } else { 12.0 }) as usize,
                iterations: between(0.0, 4.0) as u64,
                c1: Some(between(0.0, 3.0)),
                c2: Some(between(0.0, 3.0)),
                inertia: Some(Schedule::Linear { from: between(0.0, 1.2), to: between(0.0, 1.2) }),
                velocity_limit: Some(if speed > 0.05 {
                    VelocityLimit::Fraction(speed)
                } else {
                    VelocityLimit::Word(NoLimit::None)
                }),
                bounds: Some(BOUNDS[between(0.0, 6.0) as usize]),
                random_numbers: Some(if between(0.0, 1.0) < 0.5 {
                    RandomNumbers::PerDimension
                } else {
                    RandomNumbers::PerParticle
                }),
                penalty: between(1.0, 1000.0),
                ..Settings::default()
            }
            .filled();
            let columns = Columns::new(scene.start(), scene.goal(), settings.columns);
            let seed = (between(0.0, 1.0) * 1e9) as u64;
            let plain = check_against_reference(&settings, &world, &columns, seed);
            // Heights lie within H at first, so that a path is at most √(1 + ((m + 1)/2)²) L long.
            for &cost in &plain.best_cost {
                let longest = columns.frame().length() * (2.0 + settings.columns as f64);
                penalised += usize::from(cost > longest);
                free += usize::from(cost <= longest);
            }
            let h = columns.half_width();
            hidden += plain.x.iter().filter(|y| y.iter().any(|y| y.abs() > h)).count();
        }
    }
    assert!(hidden > 1000 && penalised > 10_000 && free > 10_000, "{hidden} outside, {penalised} hit, {free} free");
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
        let narrow = run(Width::Scalar, settings, &world, &columns, 3);
        for width in Width::all() {
            let wide = run(width, settings, &world, &columns, 3);
            assert_eq!(wide.best_cost, narrow.best_cost, "{}, {settings:?}", width.name());
            assert_eq!(wide.global_cost.to_bits(), narrow.global_cost.to_bits());
            for d in 0..wide.dims {
                let row = d * wide.stride..d * wide.stride + wide.particles;
                assert_eq!(wide.x[row.clone()], narrow.x[row.clone()], "{}, {settings:?}", width.name());
                assert_eq!(wide.best[row.clone()], narrow.best[row]);
            }
        }
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

/// Costs of personal bests against the environment model's own distances, with
/// every shape, a field, every border and every neighbourhood.
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
                iterations: 6,
                velocity_limit: Some(VelocityLimit::Fraction(2.0)),
                ..Settings::default()
            };
            let columns = Columns::new(scene.start(), scene.goal(), settings.columns);
            let swarm = run(Width::widest(), &settings, &world, &columns, 9);
            let mut path = Vec::new();
            for i in (0..swarm.particles).filter(|&i| swarm.best_cost[i].is_finite()) {
                let heights: Vec<f64> = (0..swarm.dims).map(|d| swarm.best[d * swarm.stride + i]).collect();
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
                assert!((swarm.best_cost[i] / cost - 1.0).abs() < 1e-12, "{bounds:?}, {topology:?}, particle {i}");
            }
        }
    }
    assert!(hits > 100 && outside > 50 && free > 100, "{hits} hits, {outside} outside, {free} free");
}
