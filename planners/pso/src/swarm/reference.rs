//! The paper's swarm in plain code: one particle and one number at a time, straight
//! from the formulas, sharing neither loops nor generators nor tables with the planner.

use env_model::geometry::point_segment_distance;
use env_model::{Columns, Point, World};
use planner_api::seed::splitmix64;
use rand::{Rng, SeedableRng};
use rand_xoshiro::Xoroshiro128PlusPlus;

use crate::choices::{Bounds, RandomNumbers};
use crate::settings::Settings;

/// State after a run.
pub struct Reference {
    pub x: Vec<Vec<f64>>,
    pub v: Vec<Vec<f64>>,
    pub best: Vec<Vec<f64>>,
    pub best_cost: Vec<f64>,
    pub global: Vec<f64>,
    pub global_cost: f64,
}

/// Equation (4): Σ λᵢ fᵢ; `None` for a particle that invisible walls hide.
fn cost(settings: &Settings, world: &World, columns: &Columns, y: &[f64]) -> Option<f64> {
    let m = settings.columns;
    if settings.bounds == Some(Bounds::Invisible) && y.iter().any(|y| y.abs() > columns.half_width()) {
        return None;
    }
    let at = |i: usize| Point::new(columns.x(i), if i == 0 || i > m { 0.0 } else { y[i - 1] });
    let frame = columns.frame();
    let collides = |i: usize| {
        let (a, b) = (at(i), at(i + 1));
        let (start, end) = (frame.to_world(a), frame.to_world(b));
        let off_field = |i: usize, p: Point| (1..=m).contains(&i) && world.field_clearance(p) < 0.0;
        off_field(i, start)
            || off_field(i + 1, end)
            || world.obstacles().iter().any(|obstacle| match obstacle.as_disc() {
                Some((centre, r)) => point_segment_distance(frame.to_local(centre), a, b) < r,
                None => !obstacle.segment_free(start, end, 0.0),
            })
    };
    let mut sum = 0.0;
    for i in 0..=m {
        let (dx, dy) = (columns.spacing(), at(i + 1).y - at(i).y);
        let length = (dx * dx + dy * dy).sqrt();
        sum += if collides(i) { settings.penalty * length } else { length };
    }
    Some(sum)
}

/// Equations (1) and (2), and what happens at the border: new position and velocity.
fn fly(settings: &Settings, h: f64, x: f64, v: f64) -> (f64, f64) {
    let limit = settings.max_speed(h);
    let v = v.clamp(-limit, limit);
    let y = x + v;
    let inside = y.clamp(-h, h);
    match settings.bounds.unwrap() {
        Bounds::None | Bounds::Invisible => (y, v),
        _ if inside == y => (y, v),
        Bounds::Clip => (inside, v),
        Bounds::Stop => (inside, 0.0),
        Bounds::Rebound => (inside, -0.5 * v),
        Bounds::Reflect => ((inside + inside - y).clamp(-h, h), -v),
    }
}

/// A run of the rule of inertia with one neighbourhood.
pub fn reference(settings: &Settings, world: &World, columns: &Columns, seed: u64) -> Reference {
    let (n, m, h) = (settings.particles, settings.columns, columns.half_width());
    let mut state = seed;
    let mut generators: Vec<Xoroshiro128PlusPlus> = (0..n)
        .map(|_| {
            let words = [splitmix64(&mut state), splitmix64(&mut state)];
            Xoroshiro128PlusPlus::from_seed(words.map(u64::to_le_bytes).concat().try_into().unwrap())
        })
        .collect();
    let mut place = |i: usize| (2.0 * ((generators[i].next_u64() >> 11) as f64 / 2f64.powi(53)) - 1.0) * h;
    let x: Vec<Vec<f64>> = (0..n).map(|i| (0..m).map(|_| place(i)).collect()).collect();
    let mut swarm = Reference {
        v: vec![vec![0.0; m]; n],
        best: vec![vec![0.0; m]; n],
        best_cost: vec![f64::INFINITY; n],
        global: vec![0.0; m],
        global_cost: f64::INFINITY,
        x,
    };
    let keep = |swarm: &mut Reference| {
        for i in 0..n {
            let cost = cost(settings, world, columns, &swarm.x[i]).unwrap_or(f64::INFINITY);
            if cost < swarm.best_cost[i] {
                swarm.best_cost[i] = cost;
                swarm.best[i] = swarm.x[i].clone();
            }
        }
        for i in 0..n {
            if swarm.best_cost[i] < swarm.global_cost {
                swarm.global_cost = swarm.best_cost[i];
                swarm.global = swarm.best[i].clone();
            }
        }
    };
    keep(&mut swarm);
    let (c1, c2, inertia) = (settings.c1.unwrap(), settings.c2.unwrap(), settings.inertia.unwrap());
    for t in 0..settings.iterations {
        let w = inertia.at(t, settings.iterations);
        for (i, generator) in generators.iter_mut().enumerate() {
            let mut pair = || {
                let word = generator.next_u64();
                ((word >> 32) as f64 / 2f64.powi(32), (word & 0xffff_ffff) as f64 / 2f64.powi(32))
            };
            let mut r = (0.0, 0.0);
            for d in 0..m {
                if d == 0 || settings.random_numbers == Some(RandomNumbers::PerDimension) {
                    r = pair();
                }
                let (x, own, social) = (swarm.x[i][d], swarm.best[i][d], swarm.global[d]);
                let v = (w * swarm.v[i][d] + (c1 * r.0) * (own - x)) + (c2 * r.1) * (social - x);
                (swarm.x[i][d], swarm.v[i][d]) = fly(settings, h, x, v);
            }
        }
        keep(&mut swarm);
    }
    swarm
}
