//! `runs.db`: the durable record of a campaign, from which everything else can be made again.
//!
//! An `SQLite` database in WAL mode, one transaction a run, so an interrupted campaign keeps
//! every run that ended. Paths and progress curves are JSON text
//! (`[[x, y], …]` and `[[evaluations, time_us, cost], …]`), and so are terms (`[[name, value], …]`),
//! snapshots ([`Snapshot`]), simulations, tunings and traces: readable from any language.

mod read;
mod write;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use env_model::Scene;
use rusqlite::{Connection, ErrorCode, OpenFlags, OptionalExtension};
use serde::{Deserialize, Serialize};

use crate::campaign::Campaign;
use crate::config::BudgetSpec;
use crate::error::Error;
use crate::results::{Manifest, MovingTrace, Results, RunRecord, RunStatus, Subject};
use crate::shell::quoted;
use crate::snapshot::Snapshot;
use read::Read;

/// The file's name in a campaign's folder.
pub const FILE: &str = "runs.db";
/// Version of the tables below.
const SCHEMA: i64 = 4;
/// The first version, which this program still reads: without `snapshot` and a run's `cost` and `terms`. The second
/// has them, and lacks a planner's `variant`, a scene's `role` and a run's `overhead_us`.
const FIRST: i64 = 1;
/// The first version with variants, roles and overheads. It knows paths alone: no `subject`, `protocol`, `simulation`,
/// `moving`, `tuning`, and no table `trace`.
const VARIANTS: i64 = 3;

const TABLES: &str = "
CREATE TABLE campaign (
    schema INTEGER NOT NULL,
    name TEXT NOT NULL,
    seed INTEGER NOT NULL,
    repeats INTEGER NOT NULL,
    comparison TEXT NOT NULL,          -- resolved, TOML
    manifest TEXT NOT NULL,            -- JSON; finished = '' while the campaign lasts
    subject TEXT NOT NULL,             -- paths, simulation or behaviour
    protocol TEXT NOT NULL             -- of behaviour, TOML
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
    role TEXT NOT NULL,                -- test or tuning
    simulation TEXT                    -- what moves, JSON
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
    moving TEXT,                       -- of a simulation, JSON
    tuning TEXT,                       -- of a behaviour, JSON
    PRIMARY KEY (scene, planner, repeat)
) WITHOUT ROWID;
CREATE TABLE snapshot (
    position INTEGER PRIMARY KEY,
    snapshot TEXT NOT NULL             -- JSON
);
CREATE TABLE trace (
    position INTEGER PRIMARY KEY,
    trace TEXT NOT NULL                -- JSON
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
    /// How long each scene took to compile, µs, in that order too.
    pub compile_us: Vec<f64>,
}

impl Stored {
    /// Scenes that are files beside the comparison, with those: none where scenes are settings.
    pub fn still_scenes(&self) -> impl Iterator<Item = (&str, &Scene)> {
        let all = self.scene_files.iter().zip(&self.results.scenes);
        let still = self.results.subject == Subject::Paths;
        all.filter(move |_| still).map(|(file, result)| (file.as_str(), &result.scene))
    }
}

/// How many runs of one planner in one scene ended in one way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Count {
    /// Name of the scene.
    pub scene: String,
    /// Label of the planner.
    pub planner: String,
    /// How they ended.
    pub status: RunStatus,
    /// How many.
    pub runs: usize,
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
        Self::write(folder, &campaign.stored(results))
    }

    /// Creates `folder/runs.db`, or fills it when it is empty, with all that is there, in one transaction.
    pub fn write(folder: &Path, stored: &Stored) -> Result<Self, Error> {
        let path = folder.join(FILE);
        let fail = |source| Error::Store { path: path.clone(), source };
        let mut db = Connection::open(&path).map_err(fail)?;
        db.pragma_update(None, "journal_mode", "WAL").map_err(fail)?;
        durable(&db).map_err(fail)?;
        write::fill(&mut db, stored).map_err(fail)?;
        Ok(Self { path, db, schema: SCHEMA })
    }

    /// Whether `folder/runs.db` was never begun: it is missing, empty, or a database without a table, which is what
    /// a campaign leaves that was killed before its first transaction.
    pub fn is_blank(folder: &Path) -> Result<bool, Error> {
        let path = folder.join(FILE);
        match path.metadata() {
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(true),
            Err(e) => return Err(Error::io("read", &path)(e)),
            Ok(file) if file.len() == 0 => return Ok(true),
            Ok(_) => {}
        }
        let fail = |source| Error::Store { path: path.clone(), source };
        let db = connect(&path)?;
        let tables = db.query_row("SELECT count(*) FROM sqlite_master", [], |row| row.get::<_, i64>(0));
        tables.map(|n| n == 0).map_err(fail)
    }

    /// Opens `folder/runs.db` for reading, also while another process writes.
    pub fn open(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(FILE);
        let fail = |source| Error::Store { path: path.clone(), source };
        let foreign = |message: String| Error::Foreign { path: path.clone(), message };
        if !path.is_file() {
            return Err(foreign("no such file; expected the folder of a campaign".to_owned()));
        }
        let db = connect(&path)?;
        if Self::is_blank(folder)? {
            let message = "empty: a campaign that is just beginning, or never began; \
                to begin it, name the comparison: touchline run COMPARISON --resume --out";
            return Err(foreign(format!("{message} {}", quoted(&folder.display().to_string()))));
        }
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

    /// Opens `folder/runs.db` to go on with its campaign: `manifest` takes the place of the one that is there.
    pub fn resume(folder: &Path, manifest: &Manifest) -> Result<Self, Error> {
        let store = Self::open(folder)?;
        if store.schema < SCHEMA {
            let message = format!("schema version {}; only version {SCHEMA} can be added to", store.schema);
            return Err(Error::Foreign { path: store.path, message });
        }
        durable(&store.db).map_err(store.fail())?;
        store.finish(manifest)?;
        Ok(store)
    }

    fn fail(&self) -> impl Fn(rusqlite::Error) -> Error + '_ {
        |source| Error::Store { path: self.path.clone(), source }
    }

    fn sense<T>(&self, read: Read<T>) -> Result<T, Error> {
        let foreign = |message: String| Error::Foreign { path: self.path.clone(), message };
        read.map_err(self.fail())?.map_err(foreign)
    }

    /// Adds a run, in one transaction.
    pub fn add(&mut self, run: &RunRecord) -> Result<(), Error> {
        write::insert(&self.db, run).map_err(self.fail())
    }

    /// Puts what planners looked like in the place of what is there, all in one transaction.
    pub fn add_snapshots(&mut self, snapshots: &[Snapshot]) -> Result<(), Error> {
        write::replace_snapshots(&mut self.db, snapshots).map_err(self.fail())
    }

    /// Keeps the simulations to look at, in place of those that are there.
    pub fn add_traces(&mut self, traces: &[MovingTrace]) -> Result<(), Error> {
        write::replace_traces(&mut self.db, traces).map_err(self.fail())
    }

    /// Notes that the campaign has ended, or goes on: what `manifest` says.
    pub fn finish(&self, manifest: &Manifest) -> Result<(), Error> {
        write::set_manifest(&self.db, manifest).map_err(self.fail())
    }

    /// Seconds from `then`, RFC 3339 in UTC, until now.
    pub fn seconds_since(&self, then: &str) -> Result<f64, Error> {
        let seconds = self.db.query_row("SELECT unixepoch('now') - unixepoch(?1)", [then], |row| row.get(0));
        seconds.map_err(self.fail())
    }

    /// Reads everything back.
    pub fn read(&self) -> Result<Stored, Error> {
        // One moment of a campaign that lasts.
        let moment = self.db.unchecked_transaction().map_err(self.fail())?;
        let mut stored = self.head()?;
        stored.results.runs = self.sense(read::runs(&self.db, self.schema))?;
        stored.results.snapshots = self.sense(read::snapshots(&self.db))?;
        stored.results.traces = self.sense(read::traces(&self.db, self.schema))?;
        drop(moment);
        Ok(stored)
    }

    /// Reads everything back but runs, snapshots and traces.
    pub fn head(&self) -> Result<Stored, Error> {
        self.sense(read::head(&self.db, self.schema))
    }

    /// Which runs there are, as (scene, planner, repeat).
    pub fn keys(&self) -> Result<BTreeSet<(String, String, u32)>, Error> {
        read::keys(&self.db).map_err(self.fail())
    }

    /// How many runs of every scene and planner ended how, sorted.
    pub fn counts(&self) -> Result<Vec<Count>, Error> {
        self.sense(read::counts(&self.db))
    }
}

/// In WAL mode a crash of the program loses nothing; of the machine, at most the last runs.
fn durable(db: &Connection) -> rusqlite::Result<()> {
    db.pragma_update(None, "synchronous", "NORMAL")
}

/// A connection to a database that is there. In a place that cannot be written to, `SQLite` reads a WAL database only
/// when told that nobody else writes it; with a log still beside it, that would hide the last runs.
fn connect(path: &Path) -> Result<Connection, Error> {
    let fail = |source| Error::Store { path: path.to_owned(), source };
    let db = Connection::open_with_flags(path, OpenFlags::SQLITE_OPEN_READ_WRITE).map_err(fail)?;
    let tried = db.query_row("SELECT count(*) FROM sqlite_master", [], |row| row.get::<_, i64>(0));
    let mut log = path.as_os_str().to_owned();
    log.push("-wal");
    match tried {
        Err(e) if matches!(e.sqlite_error_code(), Some(ErrorCode::CannotOpen | ErrorCode::ReadOnly)) => {
            if Path::new(&log).exists() {
                let message = format!(
                    "{e}: its last runs are still in {FILE}-wal, which can only be read where {FILE}-shm can be \
                     written; expected a folder that can be written into, such as a copy"
                );
                return Err(Error::Foreign { path: path.to_owned(), message });
            }
            let escaped: String =
                path.display().to_string().replace('%', "%25").replace('?', "%3f").replace('#', "%23");
            let flags = OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI;
            Connection::open_with_flags(format!("file:{escaped}?immutable=1"), flags).map_err(fail)
        }
        other => other.map(|_| db).map_err(fail),
    }
}

/// What tells a planner from the others of its group.
#[derive(Serialize, Deserialize)]
struct Variant {
    group: String,
    varied: String,
    budget: BudgetSpec,
}
