//! What other programs read and write: OMPL's log, `IOHanalyzer`'s table, one JSON document, grid maps; and the gate
//! against regressions, on a small comparison whose counts are kept in the repository.

mod common;

use std::fs;
use std::path::{Path, PathBuf};

use common::Place;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

const MAP: &str = "type octile\nheight 5\nwidth 7\nmap\n.......\n.@@@@..\n....@..\n..T.@..\n.......\n";
/// Lengths by hand. 0: six to the right. 1: one down. 2: two down, two right below the wall (no corner cut), one
/// diagonal, one up. 3: round the tree, again without a diagonal.
const SCENARIO: &str = "version 1\n\
    0\tmaps/far/t.map\t7\t5\t0\t0\t6\t0\t6.00000000\n\
    0\tt.map\t7\t5\t3\t2\t3\t3\t1\n\
    1\tt.map\t7\t5\t3\t2\t6\t2\t6.41421356\n\
    1\tt.map\t7\t5\t2\t2\t2\t4\t4\n";
const COMPARISON: &str = "name = \"maps\"\nrepeats = 2\nscenes = [{ movingai = \"t.map.scen\" }]\n
[planner.astar]\ncells = 7\n[planner.tangent]\n";

fn furnished(name: &str) -> Place {
    let place = Place::new(name);
    place.write("t.map", MAP);
    place.write("t.map.scen", SCENARIO);
    place.write("maps.toml", COMPARISON);
    place
}

/// (scene, planner) → length, of the first repeats.
fn length(runs: &str, scene: &str, planner: &str) -> f64 {
    let mut reader = csv::Reader::from_reader(runs.as_bytes());
    let column = reader.headers().unwrap().iter().position(|h| h == "length").unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    rows.iter().find(|r| (&r[0], &r[1], &r[2]) == (scene, planner, "0")).unwrap()[column].parse().unwrap()
}

#[test]
fn the_grid_search_finds_the_lengths_of_the_scenario_and_the_optimum_is_no_longer() {
    let place = furnished("lengths");
    let (code, _, notes) = place.told(&["check", "maps.toml"]);
    assert_eq!(code, 0);
    let expected = "note: shortest octile paths by our search, all as in t.map.scen: t-p0000 6.00000000, \
                    t-p0001 1.00000000, t-p0002 6.41421356, t-p0003 4.00000000\n";
    assert_eq!(notes, expected);
    let printed = place.ok(&["check", "--optimum", "maps.toml"]);
    assert!(printed.contains("t-p0000: exact optimum 6.000000"), "{printed}");
    assert!(printed.contains("t-p0001: exact optimum 1.000000"), "{printed}");
    place.ok(&["run", "maps.toml", "--out", "out", "--quiet", "--fail-on", "invalid"]);
    let runs = place.read("out/runs.csv");
    let sqrt2 = std::f64::consts::SQRT_2;
    // The scene's corners have coordinates up to 7: sums of a dozen moves are good to 1e-14, ε is 1e-8.
    for (scene, octile) in [("t-p0000", 6.0), ("t-p0001", 1.0), ("t-p0002", 5.0 + sqrt2), ("t-p0003", 4.0)] {
        assert!((length(&runs, scene, "astar") - octile).abs() < 1e-12, "{scene}");
        assert!(length(&runs, scene, "tangent") <= octile + 1e-7, "{scene}");
    }
    assert!(place.read("out/manifest.json").contains("t-p0002 6.41421356"), "the record keeps them");
}

#[test]
fn the_map_of_the_repository_agrees_with_its_scenario() {
    let place = Place::new("hall");
    let comparison = repository().join("configs/comparisons/hall.toml");
    let (code, _, notes) = place.told(&["check", comparison.to_str().unwrap()]);
    assert!(code == 0 && notes.contains("all as in") && notes.matches("hall-p").count() == 6, "{notes}");
}

#[test]
fn problems_are_chosen_by_bucket_number_and_count() {
    let place = furnished("choice");
    let chosen = |keys: &str| {
        place.write("maps.toml", &COMPARISON.replace("\" }", &format!("\", {keys} }}")));
        let (code, _, errors) = place.told(&["check", "maps.toml"]);
        let numbers = errors.split("t-p").skip(1).map(|rest| rest[..4].parse().unwrap());
        (code, numbers.collect::<Vec<u32>>(), errors)
    };
    assert_eq!(chosen("buckets = [1]").1, [2, 3]);
    assert_eq!(chosen("problems = [3, 0]").1, [3, 0]);
    assert_eq!(chosen("count = 2").1, [0, 3]);
    assert_eq!(chosen("count = 1, buckets = [1]").1, [2]);
    for (keys, expected) in [
        ("buckets = [7]", "maps.toml:3:11: no problem in bucket 7; expected buckets up to 1"),
        ("problems = [4]", "problem 4 of 4; expected numbers from 0"),
        ("problems = [0], buckets = [0]", "both problems and buckets"),
        ("count = 0", "0 problems; expected 1 to 10000"),
        ("cuont = 2", "unknown field `cuont`"),
        ("map = \"u.map\"", "cannot read u.map"),
    ] {
        let (code, _, errors) = chosen(keys);
        assert!(code == 2 && errors.contains(expected), "{keys}: {errors}");
    }
}

#[test]
fn scenarios_that_disagree_with_the_map_are_named() {
    let place = furnished("disagree");
    place.write("t.map.scen", &SCENARIO.replace("6.41421356", "5.24264069"));
    let (code, _, notes) = place.told(&["check", "maps.toml"]);
    assert_eq!(code, 0);
    let expected = "t-p0002: the shortest octile path is 6.41421356 by our search and 5.24264069 by t.map.scen:4;";
    assert!(notes.contains(expected) && notes.contains("not all as in"), "{notes}");
    place.write("t.map.scen", &SCENARIO.replace("\t6\t0\t", "\t1\t1\t"));
    let (code, _, errors) = place.told(&["check", "maps.toml"]);
    assert!(code == 2 && errors.contains("t.map.scen:2: problem 0: goal (1, 1) is on '@'"), "{errors}");
    fs::remove_file(place.0.join("t.map")).unwrap();
    let (code, _, errors) = place.told(&["check", "maps.toml"]);
    assert!(code == 2 && errors.contains("expected the map beside the scenario"), "{errors}");
}

#[test]
fn problems_that_end_where_they_start_are_left_out() {
    let place = furnished("trivial");
    place
        .write("t.map.scen", &(SCENARIO.to_owned() + "0\tt.map\t7\t5\t3\t2\t3\t2\t0\n9\tt.map\t7\t5\t0\t0\t0\t0\t0\n"));
    let check = |keys: &str| {
        place.write("maps.toml", &COMPARISON.replace("\" }", &format!("\"{keys} }}")));
        let (code, _, errors) = place.told(&["check", "maps.toml"]);
        (code, errors)
    };
    let (code, notes) = check("");
    assert!(code == 0 && notes.contains("left out of t.map.scen, their start is their goal: problems 4, 5"), "{notes}");
    assert_eq!(notes.matches("t-p").count(), 4, "{notes}");
    let (code, notes) = check(", count = 2");
    assert!(code == 0 && notes.contains("t-p0000 6.00000000, t-p0003 4.00000000"), "{notes}");
    for (keys, expected) in [
        (", problems = [0, 4]", "t.map.scen:6: problem 4: start and goal are the same point (3.5, 2.5)"),
        (", buckets = [9]", "0 problems, besides 1 whose start is their goal; expected 1 to 10000"),
    ] {
        let (code, errors) = check(keys);
        assert!(code == 2 && errors.contains(expected), "{keys}: {errors}");
    }
}

#[test]
fn exports_are_made_when_asked_for() {
    let place = furnished("exports");
    place.ok(&["run", "maps.toml", "--out", "out", "--quiet"]);
    assert!(!place.0.join("out/ioh.csv").exists() && !place.0.join("out/results.json").exists());
    place.ok(&["report", "out", "--format", "ompl,ioh,json"]);
    assert!(place.read("out/ompl/t-p0002.log").starts_with("touchline version "));
    assert!(place.read("out/ioh.csv").starts_with("evaluations,function_value,"));
    let document: serde_json::Value = serde_json::from_str(&place.read("out/results.json")).unwrap();
    assert_eq!(document["$schema"], "results.schema.json");
    let kept = fs::read_to_string(repository().join("eval/src/export/results.schema.json")).unwrap();
    assert_eq!(place.read("out/results.schema.json"), kept);
}

#[test]
fn the_fixed_comparison_still_gives_the_committed_counts() {
    let place = Place::new("baseline");
    let baseline = repository().join("tests/baseline");
    let [comparison, runs] = ["small.toml", "runs.csv"].map(|file| baseline.join(file).display().to_string());
    place.ok(&["run", &comparison, "--out", "out", "--quiet"]);
    let (code, printed, errors) = place.told(&["compare", &runs, "out", "--fail-on", "changed"]);
    // A change that is meant: see docs/interchange.md for how to renew the baseline.
    assert_eq!(code, 0, "{printed}{errors}");
    assert!(printed.contains("are the same in every count."), "{printed}");
    let worse = fs::read_to_string(&runs).unwrap().replacen("solved,true", "solved,false", 1);
    place.write("other.csv", &worse);
    assert_eq!(place.told(&["compare", "other.csv", "out", "--fail-on", "changed"]).0, 1, "the gate closes");
    assert_eq!(place.told(&["compare", "other.csv", "out"]).0, 0, "only when asked");
    assert_eq!(place.told(&["compare", "other.csv", "nowhere"]).0, 2);
}
