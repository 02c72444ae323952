//! `paths.jsonl`, `manifest.json`, and everything in one: `results.json`.

use serde::Serialize;
use serde_json::json;

use crate::json;
use crate::results::{Manifest, Optimum, PlannerInfo, Results, RunRecord, SceneResult};
use crate::seeds;

/// `paths.jsonl`: one line a run, an empty path where there is none.
pub fn paths_jsonl(results: &Results) -> String {
    #[derive(Serialize)]
    struct Line<'a> {
        scene: &'a str,
        planner: &'a str,
        repeat: u32,
        path: Vec<[f64; 2]>,
    }
    let line = |r: &RunRecord| {
        let path = json::points(&r.path);
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

/// The schema that [`results_json`] follows, written beside it.
pub const SCHEMA: &str = include_str!("results.schema.json");

/// `results.json`: everything but pictures, in one document. It holds no infinities: what there is not is null.
pub fn results_json(results: &Results) -> String {
    let planner = |p: &PlannerInfo| {
        let mut settings: toml::Table = p.settings.parse().expect("written by this program");
        settings.remove("budget");
        json!({
            "label": p.label,
            "kind": p.kind,
            "group": p.group,
            "varied": p.varied,
            "budget": p.budget,
            "settings": json::from_toml(&toml::Value::Table(settings)),
        })
    };
    let scene = |s: &SceneResult| {
        let Optimum { length, path, reason } = &s.optimum;
        let mut scene = json!({
            "set": s.set,
            "scene": s.scene,
            "optimum": { "length": length, "path": json::points(path), "reason": reason },
        });
        if let Some(settings) = &s.simulation {
            scene["simulation"] = json!(settings);
        }
        scene
    };
    let run = |r: &RunRecord| {
        let mut run = json::run(r);
        run.extend([
            ("planner".to_owned(), json!(r.planner)),
            ("repeat".to_owned(), json!(r.repeat)),
            ("overhead_us".to_owned(), json!(r.overhead_us)),
            ("terms".to_owned(), json!(r.terms)),
        ]);
        run.extend(r.moving.as_ref().map(|moving| ("moving".to_owned(), json!(moving))));
        run.extend(r.tuning.as_ref().map(|tuning| ("tuning".to_owned(), json!(tuning))));
        run
    };
    let mut whole = json!({
        "$schema": "results.schema.json",
        "format": 1,
        "name": results.name,
        "seed": results.seed,
        "repeats": results.repeats,
        "subject": results.subject,
        "seed_formula": seeds::FORMULA,
        "metrics_version": crate::metrics::VERSION,
        "manifest": results.manifest,
        "planners": results.planners.iter().map(planner).collect::<Vec<_>>(),
        "scenes": results.scenes.iter().map(scene).collect::<Vec<_>>(),
        "runs": results.runs.iter().map(run).collect::<Vec<_>>(),
    });
    if let Ok(protocol) = results.protocol.parse::<toml::Table>()
        && !protocol.is_empty()
    {
        whole["protocol"] = json::from_toml(&toml::Value::Table(protocol));
    }
    whole.to_string() + "\n"
}

#[cfg(test)]
mod tests;
