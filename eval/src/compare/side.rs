//! One side of a comparison: the runs of a campaign's folder or of a `runs.csv`.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::export;
use crate::metrics::MOVING;
use crate::results::{Results, SceneSet};
use crate::store::{self, Store};

/// Columns that depend on the machine and the moment.
const TIMES: [&str; 3] = ["time_us", "cpu_us", "overhead_us"];

/// Scene, planner and repeat.
pub type Key = (String, String, u32);

/// What is compared of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// Its seed.
    pub seed: u64,
    /// The judge's verdict.
    pub valid: bool,
    /// Length of the path.
    pub length: Option<f64>,
    /// length/optimum − 1.
    pub gap: Option<f64>,
    /// The scene's optimum.
    pub optimum: Option<f64>,
    /// Wall time, µs, if it is told.
    pub time_us: Option<f64>,
    /// Every column but times, by name.
    pub counts: BTreeMap<String, String>,
}

impl Run {
    /// Whether a column that both have differs, but for times. Newer programs write more columns.
    pub fn differs(&self, other: &Self) -> bool {
        self.counts.iter().any(|(column, text)| other.counts.get(column).is_some_and(|theirs| theirs != text))
    }

    /// Whether its scene is one on which settings were chosen.
    pub fn tuning(&self) -> bool {
        self.counts.get("set").is_some_and(|set| set == SceneSet::Tuning.name())
    }

    /// The run's gap, or its length; +∞ without a valid path.
    pub fn quality(&self, gap: bool) -> f64 {
        let value = if gap { self.gap } else { self.length };
        value.filter(|_| self.valid).unwrap_or(f64::INFINITY)
    }
}

/// The runs of one campaign.
#[derive(Debug, Clone, PartialEq)]
pub struct Side {
    /// The folder or file as the user named it.
    pub name: String,
    /// Its runs.
    pub runs: BTreeMap<Key, Run>,
    /// Where and how times were taken, if it is told.
    pub machine: Option<String>,
}

impl Side {
    /// Reads a campaign's folder, or a file like its `runs.csv`, in which the time columns may be missing.
    ///
    /// # Errors
    /// What cannot be read, or is no such table, with the line.
    pub fn read(path: &Path) -> Result<Self, Error> {
        let name = path.display().to_string();
        if path.join(store::FILE).is_file() {
            let results = Store::open(path)?.read()?.results;
            let manifest = &results.manifest;
            let machine = format!("{} build, {} jobs, {}", manifest.profile, manifest.jobs, manifest.cpu);
            let mut side = Self { machine: Some(machine), ..Self::from_csv(&name, &export::runs_csv(&results))? };
            side.add_moving(&results);
            return Ok(side);
        }
        let file = if path.is_dir() { path.join("runs.csv") } else { path.to_owned() };
        let text = fs::read_to_string(&file).map_err(Error::io("read", &file))?;
        Self::from_csv(&file.display().to_string(), &text)
    }

    /// Reads a `runs.csv`, which messages call `name`.
    ///
    /// # Errors
    /// As [`Side::read`].
    pub fn from_csv(name: &str, text: &str) -> Result<Self, Error> {
        let foreign = |message: String| Error::Foreign { path: name.into(), message };
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().map_err(|e| foreign(e.to_string()))?.clone();
        for column in ["scene", "planner", "repeat", "seed", "valid", "length"] {
            if !header.iter().any(|h| h == column) {
                return Err(foreign(format!("no column {column}; expected a runs.csv")));
            }
        }
        let mut runs = BTreeMap::new();
        for row in reader.records() {
            let row = row.map_err(|e| foreign(e.to_string()))?;
            let line = row.position().map_or(0, csv::Position::line);
            let at = |message: String| foreign(format!("line {line}: {message}"));
            let cells: BTreeMap<&str, &str> = header.iter().zip(row.iter()).collect();
            let cell = |column: &str| cells.get(column).copied().unwrap_or_default();
            let wrong =
                |column: &str, expected: &str| at(format!("{column} is {:?}; expected {expected}", cell(column)));
            let number = |column: &'static str| match cell(column) {
                "" => Ok(None),
                text => match text.parse() {
                    Ok(number) if f64::is_finite(number) => Ok(Some(number)),
                    _ => Err(wrong(column, "a finite number, or nothing where there is none")),
                },
            };
            let run = Run {
                seed: cell("seed").parse().map_err(|_| wrong("seed", "a whole number"))?,
                valid: cell("valid").parse().map_err(|_| wrong("valid", "true or false"))?,
                length: number("length")?,
                gap: number("gap")?,
                optimum: number("optimum")?,
                time_us: number("time_us")?,
                counts: cells
                    .iter()
                    .filter(|(column, _)| !TIMES.contains(column))
                    .map(|(column, text)| ((*column).to_owned(), (*text).to_owned()))
                    .collect(),
            };
            let repeat = cell("repeat").parse().map_err(|_| wrong("repeat", "a whole number"))?;
            let key = (cell("scene").to_owned(), cell("planner").to_owned(), repeat);
            if runs.insert(key.clone(), run).is_some() {
                return Err(at(format!("a second run {repeat} of {} in {}", key.1, key.0)));
            }
        }
        Ok(Self { name: name.to_owned(), runs, machine: None })
    }

    /// What simulations were measured to be, all but times.
    fn add_moving(&mut self, results: &Results) {
        for record in &results.runs {
            let key = (record.scene.clone(), record.planner.clone(), record.repeat);
            if let (Some(moving), Some(run)) = (&record.moving, self.runs.get_mut(&key)) {
                let repeating = MOVING.iter().filter(|metric| !metric.is_timing);
                let text = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
                run.counts.extend(repeating.map(|m| (format!("moving {}", m.metric.name), text((m.value)(moving)))));
            }
        }
    }

    /// Its planners.
    pub fn planners(&self) -> BTreeSet<&str> {
        self.runs.keys().map(|(_, planner, _)| &planner[..]).collect()
    }

    /// Its scenes.
    pub fn scenes(&self) -> BTreeSet<&str> {
        self.runs.keys().map(|(scene, ..)| &scene[..]).collect()
    }

    /// Its planners and scenes in a few words.
    pub fn describe(&self) -> String {
        let few = |names: BTreeSet<&str>| {
            let listed: Vec<&str> = names.iter().copied().take(5).collect();
            let more = if names.len() > 5 { ", …" } else { "" };
            format!("{}{more}", listed.join(", "))
        };
        match self.runs.len() {
            0 => "no runs".to_owned(),
            _ => format!("{} in {}", few(self.planners()), few(self.scenes())),
        }
    }
}
