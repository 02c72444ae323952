//! Reading `runs.db`, older versions included.

use std::collections::BTreeSet;

use env_model::{Point, Scene};
use rusqlite::{Connection, Row};
use serde::de::DeserializeOwned;

use super::{Count, FIRST, SCHEMA, Stored, VARIANTS, Variant};
use crate::config::BudgetSpec;
use crate::results::{
    MovingTrace, Optimum, PlannerInfo, Progress, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
};
use crate::snapshot::Snapshot;

/// The outer error is the database's, the inner one says which content makes no sense.
pub(super) type Read<T> = rusqlite::Result<Result<T, String>>;

fn collect<T>(rows: impl Iterator<Item = Read<T>>) -> Read<Vec<T>> {
    rows.collect::<rusqlite::Result<Vec<_>>>().map(|rows| rows.into_iter().collect())
}

fn path(json: &str) -> Result<Vec<Point>, String> {
    let points: Vec<[f64; 2]> = serde_json::from_str(json).map_err(|e| format!("a path: {e}"))?;
    Ok(points.into_iter().map(Point::from).collect())
}

/// Everything but runs, snapshots and traces.
pub(super) fn head(db: &Connection, schema: i64) -> Read<Stored> {
    type Head = (String, i64, u32, String, String, String, String);
    // What older versions lack.
    let (variant, role) = if schema < VARIANTS { ("NULL", "'test'") } else { ("variant", "role") };
    let (subject, simulation) =
        if schema < SCHEMA { ("'paths', ''", "NULL") } else { ("subject, protocol", "simulation") };
    let columns = format!("SELECT name, seed, repeats, comparison, manifest, {subject} FROM campaign");
    let (name, seed, repeats, comparison, manifest, subject, protocol): Head = db.query_row(&columns, [], |row| {
        Ok((row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?, row.get(4)?, row.get(5)?, row.get(6)?))
    })?;
    let mut statement =
        db.prepare(&format!("SELECT label, kind, settings, {variant} FROM planner ORDER BY position"))?;
    let planners = collect(statement.query_map([], |row| {
        let (label, text): (String, Option<String>) = (row.get(0)?, row.get(3)?);
        let (kind, settings) = (row.get(1)?, row.get(2)?);
        let variant = text.map_or_else(
            || Ok(Variant { group: label.clone(), varied: String::new(), budget: BudgetSpec::default() }),
            |text| serde_json::from_str(&text).map_err(|e| format!("a planner: {e}")),
        );
        Ok(variant.map(|Variant { group, varied, budget }| PlannerInfo {
            label,
            kind,
            settings,
            group,
            varied,
            budget,
        }))
    })?)?;
    let mut statement = db.prepare(&format!(
        "SELECT file, toml, optimum_length, optimum_path, optimum_reason, {role}, compile_us, {simulation}
         FROM scene ORDER BY position"
    ))?;
    let scenes = collect(statement.query_map([], |row| {
        let (file, toml, shortest): (String, String, String) = (row.get(0)?, row.get(1)?, row.get(3)?);
        let (length, reason, role): (_, _, String) = (row.get(2)?, row.get(4)?, row.get(5)?);
        let (compile_us, simulation): (f64, Option<String>) = (row.get(6)?, row.get(7)?);
        Ok(Scene::from_toml(&file, &toml).map_err(|e| e.to_string()).and_then(|scene| {
            let set = SceneSet::from_name(&role).ok_or_else(|| format!("no set of scenes {role:?}"))?;
            let optimum = Optimum { length, path: path(&shortest)?, reason };
            let simulation = told(simulation).map_err(|e| format!("what moves: {e}"))?;
            Ok(((file, compile_us), SceneResult { scene, optimum, set, simulation }))
        }))
    })?)?;
    Ok((|| {
        let (places, scenes): (Vec<_>, _) = scenes?.into_iter().unzip();
        let (scene_files, compile_us) = places.into_iter().unzip();
        let manifest = serde_json::from_str(&manifest).map_err(|e| format!("the manifest: {e}"))?;
        let subject = Subject::from_name(&subject).ok_or_else(|| format!("no subject {subject:?}"))?;
        let (planners, seed) = (planners?, seed as u64);
        let (runs, snapshots, traces) = (Vec::new(), Vec::new(), Vec::new());
        let results =
            Results { name, seed, repeats, subject, protocol, planners, scenes, runs, snapshots, traces, manifest };
        Ok(Stored { results, comparison, scene_files, compile_us })
    })())
}

/// The runs, sorted by scene, planner, repeat.
pub(super) fn runs(db: &Connection, schema: i64) -> Read<Vec<RunRecord>> {
    let added = if schema == FIRST { "NULL, '[]'" } else { "cost, terms" };
    let overhead = if schema < VARIANTS { "NULL" } else { "overhead_us" };
    let moving = if schema < SCHEMA { "NULL, NULL" } else { "moving, tuning" };
    let mut statement = db.prepare(&format!(
        "SELECT scene, planner, repeat, seed, status, valid, length, gap, clearance_min, turning, iterations,
         evaluations, collision_checks, time_us, cpu_us, error, path, progress, {added}, {overhead}, {moving}
         FROM run ORDER BY scene, planner, repeat",
    ))?;
    collect(statement.query_map([], |row| {
        let (status, points, curve): (String, String, String) = (row.get(4)?, row.get(16)?, row.get(17)?);
        let terms: String = row.get(19)?;
        let [moving, tuning] = [row.get(21)?, row.get::<_, Option<String>>(22)?];
        let count = |i: usize| row.get::<_, i64>(i).map(|n| n as u64);
        let (scene, planner): (String, String) = (row.get(0)?, row.get(1)?);
        let mut run = RunRecord {
            valid: row.get(5)?,
            length: row.get(6)?,
            gap: row.get(7)?,
            clearance_min: row.get(8)?,
            turning: row.get(9)?,
            iterations: count(10)?,
            evaluations: count(11)?,
            collision_checks: count(12)?,
            time_us: row.get(13)?,
            cpu_us: row.get(14)?,
            error: row.get(15)?,
            cost: row.get(18)?,
            overhead_us: row.get(20)?,
            ..RunRecord::empty(&scene, &planner, row.get(2)?, count(3)?)
        };
        let parse = || {
            run.status = RunStatus::from_name(&status).ok_or_else(|| format!("no status {status:?}"))?;
            run.path = path(&points)?;
            let curve: Vec<(u64, f64, f64)> = serde_json::from_str(&curve).map_err(|e| format!("a curve: {e}"))?;
            let point = |(evaluations, time_us, cost)| Progress { evaluations, time_us, cost };
            run.progress = curve.into_iter().map(point).collect();
            run.terms = serde_json::from_str(&terms).map_err(|e| format!("terms: {e}"))?;
            run.moving = told(moving).map_err(|e| format!("a simulation: {e}"))?;
            run.tuning = told(tuning).map_err(|e| format!("a tuning: {e}"))?;
            Ok(())
        };
        Ok(parse().map(|()| run))
    })?)
}

fn told<T: DeserializeOwned>(text: Option<String>) -> serde_json::Result<Option<T>> {
    text.map(|text| serde_json::from_str(&text)).transpose()
}

/// Simulations to look at.
pub(super) fn traces(db: &Connection, schema: i64) -> Read<Vec<MovingTrace>> {
    if schema < SCHEMA {
        return Ok(Ok(Vec::new()));
    }
    let mut statement = db.prepare("SELECT trace FROM trace ORDER BY position")?;
    collect(statement.query_map([], |row| {
        let text: String = row.get(0)?;
        Ok(serde_json::from_str(&text).map_err(|e| format!("a trace: {e}")))
    })?)
}

/// What planners looked like.
pub(super) fn snapshots(db: &Connection) -> Read<Vec<Snapshot>> {
    // The runs are whole without pictures, whichever way a database came to lack them.
    let pictures = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'snapshot'";
    if db.query_row(pictures, [], |row| row.get::<_, i64>(0))? == 0 {
        return Ok(Ok(Vec::new()));
    }
    let mut statement = db.prepare("SELECT snapshot FROM snapshot ORDER BY position")?;
    collect(statement.query_map([], |row| {
        let text: String = row.get(0)?;
        let snapshot = serde_json::from_str::<Snapshot>(&text).map_err(|e| e.to_string());
        let checked = snapshot.and_then(|s| s.check().map(|()| s));
        Ok(checked.map_err(|e| format!("a snapshot: {e}")))
    })?)
}

/// Which runs there are, as (scene, planner, repeat).
pub(super) fn keys(db: &Connection) -> rusqlite::Result<BTreeSet<(String, String, u32)>> {
    let mut statement = db.prepare("SELECT scene, planner, repeat FROM run")?;
    let key = |row: &Row<'_>| Ok((row.get(0)?, row.get(1)?, row.get(2)?));
    statement.query_map([], key)?.collect()
}

/// How many runs of every scene and planner ended how, sorted.
pub(super) fn counts(db: &Connection) -> Read<Vec<Count>> {
    let mut statement = db
        .prepare("SELECT scene, planner, status, count(*) FROM run GROUP BY scene, planner, status ORDER BY 1, 2, 3")?;
    collect(statement.query_map([], |row| {
        let (scene, planner, status): (_, _, String) = (row.get(0)?, row.get(1)?, row.get(2)?);
        let runs: i64 = row.get(3)?;
        let status = RunStatus::from_name(&status).ok_or_else(|| format!("no status {status:?}"));
        Ok(status.map(|status| Count { scene, planner, status, runs: runs as usize }))
    })?)
}
