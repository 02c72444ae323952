//! Comparisons of moving scenes and of behaviour control, from the file to what they leave.

mod common;

use common::{Place, timeless};

/// Twelve runs of a second or less.
const MOVING: &str = "name = \"moving\"\nrepeats = 3\nscenes = [{ robots = 2 }, { robots = 3, name = \"three\" }]
[simulation]\nplay = \"circle-swap\"\nduration_s = 1.5\nframe_rate = 20.0\n
[planner.straight-line]\n[planner.swarm]\nkind = \"pso\"\nparticles = 5\nbudget = { iterations = 2 }\n";

/// Six runs, of which three tune.
const BEHAVIOUR: &str = "name = \"tuned\"\nrepeats = 3\n[behaviour]\nrobots = 2\nsteps = 20\nheld_out = 4\n
[planner.published]\nkind = \"behaviour\"\n[planner.tuned]\nkind = \"behaviour\"
tune = { population = 4, generations = 2 }\n";

fn place(name: &str) -> Place {
    let place = Place::new(name);
    place.write("moving.toml", MOVING);
    place.write("tuned.toml", BEHAVIOUR);
    place
}

/// `simulations.csv` up to the columns of times.
fn repeatable(csv: &str) -> String {
    let first_time = csv.lines().next().unwrap().split(',').position(|h| h == "call_p50_us").unwrap();
    let row = |line: &str| line.split(',').take(first_time).collect::<Vec<_>>().join(",") + "\n";
    csv.lines().map(row).collect()
}

/// That two campaigns left the same but for times.
fn same(place: &Place, a: &str, b: &str) {
    let read = |folder: &str, file: &str| place.read(&format!("{folder}/{file}"));
    assert_eq!(timeless(&read(a, "runs.csv")), timeless(&read(b, "runs.csv")));
    assert_eq!(repeatable(&read(a, "simulations.csv")), repeatable(&read(b, "simulations.csv")));
    for file in ["traces.jsonl", "comparison.toml"] {
        assert_eq!(read(a, file), read(b, file), "{file}");
    }
}

/// Leaves `runs` runs of the campaign in `folder`, as if it had been killed then.
fn interrupt(place: &Place, folder: &str, runs: u32) {
    let db = rusqlite::Connection::open(place.0.join(folder).join("runs.db")).unwrap();
    let later = "DELETE FROM run WHERE (scene, planner, repeat) IN
        (SELECT scene, planner, repeat FROM run ORDER BY repeat, planner, scene LIMIT -1 OFFSET ?1)";
    assert!(db.execute(later, [runs]).unwrap() > 0);
    db.execute_batch("DELETE FROM trace; UPDATE campaign SET manifest = json_set(manifest, '$.finished', '')").unwrap();
}

#[test]
fn jobs_shards_and_interruptions_change_nothing_but_times() {
    let place = place("moving");
    let printed = place.ok(&["run", "moving.toml", "--out", "whole"]);
    assert!(printed.contains("at most 18 s are simulated"), "{printed}");
    assert!(printed.contains("over bound") && printed.contains("three (m; moving)"), "{printed}");
    place.ok(&["run", "moving.toml", "--out", "two-jobs", "--jobs", "2", "--quiet"]);
    same(&place, "whole", "two-jobs");

    interrupt(&place, "two-jobs", 5);
    let status = place.ok(&["status", "two-jobs"]);
    assert!(status.contains("5 of 12 runs are there, 7 missing"), "{status}");
    place.ok(&["run", "--out", "two-jobs", "--resume", "--quiet"]);
    same(&place, "whole", "two-jobs");

    for shard in ["1/2", "2/2"] {
        place.ok(&["run", "moving.toml", "--shard", shard, "--quiet"]);
    }
    place.ok(&["merge", "results/moving-shard-1-of-2", "results/moving-shard-2-of-2", "--out", "merged"]);
    same(&place, "whole", "merged");

    // The resolved comparison says everything.
    place.ok(&["run", "whole/comparison.toml", "--out", "again", "--quiet"]);
    same(&place, "whole", "again");
    let (code, printed, _) = place.told(&["compare", "whole", "again", "--fail-on", "changed"]);
    assert_eq!(code, 0, "{printed}");

    let csv = place.read("whole/simulations.csv");
    insta::assert_snapshot!("simulation_columns", csv.lines().next().unwrap());
    let mut reader = csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(|row| row.unwrap()).collect();
    assert_eq!(rows.len(), 12);
    let runs = place.read("whole/runs.csv");
    for (row, run) in rows.iter().zip(csv::Reader::from_reader(runs.as_bytes()).records()) {
        let run = run.unwrap();
        assert_eq!(row[5], run[5], "clean is what runs.csv calls valid");
        assert_eq!(row[10], run[6], "its length is the time of arrival");
        assert!(run[7].is_empty() && (run[8].is_empty() || &run[5] == "true"), "no optimum; a gap only when clean");
    }
    let traces = place.read("whole/traces.jsonl");
    let trace: serde_json::Value = serde_json::from_str(traces.lines().next().unwrap()).unwrap();
    assert_eq!((&trace["faithful"], &trace["trace"]["bodies"][0]["side"]), (&true.into(), &"own".into()));
    place.ok(&["report", "whole", "--format", "json"]);
    let document: serde_json::Value = serde_json::from_str(&place.read("whole/results.json")).unwrap();
    assert_eq!(document["subject"], "simulation");
    assert_eq!(document["scenes"][1]["simulation"]["robots"], 3);
    assert_eq!(
        document["runs"][0]["moving"]["metrics"]["robots"],
        3.min(document["runs"][0]["moving"]["robots"].as_array().unwrap().len())
    );
}

#[test]
fn another_scene_is_another_campaign() {
    let place = place("moving-other");
    place.ok(&["run", "moving.toml", "--out", "out", "--repeats", "1", "--quiet"]);
    place.write("moving.toml", &MOVING.replace("1.5", "1.0"));
    let args = ["run", "moving.toml", "--out", "out", "--repeats", "1", "--resume"];
    let (code, _, error) = place.told(&args);
    assert!(code == 2 && error.contains("another content of scene circle-swap-2"), "{error}");
    place.refused(&["run", "moving.toml", "--isolate"], "--isolate: what moves runs in the bench's own process");
}

#[test]
fn parameters_are_tuned_and_judged() {
    let place = place("tuned");
    let printed = place.ok(&["run", "tuned.toml", "--out", "whole"]);
    assert!(printed.contains("held-out fitness"), "{printed}");
    place.ok(&["run", "tuned.toml", "--out", "two-jobs", "--jobs", "2", "--quiet"]);
    place.ok(&["run", "whole/comparison.toml", "--out", "again", "--quiet"]);
    for other in ["two-jobs", "again"] {
        for file in ["tuning.csv", "parameters.csv", "comparison.toml"] {
            assert_eq!(place.read(&format!("whole/{file}")), place.read(&format!("{other}/{file}")), "{file}");
        }
    }
    // Three generations of each of three searches.
    assert_eq!(place.read("whole/tuning.csv").lines().count(), 1 + 9);
    let parameters = place.read("whole/parameters.csv");
    assert!(
        parameters.starts_with("planner,repeat,seed,training,held_out,arrived,collided,goal_gain,"),
        "{parameters}"
    );
    let runs = place.read("whole/runs.csv");
    let rows = csv::Reader::from_reader(runs.as_bytes()).into_records().map(|row| row.unwrap());
    let losses = rows.map(|row| 1.0 - row[6].parse::<f64>().unwrap());
    let judged = csv::Reader::from_reader(parameters.as_bytes())
        .into_records()
        .map(|row| row.unwrap()[4].parse::<f64>().unwrap());
    for (a, b) in losses.zip(judged.collect::<Vec<_>>()) {
        assert!((a - b).abs() < 1e-15, "1 - (1 - fitness), two roundings: {a} {b}");
    }
}
