//! Cost of collision queries and of compiling a scene: in a Small Size League game, among
//! 22 discs at its density, among 10⁵, and among the blocks of Fang's figure for a point robot.
//!
//! `cargo bench -p env-model`. Queries are precomputed and cycled through, so that
//! branches are not learnt; a time is that of one query.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use env_model::generate::{Generator, generate};
use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Vector, World};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

const QUERIES: usize = 4096;

/// `count` robots at the density of 22 on 12 × 9 m.
fn discs(count: usize, rng: &mut ChaCha8Rng) -> Scene {
    let half = 0.5 * (count as f64 * 12.0 * 9.0 / 22.0).sqrt();
    Scene {
        name: "bench".into(),
        unit: "m".into(),
        robot_radius: 0.09,
        start: [-half, 0.0],
        goal: [half, 0.0],
        field: Some(Field { min: [-half, -half], max: [half, half] }),
        obstacles: (0..count).map(|_| Obstacle::disc(point(rng, half), 0.09)).collect(),
    }
}

fn scenes(rng: &mut ChaCha8Rng) -> Vec<(&'static str, Scene)> {
    let blocks = include_str!("../../configs/scenes/fang-2009-blocks.toml");
    vec![
        ("ssl-a", generate(Generator::SslA, None, 1, 0).expect("its own number of robots")),
        ("22 discs", discs(22, rng)),
        ("100000 discs", discs(100_000, rng)),
        ("blocks", Scene::from_toml("fang-2009-blocks.toml", blocks).expect("a scene of the repository")),
    ]
}

fn unit(rng: &mut ChaCha8Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64
}

fn point(rng: &mut ChaCha8Rng, half: f64) -> Point {
    Point::new((2.0 * unit(rng) - 1.0) * half, (2.0 * unit(rng) - 1.0) * half)
}

fn collision(c: &mut Criterion) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    for (name, scene) in scenes(&mut rng) {
        let world = World::new(&scene).expect("numbers are finite");
        let field = world.extent();
        let segments: Vec<(Point, Point)> = (0..QUERIES)
            .map(|_| {
                let a = field.min + field.size().component_mul(&Vector::new(unit(&mut rng), unit(&mut rng)));
                // 0.5 to 2 m in a random direction.
                let d = point(&mut rng, 1.0) - Point::origin();
                (a, a + d.try_normalize(0.0).unwrap_or(Vector::x()) * (0.5 + 1.5 * unit(&mut rng)))
            })
            .collect();
        let free = segments.iter().filter(|(a, b)| world.segment_free(*a, *b)).count();
        println!("{name}: {free} of {QUERIES} segments are free");
        let mut group = c.benchmark_group(name);
        let mut next = (0..QUERIES).cycle();
        let mut each = |name: &str, query: &dyn Fn(Point, Point) -> f64| {
            group.bench_function(name, |bencher| {
                bencher.iter(|| {
                    let (a, b) = segments[next.next().unwrap_or(0)];
                    query(black_box(a), black_box(b))
                });
            });
        };
        // What the loop round each query costs.
        each("nothing", &|a, _| a.x);
        each("segment_free", &|a, b| f64::from(u8::from(world.segment_free(a, b))));
        each("segment_clearance", &|a, b| world.segment_clearance(a, b));
        each("point_clearance", &|a, _| world.point_clearance(a));
        each("point_free", &|a, _| f64::from(u8::from(world.point_free(a))));
        each("for_each_along", &|a, b| {
            let mut last = 0;
            world.for_each_along(a, b, |i| last = i);
            last as f64
        });
        group.sample_size(10).bench_function("World::new", |bencher| bencher.iter(|| World::new(black_box(&scene))));
        group.finish();
    }
}

criterion_group!(benches, collision);
criterion_main!(benches);
