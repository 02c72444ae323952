//! `touchline check`.

use std::path::Path;
use std::process::ExitCode;

use env_model::Scene;

use super::{CheckArgs, say};
use crate::config::{Comparison, Disk};
use crate::error::Error;

pub(super) fn check(args: &CheckArgs) -> Result<ExitCode, Error> {
    let mut code = ExitCode::SUCCESS;
    for file in &args.files {
        match check_one(file) {
            Ok(what) => say(format!("ok: {}: {what}", file.display())),
            Err(error) => {
                eprintln!("error: {error}");
                code = ExitCode::from(2);
            }
        }
    }
    Ok(code)
}

fn check_one(file: &Path) -> Result<String, Error> {
    let text = std::fs::read_to_string(file).map_err(Error::io("read", file))?;
    let path = file.display().to_string();
    // A comparison is told by a key that scenes lack; what is neither is read as a scene.
    let is_comparison = toml::from_str::<toml::Table>(&text)
        .is_ok_and(|t| ["planner", "scenes", "repeats", "budget"].iter().any(|key| t.contains_key(*key)));
    if is_comparison {
        let comparison = Comparison::from_toml(&path, &text, &Disk::beside(file))?;
        let Comparison { name, repeats, scenes, planners, notes, .. } = &comparison;
        notes.iter().for_each(|note| eprintln!("note: {note}"));
        Ok(format!("comparison {name}, {} planners, {} scenes, {repeats} repeats", planners.len(), scenes.len()))
    } else {
        let scene = Scene::from_toml(&path, &text)?;
        Ok(format!("scene {}, {} obstacles", scene.name, scene.obstacles.len()))
    }
}
