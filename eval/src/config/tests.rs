use std::io::Cursor;
use std::path::Path;

use super::*;

const GOOD: &str = r#"name = "demo"
seed = 7
repeats = 3
scenes = ["a.toml", { generate = "wall", count = 2, obstacles = 5, seed = 4 }]
budget = { iterations = 50 }

[planner.tangent]
[planner.swarm]
kind = "pso"
particles = 10
budget = { evaluations = 300 }
"#;

const SCENE: &str = r#"name = "a"
start = [0.0, 0.0]
goal = [10.0, 0.0]
[[obstacle]]
disc = { centre = [5.0, 0.0], radius = 1.0 }
"#;

const RCG: &str = "ULG6
(show 7 ((b) 1 2 0 0) ((l 2) 1 0x1 0 2 0 0 0 0) ((r 2) 1 0x1 2 2.5 0 0 0 0))
(show 9 ((b) 1 2 0 0) ((l 2) 1 0x1 3 2 0 0 0 0) ((r 2) 1 0x1 3 2.5 0 0 0 0))
(show 10 ((b) 1 2 0 0) ((r 2) 1 0x1 2 2.5 0 0 0 0))
";

/// Scenes and logs in memory, and the project's own data.
struct Memory;

impl Files for Memory {
    fn folder(&self) -> &Path {
        Path::new(".")
    }

    fn open(&self, relative: &str) -> Result<Opened, String> {
        let scene = |from: &str, to: &str| {
            assert!(SCENE.contains(from));
            SCENE.replace(from, to)
        };
        let text = match relative {
            "a.toml" => scene("a", "a"),
            "b.toml" => scene("\"a\"", "\"b\""),
            "inside.toml" => scene("start = [0.0", "start = [5.5"),
            "moving.toml" => scene("radius = 1.0 }", "radius = 1.0 }\nvelocity = [0.0, 0.5]\nlabel = \"runner\""),
            "bow-tie.toml" => {
                scene("disc = { centre = [5.0, 0.0], radius = 1.0 }", "polygon = [[1, 1], [2, 2], [2, 1], [1, 2]]")
            }
            "logs/game.rcg" => RCG.to_owned(),
            "cut.rcg.gz" => RCG[..100].to_owned(),
            _ if relative.starts_with("data/") => {
                return Disk::beside(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../configs/x"))).open(relative);
            }
            _ => return Err(format!("cannot read {relative}: no such file")),
        };
        Ok((relative.to_owned(), Box::new(Cursor::new(text))))
    }
}

fn read(text: &str) -> Result<Comparison, String> {
    Comparison::from_toml("c.toml", text, &Memory).map_err(|e| e.to_string())
}

#[test]
fn a_good_file_is_understood_in_its_own_order() {
    let c = read(GOOD).unwrap();
    assert_eq!((c.name.as_str(), c.seed, c.repeats), ("demo", 7, 3));
    let scenes: Vec<_> = c.scenes.iter().map(|s| (s.scene.name.as_str(), s.scene.obstacles.len())).collect();
    assert_eq!(scenes, [("a", 1), ("wall-s4-00", 5), ("wall-s4-01", 5)]);
    let planners: Vec<_> = c.planners.iter().map(|p| (p.label.as_str(), p.kind.as_str())).collect();
    assert_eq!(planners, [("tangent", "tangent"), ("swarm", "pso")], "not the alphabet's order");
    assert_eq!(c.planners[0].budget, BudgetSpec { iterations: Some(50), ..BudgetSpec::default() });
    let merged = BudgetSpec { iterations: Some(50), evaluations: Some(300), time_ms: None };
    assert_eq!(c.planners[1].budget, merged, "key by key");
    assert_eq!(c.planners[1].settings["particles"].as_integer(), Some(10));
    assert_eq!(c.planners[1].settings["columns"].as_integer(), Some(20), "defaults are written out");
    let c = read("name = \"demo\"\nscenes = [\"a.toml\"]\n[planner.tangent]").unwrap();
    assert_eq!((c.seed, c.repeats), (1, 30), "defaults");
}

#[test]
fn the_resolved_file_says_everything_and_reads_back() {
    struct Copies<'c>(&'c Comparison);
    impl Files for Copies<'_> {
        fn folder(&self) -> &Path {
            Path::new(".")
        }

        fn open(&self, relative: &str) -> Result<Opened, String> {
            let i = self.0.scene_files().iter().position(|f| f == relative).ok_or("no such copy")?;
            Ok((relative.to_owned(), Box::new(Cursor::new(self.0.scenes[i].scene.to_toml()))))
        }
    }
    let text = GOOD.replace("\"a.toml\",", "\"a.toml\", { rcg = \"logs/game.rcg\", cycles = [7], side = \"right\" },");
    let text = text.replace("[planner.swarm]", "[planner.\"a.b c\"]\nkind = \"pso-qp\"\n[planner.swarm]");
    let first = read(&text).unwrap();
    let resolved = first.to_toml();
    let second =
        Comparison::from_toml("again", &resolved, &Copies(&first)).unwrap_or_else(|e| panic!("{e}\n{resolved}"));
    assert_eq!(second.to_toml(), resolved);
    assert_eq!(second.scenes, first.scenes);
    let labels = |c: &Comparison| c.planners.iter().map(|p| p.label.clone()).collect::<Vec<_>>();
    assert_eq!(labels(&first), labels(&second));
    assert!(resolved.contains("columns = 20"), "{resolved}");
}

#[test]
fn mistakes_are_named_with_their_place() {
    let cases = [
        ("name = \"demo\"\n", "", "c.toml:1:1: missing field `name`"),
        ("name = \"demo\"", "name = demo", "c.toml:1:8: "),
        ("name = \"demo\"", "name = \"../demo\"", "c.toml:1:8: name = \"../demo\"; expected letters"),
        ("name = \"demo\"", "name = \"\"", "c.toml:1:8: name = \"\""),
        ("seed = 7", "sed = 7", "c.toml:2:1: unknown field `sed`, expected one of `name`, `seed`"),
        ("seed = 7", "seed = -7", "c.toml:2:8: seed = -7; expected an integer of at least 0"),
        ("seed = 7", "seed = 7.5", "c.toml:2:8: invalid type: floating point `7.5`"),
        ("repeats = 3", "repeats = 0", "c.toml:3:11: repeats = 0; expected an integer of at least 1"),
        ("repeats = 3", "repeats = \"3\"", "c.toml:3:11: invalid type: string \"3\""),
        ("repeats = 3", "repeats = 5000000000", "c.toml:3:11: repeats = 5000000000"),
        ("\"a.toml\",", "\"missing.toml\",", "c.toml:4:11: cannot read missing.toml"),
        ("\"a.toml\",", "5,", "c.toml:4:11: found integer; expected a path or { generate"),
        ("\"a.toml\",", "\"a.toml\", \"a.toml\",", "c.toml:4:21: a second scene named \"a\"; expected different names"),
        ("\"a.toml\",", "\"inside.toml\",", "inside.toml:2:9: start (5.500, 0.000) is 0.5000 inside obstacle 0"),
        ("\"a.toml\",", "\"bow-tie.toml\",", "bow-tie.toml:5:11: obstacle 0: sides 0 and 2 (counted from 0) cross"),
        (
            "\"a.toml\",",
            "\"moving.toml\",",
            "c.toml:4:11: scene \"a\": obstacle 0 (\"runner\") moves with velocity [0, 0.5]; expected obstacles at rest",
        ),
        ("\"wall\"", "\"walls\"", "c.toml:4:34: unknown generator \"walls\"; expected one of open, wall"),
        ("\"wall\"", "7", "c.toml:4:34: invalid type: integer `7`"),
        ("count = 2", "count = 0", "c.toml:4:50: count = 0; expected 1 to 100000"),
        ("count = 2", "cuont = 2", "c.toml:4:42: unknown field `cuont`"),
        ("obstacles = 5", "obstacles = 1", "c.toml:4:21: generator wall with 1 obstacles; expected at least 3"),
        ("budget = { iterations = 50 }", "budget = 50", "c.toml:5:10: found integer; expected a table such as"),
        ("budget = { iterations = 50 }", "budget = {}", "c.toml:5:10: an empty budget"),
        ("iterations = 50", "iterations = -1", "c.toml:5:25: invalid value: integer `-1`"),
        ("iterations = 50", "time_ms = nan", "c.toml:5:10: time_ms = NaN; expected a number above 0"),
        ("iterations = 50", "time_ms = 0", "c.toml:5:10: time_ms = 0; expected a number above 0"),
        ("iterations = 50", "time = 1", "c.toml:5:12: unknown field `time`"),
        ("[planner.tangent]", "[planner.tangnet]", "c.toml:7:10: unknown planner \"tangnet\"; expected one of"),
        ("kind = \"pso\"", "kind = \"psso\"", "c.toml:9:8: unknown planner \"psso\"; expected one of"),
        ("kind = \"pso\"", "kind = 3", "c.toml:9:8: kind is of type integer"),
        ("kind = \"pso\"", "kind = \"external\"", "c.toml:9:8: an external planner without command"),
        ("particles = 10", "hard_limit_ms = 0", "c.toml:10:17: hard_limit_ms: expected milliseconds"),
        ("particles = 10", "particles = 0", "c.toml:10:13: particles = 0; expected"),
        ("particles = 10", "columns = 0", "c.toml:10:11: columns = 0; expected"),
        ("particles = 10", "particles = \"ten\"", "c.toml:10:13: invalid type: string \"ten\""),
        ("particles = 10", "particels = 10", "c.toml:10:1: unknown field `particels`"),
        ("particles = 10", "velocity_limit = inf", "c.toml:10:18: velocity_limit = inf"),
        ("particles = 10", "particles = 1\nparticles = 2", "c.toml:11:1: duplicate key"),
        ("evaluations = 300", "evaluation = 300", "c.toml:11:12: unknown field `evaluation`"),
        ("[planner.swarm]", "[planner.\"\"]", "c.toml:8:10: planner label \"\"; expected printable text"),
    ];
    for (from, to, expected) in cases {
        assert!(GOOD.contains(from), "{from}");
        let message = read(&GOOD.replacen(from, to, 1)).err().unwrap_or_else(|| panic!("{to}: accepted"));
        assert!(message.starts_with(expected), "{to}:\n  {message}\n  {expected}");
    }
}

fn with_source(scene: &str) -> Result<Comparison, String> {
    read(&format!("name = \"x\"\nscenes = [{scene}]\n[planner.tangent]"))
}

#[test]
fn logs_are_sources_of_scenes() {
    let names = |scene: &str| {
        let c = with_source(scene).unwrap_or_else(|e| panic!("{e}"));
        c.scenes.iter().map(|s| s.scene.name.clone()).collect::<Vec<_>>()
    };
    assert_eq!(
        names("{ rcg = \"logs/game.rcg\", cycles = [10, 7], side = \"right\" }"),
        ["game-c0010-right", "game-c0007-right"]
    );
    assert_eq!(
        names("{ rcg = \"logs/game.rcg\", cycles = [7], side = \"left\", name = \"final\" }"),
        ["final-c0007-left"]
    );
    let c = with_source("{ rcg = \"logs/game.rcg\", cycles = [9], side = \"left\", target = [-1, 2.5] }").unwrap();
    assert_eq!((c.scenes[0].scene.start, c.scenes[0].scene.goal), ([3.0, 2.0], [-1.0, 2.5]));
    assert!(c.notes[0].starts_with("game-c0009-left: opponent 2 overlaps the start by 0.1"), "{:?}", c.notes);
    assert_eq!(
        names("{ rcg = \"data/robocup2d-heliosbase-selfplay.rcg.gz\", cycles = [120, 480], side = \"left\" }"),
        ["robocup2d-heliosbase-selfplay-c0120-left", "robocup2d-heliosbase-selfplay-c0480-left"]
    );
    let ssl = "ssl-log = \"data/ssl-divB-6v6-simulated.log.gz\", frames = [10], team = \"blue\", robot = 3";
    assert_eq!(names(&format!("{{ {ssl} }}")), ["ssl-divB-6v6-simulated-f0010-blue3"]);
    let c = with_source(&format!("{{ {ssl}, attack = \"left\" }}")).unwrap();
    assert_eq!((c.scenes[0].scene.goal, c.notes.len()), ([-4.5, 0.0], 0));
}

#[test]
fn mistakes_with_logs_are_named_with_their_place() {
    let rcg = "{ rcg = \"logs/game.rcg\", cycles = [7], side = \"left\", target = [5, 5] }";
    let ssl = "{ ssl-log = \"data/ssl-divB-6v6-simulated.log.gz\", frames = [10], team = \"blue\", robot = 3 }";
    let cases = [
        (
            rcg,
            "rcg = ",
            "rgc = ",
            "c.toml:2:11: none of generate, rcg, ssl-log and movingai; expected a path or { generate",
        ),
        (rcg, "logs/game.rcg", "none.rcg", "c.toml:2:19: cannot read none.rcg: no such file; expected a match log"),
        (rcg, "logs/game.rcg", "a.toml", "c.toml:2:19: a.toml:1: begins with \"name = \\\"\"; expected ULG4"),
        (rcg, "logs/game.rcg", "cut.rcg.gz", "c.toml:2:19: cut.rcg.gz:3: the line is cut short"),
        (rcg, "[7]", "[7, 8]", "c.toml:2:49: logs/game.rcg: cycle 8: not in the log; expected cycles from 7 to 10"),
        (rcg, "[7]", "[7, 10]", "c.toml:2:49: logs/game.rcg:4: cycle 10: the left side has no player on the field"),
        (rcg, "[7]", "[7, 7]", "c.toml:2:11: a second scene named \"game-c0007-left\"; expected different names"),
        (rcg, "[7]", "[]", "c.toml:2:45: 0 cycles; expected 1 to 10000, such as cycles = [120, 480]"),
        (rcg, "[7]", "[-7]", "c.toml:2:46: invalid value: integer `-7`"),
        (rcg, "[7]", "7", "c.toml:2:45: invalid type: integer `7`, expected a sequence"),
        (rcg, "\"left\"", "\"east\"", "c.toml:2:57: unknown variant `east`, expected `left` or `right`"),
        (rcg, "[5, 5]", "[5]", "c.toml:2:74: a target of 1 numbers; expected two finite ones, [x, y]"),
        (rcg, "[5, 5]", "[5, nan]", "c.toml:2:74: a target of 2 numbers; expected two finite ones, [x, y]"),
        (rcg, "[5, 5]", "[2, 2.6]", "c.toml:2:46: logs/game.rcg:2: cycle 7: goal (2.000, 2.600) is 0.5000 inside"),
        (rcg, "target = [5, 5]", "name = \"\"", "c.toml:2:72: name = \"\"; expected letters, digits, spaces"),
        (rcg, "target = [5, 5]", "name = \"a/b\"", "c.toml:2:72: name = \"a/b\"; expected letters, digits, spaces"),
        (ssl, "robot = 3", "robot = 3, name = \" \"", "c.toml:2:109: name = \" \"; expected letters"),
        (rcg, "target =", "goal =", "c.toml:2:65: unknown field `goal`, expected one of `rcg`, `cycles`, `side`"),
        (rcg, ", side = \"left\"", "", "c.toml:2:11: missing field `side`"),
        (ssl, "[10]", "[10, 700]", "c.toml:2:75: "),
        (ssl, "\"blue\"", "\"red\"", "c.toml:2:83: unknown variant `red`, expected `blue` or `yellow`"),
        (ssl, "robot = 3", "robot = 12", "c.toml:2:71: "),
        (ssl, "robot = 3", "robot = -1", "c.toml:2:99: invalid value: integer `-1`"),
        (ssl, "ssl-divB", "robocup", "c.toml:2:23: cannot read "),
    ];
    for (good, from, to, expected) in cases {
        assert!(good.contains(from), "{from}");
        let message = with_source(&good.replacen(from, to, 1)).err().unwrap_or_else(|| panic!("{to}: accepted"));
        assert!(message.starts_with(expected), "{to}:\n  {message}\n  {expected}");
    }
}

#[test]
fn a_folder_is_no_file() {
    let here = Disk::beside(Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/c.toml")));
    let error = |scene: &str| {
        let text = format!("name = \"x\"\nscenes = [{scene}]\n[planner.tangent]");
        Comparison::from_toml("c.toml", &text, &here).err().unwrap().to_string()
    };
    let log = |path: &str| error(&format!("{{ rcg = \"{path}\", cycles = [7], side = \"left\" }}"));
    assert_eq!(log(""), "c.toml:2:19: an empty path; expected a match log");
    let folder = log("src");
    assert!(
        folder.starts_with("c.toml:2:19: cannot read ")
            && folder.ends_with("src: it is a folder; expected a match log")
    );
    assert_eq!(error("\"\""), "c.toml:2:11: an empty path; expected a scene file");
}

#[test]
fn an_empty_comparison_is_a_mistake() {
    let cases = [
        ("", "c.toml:1:1: missing field `name`"),
        ("name = \"x\"\n[planner.tangent]", "c.toml:1:1: an empty comparison: no scenes"),
        ("name = \"x\"\nscenes = []\n[planner.tangent]", "c.toml:2:10: an empty comparison: no scenes"),
        ("name = \"x\"\nscenes = [\"a.toml\"]", "c.toml:1:1: an empty comparison: no planner"),
        ("name = \"x\"\nscenes = [\"a.toml\"]\n[planner]", "c.toml:3:1: an empty comparison: no planner"),
        ("name = \"x\"\nscenes = [\"a.toml\"]\nplanner = 3", "c.toml:3:11: found integer; expected tables"),
        ("name = \"x\"\nscenes = \"a.toml\"\n[planner.tangent]", "c.toml:2:10: found string; expected an array"),
    ];
    for (text, expected) in cases {
        let message = read(text).err().unwrap_or_else(|| panic!("{text}: accepted"));
        assert!(message.starts_with(expected), "{text}:\n  {message}");
    }
}

#[test]
fn copies_of_scenes_have_safe_and_different_names() {
    let mut c = read(GOOD).unwrap();
    for (scene, name) in c.scenes.iter_mut().zip(["../../etc/x", "Wall", "wall"]) {
        scene.scene.name = name.to_owned();
    }
    assert_eq!(c.scene_files(), ["scenes/_.._.._etc_x.toml", "scenes/Wall.toml", "scenes/wall~2.toml"]);
}

#[test]
fn planners_can_be_picked_by_label() {
    let mut c = read(GOOD).unwrap();
    let error = c.keep_planners(&["swarm".into(), "pso".into()]).unwrap_err();
    assert!(
        error.starts_with(
            "--planner \"pso\": no such label in comparison demo; expected some of: \"tangent\", \"swarm\""
        )
    );
    c.keep_planners(&["swarm, tangent".into()]).unwrap();
    assert_eq!(c.planners.len(), 2, "several, separated by commas");
    c.planners[0].label = "swarm, tangent".into();
    c.keep_planners(&["swarm, tangent".into()]).unwrap();
    assert_eq!(c.planners.len(), 1, "a label with a comma is itself");
}

#[test]
fn the_embedded_comparison_is_sound() {
    let c = Comparison::from_toml(EMBEDDED_NAME, Embedded::COMPARISON, &Embedded).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!((c.repeats, c.scenes.len(), c.planners.len()), (30, 1, 7));
}

fn labels(text: &str) -> Result<Vec<(String, String)>, String> {
    let text = format!("name = \"x\"\nscenes = [\"a.toml\"]\n{text}");
    let c = Comparison::from_toml("x.toml", &text, &Memory).map_err(|e| e.to_string())?;
    // What the resolved comparison says is read as the same planners.
    let again = Comparison::from_toml("x.toml", &c.to_toml().replace("scenes/a", "a"), &Memory).unwrap();
    assert_eq!(again.to_toml(), c.to_toml());
    Ok(c.planners.iter().map(|p| (p.label.clone(), p.group.clone())).collect())
}

#[test]
fn sweeps_and_budgets_make_labelled_variants() {
    let all = labels(
        "budget = [{ iterations = 50 }, { iterations = 100 }]\n[planner.pso]\nvelocity_limit = { sweep = [0.2, \"none\"] }\n\
         particles = { sweep = [10, 20] }\n[planner.plain]\nkind = \"tangent\"\nbudget = { time_ms = 1.5 }\n\
         [planner.pso-qp]\nqp = { solver = { sweep = [\"structured\", \"clarabel\"] } }\nbudget = [{ iterations = 9 }]",
    )
    .unwrap();
    let shown: Vec<&str> = all.iter().map(|(label, _)| label.as_str()).collect();
    assert_eq!(
        shown,
        [
            "pso[velocity_limit=0.2, particles=10, 50 iterations]",
            "pso[velocity_limit=0.2, particles=10, 100 iterations]",
            "pso[velocity_limit=0.2, particles=20, 50 iterations]",
            "pso[velocity_limit=0.2, particles=20, 100 iterations]",
            "pso[velocity_limit=none, particles=10, 50 iterations]",
            "pso[velocity_limit=none, particles=10, 100 iterations]",
            "pso[velocity_limit=none, particles=20, 50 iterations]",
            "pso[velocity_limit=none, particles=20, 100 iterations]",
            "plain[50 iterations, 1.5 ms]",
            "plain[100 iterations, 1.5 ms]",
            "pso-qp[qp.solver=structured]",
            "pso-qp[qp.solver=clarabel]",
        ]
    );
    assert!(all[..8].iter().all(|(_, group)| group == "pso"));
    for (text, part) in [
        ("[planner.pso]\nparticles = { sweep = [] }", "expected an array of one value or more"),
        ("[planner.pso]\nparticles = { sweep = [1], x = 2 }", "x beside sweep"),
        ("[planner.pso]\nparticles = { sweep = [10, 0] }", "x.toml:4:28: particles = 0"),
        ("[planner.pso]\nparticles = { sweep = [10, 10] }", "a second planner labelled \"pso[particles=10]\""),
        ("budget = []\n[planner.pso]", "no budget"),
        ("budget = [{ iterations = 5 }, { iterations = 5 }]\n[planner.pso]", "a second budget of 5 iterations"),
    ] {
        let error = labels(text).unwrap_err();
        assert!(error.contains(part), "{text}: {error}");
    }
}

#[test]
fn external_planners_and_limits() {
    let ours = "[planner.mine]\nkind = \"external\"\ncommand = [\"python3\", \"p.py\"]\nmemory_mb = 64\nhard_limit_ms = 2.5\n\
                gain = 3\ngroup = 1\nvaried = 2\n[planner.pso]\nmemory_mb = 10\n[planner.tangent]";
    let c = Comparison::from_toml("x.toml", &format!("name = \"x\"\nscenes = [\"a.toml\"]\n{ours}"), &Memory).unwrap();
    let isolated: Vec<bool> = c.planners.iter().map(PlannerEntry::isolated).collect();
    assert_eq!(isolated, [true, true, false]);
    assert_eq!(c.planners[0].limits, Limits { hard_limit_ms: Some(2.5), memory_mb: Some(64) });
    assert_eq!(c.planners[0].hard_limit().as_secs_f64(), 0.0025);
    assert_eq!(c.planners[1].hard_limit().as_secs_f64(), 60.0, "a minute without a time budget");
    let settings: Vec<&str> = c.planners[0].settings.keys().map(String::as_str).collect();
    assert_eq!(settings, ["gain", "group", "varied"], "all others are its own");
    assert!(labels(ours).is_ok());
    for (text, part) in [
        ("kind = \"external\"", "without command"),
        ("kind = \"external\"\ncommand = []", "expected command ="),
        ("kind = \"external\"\ncommand = [1]", "found integer; expected text"),
        ("kind = \"external\"\ncommand = [\"a\"]\nrefine = [\"qp\"]", "refine in an external"),
        ("kind = \"pso\"\ncommand = [\"a\"]", "expected kind = \"external\""),
        ("kind = \"pso\"\nvariant = \"x\"", "found string; expected variant = { of = "),
        ("kind = \"pso\"\nvariant = { of = \"x\" }", "expected variant = { of = "),
        ("kind = \"pso\"\nvariant = { of = \"x\", by = 1 }", "found integer; expected text"),
        ("kind = \"pso\"\nvariant = { of = \"x\", by = \"y\", z = 1 }", "expected variant = { of = "),
        ("kind = \"pso\"\nmemory_mb = 0", "memory_mb: expected mebibytes"),
        ("kind = \"pso\"\nhard_limit_ms = \"x\"", "hard_limit_ms: expected milliseconds"),
    ] {
        let error = labels(&format!("[planner.a]\n{text}")).unwrap_err();
        assert!(error.contains(part), "{text}: {error}");
    }
}

#[test]
fn the_folder_of_an_external_planner_is_said_but_no_part_of_identity() {
    let read = |keys: &str| {
        let planner = format!("[planner.mine]\nkind = \"external\"\ncommand = [\"./p\"]\n{keys}");
        Comparison::from_toml("x.toml", &format!("name = \"x\"\nscenes = [\"a.toml\"]\n{planner}"), &Memory)
    };
    let folder = |c: &Comparison| match &c.planners[0].maker {
        Maker::External(external) => external.folder.clone(),
        _ => unreachable!("it is external"),
    };
    let [usual, own, far] = ["", "folder = \"own\"", "folder = \"/far\""].map(|keys| read(keys).unwrap());
    let here = std::env::current_dir().unwrap();
    assert_eq!([folder(&usual), folder(&own), folder(&far)], [here.clone(), here.join("own"), "/far".into()]);
    assert!(own.to_toml().contains(&format!("folder = \"{}\"", here.join("own").display())), "{}", own.to_toml());
    assert!(own.planners[0].settings.is_empty());
    assert_eq!(usual.portable_toml(), far.portable_toml());
    assert_ne!(usual.to_toml(), far.to_toml());
    assert!(read("folder = 1").err().unwrap().to_string().contains("x.toml:6:10: found integer; expected text"));
}

#[test]
fn tuning_scenes_stay_apart() {
    let read =
        |scenes: &str| Comparison::from_toml("x.toml", &format!("name = \"x\"\n{scenes}\n[planner.pso]"), &Memory);
    let c = read("scenes = [\"a.toml\"]\ntuning = [{ generate = \"wall\", count = 2 }]").unwrap();
    let sets: Vec<SceneSet> = c.scenes.iter().map(|s| s.set).collect();
    assert_eq!(sets, [SceneSet::Test, SceneSet::Tuning, SceneSet::Tuning]);
    assert!(c.to_toml().contains("tuning = [\n    \"scenes/wall-s1-00.toml\","), "{}", c.to_toml());
    let error = read("scenes = [\"a.toml\"]\ntuning = [\"b.toml\"]").err().unwrap().to_string();
    assert!(error.contains("\"b\" of the tuning set is \"a\" of the test set under another name"), "{error}");
}

const MOVING: &str = r#"name = "moving"
scenes = [{ play = "circle-swap" }, { play = "crossing", opponents = 3, name = "busy" }]
[simulation]
robots = 4
swap = [{ at_s = 1.0, planner = "tangent" }]
[planner.straight-line]
budget = { time_ms = 2.0 }
[planner.swarm]
kind = "pso"
particles = { sweep = [5, 10] }
"#;

#[test]
fn moving_scenes_take_common_keys_and_names() {
    let c = read(MOVING).unwrap();
    assert_eq!(c.subject, Subject::Simulation);
    let scene = |i: usize| (c.scenes[i].scene.name.as_str(), c.scenes[i].simulation.clone().unwrap());
    let ((first, a), (second, b)) = (scene(0), scene(1));
    assert_eq!((first, a.robots, a.opponents, second, b.robots, b.opponents), ("circle-swap-4", 4, 0, "busy", 4, 3));
    assert_eq!(a.swap[0].planner, "tangent");
    let labels: Vec<_> = c.planners.iter().map(|p| p.label.as_str()).collect();
    assert_eq!(labels, ["straight-line", "swarm[particles=5]", "swarm[particles=10]"]);
    let again =
        Comparison::from_toml("again", &c.to_toml(), &Memory).unwrap_or_else(|e| panic!("{e}\n{}", c.to_toml()));
    assert_eq!((again.to_toml(), &again.scenes), (c.to_toml(), &c.scenes));
    let alone = "name = \"x\"\n[simulation]\nplay = \"crossing\"\nopponents = 2\n[planner.tangent]";
    assert_eq!(read(alone).unwrap().scenes[0].scene.name, "crossing-8v2");
}

#[test]
fn mistakes_in_moving_scenes_are_named_with_their_place() {
    let cases = [
        (
            "{ play = \"circle-swap\" }",
            "{ play = \"circle\" }",
            "c.toml:2:20: unknown variant `circle`, expected one of",
        ),
        ("{ play = \"circle-swap\" }", "{}", "c.toml:2:11: a scene without play; expected a moving scene such as"),
        ("{ play = \"circle-swap\" }", "\"a.toml\"", "c.toml:2:11: found string; expected a moving scene such as"),
        ("opponents = 3", "opponents = 30", "c.toml:2:70: opponents = 30; expected 0 to 16"),
        ("opponents = 3", "oponents = 3", "c.toml:2:58: unknown field `oponents`"),
        ("\"busy\"", "\"../x\"", "c.toml:2:80: name: expected text of letters"),
        ("\"busy\"", "\"circle-swap-4\"", "c.toml:2:37: a second scene named \"circle-swap-4\""),
        ("robots = 4", "robots = 0", "c.toml:4:10: robots = 0; expected 1 to 16"),
        ("at_s = 1.0", "at_s = -1.0", "c.toml:5:8: swap.at_s = -1"),
        ("planner = \"tangent\"", "planner = \"tangents\"", "c.toml:5:33: planner \"tangents\": unknown planner"),
        ("[planner.straight-line]", "[planner.straight]", "c.toml:6:10: unknown planner \"straight\"; expected one of"),
        (
            "time_ms = 2.0 }",
            "time_ms = 2.0 }\nmemory_mb = 5",
            "c.toml:8:1: memory_mb: expected a planner of the catalogue",
        ),
        (
            "kind = \"pso\"",
            "kind = \"external\"",
            "c.toml:9:8: an external planner; expected a planner of the catalogue",
        ),
        ("particles = {", "particle = {", "unknown field `particle`"),
    ];
    for (from, to, expected) in cases {
        assert!(MOVING.contains(from), "{from}");
        let error = read(&MOVING.replacen(from, to, 1)).err().unwrap_or_default();
        assert!(error.contains(expected), "{to}:\n{error}\nexpected: {expected}");
    }
    let still = GOOD.replace("[planner.tangent]", "[planner.behaviour]");
    let error = read(&still).err().unwrap();
    assert!(error.contains("c.toml:7:10: \"behaviour\" moves a robot among what moves, and plans no path"), "{error}");
}

#[test]
fn mistakes_in_behaviour_are_named_with_their_place() {
    let good =
        "name = \"b\"\n[behaviour]\nrobots = 3\n[planner.tuned]\nkind = \"behaviour\"\ntune = { population = 5 }\n";
    let c = read(good).unwrap();
    assert_eq!((c.subject, c.protocol.as_ref().unwrap().robots), (Subject::Behaviour, 3));
    assert_eq!(Comparison::from_toml("again", &c.to_toml(), &Memory).unwrap().to_toml(), c.to_toml());
    let cases = [
        ("robots = 3", "robots = 30", "c.toml:3:10: robots = 30; expected 1 to 16"),
        ("robots = 3", "robot = 3", "c.toml:3:1: unknown field `robot`"),
        ("kind = \"behaviour\"", "kind = \"orca\"", "c.toml:5:8: planner \"orca\" beside a table [behaviour]"),
        ("population = 5", "population = 1", "c.toml:6:23: population = 1; expected 2 to 1000"),
        ("tune =", "tunes =", "c.toml:6:1: unknown field `tunes`"),
        ("tune = {", "parameters = {}\ntune = {", "c.toml:6:14: parameters beside tune"),
        ("[behaviour]", "scenes = [\"a.toml\"]\n[behaviour]", "c.toml:2:10: scenes beside [behaviour]"),
        ("[behaviour]", "[simulation]\n[behaviour]", "c.toml:3:1: [behaviour] beside [simulation]"),
    ];
    for (from, to, expected) in cases {
        let error = read(&good.replacen(from, to, 1)).err().unwrap_or_default();
        assert!(error.contains(expected), "{to}:\n{error}\nexpected: {expected}");
    }
}
