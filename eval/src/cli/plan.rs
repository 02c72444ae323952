//! `touchline plan`: one planner, once, in one scene.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::BufWriter;
use std::path::Path;
use std::process::ExitCode;

use env_model::Scene;
use planner_api::{Plan, Run};
use serde_json::json;

use super::{PlanArgs, say};
use crate::campaign::Arena;
use crate::config::{self, Maker, PlannerEntry};
use crate::error::Error;
use crate::format;
use crate::json;
use crate::report::svg::{PathLayer, scene_svg};
use crate::results::{RunRecord, SceneResult, Subject};
use crate::runner;
use crate::trace::Tracer;
use crate::verdict::Judge;
use crate::worker::Seat;

pub(super) fn plan(args: &PlanArgs) -> Result<ExitCode, Error> {
    let file = args.scene.display().to_string();
    let text = std::fs::read_to_string(&args.scene).map_err(Error::io("read", &args.scene))?;
    let scene = Scene::from_toml(&file, &text)?;
    config::refuse_motion(&scene).map_err(|e| Error::Usage(format!("{file}: {e}")))?;
    let settings = settings(&args.set)?;
    let entry = config::single("--set", &args.planner, &settings)
        // Places in a text that the user has not written help nobody.
        .map_err(|e| Error::Usage(format!("--planner {}: {}", args.planner, e.message)))?;
    let arena = Arena::new(scene).map_err(|e| Error::Usage(format!("{file}: {e}")))?;
    if args.trace.is_some() && matches!(entry.maker, Maker::External(_)) {
        let message = "--trace: an external planner shows no frames; expected a planner of the catalogue";
        return Err(Error::Usage(message.to_owned()));
    }
    let judge = Judge::new(&arena.scene);
    let result = arena.result(Subject::Paths);
    // It warms up first, as in the bench.
    let record = Seat::new(&entry, false).run(0, &arena, args.seed)?;
    let record = runner::judged(record, &judge, result.optimum.length);
    if let Some(path) = &args.svg {
        std::fs::write(path, picture(&entry, &result, &record)).map_err(Error::io("write", path))?;
    }
    if let Some(path) = &args.trace {
        trace(path, &entry, &arena, args.seed)?;
    }
    if args.json {
        say(as_json(&entry, &result, &record));
    } else {
        summary(&entry, &result, &record, &judge);
    }
    Ok(ExitCode::SUCCESS)
}

/// The text of a planner's table from `key=value` pairs. A value that is no TOML is text.
fn settings(pairs: &[String]) -> Result<String, Error> {
    let mut table = toml::Table::new();
    for pair in pairs {
        let Some((key, value)) = pair.split_once('=') else {
            return Err(Error::Usage(format!("--set {pair}; expected KEY=VALUE")));
        };
        let parsed = toml::from_str::<toml::Table>(&format!("x = {value}")).ok().filter(|t| t.len() == 1);
        let value = parsed.and_then(|mut t| t.remove("x")).unwrap_or_else(|| value.into());
        let mut keys: Vec<&str> = key.trim().split('.').collect();
        let last = keys.pop().unwrap_or_default();
        if last.is_empty() || keys.iter().any(|k| k.is_empty()) {
            return Err(Error::Usage(format!("--set {pair}; expected KEY=VALUE")));
        }
        if keys.is_empty() && last == "kind" {
            return Err(Error::Usage(format!("--set {pair}; the kind is what --planner says")));
        }
        let mut inner = &mut table;
        for key in keys {
            let entry = inner.entry(key).or_insert_with(|| toml::Table::new().into());
            inner = entry.as_table_mut().ok_or_else(|| Error::Usage(format!("--set {pair}: {key} is no table")))?;
        }
        inner.insert(last.to_owned(), value);
    }
    Ok(table.to_string())
}

fn picture(entry: &PlannerEntry, scene: &SceneResult, record: &RunRecord) -> String {
    let optimum = scene.optimum.length.map(|_| scene.optimum.path.as_slice());
    let layer = PathLayer { label: &entry.label, points: &record.path, valid: record.valid, series: 0 };
    scene_svg(&scene.scene, optimum, if record.path.is_empty() { &[] } else { std::slice::from_ref(&layer) })
}

fn trace(path: &Path, entry: &PlannerEntry, arena: &Arena, seed: u64) -> Result<(), Error> {
    let problem = arena.problem().map_err(|e| Error::Usage(e.to_string()))?;
    let file = File::create(path).map_err(Error::io("write", path))?;
    let mut tracer = Tracer::new(BufWriter::new(file), &problem);
    let mut run = Run::new(seed).with_budget(entry.budget.begin()).with_observer(&mut tracer);
    // The first run has told how planning ended; this one is only watched.
    let _ = entry.instance().map(|mut planner| planner.plan_into(&problem, &mut run, &mut Plan::new()));
    tracer.finish().map_err(Error::io("write", path))
}

fn as_json(entry: &PlannerEntry, scene: &SceneResult, r: &RunRecord) -> String {
    let mut value = json::run(r);
    value.extend([
        ("planner".to_owned(), json!(entry.kind)),
        ("settings".to_owned(), json!(entry.settings)),
        ("budget".to_owned(), json!(entry.budget)),
        ("optimum".to_owned(), json!(scene.optimum.length)),
        ("terms".to_owned(), json!(r.terms.iter().cloned().collect::<BTreeMap<_, _>>())),
    ]);
    serde_json::to_string_pretty(&value).expect("plain data with string keys")
}

fn summary(entry: &PlannerEntry, scene: &SceneResult, r: &RunRecord, judge: &Judge<'_>) {
    let unit = &scene.scene.unit;
    let line = |name: &str, value: String| say(format!("{name:<10} {value}"));
    line("scene", format!("{} ({} obstacles)", r.scene, scene.scene.obstacles.len()));
    line("planner", format!("{}, seed {}", entry.kind, r.seed));
    line("status", r.status.name().to_owned());
    line("valid", judge.verdict(&r.path).map_or_else(|fault| format!("no: {fault}"), |()| "yes".to_owned()));
    if let Some(length) = r.length {
        line("length", format!("{} {unit} in {} segments", format::length(length), r.path.len() - 1));
    }
    match (&scene.optimum.length, &scene.optimum.reason) {
        (Some(optimum), _) => line("optimum", format!("{} {unit}", format::length(*optimum))),
        (None, reason) => line("optimum", format!("none: {}", reason.as_deref().unwrap_or("not computed"))),
    }
    if let Some(gap) = r.gap {
        line("gap", format::percent(gap));
    }
    if let Some(clearance) = r.clearance_min {
        line("clearance", format!("{clearance:.6} {unit}"));
    }
    if !r.terms.is_empty() {
        let terms: Vec<String> = r.terms.iter().map(|(n, v)| format!("{n} {}", format::significant(*v, 6))).collect();
        line("terms", terms.join(", "));
    }
    line(
        "work",
        format!("{} iterations, {} evaluations, {} collision checks", r.iterations, r.evaluations, r.collision_checks),
    );
    line("time", format::time(r.time_us));
    if let Some(error) = &r.error {
        line("error", error.clone());
    }
}
