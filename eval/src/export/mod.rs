//! Everything that a campaign leaves besides `runs.db`, made from the stored runs alone.

mod csv;
mod ioh;
mod json;
mod moving;
mod ompl;

use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::report::{self, Language};
use crate::results::Subject;
use crate::store::Stored;

pub use csv::{RUN_COLUMNS, SUMMARY_COLUMNS, runs_csv, summaries, summary_csv};
pub use json::{manifest_json, paths_jsonl, results_json};
pub use moving::{parameters_csv, simulation_columns, simulations_csv, traces_jsonl, tuning_csv};

/// What to export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formats {
    /// `report.html`.
    pub html: bool,
    /// `runs.csv` and `summary.csv`; of moving scenes `simulations.csv`, of behaviour `tuning.csv` and `parameters.csv`.
    pub csv: bool,
    /// `paths.jsonl` and `manifest.json`; of moving scenes `traces.jsonl`.
    pub json: bool,
    /// `results.json` with its schema: the same and everything else in one document.
    pub document: bool,
    /// `ompl/SCENE.log`.
    pub ompl: bool,
    /// `ioh.csv`.
    pub ioh: bool,
    /// `comparison.toml` and its scenes.
    pub toml: bool,
}

impl Formats {
    /// None of them.
    pub const NONE: Self =
        Self { html: false, csv: false, json: false, document: false, ompl: false, ioh: false, toml: false };
    /// What every campaign leaves. What is only for other programs, and large, is made when it is asked for.
    pub const OWN: Self = Self { html: true, csv: true, json: true, toml: true, ..Self::NONE };
}

/// Writes a file whole or not at all: who reads it, or is left with it by a kill, never has half of it.
fn put(path: &Path, text: &str) -> Result<(), Error> {
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let written = fs::write(&part, text).and_then(|()| fs::rename(&part, path));
    written.inspect_err(|_| drop(fs::remove_file(&part))).map_err(Error::io("write", path))
}

/// Whether `folder` holds the exports of what is stored, [`Formats::OWN`]: the manifest, which is written last, and
/// all others.
pub fn are_made(folder: &Path, stored: &Stored) -> bool {
    let files = ["runs.csv", "summary.csv", "comparison.toml", "report.html"];
    let more: &[&str] = match stored.results.subject {
        Subject::Paths => &["paths.jsonl"],
        Subject::Simulation => &["simulations.csv", "traces.jsonl"],
        Subject::Behaviour => &["tuning.csv", "parameters.csv"],
    };
    let scenes = more.iter().copied().chain(stored.still_scenes().map(|(file, _)| file));
    let manifest = fs::read_to_string(folder.join("manifest.json"));
    manifest.is_ok_and(|text| text == manifest_json(&stored.results))
        && files.into_iter().chain(scenes).all(|file| folder.join(file).is_file())
}

/// Writes the exports into `folder`.
pub fn write(folder: &Path, stored: &Stored, formats: Formats, language: Language) -> Result<(), Error> {
    let results = &stored.results;
    let put = |name: &str, text: &str| put(&folder.join(name), text);
    let create = |name: &str| {
        let path = folder.join(name);
        fs::create_dir_all(&path).map_err(Error::io("create", &path))
    };
    if formats.csv {
        put("runs.csv", &runs_csv(results))?;
        put("summary.csv", &summary_csv(results))?;
        match results.subject {
            Subject::Paths => {}
            Subject::Simulation => put("simulations.csv", &simulations_csv(results))?,
            Subject::Behaviour => {
                put("tuning.csv", &tuning_csv(results))?;
                put("parameters.csv", &parameters_csv(results))?;
            }
        }
    }
    if formats.json {
        match results.subject {
            Subject::Paths => put("paths.jsonl", &paths_jsonl(results))?,
            Subject::Simulation => put("traces.jsonl", &traces_jsonl(results))?,
            Subject::Behaviour => {}
        }
    }
    if formats.document {
        put("results.json", &results_json(results))?;
        put("results.schema.json", json::SCHEMA)?;
    }
    if formats.ioh {
        put("ioh.csv", &ioh::csv(results))?;
    }
    if formats.ompl {
        create("ompl")?;
        for (name, log) in ompl::logs(results, &stored.comparison) {
            put(&format!("ompl/{name}.log"), &log)?;
        }
    }
    if formats.toml {
        for (file, scene) in stored.still_scenes() {
            create("scenes")?;
            put(file, &scene.to_toml())?;
        }
        put("comparison.toml", &stored.comparison)?;
    }
    if formats.html {
        put("report.html", &report::html(results, language))?;
    }
    // Last: it stands for all of them.
    if formats.json {
        put("manifest.json", &manifest_json(results))?;
    }
    Ok(())
}

#[cfg(test)]
mod tests;
