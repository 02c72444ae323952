//! What is missing, for each planner and scene, and why.

use minijinja::{Value, context};

use super::data_table::{number, planner_row, row, table, words};
use super::language::Strings;
use crate::format;
use crate::results::{Results, RunRecord, RunStatus, SceneSet};

/// Why there is no valid path, in the order of the columns.
const REASONS: [&str; 8] = [
    "missing_not_run",
    "status_error",
    "status_crashed",
    "status_timeout",
    "status_out_of_memory",
    "missing_no_path",
    "missing_invalid",
    "missing_violation",
];

/// Columns of a run that is not valid; a simulation may fail in several ways at once.
fn reasons(run: &RunRecord) -> Vec<usize> {
    let one = match (run.status, &run.moving) {
        (RunStatus::Error, _) => 1,
        (RunStatus::Crashed, _) => 2,
        (RunStatus::Timeout, _) => 3,
        (RunStatus::OutOfMemory, _) => 4,
        (_, Some(m)) => {
            let m = &m.metrics;
            let of = [(5, m.arrived < m.robots), (6, m.collisions > 0), (7, m.violations > 0)];
            return of.into_iter().filter(|(_, so)| *so).map(|(column, _)| column).collect();
        }
        _ if run.path.is_empty() => 5,
        _ => 6,
    };
    vec![one]
}

/// What lacks of one planner in one scene.
struct Lack {
    planner: usize,
    scene: usize,
    set: SceneSet,
    counts: [usize; REASONS.len()],
}

/// Every planner and scene of which something is missing, sorted by planner, test scenes first.
fn lacks(results: &Results) -> Vec<Lack> {
    let mut all = Vec::new();
    for (planner, p) in results.planners.iter().enumerate() {
        // One pass over a planner's runs, not one for each scene.
        let mut counts = vec![[0; REASONS.len()]; results.scenes.len()];
        counts.iter_mut().for_each(|c| c[0] = results.repeats as usize);
        for run in results.runs_of(&p.label, None) {
            if let Some(scene) = results.scenes.iter().position(|s| s.scene.name == run.scene) {
                counts[scene][0] = counts[scene][0].saturating_sub(1);
                if !run.valid {
                    reasons(run).into_iter().for_each(|column| counts[scene][column] += 1);
                }
            }
        }
        let lacking = counts.into_iter().enumerate().filter(|(_, c)| c.iter().any(|n| *n > 0));
        let mut lacking: Vec<Lack> =
            lacking.map(|(scene, counts)| Lack { planner, scene, set: results.scenes[scene].set, counts }).collect();
        lacking.sort_by_key(|l| l.set == SceneSet::Tuning);
        all.append(&mut lacking);
    }
    all
}

/// Both tables, by planner and by planner and scene; `None` where every run gave a valid path.
pub fn figure(results: &Results, t: &Strings) -> Option<Value> {
    let lacks = lacks(results);
    if lacks.is_empty() {
        return None;
    }
    let used: Vec<usize> = (0..REASONS.len()).filter(|k| lacks.iter().any(|l| l.counts[*k] > 0)).collect();
    let count = |n: usize| number(if n == 0 { format::NONE.to_owned() } else { format::count(n as f64) }, n as f64);
    // What is missing in tuning scenes is no evidence: it is told apart, where there are any.
    let sets = results.scenes.iter().any(|s| s.set == SceneSet::Tuning);
    let set = |set: SceneSet| {
        let key = if set == SceneSet::Tuning { "set_tuning" } else { "set_test" };
        sets.then(|| words(t.get(key)))
    };
    let heads = |first: &[&'static str]| -> Vec<String> {
        let reasons = used.iter().map(|k| t.get(REASONS[*k]).to_owned());
        let first = first.iter().filter(|key| sets || **key != "missing_set");
        first.map(|key| t.get(key).to_owned()).chain(reasons).chain([t.get("missing_of").to_owned()]).collect()
    };
    let by_planner = lacks.chunk_by(|a, b| (a.planner, a.set) == (b.planner, b.set)).map(|group| {
        let p = group[0].planner;
        let sum = |k: &usize| group.iter().map(|l| l.counts[*k]).sum::<usize>();
        let of_set = results.scenes.iter().filter(|s| s.set == group[0].set).count();
        let planned = of_set * results.repeats as usize;
        let cells = set(group[0].set)
            .into_iter()
            .chain([count(group.len())])
            .chain(used.iter().map(|k| count(sum(k))))
            .chain([count(planned)]);
        planner_row(&results.planners[p].label, p, cells.collect())
    });
    let by_planner = by_planner.collect();
    let by_scene = lacks.iter().map(|l| {
        let cells =
            [words(results.planners[l.planner].label.as_str()), words(results.scenes[l.scene].scene.name.as_str())];
        let counts = used.iter().map(|k| count(l.counts[*k])).chain([count(results.repeats as usize)]);
        row(cells.into_iter().chain(set(l.set)).chain(counts).collect())
    });
    let by_scene: Vec<Value> = by_scene.collect();
    let as_table = |id: &str, caption: &str, heads: &[String], rows: Vec<Value>| {
        table(id, caption, &heads.iter().map(String::as_str).collect::<Vec<_>>(), rows)
    };
    let scenes = results.scenes.len() > 1;
    Some(context! {
        planners => as_table("missing-planners", t.get("missing_title"), &heads(&["head_planner", "missing_set", "missing_scenes"]), by_planner),
        scenes => scenes.then(|| as_table("missing-scenes", t.get("missing_title"), &heads(&["head_planner", "section_scene", "missing_set"]), by_scene)),
    })
}
