//! `touchline check`.

use std::path::Path;
use std::process::ExitCode;

use env_model::Scene;
use toml::de::DeTable;

use super::{CheckArgs, say, warn};
use crate::campaign::Arena;
use crate::config::{Comparison, Disk};
use crate::error::Error;
use crate::results::{Optimum, Subject};

pub(super) fn check(args: &CheckArgs) -> Result<ExitCode, Error> {
    let mut code = ExitCode::SUCCESS;
    for file in &args.files {
        match check_one(file, args.optimum) {
            Ok(what) => say(format!("ok: {}: {what}", file.display())),
            Err(error) => {
                warn(format_args!("error: {error}"));
                code = ExitCode::from(2);
            }
        }
    }
    Ok(code)
}

fn check_one(file: &Path, optimum: bool) -> Result<String, Error> {
    let text = std::fs::read_to_string(file).map_err(Error::io("read", file))?;
    let path = file.display().to_string();
    if is_comparison(&text) {
        let comparison = Comparison::from_toml(&path, &text, &Disk::beside(file))?;
        let Comparison { name, repeats, scenes, planners, notes, .. } = &comparison;
        notes.iter().for_each(|note| warn(format_args!("note: {note}")));
        if optimum && comparison.subject == Subject::Paths {
            scenes.iter().try_for_each(|entry| say_optimum(&entry.scene))?;
        }
        Ok(format!("comparison {name}, {} planners, {} scenes, {repeats} repeats", planners.len(), scenes.len()))
    } else {
        let scene = Scene::from_toml(&path, &text)?;
        if optimum {
            say_optimum(&scene)?;
        }
        Ok(format!("scene {}, {} obstacles", scene.name, scene.obstacles.len()))
    }
}

/// The exact shortest length, or why there is none.
fn say_optimum(scene: &Scene) -> Result<(), Error> {
    let arena = Arena::new(scene.clone()).map_err(|e| Error::Usage(e.to_string()))?;
    let Optimum { length, reason, .. } = arena.result(Subject::Paths).optimum;
    let found = length.map_or_else(|| reason.unwrap_or_default(), |length| format!("{length:.8} {}", scene.unit));
    say(format!("{}: exact optimum {found}", scene.name));
    Ok(())
}

/// A comparison is told by a key that scenes lack; what is neither is read as a scene.
fn is_comparison(text: &str) -> bool {
    // Parsed as comparisons are: a table of values would refuse integers above i64.
    let keys = ["planner", "scenes", "repeats", "budget", "simulation", "behaviour"];
    DeTable::parse(text).is_ok_and(|table| keys.iter().any(|key| table.get_ref().contains_key(*key)))
}

#[cfg(test)]
mod tests {
    use super::is_comparison;

    #[test]
    fn comparisons_are_told_by_their_keys() {
        assert!(is_comparison("scenes = [{ rcg = \"a.rcg\", cycles = [18446744073709551615] }]"));
        assert!(is_comparison("[planner.pso]"));
        assert!(!is_comparison("name = \"a\"\nstart = [0, 0]"));
        assert!(!is_comparison("repeats = "));
    }
}
