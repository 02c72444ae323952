//! The scenes that come with the project can be read and say what they should.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use env_model::{Scene, Shape, World};

fn load(file: &Path) -> Scene {
    let text = fs::read_to_string(file).unwrap();
    Scene::from_toml(&file.display().to_string(), &text).unwrap_or_else(|e| panic!("{e}"))
}

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../configs/scenes"))
}

#[test]
fn every_scene_of_the_project_loads_under_its_own_name() {
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder()).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|e| e == "toml") {
            let scene = load(&path);
            assert_eq!(scene.name, path.file_stem().unwrap().to_str().unwrap());
            assert_eq!(Scene::from_toml("again", &scene.to_toml()).unwrap(), scene);
            names.insert(scene.name);
        }
    }
    for expected in ["lu-sun-2012", "mixed-shapes", "corridor", "trap"] {
        assert!(names.contains(expected), "{expected} is missing: {names:?}");
    }
}

#[test]
fn the_papers_scene_is_the_papers() {
    let scene = load(&folder().join("lu-sun-2012.toml"));
    assert_eq!((scene.start, scene.goal), ([200.0, 150.0], [400.0, 260.0]));
    assert_eq!((scene.robot_radius, scene.field, scene.unit.as_str()), (0.0, None, "cm"));
    let discs: Vec<_> = scene.obstacles.iter().map(|o| o.shape.clone()).collect();
    let expected = [[240.0, 160.0], [280.0, 200.0], [320.0, 230.0]].map(|centre| Shape::Disc { centre, radius: 16.0 });
    assert_eq!(discs, expected);
}

#[test]
fn the_straight_line_is_blocked_in_all_of_them() {
    for name in ["lu-sun-2012", "mixed-shapes", "corridor", "trap"] {
        let scene = load(&folder().join(name).with_extension("toml"));
        let world = World::new(&scene).unwrap();
        assert!(!world.segment_free(scene.start(), scene.goal()), "{name}");
    }
}

#[test]
fn the_doors_of_the_corridor_let_the_robot_through_and_the_trap_does_not() {
    let corridor = World::new(&load(&folder().join("corridor.toml"))).unwrap();
    let through = [[-2.5, 0.0], [-1.2, 0.95], [-0.8, 0.95], [0.8, -0.95], [1.2, -0.95], [2.5, 0.0]].map(Into::into);
    assert!(corridor.path_free(&through));
    let trap = load(&folder().join("trap.toml"));
    let trap = World::new(&trap).unwrap();
    for (a, b) in trap.obstacles().iter().zip(&trap.obstacles()[1..]) {
        let ((c, r), (d, s)) = (a.as_disc().unwrap(), b.as_disc().unwrap());
        assert!((c - d).norm() < r + s, "neighbours of the U overlap when inflated");
    }
}
