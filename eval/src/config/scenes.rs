//! The `scenes` of a comparison: files, generators, match logs, grid maps.

use env_model::generate::{Generator, Request};
use env_model::source::Source;
use env_model::{FileError, Scene};
use serde::Deserialize;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{Files, SceneEntry, from_table, logs, movingai};
use crate::results::SceneSet;

const EXPECTED: &str = "a path or { generate = \"wall\", count = 20, obstacles = 21, seed = 2 }, \
    { rcg = \"game.rcg.gz\", cycles = [120], side = \"left\" }, \
    { ssl-log = \"game.log.gz\", frames = [10], team = \"blue\", robot = 3 }, \
    { movingai = \"arena.map.scen\", count = 10 }";
/// More would be a slip of the pen.
const MOST: u32 = 100_000;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Generated {
    generate: Spanned<String>,
    count: Option<Spanned<u32>>,
    obstacles: Option<usize>,
    /// Of the generator, not of the runs. Default 1.
    seed: Option<u64>,
}

pub(super) fn read(
    source: &Source<'_>,
    sets: [(SceneSet, Option<Spanned<DeValue<'_>>>); 2],
    files: &dyn Files,
) -> Result<(Vec<SceneEntry>, Vec<String>), FileError> {
    let (mut scenes, mut notes) = (Vec::new(), Vec::new());
    for (set, value) in sets {
        if let Some(value) = value {
            read_set(source, set, value, files, &mut scenes, &mut notes)?;
        }
    }
    Ok((scenes, notes))
}

fn read_set(
    source: &Source<'_>,
    set: SceneSet,
    value: Spanned<DeValue<'_>>,
    files: &dyn Files,
    scenes: &mut Vec<SceneEntry>,
    notes: &mut Vec<String>,
) -> Result<(), FileError> {
    let span = value.span();
    let entries = match value.into_inner() {
        DeValue::Array(entries) => entries,
        other => return Err(source.error_at(span, format!("found {}; expected an array of scenes", other.type_str()))),
    };
    if entries.is_empty() {
        return Err(source.error_at(span, format!("an empty comparison: no scenes; expected {EXPECTED}")));
    }
    for entry in entries {
        let span = entry.span();
        let new = match entry.into_inner() {
            DeValue::String(path) => vec![from_file(source, &path, span.clone(), files)?],
            DeValue::Table(table) => {
                let table = Spanned::new(span.clone(), table);
                match logs::read(source, &table, files)? {
                    Some(imported) => {
                        notes.extend(imported.notes);
                        imported.scenes
                    }
                    None if table.get_ref().contains_key("generate") => generated(source, table)?,
                    None if table.get_ref().contains_key("movingai") => {
                        let (imported, more) = movingai::read(source, table, files)?;
                        notes.extend(more);
                        imported
                    }
                    None => {
                        let message = format!("none of generate, rcg, ssl-log and movingai; expected {EXPECTED}");
                        return Err(source.error_at(span, message));
                    }
                }
            }
            other => return Err(source.error_at(span, format!("found {}; expected {EXPECTED}", other.type_str()))),
        };
        for scene in new {
            if let Err(message) = refuse_motion(&scene) {
                return Err(source.error_at(span, message));
            }
            if scenes.iter().any(|s| s.scene.name == scene.name) {
                let message = format!("a second scene named {:?}; expected different names", scene.name);
                return Err(source.error_at(span, message));
            }
            // Under another name it would be tested on what it was tuned for.
            let renamed = |other: &Scene| Scene { name: scene.name.clone(), ..other.clone() } == scene;
            if let Some(twin) = scenes.iter().find(|s| s.set != set && renamed(&s.scene)) {
                let message = format!(
                    "scene {:?} of the tuning set is {:?} of the test set under another name; expected scenes of one set",
                    scene.name, twin.scene.name
                );
                return Err(source.error_at(span, message));
            }
            scenes.push(SceneEntry { scene, set, simulation: None });
        }
    }
    Ok(())
}

fn from_file(
    source: &Source<'_>,
    path: &str,
    span: std::ops::Range<usize>,
    files: &dyn Files,
) -> Result<Scene, FileError> {
    let (name, text) = files.read(path).map_err(|e| source.error_at(span, format!("{e}; expected a scene file")))?;
    Scene::from_toml(&name, &text)
}

fn generated(source: &Source<'_>, table: Spanned<DeTable<'_>>) -> Result<Vec<Scene>, FileError> {
    let span = table.span();
    let request: Generated = from_table(source, table)?;
    let name = request.generate.get_ref();
    let generator = Generator::from_name(name).map_err(|e| source.error_at(request.generate.span(), e.to_string()))?;
    let count = request.count.map_or(Ok(1), |count| match *count.get_ref() {
        n @ 1..=MOST => Ok(n),
        n => Err(source.error_at(count.span(), format!("count = {n}; expected 1 to {MOST}"))),
    })?;
    let request = Request { generator, count, obstacles: request.obstacles, seed: request.seed.unwrap_or(1) };
    request.scenes().collect::<Result<_, _>>().map_err(|e| source.error_at(span, e.to_string()))
}

/// Static comparisons want obstacles at rest.
pub fn refuse_motion(scene: &Scene) -> Result<(), String> {
    let moving = scene.obstacles.iter().position(|o| o.velocity.is_some_and(|v| v != [0.0, 0.0]));
    moving.map_or(Ok(()), |index| {
        let velocity = scene.obstacles[index].velocity.unwrap_or_default();
        Err(format!(
            "scene {:?}: {} moves with velocity [{}, {}]; expected obstacles at rest",
            scene.name,
            scene.describe(index),
            velocity[0],
            velocity[1]
        ))
    })
}
