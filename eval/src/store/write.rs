//! Writing into `runs.db`: every function one transaction.

use env_model::Point;
use rusqlite::{Connection, params};
use serde::Serialize;

use super::{SCHEMA, Stored, TABLES, Variant};
use crate::results::{Manifest, MovingTrace, Optimum, RunRecord};
use crate::snapshot::Snapshot;

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain data with string keys")
}

fn points(path: &[Point]) -> String {
    json(&path.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>())
}

/// Everything at once.
pub(super) fn fill(db: &mut Connection, stored: &Stored) -> rusqlite::Result<()> {
    let Stored { results, comparison, scene_files, compile_us } = stored;
    let tx = db.transaction()?;
    tx.execute_batch(TABLES)?;
    tx.execute(
        "INSERT INTO campaign VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8)",
        params![
            SCHEMA,
            results.name,
            results.seed as i64,
            results.repeats,
            comparison,
            json(&results.manifest),
            results.subject.name(),
            results.protocol
        ],
    )?;
    for (i, planner) in results.planners.iter().enumerate() {
        tx.execute(
            "INSERT INTO planner VALUES (?1, ?2, ?3, ?4, ?5)",
            params![
                i as i64,
                planner.label,
                planner.kind,
                planner.settings,
                json(&Variant { group: planner.group.clone(), varied: planner.varied.clone(), budget: planner.budget })
            ],
        )?;
    }
    for (i, ((scene, compile_us), file)) in results.scenes.iter().zip(compile_us).zip(scene_files).enumerate() {
        let Optimum { length, path, reason } = &scene.optimum;
        tx.execute(
            "INSERT INTO scene VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10)",
            params![
                i as i64,
                scene.scene.name,
                file,
                scene.scene.to_toml(),
                compile_us,
                length,
                points(path),
                reason,
                scene.set.name(),
                scene.simulation.as_ref().map(json)
            ],
        )?;
    }
    for run in &results.runs {
        insert(&tx, run)?;
    }
    put_snapshots(&tx, &results.snapshots)?;
    put_traces(&tx, &results.traces)?;
    tx.commit()
}

/// Adds a run.
pub(super) fn insert(db: &Connection, run: &RunRecord) -> rusqlite::Result<()> {
    let progress: Vec<(u64, f64, f64)> = run.progress.iter().map(|p| (p.evaluations, p.time_us, p.cost)).collect();
    let mut statement = db.prepare_cached(
        "INSERT INTO run VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18,
         ?19, ?20, ?21, ?22, ?23)",
    )?;
    // Outside of `BEGIN` every statement is a transaction of its own.
    statement.execute(params![
        run.scene,
        run.planner,
        run.repeat,
        run.seed as i64,
        run.status.name(),
        run.valid,
        run.length,
        run.gap,
        run.clearance_min,
        run.turning,
        run.iterations as i64,
        run.evaluations as i64,
        run.collision_checks as i64,
        run.time_us,
        run.cpu_us,
        run.error,
        points(&run.path),
        json(&progress),
        run.cost,
        json(&run.terms),
        run.overhead_us,
        run.moving.as_ref().map(json),
        run.tuning.as_ref().map(json),
    ])?;
    Ok(())
}

/// Puts `snapshots` in the place of those that are there.
pub(super) fn replace_snapshots(db: &mut Connection, snapshots: &[Snapshot]) -> rusqlite::Result<()> {
    let tx = db.transaction()?;
    tx.execute("DELETE FROM snapshot", [])?;
    put_snapshots(&tx, snapshots)?;
    tx.commit()
}

fn put_snapshots(db: &Connection, snapshots: &[Snapshot]) -> rusqlite::Result<()> {
    let mut statement = db.prepare("INSERT INTO snapshot (snapshot) VALUES (?1)")?;
    for snapshot in snapshots {
        statement.execute(params![json(snapshot)])?;
    }
    Ok(())
}

/// Puts `traces` in the place of those that are there.
pub(super) fn replace_traces(db: &mut Connection, traces: &[MovingTrace]) -> rusqlite::Result<()> {
    let tx = db.transaction()?;
    tx.execute("DELETE FROM trace", [])?;
    put_traces(&tx, traces)?;
    tx.commit()
}

fn put_traces(db: &Connection, traces: &[MovingTrace]) -> rusqlite::Result<()> {
    let mut statement = db.prepare("INSERT INTO trace (trace) VALUES (?1)")?;
    for trace in traces {
        statement.execute(params![json(trace)])?;
    }
    Ok(())
}

/// Puts `manifest` in the place of the one that is there.
pub(super) fn set_manifest(db: &Connection, manifest: &Manifest) -> rusqlite::Result<()> {
    db.execute("UPDATE campaign SET manifest = ?1", params![json(manifest)]).map(drop)
}
