//! Everything that a campaign leaves besides `runs.db`, made from the stored runs alone.

mod csv;
mod ioh;
mod json;
mod ompl;

use std::fs;
use std::path::Path;

use crate::error::Error;
use crate::report::{self, Language};
use crate::store::Stored;

pub use csv::{RUN_COLUMNS, SUMMARY_COLUMNS, runs_csv, summaries, summary_csv};
pub use json::{manifest_json, paths_jsonl, results_json};

/// What to export.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Formats {
    /// `report.html`.
    pub html: bool,
    /// `runs.csv` and `summary.csv`.
    pub csv: bool,
    /// `paths.jsonl` and `manifest.json`.
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
    let files = ["runs.csv", "summary.csv", "paths.jsonl", "comparison.toml", "report.html"];
    let scenes = stored.scene_files.iter().map(String::as_str);
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
    }
    if formats.json {
        put("paths.jsonl", &paths_jsonl(results))?;
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
        create("scenes")?;
        for (file, scene) in stored.scene_files.iter().zip(&results.scenes) {
            put(file, &scene.scene.to_toml())?;
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
