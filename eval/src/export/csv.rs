//! `runs.csv` and `summary.csv`.

use std::collections::BTreeMap;

use crate::analysis::{Summary, summarise};
use crate::results::{Results, SceneResult, SceneSet};

/// The columns of `runs.csv`, stable: new ones come last.
pub const RUN_COLUMNS: [&str; 20] = [
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
    "set",
];

/// The columns of `summary.csv`.
pub const SUMMARY_COLUMNS: [&str; 12] = [
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
    "cost_median",
];

/// The shortest decimal that reads back as the same number, empty for none.
pub(super) fn cell(value: Option<f64>) -> String {
    value.map(|v| v.to_string()).unwrap_or_default()
}

pub(super) fn csv_text<R: AsRef<[String]>>(columns: &[&str], rows: impl Iterator<Item = R>) -> String {
    let mut writer = ::csv::Writer::from_writer(Vec::new());
    let written = writer
        .write_record(columns)
        .and_then(|()| rows.into_iter().try_for_each(|row| writer.write_record(row.as_ref())));
    written.expect("rows as long as the header, written to memory");
    let bytes = writer.into_inner().expect("flushing to memory");
    String::from_utf8(bytes).expect("written from strings")
}

/// `runs.csv`: one row a run, sorted by scene, planner, repeat.
pub fn runs_csv(results: &Results) -> String {
    let scenes: BTreeMap<&str, &SceneResult> = results.scenes.iter().map(|s| (s.scene.name.as_str(), s)).collect();
    let rows = results.runs.iter().map(|r| {
        let scene = scenes.get(r.scene.as_str());
        [
            r.scene.clone(),
            r.planner.clone(),
            r.repeat.to_string(),
            r.seed.to_string(),
            r.status.name().to_owned(),
            r.valid.to_string(),
            cell(r.length),
            cell(scene.and_then(|s| s.optimum.length)),
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
            scene.map_or_else(String::new, |s| s.set.name().to_owned()),
        ]
    });
    csv_text(&RUN_COLUMNS, rows)
}

/// The summaries of every planner, scene by scene and, where there are several
/// scenes, over all of them; in the comparison's order.
pub fn summaries(results: &Results) -> Vec<Summary> {
    let all = (results.scenes.iter().filter(|s| s.set == SceneSet::Test).count() > 1).then_some(None);
    let groups = all.into_iter().chain(results.scenes.iter().map(|s| Some(s.scene.name.as_str())));
    let of_group = |scene| results.planners.iter().filter_map(move |p| summarise(results, &p.label, scene));
    groups.flat_map(of_group).collect()
}

/// `summary.csv`: medians and quartiles, in which failures are +∞ (`inf`). An empty
/// scene means all test scenes together.
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
            cell(s.cost_median),
        ]
    });
    csv_text(&SUMMARY_COLUMNS, rows)
}
