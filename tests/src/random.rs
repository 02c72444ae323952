//! Uniform random worlds of any size, for growth.

use env_model::scene::Field;
use env_model::{Obstacle, Point, Scene, Vector, World};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::scenes;

fn uniform(rng: &mut ChaCha8Rng, low: f64, high: f64) -> f64 {
    low + (high - low) * ((rng.next_u64() >> 11) as f64 / (1u64 << 53) as f64)
}

/// `count` discs with radii 0.2 to 0.6, one in two square units, uniform in a
/// square that the robot, a point, crosses from corner to corner. Both corners are free.
pub fn discs(count: usize, seed: u64) -> Scene {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let side = (2.0 * count as f64).sqrt();
    let (start, goal) = (Point::new(0.0, 0.0), Point::new(side, side));
    let mut obstacles = Vec::with_capacity(count);
    while obstacles.len() < count {
        let centre = Point::new(uniform(&mut rng, 0.0, side), uniform(&mut rng, 0.0, side));
        let radius = uniform(&mut rng, 0.2, 0.6);
        if (centre - start).norm() > radius && (centre - goal).norm() > radius {
            obstacles.push(Obstacle::disc(centre, radius));
        }
    }
    Scene {
        name: format!("{count} discs, seed {seed}"),
        unit: "m".into(),
        robot_radius: 0.0,
        start: start.into(),
        goal: goal.into(),
        field: None,
        obstacles,
    }
}

/// `scene` of [`discs`] in a field one unit wider all round: no disc closes that
/// rim, so there is a way, and the ways round all discs are narrow.
pub fn walled(mut scene: Scene) -> Scene {
    let [width, height] = scene.goal;
    scene.field = Some(Field { min: [-1.0, -1.0], max: [width + 1.0, height + 1.0] });
    scene
}

/// Robots at the density of `ssl-a`, and segments among them.
pub struct Robots {
    /// The robots, in a square with room round it.
    pub scene: Scene,
    /// The scene compiled.
    pub world: World,
    /// Queries 0.5 to 2 m long: more than a processor learns the branches of.
    pub segments: Vec<(Point, Point)>,
}

impl Robots {
    /// `count` robots, uniform at the density of 22 on 12 × 9 m.
    pub fn new(count: usize) -> Self {
        const QUERIES: usize = 4096;
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let half = 0.5 * (count as f64 * 12.0 * 9.0 / 22.0).sqrt();
        let mut point = |half: f64| Point::new(uniform(&mut rng, -half, half), uniform(&mut rng, -half, half));
        let obstacles = (0..count).map(|_| Obstacle::disc(point(half), 0.09)).collect();
        let ends: Vec<(Point, Point)> = (0..QUERIES).map(|_| (point(half), point(1.0))).collect();
        let segments = ends
            .into_iter()
            .map(|(a, towards)| {
                let direction = towards.coords.try_normalize(0.0).unwrap_or(Vector::x());
                (a, a + direction * uniform(&mut rng, 0.5, 2.0))
            })
            .collect();
        let edge = half + 3.0;
        let scene = Scene {
            name: format!("{count} robots"),
            unit: "m".into(),
            robot_radius: 0.09,
            start: [-half, 0.0],
            goal: [half, 0.0],
            field: Some(Field { min: [-edge, -edge], max: [edge, edge] }),
            obstacles,
        };
        Self { world: scenes::world(&scene), scene, segments }
    }
}
