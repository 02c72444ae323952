//! The `[simulation]` table of a comparison, and the moving scenes that it begins.
//!
//! ```toml
//! scenes = [{ play = "circle-swap" }, { play = "crossing", opponents = 6, name = "busy" }]
//!
//! [simulation]                      # common to all scenes; keys of strategy::Settings
//! robots = 8
//! duration_s = 12.0
//! ```
//!
//! `play` in `[simulation]` and no `scenes` is one scene.

use env_model::source::{Key, Source, span_of};
use env_model::{FileError, Scene};
use strategy::Settings;
use strategy::league::ROBOT_RADIUS;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{SceneEntry, from_table, table_of};
use crate::results::SceneSet;

const EXPECTED: &str = "a moving scene such as { play = \"circle-swap\", robots = 8 }";

/// The moving scenes of a comparison; `common` is its table `[simulation]`.
pub(super) fn read(
    source: &Source<'_>,
    common: Spanned<DeValue<'_>>,
    sets: [(SceneSet, Option<Spanned<DeValue<'_>>>); 2],
) -> Result<Vec<SceneEntry>, FileError> {
    let common = table_of(source, common, "a table [simulation]")?;
    let mut scenes: Vec<SceneEntry> = Vec::new();
    let mut add = |entry: SceneEntry, span| match scenes.iter().any(|s| s.scene.name == entry.scene.name) {
        true => Err(source.error_at(
            span,
            format!("a second scene named {:?}; expected different names: name = \"…\"", entry.scene.name),
        )),
        false => {
            scenes.push(entry);
            Ok(())
        }
    };
    let [(_, tests), _] = &sets;
    if tests.is_none() {
        let span = common.span();
        add(scene(source, SceneSet::Test, &common, Spanned::new(span.clone(), DeTable::new()))?, span)?;
    }
    for (set, value) in sets {
        let Some(value) = value else { continue };
        let span = value.span();
        let entries = match value.into_inner() {
            DeValue::Array(entries) if !entries.is_empty() => entries,
            _ => return Err(source.error_at(span, format!("expected an array of one or more, each {EXPECTED}"))),
        };
        for entry in entries {
            let span = entry.span();
            let own = table_of(source, entry, &format!("{EXPECTED}, for there is a table [simulation]"))?;
            add(scene(source, set, &common, own)?, span)?;
        }
    }
    Ok(scenes)
}

/// The scene of the table `own`, whose keys take the place of those of `common`.
fn scene<'i>(
    source: &Source<'_>,
    set: SceneSet,
    common: &Spanned<DeTable<'i>>,
    own: Spanned<DeTable<'i>>,
) -> Result<SceneEntry, FileError> {
    let at = own.span();
    let mut keys = common.get_ref().clone();
    keys.extend(own.into_inner());
    let name = keys.remove("name");
    if !keys.contains_key("play") {
        return Err(source.error_at(at, format!("a scene without play; expected {EXPECTED}")));
    }
    let table = Spanned::new(at.clone(), keys);
    let settings: Settings = from_table(source, table.clone())?;
    settings.validate().map_err(|e| {
        let path: Vec<Key<'_>> = e.key.split('.').map(Key::Name).collect();
        source.error_at(span_of(&table, &path), e.to_string())
    })?;
    for (index, swap) in settings.swap.iter().enumerate() {
        planner_catalogue::build_controller_str(&swap.planner, &swap.settings.to_string()).map_err(|e| {
            let place = span_of(&table, &[Key::Name("swap"), Key::Index(index), Key::Name("planner")]);
            source.error_at(place, format!("planner {:?}: {e}", swap.planner))
        })?;
    }
    let name = match name {
        None => usual_name(&settings),
        Some(name) => match name.get_ref() {
            DeValue::String(text) if super::is_folder_name(text) => text.to_string(),
            _ => {
                let expected = "name: expected text of letters, digits, spaces and . _ -";
                return Err(source.error_at(name.span(), expected));
            }
        },
    };
    Ok(SceneEntry { scene: stand_in(&name, &settings), set, simulation: Some(settings) })
}

/// `circle-swap-8`, or `attack-6v6` with opponents.
fn usual_name(settings: &Settings) -> String {
    let Settings { robots, opponents, .. } = settings;
    let against = if *opponents > 0 { format!("v{opponents}") } else { String::new() };
    format!("{}-{robots}{against}", play_name(settings))
}

/// What configurations call the play.
pub fn play_name(settings: &Settings) -> String {
    let value = toml::Value::try_from(settings.play);
    value.ok().and_then(|v| v.as_str().map(str::to_owned)).unwrap_or_default()
}

/// A still scene that stands for the field of a moving one.
fn stand_in(name: &str, settings: &Settings) -> Scene {
    Scene {
        name: name.to_owned(),
        unit: "m".into(),
        robot_radius: ROBOT_RADIUS,
        start: [-1.0, 0.0],
        goal: [1.0, 0.0],
        field: Some(settings.league.field()),
        obstacles: Vec::new(),
    }
}

/// The scene as an entry of `scenes` that says everything.
pub(super) fn to_toml(name: &str, settings: &Settings) -> String {
    let mut table = toml::Table::from_iter([("name".to_owned(), name.into())]);
    table.extend(toml::Table::try_from(settings).expect("validated settings have a place in TOML"));
    toml::Value::Table(table).to_string()
}
