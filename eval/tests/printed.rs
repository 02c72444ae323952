//! Snapshots of what the command prints: help, lists, and every kind of bad input.

use std::fmt::Write as _;
use std::fs;
use std::process::Command;

/// What `touchline args…` prints in `folder`, with its exit code.
fn printed(folder: &std::path::Path, args: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_touchline"))
        .args(args)
        .current_dir(folder)
        .env_remove("COLUMNS")
        .output()
        .expect("the binary runs");
    let text = [output.stdout, output.stderr].concat();
    format!("{}exit code {}\n", String::from_utf8_lossy(&text), output.status.code().expect("no signal"))
}

fn folder(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("touchline-printed-{}-{name}", std::process::id()));
    fs::create_dir_all(&folder).expect("a temporary folder");
    folder
}

#[test]
fn help() {
    let here = folder("help");
    for command in ["run", "plan", "report", "list", "check", "status", "merge", "compare"] {
        insta::assert_snapshot!(format!("help_{command}"), printed(&here, &[command, "--help"]));
    }
    insta::assert_snapshot!("help", printed(&here, &["--help"]));
}

#[test]
fn lists() {
    let here = folder("lists");
    for what in ["planners", "generators", "metrics"] {
        insta::assert_snapshot!(format!("list_{what}"), printed(&here, &["list", what]));
    }
}

/// A scene and a comparison that are right, and what is wrong with each variant.
#[test]
fn bad_input() {
    const SCENE: &str = "\
name = \"demo\"
start = [0.0, 0.0]
goal = [10.0, 0.0]

[[obstacle]]
disc = { centre = [5.0, 0.0], radius = 1.0 }
[[obstacle]]
polygon = [[7.0, 2.0], [8.0, 2.0], [8.0, 3.0], [7.0, 3.0]]
";
    const COMPARISON: &str = "\
name = \"demo\"
repeats = 2
scenes = [\"scene.toml\"]

[planner.pso]
particles = 4
iterations = 5
";
    let here = folder("bad");
    let variants = [
        ("scene", "TOML syntax", "start = [0.0, 0.0]", "start = [0.0, 0.0"),
        ("scene", "unknown key", "goal =", "gaol ="),
        ("scene", "wrong type", "radius = 1.0", "radius = \"one\""),
        ("scene", "NaN", "start = [0.0", "start = [nan"),
        ("scene", "infinite", "goal = [10.0", "goal = [inf"),
        ("scene", "negative radius", "radius = 1.0", "radius = -1.0"),
        ("scene", "self-crossing polygon", "[8.0, 3.0], [7.0, 3.0]", "[7.0, 3.0], [8.0, 3.0]"),
        ("scene", "start inside an obstacle", "start = [0.0", "start = [4.5"),
        ("scene", "start = goal", "start = [0.0", "start = [10.0"),
        ("scene", "moving obstacle", "radius = 1.0 }", "radius = 1.0 }\nvelocity = [1.0, 0.0]"),
        ("comparison", "TOML syntax", "repeats = 2", "repeats = "),
        ("comparison", "unknown key", "repeats", "repeat"),
        ("comparison", "unknown setting", "particles", "particle"),
        ("comparison", "wrong type", "particles = 4", "particles = \"four\""),
        ("comparison", "zero particles", "particles = 4", "particles = 0"),
        ("comparison", "columns = 0", "particles = 4", "columns = 0"),
        ("comparison", "unknown planner", "[planner.pso]", "[planner.psso]"),
        ("comparison", "external planner", "[planner.pso]", "[planner.pso]\nkind = \"external\""),
        ("comparison", "no planner", "[planner.pso]\nparticles = 4\niterations = 5\n", ""),
        ("comparison", "no scene", "\"scene.toml\"", ""),
        ("comparison", "no repeats", "repeats = 2", "repeats = 0"),
        ("comparison", "missing scene", "scene.toml", "elsewhere.toml"),
        ("comparison", "two scenes of one name", "\"scene.toml\"", "\"scene.toml\", \"scene.toml\""),
        ("comparison", "unknown generator", "\"scene.toml\"", "{ generate = \"maze\", count = 1 }"),
    ];
    let mut all = String::new();
    for (file, what, from, to) in variants {
        let (mut scene, mut comparison) = (SCENE.to_owned(), COMPARISON.to_owned());
        let text = if file == "scene" { &mut scene } else { &mut comparison };
        assert!(text.contains(from), "{what}");
        *text = text.replacen(from, to, 1);
        fs::write(here.join("scene.toml"), &scene).expect("writable");
        fs::write(here.join("demo.toml"), &comparison).expect("writable");
        let output = printed(&here, &["run", "demo.toml", "--out", "out"]);
        let _ = write!(all, "## {file}: {what}\n{output}\n");
        assert!(output.ends_with("exit code 2\n"), "{what}: {output}");
        assert!(!here.join("out").exists(), "{what}: something was written");
    }
    let _ = write!(all, "## missing comparison\n{}\n", printed(&here, &["run", "nowhere.toml"]));
    insta::assert_snapshot!(all);
    fs::remove_dir_all(here).expect("ours");
}
