//! `runs.db`: the durable record of a campaign, from which everything else can be made again.
//!
//! An `SQLite` database in WAL mode, one transaction a run, so an interrupted campaign keeps
//! every run that ended. Paths and progress curves are JSON text
//! (`[[x, y], …]` and `[[evaluations, time_us, cost], …]`), and so are terms (`[[name, value], …]`)
//! and snapshots ([`Snapshot`]): readable from any language.

use std::path::{Path, PathBuf};

use env_model::{Point, Scene};
use rusqlite::{Connection, OpenFlags, OptionalExtension, params};
use serde::{Deserialize, Serialize};

use crate::campaign::Campaign;
use crate::config::BudgetSpec;
use crate::error::Error;
use crate::results::{Manifest, Optimum, PlannerInfo, Progress, Results, RunRecord, RunStatus, SceneResult, SceneSet};
use crate::snapshot::Snapshot;

/// The file's name in a campaign's folder.
pub const FILE: &str = "runs.db";
/// Version of the tables below.
const SCHEMA: i64 = 3;
/// The first version, which this program still reads: without `snapshot` and a run's `cost` and `terms`. The second
/// has them, and lacks a planner's `variant`, a scene's `role` and a run's `overhead_us`.
const FIRST: i64 = 1;

const TABLES: &str = "
CREATE TABLE campaign (
    schema INTEGER NOT NULL,
    name TEXT NOT NULL,
    seed INTEGER NOT NULL,
    repeats INTEGER NOT NULL,
    comparison TEXT NOT NULL,          -- resolved, TOML
    manifest TEXT NOT NULL             -- JSON; finished = '' while the campaign lasts
);
CREATE TABLE planner (
    position INTEGER PRIMARY KEY,
    label TEXT NOT NULL UNIQUE,
    kind TEXT NOT NULL,
    settings TEXT NOT NULL,            -- resolved, TOML
    variant TEXT NOT NULL              -- JSON: group, varied, budget
);
CREATE TABLE scene (
    position INTEGER PRIMARY KEY,
    name TEXT NOT NULL UNIQUE,
    file TEXT NOT NULL,                -- where the resolved comparison expects it
    toml TEXT NOT NULL,
    compile_us REAL NOT NULL,
    optimum_length REAL,
    optimum_path TEXT NOT NULL,        -- JSON
    optimum_reason TEXT,
    role TEXT NOT NULL                 -- test or tuning
);
CREATE TABLE run (
    scene TEXT NOT NULL,
    planner TEXT NOT NULL,
    repeat INTEGER NOT NULL,
    seed INTEGER NOT NULL,
    status TEXT NOT NULL,
    valid INTEGER NOT NULL,
    length REAL,
    gap REAL,
    clearance_min REAL,
    turning REAL,
    iterations INTEGER NOT NULL,
    evaluations INTEGER NOT NULL,
    collision_checks INTEGER NOT NULL,
    time_us REAL NOT NULL,
    cpu_us REAL NOT NULL,
    error TEXT,
    path TEXT NOT NULL,                -- JSON
    progress TEXT NOT NULL,            -- JSON
    cost REAL,
    terms TEXT NOT NULL,               -- JSON
    overhead_us REAL,                  -- beside time_us, of a run in a process of its own
    PRIMARY KEY (scene, planner, repeat)
) WITHOUT ROWID;
CREATE TABLE snapshot (
    position INTEGER PRIMARY KEY,
    snapshot TEXT NOT NULL             -- JSON
);
";

/// What a store holds besides the results proper.
#[derive(Debug, Clone, PartialEq)]
pub struct Stored {
    /// The results, runs sorted by scene, planner, repeat (names in byte order).
    pub results: Results,
    /// The resolved comparison.
    pub comparison: String,
    /// Where the resolved comparison expects each scene, in the order of `results.scenes`.
    pub scene_files: Vec<String>,
}

/// An open `runs.db`.
pub struct Store {
    path: PathBuf,
    db: Connection,
    schema: i64,
}

impl Store {
    /// Creates `folder/runs.db`, or fills it when it is empty, for a campaign without runs.
    pub fn create(folder: &Path, campaign: &Campaign, results: &Results) -> Result<Self, Error> {
        let path = folder.join(FILE);
        let fail = |source| Error::Store { path: path.clone(), source };
        let mut db = Connection::open(&path).map_err(fail)?;
        db.pragma_update(None, "journal_mode", "WAL").map_err(fail)?;
        // In WAL mode a crash of the program loses nothing; of the machine, at most the last runs.
        db.pragma_update(None, "synchronous", "NORMAL").map_err(fail)?;
        fill(&mut db, campaign, results).map_err(fail)?;
        Ok(Self { path, db, schema: SCHEMA })
    }

    /// Opens `folder/runs.db` for reading.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(FILE);
        let fail = |source| Error::Store { path: path.clone(), source };
        let foreign = |message: String| Error::Foreign { path: path.clone(), message };
        if !path.is_file() {
            return Err(foreign("no such file; expected the folder of a campaign".to_owned()));
        }
        let db = Connection::open_with_flags(&path, OpenFlags::SQLITE_OPEN_READ_WRITE).map_err(fail)?;
        let known = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name IN ('campaign', 'run')";
        let tables: i64 = db.query_row(known, [], |row| row.get(0)).map_err(fail)?;
        if tables != 2 {
            return Err(foreign("not a database of runs".to_owned()));
        }
        let schema: Option<i64> =
            db.query_row("SELECT schema FROM campaign", [], |row| row.get(0)).optional().map_err(fail)?;
        match schema {
            Some(schema @ FIRST..=SCHEMA) => Ok(Self { path, db, schema }),
            Some(other) => {
                Err(foreign(format!("schema version {other}; this program reads versions {FIRST} to {SCHEMA}")))
            }
            None => Err(foreign("a database of runs that was never begun".to_owned())),
        }
    }

    fn fail(&self) -> impl Fn(rusqlite::Error) -> Error + '_ {
        |source| Error::Store { path: self.path.clone(), source }
    }

    /// Adds a run, in one transaction.
    pub fn add(&mut self, run: &RunRecord) -> Result<(), Error> {
        insert(&self.db, run).map_err(self.fail())
    }

    /// Adds what planners looked like, all in one transaction.
    pub fn add_snapshots(&mut self, snapshots: &[Snapshot]) -> Result<(), Error> {
        add_snapshots(&mut self.db, snapshots).map_err(self.fail())
    }

    /// Notes that the campaign has ended.
    pub fn finish(&mut self, manifest: &Manifest) -> Result<(), Error> {
        let json = json(manifest);
        self.db.execute("UPDATE campaign SET manifest = ?1", params![json]).map_err(self.fail())?;
        Ok(())
    }

    /// Reads everything back.
    pub fn read(&self) -> Result<Stored, Error> {
        let foreign = |message: String| Error::Foreign { path: self.path.clone(), message };
        let stored = read(&self.db, self.schema).map_err(self.fail())?;
        stored.map_err(foreign)
    }
}

/// What tells a planner from the others of its group.
#[derive(Serialize, Deserialize)]
struct Variant {
    group: String,
    varied: String,
    budget: BudgetSpec,
}

fn json(value: &impl Serialize) -> String {
    serde_json::to_string(value).expect("plain data with string keys")
}

fn points(path: &[Point]) -> String {
    json(&path.iter().map(|p| [p.x, p.y]).collect::<Vec<_>>())
}

fn fill(db: &mut Connection, campaign: &Campaign, results: &Results) -> rusqlite::Result<()> {
    let comparison = &campaign.comparison;
    let tx = db.transaction()?;
    tx.execute_batch(TABLES)?;
    tx.execute(
        "INSERT INTO campaign VALUES (?1, ?2, ?3, ?4, ?5, ?6)",
        params![
            SCHEMA,
            results.name,
            results.seed as i64,
            results.repeats,
            comparison.to_toml(),
            json(&results.manifest)
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
    let files = comparison.scene_files();
    for (i, ((scene, arena), file)) in results.scenes.iter().zip(&campaign.arenas).zip(files).enumerate() {
        let Optimum { length, path, reason } = &scene.optimum;
        tx.execute(
            "INSERT INTO scene VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9)",
            params![
                i as i64,
                scene.scene.name,
                file,
                scene.scene.to_toml(),
                arena.compile_us,
                length,
                points(path),
                reason,
                scene.set.name()
            ],
        )?;
    }
    tx.commit()
}

fn insert(db: &Connection, run: &RunRecord) -> rusqlite::Result<()> {
    let progress: Vec<(u64, f64, f64)> = run.progress.iter().map(|p| (p.evaluations, p.time_us, p.cost)).collect();
    let mut statement = db.prepare_cached(
        "INSERT INTO run VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14, ?15, ?16, ?17, ?18,
         ?19, ?20, ?21)",
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
    ])?;
    Ok(())
}

fn add_snapshots(db: &mut Connection, snapshots: &[Snapshot]) -> rusqlite::Result<()> {
    let tx = db.transaction()?;
    for snapshot in snapshots {
        tx.prepare_cached("INSERT INTO snapshot (snapshot) VALUES (?1)")?.execute(params![json(snapshot)])?;
    }
    tx.commit()
}

/// The outer error is the database's, the inner one says which content makes no sense.
fn read(db: &Connection, schema: i64) -> rusqlite::Result<Result<Stored, String>> {
    fn path(json: &str) -> Result<Vec<Point>, String> {
        let points: Vec<[f64; 2]> = serde_json::from_str(json).map_err(|e| format!("a path: {e}"))?;
        Ok(points.into_iter().map(Point::from).collect())
    }
    fn collect<T>(
        rows: impl Iterator<Item = rusqlite::Result<Result<T, String>>>,
    ) -> rusqlite::Result<Result<Vec<T>, String>> {
        rows.collect::<rusqlite::Result<Vec<_>>>().map(|rows| rows.into_iter().collect())
    }

    let (name, seed, repeats, comparison, manifest): (String, i64, u32, String, String) =
        db.query_row("SELECT name, seed, repeats, comparison, manifest FROM campaign", [], |row| {
            Ok((row.get(0)?, row.get(1)?, row.get(2)?, row.get(3)?, row.get(4)?))
        })?;
    // What older versions lack.
    let (variant, role, overhead) =
        if schema < SCHEMA { ("NULL", "'test'", "NULL") } else { ("variant", "role", "overhead_us") };
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
        "SELECT file, toml, optimum_length, optimum_path, optimum_reason, {role} FROM scene ORDER BY position"
    ))?;
    let scenes = collect(statement.query_map([], |row| {
        let (file, toml, shortest): (String, String, String) = (row.get(0)?, row.get(1)?, row.get(3)?);
        let (length, reason, role): (_, _, String) = (row.get(2)?, row.get(4)?, row.get(5)?);
        Ok(Scene::from_toml(&file, &toml).map_err(|e| e.to_string()).and_then(|scene| {
            let set = SceneSet::from_name(&role).ok_or_else(|| format!("no set of scenes {role:?}"))?;
            Ok((file, SceneResult { scene, optimum: Optimum { length, path: path(&shortest)?, reason }, set }))
        }))
    })?)?;
    let added = if schema == FIRST { "NULL, '[]'" } else { "cost, terms" };
    let mut statement = db.prepare(&format!(
        "SELECT scene, planner, repeat, seed, status, valid, length, gap, clearance_min, turning, iterations,
         evaluations, collision_checks, time_us, cpu_us, error, path, progress, {added}, {overhead}
         FROM run ORDER BY scene, planner, repeat",
    ))?;
    let runs = collect(statement.query_map([], |row| {
        let (status, points, curve): (String, String, String) = (row.get(4)?, row.get(16)?, row.get(17)?);
        let terms: String = row.get(19)?;
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
        let mut parse = || {
            run.status = RunStatus::from_name(&status).ok_or_else(|| format!("no status {status:?}"))?;
            run.path = path(&points)?;
            let curve: Vec<(u64, f64, f64)> = serde_json::from_str(&curve).map_err(|e| format!("a curve: {e}"))?;
            let point = |(evaluations, time_us, cost)| Progress { evaluations, time_us, cost };
            run.progress = curve.into_iter().map(point).collect();
            run.terms = serde_json::from_str(&terms).map_err(|e| format!("terms: {e}"))?;
            Ok(())
        };
        Ok(parse().map(|()| run))
    })?)?;
    let mut snapshots = Ok(Vec::new());
    // The runs are whole without pictures, whichever way a database came to lack them.
    let pictures = "SELECT count(*) FROM sqlite_master WHERE type = 'table' AND name = 'snapshot'";
    if db.query_row(pictures, [], |row| row.get::<_, i64>(0))? == 1 {
        let mut statement = db.prepare("SELECT snapshot FROM snapshot ORDER BY position")?;
        snapshots = collect(statement.query_map([], |row| {
            let text: String = row.get(0)?;
            let snapshot = serde_json::from_str::<Snapshot>(&text).map_err(|e| e.to_string());
            let checked = snapshot.and_then(|s| s.check().map(|()| s));
            Ok(checked.map_err(|e| format!("a snapshot: {e}")))
        })?)?;
    }
    Ok((|| {
        let (scene_files, scenes) = scenes?.into_iter().unzip();
        let manifest = serde_json::from_str(&manifest).map_err(|e| format!("the manifest: {e}"))?;
        let (planners, runs, snapshots) = (planners?, runs?, snapshots?);
        let results = Results { name, seed: seed as u64, repeats, planners, scenes, runs, snapshots, manifest };
        Ok(Stored { results, comparison, scene_files })
    })())
}
