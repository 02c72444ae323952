//! Scenes that tests and benchmarks plan in.

use std::path::Path;

use env_model::generate::{Generator, generate};
use env_model::{Scene, World};

/// Reads a scene of this repository.
pub fn load(relative: &str) -> Scene {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(relative);
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    Scene::from_toml(relative, &text).unwrap_or_else(|e| panic!("{e}"))
}

/// The scene of the 2012 paper.
pub fn paper() -> Scene {
    load("configs/scenes/lu-sun-2012.toml")
}

/// A scene of `tests/reference/`.
pub fn reference(name: &str) -> Scene {
    load(&format!("tests/reference/{name}.toml"))
}

/// `count` instants of an 11-against-11 game.
pub fn games(count: u32) -> Vec<Scene> {
    (0..count).map(|index| generate(Generator::SslA, None, 1, index).unwrap_or_else(|e| panic!("{e}"))).collect()
}

/// A scene of every kind that planners must cope with: discs, overlapping
/// discs, a field, all shapes, a crowd, a scaled one.
pub fn all() -> Vec<Scene> {
    let mut scenes = vec![
        paper(),
        load("tests/reference/wall-00.toml"),
        load("tests/reference/ssl22-00.toml"),
        load("configs/scenes/mixed-shapes.toml"),
        load("configs/scenes/corridor.toml"),
        load("configs/scenes/trap.toml"),
    ];
    for generator in Generator::ALL {
        scenes.push(generate(generator, None, 5, 0).unwrap_or_else(|e| panic!("{e}")));
    }
    let mut tiny = paper();
    tiny.name = "paper-in-millionths".into();
    scale(&mut tiny, 1e-6);
    scenes.push(tiny);
    let mut empty = paper();
    empty.name = "empty".into();
    empty.obstacles.clear();
    scenes.push(empty);
    scenes
}

fn scale(scene: &mut Scene, factor: f64) {
    use env_model::Shape;
    let point = |p: &mut [f64; 2]| *p = p.map(|v| v * factor);
    point(&mut scene.start);
    point(&mut scene.goal);
    for obstacle in &mut scene.obstacles {
        match &mut obstacle.shape {
            Shape::Disc { centre, radius } => {
                point(centre);
                *radius *= factor;
            }
            _ => panic!("only discs here"),
        }
    }
}

/// The scene compiled.
pub fn world(scene: &Scene) -> World {
    World::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name))
}
