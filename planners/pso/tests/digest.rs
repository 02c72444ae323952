//! Rows of the published table of readings, and invariants of the swarm.

use env_model::{Scene, World, path_length};
use planner_api::{Plan, Planner, Problem, Run};
use planner_pso::{Bounds, NoLimit, Pso, RandomNumbers, Rule, Settings, Topology, VelocityLimit};

fn paper() -> Scene {
    Scene::from_toml("lu-sun-2012.toml", include_str!("../../../configs/scenes/lu-sun-2012.toml")).unwrap()
}

/// Share of valid runs (%) and median length of the valid ones over `seeds` seeds.
fn campaign(settings: Settings, seeds: u64) -> (f64, f64) {
    let scene = paper();
    let world = World::new(&scene).unwrap();
    let problem = Problem::new(&world, scene.start(), scene.goal()).unwrap();
    let mut pso = Pso::new(settings).unwrap();
    let mut plan = Plan::new();
    let mut lengths = Vec::new();
    for seed in 0..seeds {
        pso.plan_into(&problem, &mut Run::new(seed), &mut plan).unwrap();
        if world.first_violation(&plan.path).is_none() {
            lengths.push(path_length(&plan.path));
        }
    }
    lengths.sort_by(f64::total_cmp);
    (100.0 * lengths.len() as f64 / seeds as f64, lengths[lengths.len() / 2])
}

fn reading(bounds: Bounds, limit: Option<f64>) -> Settings {
    let velocity_limit = limit.map_or(VelocityLimit::Word(NoLimit::None), VelocityLimit::Fraction);
    Settings { bounds: Some(bounds), velocity_limit: Some(velocity_limit), ..Settings::default() }
}

#[test]
#[ignore = "prints the whole table; run with --release -- --ignored --nocapture"]
fn table() {
    use Bounds::{Clip, None as Free, Reflect, Stop};
    for (bounds, limit) in [
        (Free, None),
        (Free, Some(2.0)),
        (Free, Some(1.0)),
        (Free, Some(0.4)),
        (Free, Some(0.2)),
        (Clip, None),
        (Clip, Some(0.4)),
        (Stop, None),
        (Stop, Some(0.4)),
        (Stop, Some(0.5)),
        (Reflect, None),
        (Reflect, Some(1.0)),
        (Reflect, Some(0.4)),
    ] {
        println!("{bounds:?} {limit:?}: {:?}", campaign(reading(bounds, limit), 1000));
    }
    let per_particle = Settings { random_numbers: Some(RandomNumbers::PerParticle), ..reading(Free, None) };
    println!("one pair a particle: {:?}", campaign(per_particle, 1000));
    for topology in [Topology::Global, Topology::Ring, Topology::VonNeumann, Topology::Random] {
        for limit in [None, Some(0.5)] {
            let s = Settings { rule: Rule::Constriction, topology: Some(topology), ..reading(Stop, limit) };
            println!("constriction {topology:?} {limit:?}: {:?}", campaign(s, 1000));
        }
        for rule in [Rule::Inertia, Rule::Quantum, Rule::Spso2011] {
            let s = Settings { rule, topology: Some(topology), ..Settings::default() };
            println!("{rule:?} {topology:?}: {:?}", campaign(s, 1000));
        }
    }
    for bounds in [Free, Clip, Stop, Bounds::Rebound, Reflect, Bounds::Invisible] {
        for rule in [Rule::Quantum, Rule::Spso2011, Rule::Comprehensive] {
            let s = Settings { rule, bounds: Some(bounds), ..Settings::default() };
            println!("{rule:?} {bounds:?}: {:?}", campaign(s, 1000));
        }
    }
}

/// 60 seeds keep the test quick. Bands are the published medians of 1000 seeds
/// ± 3 % and shares ± 3 standard errors of 60 runs, or one failure.
#[test]
fn rows_of_the_table_reproduce() {
    let default = campaign(Settings::default(), 60);
    assert!(default.0 >= 95.0 && (default.1 - 241.9).abs() < 7.3, "{default:?}");
    let narrow = campaign(reading(Bounds::None, Some(0.2)), 60);
    assert!((72.0..=99.0).contains(&narrow.0) && (narrow.1 - 234.1).abs() < 7.0, "{narrow:?}");
    let unlimited = campaign(reading(Bounds::None, None), 60);
    assert!(unlimited.0 == 100.0 && (unlimited.1 - 355.7).abs() < 20.0, "{unlimited:?}");
}

/// Quantum-behaved particles against the published 99 % and 245 of 200 seeds. Both
/// campaigns have 200 runs: a share of 0.99 has a standard error of 0.7 %, the
/// difference 1 %; three of them. The median's is about 0.77 by the spread of the
/// lengths (quartiles 11.7 apart: 1.25·11.7/1.35/√200), the difference's 1.1; three of them.
#[test]
fn quantum_behaved_particles_reproduce() {
    let (valid, median) = campaign(Settings { rule: Rule::Quantum, ..Settings::default() }, 200);
    assert!(valid >= 96.0 && (median - 245.0).abs() < 3.3, "{valid} %, {median}");
}
