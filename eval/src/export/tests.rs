use super::*;
use crate::campaign::Campaign;
use crate::config::BudgetSpec;
use crate::replay;
use crate::results::{Optimum, Progress, Results, RunRecord, RunStatus};
use crate::store::Store;
use crate::testing::{campaign, climber, detour, entry, runs_of, straight};
use env_model::Point;

fn record(planner: &str, repeat: u32) -> RunRecord {
    RunRecord {
        status: RunStatus::NotFound,
        time_us: 0.25,
        cpu_us: 1234.567,
        ..RunRecord::empty("a-scene", planner, repeat, (1 << 53) - 1)
    }
}

fn results(campaign: &Campaign) -> Results {
    let mut results = campaign.empty_results(1);
    for scene in &mut results.scenes {
        scene.optimum = Optimum { length: Some(10.1), path: vec![Point::new(0.1, 0.2)], reason: None };
    }
    results.scenes[0].optimum = Optimum { length: None, path: Vec::new(), reason: Some("a polygon".into()) };
    let good = RunRecord {
        status: RunStatus::Solved,
        valid: true,
        length: Some(10.0 + 1.0 / 3.0),
        gap: Some(1e-7),
        clearance_min: Some(-1.5e-9),
        turning: Some(0.1 + 0.2),
        evaluations: 8020,
        cost: Some(2.0 / 3.0),
        terms: vec![("length".into(), 0.1 + 0.2), ("risk".into(), 5.0)],
        path: vec![Point::new(0.0, 0.0), Point::new(0.1 + 0.2, 1e-300), Point::new(10.0, 0.0)],
        progress: vec![Progress { evaluations: 20, time_us: 0.5, cost: 1.0 / 3.0 }],
        ..record("detour", 1)
    };
    let bad =
        RunRecord { status: RunStatus::Error, error: Some("no, \"thanks\"\nreally".into()), ..record("straight", 0) };
    results.runs = vec![record("detour", 0), good, bad];
    results
}

#[test]
fn runs_csv_is_as_designed() {
    let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
    let expected = "\
scene,planner,repeat,seed,status,valid,length,optimum,gap,clearance_min,turning,iterations,evaluations,collision_checks,time_us,cpu_us,error,cost,terms,set
a-scene,detour,0,9007199254740991,not_found,false,,10.1,,,,0,0,0,0.25,1234.567,,,,test
a-scene,detour,1,9007199254740991,solved,true,10.333333333333334,10.1,0.0000001,-0.0000000015,0.30000000000000004,0,8020,0,0.25,1234.567,,0.6666666666666666,length=0.30000000000000004;risk=5,test
a-scene,straight,0,9007199254740991,error,false,,10.1,,,,0,0,0,0.25,1234.567,\"no, \"\"thanks\"\"
really\",,,test
";
    assert_eq!(runs_csv(&results(&campaign)), expected);
}

#[test]
fn summaries_count_failures_as_infinite() {
    let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
    let expected = "\
planner,scene,runs,valid,length_median,length_q1,length_q3,length_best,gap_median,time_us_median,evaluations_median,cost_median
straight,,1,0,inf,inf,inf,inf,inf,0.25,inf,
detour,,2,1,inf,inf,inf,10.333333333333334,inf,0.25,4010,inf
straight,a-scene,1,0,inf,inf,inf,inf,inf,0.25,inf,
detour,a-scene,2,1,inf,inf,inf,10.333333333333334,inf,0.25,4010,inf
";
    assert_eq!(summary_csv(&results(&campaign)), expected);
}

#[test]
fn the_store_gives_back_every_bit() {
    let folder = std::env::temp_dir().join(format!("touchline-store-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
    let mut results = results(&campaign);
    let mut store = Store::create(&folder, &campaign, &results).unwrap();
    for run in results.runs.iter().rev() {
        store.add(run).unwrap();
    }
    assert!(store.add(&results.runs[0]).is_err(), "a run is stored once");
    results.manifest.finished = "2012-07-10T00:00:00Z".into();
    store.finish(&results.manifest).unwrap();
    drop(store);
    let stored = Store::open(&folder).unwrap().read().unwrap();
    assert_eq!(stored.results, results);
    assert_eq!(stored.comparison, campaign.comparison.to_toml());
    assert_eq!(stored.scene_files, ["scenes/b-scene.toml", "scenes/a-scene.toml"]);
    write(&folder, &stored, Formats::OWN, Language::English).unwrap();
    let line = fs::read_to_string(folder.join("paths.jsonl")).unwrap().lines().nth(1).unwrap().to_owned();
    let value: serde_json::Value = serde_json::from_str(&line).unwrap();
    assert_eq!(value["path"][1], serde_json::json!([0.1 + 0.2, 1e-300]));
    assert!(folder.join("scenes/a-scene.toml").is_file());
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn snapshots_are_kept_and_the_first_version_is_still_read() {
    let folder = std::env::temp_dir().join(format!("touchline-versions-{}", std::process::id()));
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    let campaign = campaign(vec![climber(BudgetSpec::default())]);
    let mut results = campaign.empty_results(1);
    results.runs = runs_of(&campaign);
    assert!(results.runs.iter().all(|r| r.cost == Some(12.0) && r.terms == [("length".to_owned(), 12.5)]));
    results.snapshots = replay::snapshots(&campaign, &results.runs);
    assert_eq!(results.snapshots.len(), 4);
    let mut store = Store::create(&folder, &campaign, &results).unwrap();
    results.runs.iter().for_each(|run| store.add(run).unwrap());
    store.add_snapshots(&results.snapshots).unwrap();
    drop(store);
    assert_eq!(Store::open(&folder).unwrap().read().unwrap().results, results);

    let db = rusqlite::Connection::open(folder.join(crate::store::FILE)).unwrap();
    // Pictures alone are missing: everything else is read.
    db.execute_batch("ALTER TABLE snapshot RENAME TO kept").unwrap();
    let without = Store::open(&folder).unwrap().read().unwrap().results;
    assert_eq!((without.snapshots.len(), &without.runs), (0, &results.runs));
    // A damaged picture is refused by name: drawing it might never end.
    db.execute_batch("ALTER TABLE kept RENAME TO snapshot").unwrap();
    let mut damaged = results.snapshots[0].clone();
    let crate::snapshot::State::Population { mesh, .. } = &mut damaged.state else { panic!() };
    let json = r#"{"min":[0.0,0.0],"size":1.0,"columns":610000000,"rows":36,"every":1}"#;
    *mesh = Some(serde_json::from_str(json).unwrap());
    let text = serde_json::to_string(&damaged).unwrap();
    db.execute("INSERT INTO snapshot (position, snapshot) VALUES (99, ?1)", [text]).unwrap();
    let refusal = Store::open(&folder).unwrap().read().err().unwrap().to_string();
    assert!(refusal.contains("runs.db: a snapshot: of climber in"), "{refusal}");

    // What version 3 had not is taken away.
    db.execute_batch(
        "DELETE FROM snapshot WHERE position = 99; DROP TABLE trace;
             ALTER TABLE run DROP COLUMN moving; ALTER TABLE run DROP COLUMN tuning;
             ALTER TABLE scene DROP COLUMN simulation; ALTER TABLE campaign DROP COLUMN subject;
             ALTER TABLE campaign DROP COLUMN protocol; UPDATE campaign SET schema = 3;",
    )
    .unwrap();
    assert_eq!(Store::open(&folder).unwrap().read().unwrap().results, results);

    // What version 1 had not is taken away.
    db.execute_batch(
        "DROP TABLE snapshot; ALTER TABLE run DROP COLUMN cost; ALTER TABLE run DROP COLUMN terms;
             UPDATE campaign SET schema = 1;",
    )
    .unwrap();
    results.snapshots.clear();
    for run in &mut results.runs {
        (run.cost, run.terms) = (None, Vec::new());
    }
    assert_eq!(Store::open(&folder).unwrap().read().unwrap().results, results);
    db.execute_batch("UPDATE campaign SET schema = 5").unwrap();
    let refusal = Store::open(&folder).err().unwrap().to_string();
    assert!(refusal.contains("schema version 5; this program reads versions 1 to 4"), "{refusal}");
    drop(db);
    fs::remove_dir_all(&folder).unwrap();
}
