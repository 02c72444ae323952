//! Three updates of a swarm small enough to follow by hand, with given random numbers.
//!
//! Three particles with two heights each fly over an empty ground, from (0, 0) to
//! (12, 0): columns 4 apart, H = 3, cost √(16 + y₁²) + √(16 + (y₂ − y₁)²) + √(16 + y₂²).
//! The costs of the start are 13.595, 12.426 and 13.748: particle 1 leads. The
//! tests work one number of the first update out in a comment; the other numbers
//! are from a short calculation of its own, in plain Python, of the rule's formula.

use env_model::{Columns, Point, Scene, World};
use pulp::Scalar;

use super::UpdateRule;
use crate::choices::Bounds;
use crate::settings::Settings;
use crate::swarm::{Ground, Swarm};
use crate::terrain::Terrain;
use crate::width::Width;

/// Positions of the three particles.
pub type Positions = [[f64; 2]; 3];

/// Where they start.
pub const START: Positions = [[2.0, -1.0], [1.0, 1.5], [-2.5, 0.5]];

/// The first random number of iteration `k` (from 0) in a row of a particle's numbers.
pub fn r1(k: usize, row: usize, particle: usize) -> f64 {
    ((3 * k + 2 * row + particle) % 7 + 1) as f64 / 8.0
}

/// The second one.
pub fn r2(k: usize, row: usize, particle: usize) -> f64 {
    ((5 * k + row + 3 * particle) % 7 + 1) as f64 / 8.0
}

/// Makes three updates from `START` with `velocities`, the first of them being
/// iteration `first`, and checks where the particles are after each.
pub fn check(
    settings: &Settings,
    rule: &mut dyn UpdateRule,
    velocities: Positions,
    first: u64,
    expected: [Positions; 3],
) {
    let settings = Settings { particles: 3, columns: 2, ..settings.clone() };
    let scene = Scene::from_toml("empty", "name = \"empty\"\nstart = [0.0, 0.0]\ngoal = [12.0, 0.0]").unwrap();
    let world = World::new(&scene).unwrap();
    let columns = Columns::new(Point::new(0.0, 0.0), Point::new(12.0, 0.0), 2);
    assert_eq!((columns.spacing(), columns.half_width()), (4.0, 3.0));
    let mut terrain = Terrain::default();
    terrain.compile(&world, &columns, Bounds::None);
    let ground =
        Ground { width: Width::widest(), settings: &settings, world: &world, columns: &columns, terrain: &terrain };

    let mut swarm = Swarm::default();
    swarm.initialise(ground, rule, 0);
    for (i, (position, velocity)) in START.iter().zip(&velocities).enumerate() {
        for d in 0..2 {
            swarm.x[d * swarm.stride + i] = position[d];
            swarm.v[d * swarm.stride + i] = velocity[d];
        }
    }
    swarm.best_cost.fill(f64::INFINITY);
    swarm.global_cost = f64::INFINITY;
    swarm.evaluate(ground, None);
    assert_eq!(swarm.leader_of(0), 1);
    for (k, expected) in expected.into_iter().enumerate() {
        for row in 0..rule.rows(2) {
            for i in 0..3 {
                swarm.random[0][row * swarm.stride + i] = r1(k, row, i);
                swarm.random[1][row * swarm.stride + i] = r2(k, row, i);
            }
        }
        if let Some(weights) = rule.steer(&mut swarm, first + k as u64) {
            // Their sweep draws numbers of its own.
            for (d, i) in (0..2).flat_map(|d| (0..3).map(move |i| (d, i))) {
                let at = d * swarm.stride + i;
                let (own, social) = (swarm.best[at], swarm.global[d]);
                let numbers = (r1(k, d, i), r2(k, d, i));
                swarm.v[at] = weights.velocity(Scalar, numbers, (swarm.x[at], swarm.v[at]), (own, social));
            }
        }
        swarm.advance(ground);
        swarm.evaluate(ground, None);
        for (i, expected) in expected.into_iter().enumerate() {
            for (d, expected) in expected.into_iter().enumerate() {
                let x = swarm.x[d * swarm.stride + i];
                // Numbers of order 1 after some fifty roundings: 1e-13 would do.
                assert!((x - expected).abs() < 1e-12, "update {k}, particle {i}, height {d}: {x}, not {expected}");
            }
        }
    }
}
