//! The command line as its users meet it: exit codes, messages, files.

mod common;

use std::fs;
use std::process::{Command, Output};

use common::{COMPARISON, Place, furnished, text, timeless};

#[test]
fn scenes_from_a_log_outlive_it() {
    let place = Place::new("log");
    place.write("game.rcg", "ULG6\n(show 7 ((b) 1 2 0 0) ((l 2) 1 0x1 0 2 0 0 0 0) ((r 2) 1 0x1 0.5 2 0 0 0 0))\n");
    let source = "{ rcg = \"game.rcg\", cycles = [7], side = \"left\" }";
    place.write("log.toml", &COMPARISON.replace("\"one.toml\"", source));
    let output = place.run(&["check", "log.toml"]);
    let note = "note: game-c0007-left: opponent 2 overlaps the start by 0.100000: radius 0.200000 instead of 0.3\n";
    assert_eq!(text(&output.stderr), note);
    place.ok(&["run", "log.toml", "--out", "out", "--quiet"]);
    let note = "game-c0007-left: opponent 2 overlaps the start by 0.100000: radius 0.200000 instead of 0.3";
    assert!(place.read("out/manifest.json").contains(note) && place.read("out/report.html").contains(note));
    fs::remove_file(place.0.join("game.rcg")).unwrap();
    place.ok(&["run", "out/comparison.toml", "--out", "again", "--quiet"]);
    assert_eq!(timeless(&place.read("again/runs.csv")), timeless(&place.read("out/runs.csv")));
}

#[test]
fn a_campaign_leaves_everything_and_can_be_made_again() {
    let place = furnished("campaign");
    let printed = place.ok(&["run", "small.toml", "--out", "out"]);
    assert!(printed.contains("small: 3 planners × 1 scene × 3 repeats = 9 runs, seed 1, 1 job"), "{printed}");
    assert!(printed.contains("straight-line") && printed.contains("0/3") && printed.contains('∞'), "{printed}");
    for file in ["runs.db", "runs.csv", "summary.csv", "paths.jsonl", "report.html", "comparison.toml", "manifest.json"]
    {
        assert!(!fs::read(place.0.join("out").join(file)).unwrap().is_empty(), "{file}");
    }
    assert!(!place.files().iter().any(|f| f.ends_with("-wal") || f.ends_with("probe")), "{:?}", place.files());
    let runs = place.read("out/runs.csv");
    assert_eq!(runs.lines().count(), 10);

    // The resolved comparison gives the same runs, and so does another number of jobs.
    place.ok(&["out/comparison.toml", "--out", "again", "--jobs", "2", "--quiet"]);
    assert_eq!(timeless(&place.read("again/runs.csv")), timeless(&runs));
    assert_eq!(place.read("again/comparison.toml"), place.read("out/comparison.toml"));
    assert_eq!(place.read("again/paths.jsonl"), place.read("out/paths.jsonl"));

    // Every export comes from the stored runs alone.
    let report = place.read("out/report.html");
    for file in ["runs.csv", "report.html", "paths.jsonl", "summary.csv", "manifest.json", "comparison.toml"] {
        fs::remove_file(place.0.join("out").join(file)).unwrap();
    }
    place.ok(&["report", "out"]);
    assert_eq!(place.read("out/runs.csv"), runs);
    assert_eq!(place.read("out/report.html"), report);
    place.ok(&["report", "out", "--format", "html", "--language", "zh"]);
    assert_ne!(place.read("out/report.html"), report);

    // A run can be replayed from its seed.
    let row = runs.lines().find(|l| l.starts_with("one,pso,2,")).unwrap();
    let cells: Vec<&str> = row.split(',').collect();
    let json =
        place.ok(&["plan", "one.toml", "--planner", "pso", "--set", "iterations=20", "--seed", cells[3], "--json"]);
    let replay: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(replay["length"].to_string(), cells[6]);
    assert_eq!(replay["cost"].to_string(), cells[17]);

    // The swarm's own picture and the exact planner's tree come from replays; the others show no state.
    assert_eq!(report.matches("<figure class=\"own\">").count(), 2);
    assert!(report.contains("from an untimed replay of repeat"));

    place.refused(&["run", "small.toml", "--out", "out"], "holds a finished campaign, \"small\"");
    place.refused(&["run", "small.toml", "--out", "."], "holds other files; expected a new or empty folder");
}

#[test]
fn default_folders_are_numbered() {
    let place = furnished("numbered");
    for _ in 0..2 {
        place.ok(&["small.toml", "--repeats", "1", "--planner", "tangent", "--quiet"]);
    }
    assert!(place.files().contains(&"results/small/runs.csv".into()));
    assert!(place.files().contains(&"results/small-2/runs.csv".into()));
    assert_eq!(place.read("results/small/runs.csv").lines().count(), 2, "one planner, one repeat");
}

#[test]
fn campaigns_begun_at_once_do_not_meet() {
    let place = furnished("at-once");
    fs::create_dir(place.0.join("there")).unwrap();
    let start = |out: Option<&str>| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
        command.args(["run", "small.toml", "--quiet"]).current_dir(&place.0);
        out.map(|out| command.args(["--out", out]));
        let piped = std::process::Stdio::piped;
        command.stdout(piped()).stderr(piped()).spawn().unwrap()
    };
    let begun: Vec<_> = (0..6).map(|_| start(None)).collect();
    for child in begun {
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{}", text(&output.stderr));
    }
    let mut folders: Vec<_> = (2..=6).map(|n| format!("results/small-{n}")).collect();
    folders.insert(0, "results/small".to_owned());
    // Once in a new folder with new parents, once in one that was there, empty.
    for out in ["new/deep/same", "there"] {
        let begun: Vec<_> = (0..3).map(|_| start(Some(out))).collect();
        let outputs: Vec<Output> = begun.into_iter().map(|child| child.wait_with_output().unwrap()).collect();
        let errors: Vec<String> = outputs.iter().map(|o| text(&o.stderr)).collect();
        assert_eq!(outputs.iter().filter(|o| o.status.success()).count(), 1, "{errors:?}");
        for (output, error) in outputs.iter().zip(&errors).filter(|(o, _)| !o.status.success()) {
            assert_eq!(output.status.code(), Some(2), "{error}");
            assert!(error.contains("expected a new or empty folder"), "{error}");
        }
        folders.push(out.to_owned());
    }
    for folder in folders {
        assert_eq!(place.read(&format!("{folder}/runs.csv")).lines().count(), 10, "{folder}");
        assert!(place.read(&format!("{folder}/report.html")).ends_with("</html>"), "{folder}");
    }
}

#[test]
fn only_what_is_asked_for_fails() {
    let place = furnished("fail-on");
    let code = |args: &[&str]| place.run(args).status.code();
    assert_eq!(code(&["run", "small.toml", "--out", "a", "--quiet", "--fail-on", "error"]), Some(0));
    assert_eq!(code(&["run", "small.toml", "--out", "b", "--quiet", "--fail-on", "invalid"]), Some(1));
    let valid = ["run", "small.toml", "--out", "c", "--quiet", "--fail-on", "invalid", "--planner", "tangent"];
    assert_eq!(code(&valid), Some(0));
    assert!(place.run(&["run", "small.toml", "--out", "d", "--quiet"]).stdout.is_empty(), "quiet");
    let before = place.files();
    assert_eq!(place.ok(&["run", "small.toml", "--dry-run", "--quiet"]), "");
    assert!(place.ok(&["run", "small.toml", "--dry-run"]).contains("= 9 runs"));
    assert_eq!(place.files(), before, "a dry run writes nothing");
}

#[test]
fn bad_input_is_refused_and_nothing_written() {
    let place = furnished("refused");
    let cases = [
        ("one.toml", "radius = 1.0", "radius = -1.0", "one.toml:7:40: obstacle 0 radius is -1"),
        ("one.toml", "radius = 1.0", "radius = nan", "one.toml:7:40: obstacle 0 radius is NaN"),
        ("one.toml", "[0.0, 0.0]", "[0.0, inf]", "one.toml:3:9: start is inf"),
        ("one.toml", "[0.0, 0.0]", "[5.0, 0.0]", "one.toml:3:9: start (5.000, 0.000) is 0.5000 inside obstacle 0"),
        ("one.toml", "[0.0, 0.0]", "[10.0, 0.0]", "one.toml:3:9: start and goal are the same point"),
        (
            "one.toml",
            "disc = { centre = [5.0, 0.5], radius = 1.0 }",
            "polygon = [[1, 1], [2, 2], [2, 1], [1, 2]]",
            "sides 0 and 2 (counted from 0) cross or touch",
        ),
        ("small.toml", "repeats = 3", "repeats = 0", "small.toml:2:11: repeats = 0"),
        ("small.toml", "repeats = 3", "repeats = ", "small.toml:2:11: "),
        ("small.toml", "repeats = 3", "repeat = 3", "small.toml:2:1: unknown field `repeat`"),
        ("small.toml", "repeats = 3", "repeats = \"3\"", "small.toml:2:11: invalid type: string"),
        ("small.toml", "\"one.toml\"", "\"two.toml\"", "small.toml:3:11: cannot read two.toml"),
        ("small.toml", "\"one.toml\"", "\"one.toml\", \"one.toml\"", "small.toml:3:23: a second scene named \"one\""),
        ("small.toml", "planner.pso", "planner.psso", "small.toml:6:10: unknown planner \"psso\""),
        ("small.toml", "iterations = 20", "particles = 0", "small.toml:7:13: particles = 0; expected"),
        ("small.toml", "iterations = 20", "columns = 0", "small.toml:7:11: columns = 0; expected"),
    ];
    for (file, from, to, message) in cases {
        let good = place.read(file);
        assert!(good.contains(from), "{from}");
        place.write(file, &good.replacen(from, to, 1));
        place.refused(&["run", "small.toml", "--out", "out"], message);
        place.refused(&["check", "small.toml"], message);
        place.write(file, &good);
    }
    place.ok(&["check", "small.toml", "one.toml"]);
    place.write("empty.toml", "name = \"empty\"\nscenes = [\"one.toml\"]\n");
    place.refused(&["run", "empty.toml"], "empty.toml:1:1: an empty comparison: no planner");
    place.refused(&["run", "nowhere.toml"], "cannot read nowhere.toml");
    place.refused(&["run", "small.toml", "--planner", "pzo"], "no such label in comparison small");
    place.refused(&["run", "small.toml", "--repeats", "0"], "--repeats");
    place.refused(&["run", "small.toml", "--jobs", "0"], "--jobs");
    place.refused(&["run", "small.toml", "--out", "one.toml"], "one.toml");
    place.refused(&["run", "small.toml", "--out", "one.toml/deeper"], "one.toml/deeper");
    place.refused(&["report", "nowhere"], "no such file; expected the folder of a campaign");
    place.write("runs.db", "not a database, but long enough to look at, and then some");
    place.refused(&["report", "."], "runs.db");
    place.refused(&["plan", "one.toml", "--planner", "psso"], "unknown planner \"psso\"");
    place.refused(&["plan", "one.toml", "--planner", "pso", "--set", "particles=0"], "particles = 0; expected");
    place.refused(&["plan", "one.toml", "--planner", "pso", "--set", "particles"], "expected KEY=VALUE");
}

#[test]
fn an_external_planner_needs_a_command() {
    let place = furnished("external");
    place.write("external.toml", "name = \"e\"\nscenes = [\"one.toml\"]\n[planner.mine]\nkind = \"external\"");
    place.refused(&["run", "external.toml"], "external.toml:4:8: an external planner without command");
}

/// A device that is always full stands for a disk that is.
#[cfg(target_os = "linux")]
#[test]
fn who_does_not_listen_does_not_stop_a_campaign() {
    let place = furnished("deaf");
    place.write("deaf.toml", "name = \"e\"\nscenes = [\"one.toml\"]\nrepeats = 1\n[planner.mine]\nkind = \"external\"\ncommand = [\"false\"]");
    let code = |args: &[&str]| {
        let full = || fs::File::options().write(true).open("/dev/full").unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_touchline"));
        command.args(args).current_dir(&place.0).stdout(full()).stderr(full());
        command.status().unwrap().code()
    };
    // It warns of runs that ended in errors.
    assert_eq!(code(&["run", "deaf.toml", "--out", "out"]), Some(0));
    assert_eq!(place.read("out/runs.csv").lines().count(), 2);
    assert_eq!(code(&["run", "nowhere.toml"]), Some(2));
    assert_eq!(code(&["check", "nowhere.toml"]), Some(2));
}

#[test]
fn every_size_is_told_at_once() {
    let place = furnished("size");
    let said = place.ok(&["run", "small.toml", "--dry-run", "--isolate", "--repeats", "4294967295"]);
    assert!(said.contains("= 12884901885 runs") && said.contains("Time: at most about "), "{said}");
}

#[test]
fn one_plan_is_printed_drawn_and_traced() {
    let place = furnished("plan");
    let args = ["plan", "one.toml", "--planner", "pso", "--set", "particles=5", "--set", "budget.iterations=3"];
    let printed = place.ok(&[&args[..], &["--svg", "path.svg", "--trace", "trace.jsonl"]].concat());
    assert!(printed.contains("status     budget_spent") && printed.contains("3 iterations"), "{printed}");
    assert!(place.read("path.svg").starts_with("<svg") || place.read("path.svg").starts_with("<?xml"));
    let trace: Vec<serde_json::Value> =
        place.read("trace.jsonl").lines().map(|l| serde_json::from_str(l).unwrap()).collect();
    assert_eq!(trace.len(), 4, "after initialisation and each iteration");
    for (i, frame) in trace.iter().enumerate() {
        assert_eq!(frame["iteration"], i);
        assert_eq!(frame["positions"].as_array().unwrap().len(), 5);
        assert_eq!(frame["positions"][4].as_array().unwrap().len(), 20);
        assert_eq!(frame["velocities"][4].as_array().unwrap().len(), 20);
        assert_eq!(frame["x"].as_array().unwrap().len(), 20);
        assert_eq!(frame["frame"], serde_json::json!({ "origin": [0.0, 0.0], "axis": [1.0, 0.0] }));
    }
    for what in ["planners", "generators", "metrics"] {
        let rows: Vec<serde_json::Value> = serde_json::from_str(&place.ok(&["list", what, "--json"])).unwrap();
        let printed = place.ok(&["list", what]);
        // A planner's settings stand below it, indented.
        assert_eq!(printed.lines().filter(|l| !l.starts_with(' ')).count(), rows.len());
        assert!(what != "planners" || rows.iter().all(|r| r["settings"].is_object()));
    }
}
