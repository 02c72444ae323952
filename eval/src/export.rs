//! Everything that a campaign leaves besides `runs.db`, made from the stored runs alone.

use std::fs;
use std::path::Path;

use serde::Serialize;

use crate::analysis::{Summary, summarise};
use crate::error::Error;
use crate::report::{self, Language};
use crate::results::{Manifest, Results};
use crate::seeds;
use crate::store::Stored;

/// What to export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formats {
    /// `report.html`.
    pub html: bool,
    /// `runs.csv` and `summary.csv`.
    pub csv: bool,
    /// `paths.jsonl` and `manifest.json`.
    pub json: bool,
    /// `comparison.toml` and its scenes.
    pub toml: bool,
}

impl Formats {
    /// All of them.
    pub const ALL: Self = Self { html: true, csv: true, json: true, toml: true };
}

/// Writes a file whole or not at all: who reads it, or is left with it by a kill, never has half of it.
fn put(path: &Path, text: &str) -> Result<(), Error> {
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let written = fs::write(&part, text).and_then(|()| fs::rename(&part, path));
    written.inspect_err(|_| drop(fs::remove_file(&part))).map_err(Error::io("write", path))
}

/// Whether `folder` holds the exports of what is stored: the manifest, which is written last, and all others.
pub fn are_made(folder: &Path, stored: &Stored) -> bool {
    let files = ["runs.csv", "summary.csv", "paths.jsonl", "comparison.toml", "report.html"];
    let scenes = stored.scene_files.iter().map(String::as_str);
    let manifest = fs::read_to_string(folder.join("manifest.json"));
    manifest.is_ok_and(|text| text == manifest_json(&stored.results))
        && files.into_iter().chain(scenes).all(|file| folder.join(file).is_file())
}

/// Writes the exports into `folder`.
pub fn write(folder: &Path, stored: &Stored, formats: Formats, language: Language) -> Result<(), Error> {
    let results = &stored.results;
    let put = |name: &str, text: &str| put(&folder.join(name), text);
    if formats.csv {
        put("runs.csv", &runs_csv(results))?;
        put("summary.csv", &summary_csv(results))?;
    }
    if formats.json {
        put("paths.jsonl", &paths_jsonl(results))?;
    }
    if formats.toml {
        let scenes = folder.join("scenes");
        fs::create_dir_all(&scenes).map_err(Error::io("create", &scenes))?;
        for (file, scene) in stored.scene_files.iter().zip(&results.scenes) {
            put(file, &scene.scene.to_toml())?;
        }
        put("comparison.toml", &stored.comparison)?;
    }
    if formats.html {
        put("report.html", &report::html(results, language))?;
    }
    // Last: it stands for all of them.
    if formats.json {
        put("manifest.json", &manifest_json(results))?;
    }
    Ok(())
}

/// The columns of `runs.csv`, stable: new ones come last.
pub const RUN_COLUMNS: [&str; 19] = [
    "scene",
    "planner",
    "repeat",
    "seed",
    "status",
    "valid",
    "length",
    "optimum",
    "gap",
    "clearance_min",
    "turning",
    "iterations",
    "evaluations",
    "collision_checks",
    "time_us",
    "cpu_us",
    "error",
    "cost",
    "terms",
];

/// The columns of `summary.csv`.
pub const SUMMARY_COLUMNS: [&str; 11] = [
    "planner",
    "scene",
    "runs",
    "valid",
    "length_median",
    "length_q1",
    "length_q3",
    "length_best",
    "gap_median",
    "time_us_median",
    "evaluations_median",
];

/// The shortest decimal that reads back as the same number, empty for none.
fn cell(value: Option<f64>) -> String {
    value.map(|v| v.to_string()).unwrap_or_default()
}

fn csv_text<R: AsRef<[String]>>(columns: &[&str], rows: impl Iterator<Item = R>) -> String {
    let mut writer = csv::Writer::from_writer(Vec::new());
    let written = writer
        .write_record(columns)
        .and_then(|()| rows.into_iter().try_for_each(|row| writer.write_record(row.as_ref())));
    written.expect("rows as long as the header, written to memory");
    let bytes = writer.into_inner().expect("flushing to memory");
    String::from_utf8(bytes).expect("written from strings")
}

/// `runs.csv`: one row a run, sorted by scene, planner, repeat.
pub fn runs_csv(results: &Results) -> String {
    let optimum = |name: &str| results.scenes.iter().find(|s| s.scene.name == name).and_then(|s| s.optimum.length);
    let rows = results.runs.iter().map(|r| {
        [
            r.scene.clone(),
            r.planner.clone(),
            r.repeat.to_string(),
            r.seed.to_string(),
            r.status.name().to_owned(),
            r.valid.to_string(),
            cell(r.length),
            cell(optimum(&r.scene)),
            cell(r.gap),
            cell(r.clearance_min),
            cell(r.turning),
            r.iterations.to_string(),
            r.evaluations.to_string(),
            r.collision_checks.to_string(),
            cell(Some(r.time_us)),
            cell(Some(r.cpu_us)),
            r.error.clone().unwrap_or_default(),
            cell(r.cost),
            r.terms.iter().map(|(name, value)| format!("{name}={value}")).collect::<Vec<_>>().join(";"),
        ]
    });
    csv_text(&RUN_COLUMNS, rows)
}

/// The summaries of every planner, scene by scene and, where there are several
/// scenes, over all of them; in the comparison's order.
pub fn summaries(results: &Results) -> Vec<Summary> {
    let all = (results.scenes.len() > 1).then_some(None);
    let groups = all.into_iter().chain(results.scenes.iter().map(|s| Some(s.scene.name.as_str())));
    let of_group = |scene| results.planners.iter().filter_map(move |p| summarise(results, &p.label, scene));
    groups.flat_map(of_group).collect()
}

/// `summary.csv`: medians and quartiles, in which failures are +∞ (`inf`). An empty
/// scene means all scenes together.
pub fn summary_csv(results: &Results) -> String {
    let rows = summaries(results).into_iter().map(|s| {
        [
            s.planner,
            s.scene.unwrap_or_default(),
            s.runs.to_string(),
            s.valid.to_string(),
            cell(Some(s.length_median)),
            cell(Some(s.length_quartiles[0])),
            cell(Some(s.length_quartiles[1])),
            cell(Some(s.length_best)),
            cell(s.gap_median),
            cell(Some(s.time_us_median)),
            cell(Some(s.evaluations_median)),
        ]
    });
    csv_text(&SUMMARY_COLUMNS, rows)
}

/// `paths.jsonl`: one line a run, an empty path where there is none.
pub fn paths_jsonl(results: &Results) -> String {
    #[derive(Serialize)]
    struct Line<'a> {
        scene: &'a str,
        planner: &'a str,
        repeat: u32,
        path: Vec<[f64; 2]>,
    }
    let line = |r: &crate::results::RunRecord| {
        let path = r.path.iter().map(|p| [p.x, p.y]).collect();
        let line = Line { scene: &r.scene, planner: &r.planner, repeat: r.repeat, path };
        serde_json::to_string(&line).expect("plain data") + "\n"
    };
    results.runs.iter().map(line).collect()
}

/// `manifest.json`: versions, machine, seeds, times.
pub fn manifest_json(results: &Results) -> String {
    #[derive(Serialize)]
    struct Whole<'a> {
        format: u32,
        name: &'a str,
        seed: u64,
        repeats: u32,
        runs: usize,
        runs_planned: usize,
        seed_formula: &'a str,
        metrics_version: u32,
        #[serde(flatten)]
        manifest: &'a Manifest,
    }
    let whole = Whole {
        format: 1,
        name: &results.name,
        seed: results.seed,
        repeats: results.repeats,
        runs: results.runs.len(),
        runs_planned: results.planned(),
        seed_formula: seeds::FORMULA,
        metrics_version: crate::metrics::VERSION,
        manifest: &results.manifest,
    };
    serde_json::to_string_pretty(&whole).expect("plain data") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::Campaign;
    use crate::config::BudgetSpec;
    use crate::replay;
    use crate::results::{Optimum, Progress, RunRecord, RunStatus};
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
        let bad = RunRecord {
            status: RunStatus::Error,
            error: Some("no, \"thanks\"\nreally".into()),
            ..record("straight", 0)
        };
        results.runs = vec![record("detour", 0), good, bad];
        results
    }

    #[test]
    fn runs_csv_is_as_designed() {
        let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
        let expected = "\
scene,planner,repeat,seed,status,valid,length,optimum,gap,clearance_min,turning,iterations,evaluations,collision_checks,time_us,cpu_us,error,cost,terms
a-scene,detour,0,9007199254740991,not_found,false,,10.1,,,,0,0,0,0.25,1234.567,,,
a-scene,detour,1,9007199254740991,solved,true,10.333333333333334,10.1,0.0000001,-0.0000000015,0.30000000000000004,0,8020,0,0.25,1234.567,,0.6666666666666666,length=0.30000000000000004;risk=5
a-scene,straight,0,9007199254740991,error,false,,10.1,,,,0,0,0,0.25,1234.567,\"no, \"\"thanks\"\"
really\",,
";
        assert_eq!(runs_csv(&results(&campaign)), expected);
    }

    #[test]
    fn summaries_count_failures_as_infinite() {
        let campaign = campaign(vec![entry("straight", straight), entry("detour", detour)]);
        let expected = "\
planner,scene,runs,valid,length_median,length_q1,length_q3,length_best,gap_median,time_us_median,evaluations_median
straight,,1,0,inf,inf,inf,inf,inf,0.25,0
detour,,2,1,inf,inf,inf,10.333333333333334,inf,0.25,4010
straight,a-scene,1,0,inf,inf,inf,inf,inf,0.25,0
detour,a-scene,2,1,inf,inf,inf,10.333333333333334,inf,0.25,4010
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
        write(&folder, &stored, Formats::ALL, Language::English).unwrap();
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
        db.execute_batch("UPDATE campaign SET schema = 4").unwrap();
        let refusal = Store::open(&folder).err().unwrap().to_string();
        assert!(refusal.contains("schema version 4; this program reads versions 1 to 3"), "{refusal}");
        drop(db);
        fs::remove_dir_all(&folder).unwrap();
    }
}
