//! `paths.jsonl`, `manifest.json`, and everything in one: `results.json`.

use env_model::Point;
use serde::Serialize;
use serde_json::{Value, json};

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
            "settings": plain(toml::Value::Table(settings)),
        })
    };
    let points = |path: &[Point]| path.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>();
    let scene = |s: &SceneResult| {
        let Optimum { length, path, reason } = &s.optimum;
        json!({
            "set": s.set,
            "scene": s.scene,
            "optimum": { "length": length, "path": points(path), "reason": reason },
        })
    };
    let run = |r: &RunRecord| {
        json!({
            "scene": r.scene,
            "planner": r.planner,
            "repeat": r.repeat,
            "seed": r.seed,
            "status": r.status,
            "valid": r.valid,
            "length": r.length,
            "gap": r.gap,
            "clearance_min": r.clearance_min,
            "turning": r.turning,
            "iterations": r.iterations,
            "evaluations": r.evaluations,
            "collision_checks": r.collision_checks,
            "time_us": r.time_us,
            "cpu_us": r.cpu_us,
            "overhead_us": r.overhead_us,
            "error": r.error,
            "cost": r.cost,
            "terms": r.terms,
            "path": points(&r.path),
            "progress": r.progress,
        })
    };
    let whole = json!({
        "$schema": "results.schema.json",
        "format": 1,
        "name": results.name,
        "seed": results.seed,
        "repeats": results.repeats,
        "seed_formula": seeds::FORMULA,
        "metrics_version": crate::metrics::VERSION,
        "manifest": results.manifest,
        "planners": results.planners.iter().map(planner).collect::<Vec<_>>(),
        "scenes": results.scenes.iter().map(scene).collect::<Vec<_>>(),
        "runs": results.runs.iter().map(run).collect::<Vec<_>>(),
    });
    whole.to_string() + "\n"
}

/// A TOML value as JSON; numbers that JSON lacks (inf, nan) and dates become their text.
fn plain(value: toml::Value) -> Value {
    match value {
        toml::Value::Float(number) if !number.is_finite() => number.to_string().into(),
        toml::Value::Float(number) => number.into(),
        toml::Value::Integer(number) => number.into(),
        toml::Value::Boolean(flag) => flag.into(),
        toml::Value::String(text) => text.into(),
        toml::Value::Datetime(instant) => instant.to_string().into(),
        toml::Value::Array(values) => values.into_iter().map(plain).collect(),
        toml::Value::Table(table) => table.into_iter().map(|(key, value)| (key, plain(value))).collect(),
    }
}

#[cfg(test)]
mod tests;
