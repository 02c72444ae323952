//! Cost of one collision query: among the 22 discs of a game, and among 10⁵ at the same density.
//!
//! `cargo bench -p env-model`. Queries are precomputed and cycled through, so that
//! branches are not learnt; a time is that of one query.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Vector, World};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const QUERIES: usize = 4096;

/// `count` robots at the density of 22 on 12 × 9 m, and the half side of their square.
fn world(count: usize, rng: &mut ChaCha8Rng) -> (World, f64) {
    let half = 0.5 * (count as f64 * 12.0 * 9.0 / 22.0).sqrt();
    let obstacles = (0..count).map(|_| Obstacle::disc(point(rng, half), 0.09)).collect();
    let edge = half + 3.0;
    let scene = Scene {
        name: "bench".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-half, 0.0],
        goal: [half, 0.0],
        field: Some(Field { min: [-edge, -edge], max: [edge, edge] }),
        obstacles,
    };
    (World::new(&scene).expect("numbers are finite"), half)
}

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn point(rng: &mut ChaCha8Rng, half: f64) -> Point {
    Point::new((2.0 * unit(rng) - 1.0) * half, (2.0 * unit(rng) - 1.0) * half)
}

fn collision(c: &mut Criterion) {
    for count in [22, 100_000] {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let (world, half) = world(count, &mut rng);
        let segments: Vec<(Point, Point)> = (0..QUERIES)
            .map(|_| {
                let a = point(&mut rng, half);
                // 0.5 to 2 m in a random direction.
                let d = point(&mut rng, 1.0) - Point::origin();
                (a, a + d.try_normalize(0.0).unwrap_or(Vector::x()) * (0.5 + 1.5 * unit(&mut rng)))
            })
            .collect();
        let free = segments.iter().filter(|(a, b)| world.segment_free(*a, *b)).count();
        println!("{count} discs: {free} of {QUERIES} segments are free");
        let mut group = c.benchmark_group(format!("{count} discs"));
        let mut next = (0..QUERIES).cycle();
        let mut each = |name: &str, query: &dyn Fn(Point, Point) -> f64| {
            group.bench_function(name, |bencher| {
                bencher.iter(|| {
                    let (a, b) = segments[next.next().unwrap_or(0)];
                    query(black_box(a), black_box(b))
                });
            });
        };
        each("segment_free", &|a, b| f64::from(u8::from(world.segment_free(a, b))));
        each("segment_clearance", &|a, b| world.segment_clearance(a, b));
        each("point_clearance", &|a, _| world.point_clearance(a));
        each("point_free", &|a, _| f64::from(u8::from(world.point_free(a))));
        group.finish();
    }
}

criterion_group!(benches, collision);
criterion_main!(benches);
