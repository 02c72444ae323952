//! Campaigns in parts, and what becomes of them when they are joined.

mod common;

use common::{COMPARISON, Place, furnished, timeless};

const TWO: &str = "name = \"two\"\nrepeats = 4\nscenes = [\"one.toml\", { generate = \"open\", count = 2 }]
tuning = [{ generate = \"wall\", count = 1 }]\n
[planner.straight-line]\n[planner.pso]\niterations = { sweep = [10, 20] }\n[planner.tangent]\n";

fn parts(name: &str) -> Place {
    let place = furnished(name);
    place.write("two.toml", TWO);
    place
}

#[test]
fn three_parts_are_one_run() {
    let place = parts("three");
    place.ok(&["run", "two.toml", "--out", "whole", "--quiet"]);
    for (shard, jobs) in [("1/3", "1"), ("2/3", "2"), ("3/3", "1")] {
        place.ok(&["run", "two.toml", "--shard", shard, "--jobs", jobs, "--quiet"]);
    }
    let folder = |i: u32| format!("results/two-shard-{i}-of-3");
    let folders = [folder(3), folder(1), folder(2)];
    // 4 scenes × 4 repeats are 16 units: 6, 5 and 5, of four runs each.
    let rows = [3, 1, 2].map(|i| place.read(&format!("{}/runs.csv", folder(i))).lines().count() - 1);
    assert_eq!(rows, [20, 24, 20]);
    let report = place.read(&format!("{}/report.html", folder(2)));
    assert!(report.contains("This is part 2&#x2f;3 of a campaign"), "the report says that it is a part");
    let status = place.ok(&["status", &folder(1)]);
    assert!(
        status.contains("two, part 1/3 (identity ") && status.contains("24 of 24 runs are there, 0 missing"),
        "{status}"
    );

    let printed = place.ok(&["merge", &folders[0], &folders[1], &folders[2], "--out", "all"]);
    assert!(printed.contains("two: 64 of 64 runs from 3 folders"), "{printed}");
    assert_eq!(timeless(&place.read("all/runs.csv")), timeless(&place.read("whole/runs.csv")));
    for file in ["paths.jsonl", "comparison.toml", "scenes/one.toml"] {
        assert_eq!(place.read(&format!("all/{file}")), place.read(&format!("whole/{file}")), "{file}");
    }
    let pictures =
        |folder: &str| place.read(&format!("{folder}/report.html")).matches("<figure class=\"own\">").count();
    assert!(pictures("whole") > 0 && pictures("all") == pictures("whole"));
    let manifest: serde_json::Value = serde_json::from_str(&place.read("all/manifest.json")).unwrap();
    let shards: Vec<_> = manifest["shards"].as_array().unwrap().iter().map(|s| s["shard"].clone()).collect();
    assert_eq!(shards, ["1/3", "2/3", "3/3"]);
    assert_eq!((&manifest["jobs"], &manifest["runs"]), (&2.into(), &64.into()));
    let whole: serde_json::Value = serde_json::from_str(&place.read("whole/manifest.json")).unwrap();
    assert_eq!(manifest["identity"], whole["identity"]);
    assert!(place.ok(&["run", "two.toml", "--out", "all", "--resume"]).contains("Nothing is missing"));
}

#[test]
fn parts_that_do_not_fit_are_named() {
    let place = parts("misfits");
    let run = |shard: &str, out: &str, more: &[&str]| {
        place.ok(&[&["run", "small.toml", "--shard", shard, "--out", out, "--quiet"], more].concat());
    };
    run("1/2", "a", &[]);
    run("1/3", "b", &[]);
    run("2/2", "c", &["--seed", "2"]);
    let overlap = "a (part 1/2) and b (part 1/3) overlap: both hold the run of planner";
    place.refused(&["merge", "a", "b", "--out", "all"], overlap);
    place.refused(&["merge", "a", "a", "--out", "all"], "a (part 1/2) and a (part 1/2) overlap");
    place.refused(&["merge", "a", "c", "--out", "all"], "c: not of the campaign of a: seed 2 instead of 1");
    place.refused(&["merge", "a", "nowhere", "--out", "all"], "nowhere/runs.db: no such file");
    place.refused(&["merge", "a", "--out", "b"], "b: holds a finished campaign");
    place.refused(&["run", "small.toml", "--shard", "3/2"], "expected I/N with 1 ≤ I ≤ N");
    place.refused(&["run", "small.toml", "--out", "a", "--resume", "--shard", "2/2"], "holds part 1/2 of the campaign");
}

#[test]
fn what_parts_lack_can_be_made() {
    let place = parts("lacking");
    place.ok(&["run", "small.toml", "--out", "whole", "--quiet"]);
    for shard in ["1/3", "2/3"] {
        let dry = place.ok(&["run", "small.toml", "--shard", shard, "--dry-run"]);
        assert!(dry.contains(&format!("Part {shard}: 3 of these runs.")), "{dry}");
        assert!(dry.contains(&format!("Would write to results/small-shard-{}-of-3;", &shard[..1])), "{dry}");
        place.ok(&["run", "small.toml", "--shard", shard, "--out", &shard[..1], "--quiet"]);
    }
    let printed = place.ok(&["merge", "2", "1", "--out", "all"]);
    assert!(printed.contains("small: 6 of 9 runs from 2 folders"), "{printed}");
    assert!(printed.contains("missing: 3 runs of part 3/3, which was not given"), "{printed}");
    let status = place.ok(&["status", "all"]);
    assert!(status.contains("6 of 9 runs are there, 3 missing"), "{status}");
    place.ok(&["run", "--out", "all", "--resume", "--quiet"]);
    assert_eq!(timeless(&place.read("all/runs.csv")), timeless(&place.read("whole/runs.csv")));
    assert!(COMPARISON.contains("repeats = 3"), "one repeat a part");
}
