//! The `[behaviour]` table of a comparison: parameters of behaviour control, given or tuned (Fang 2009, chapter 5).
//!
//! ```toml
//! [behaviour]                       # keys of planner_behaviour::Protocol
//! robots = 4
//!
//! [planner.published]
//! kind = "behaviour"                # the published parameters, unless `parameters` says others
//! [planner.tuned]
//! kind = "behaviour"
//! tune = { coding = "binary" }      # keys of planner_behaviour::Tuning; a budget is the search's
//! ```

use std::ops::Range;

use env_model::scene::Field;
use env_model::source::{Key, Source, span_of};
use env_model::{FileError, Scene};
use planner_api::SettingError;
use planner_behaviour::{Parameters, Protocol, Tuning};
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::planners::Maker;
use super::{SceneEntry, from_table, table_of};
use crate::results::SceneSet;

/// The keys of a planner's table, reserved ones aside.
#[derive(Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    #[serde(skip_serializing_if = "Option::is_none")]
    parameters: Option<Parameters>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tune: Option<Tuning>,
}

/// The protocol of the table `[behaviour]`.
pub(super) fn protocol(source: &Source<'_>, value: Spanned<DeValue<'_>>) -> Result<Protocol, FileError> {
    let table = table_of(source, value, "a table [behaviour]")?;
    let protocol: Protocol = from_table(source, table.clone())?;
    protocol.validate().map_err(|e| setting(source, &table, &[], &e))?;
    Ok(protocol)
}

/// Who plans by a planner's `table`, and its settings in full.
pub(super) fn planner(
    source: &Source<'_>,
    kind: &str,
    kind_at: Range<usize>,
    table: &Spanned<DeTable<'_>>,
) -> Result<(Maker, toml::Table), FileError> {
    if kind != "behaviour" {
        let message = format!("planner {kind:?} beside a table [behaviour]; expected kind = \"behaviour\"");
        return Err(source.error_at(kind_at, message));
    }
    let keys: Keys = from_table(source, table.clone())?;
    let keys = match keys {
        Keys { parameters: Some(_), tune: Some(_) } => {
            let at = span_of(table, &[Key::Name("parameters")]);
            return Err(source.error_at(at, "parameters beside tune, which searches them; expected one of the two"));
        }
        Keys { parameters, tune: None } => Keys { parameters: Some(parameters.unwrap_or_default()), tune: None },
        tuned => tuned,
    };
    let written = toml::Table::try_from(&keys).expect("plain numbers and words");
    let maker = match keys {
        Keys { tune: Some(tuning), .. } => {
            tuning.validate().map_err(|e| setting(source, table, &["tune"], &e))?;
            Maker::Tuning(tuning)
        }
        Keys { parameters, .. } => {
            let parameters = parameters.unwrap_or_default();
            parameters.validate().map_err(|e| setting(source, table, &["parameters"], &e))?;
            Maker::Parameters(parameters)
        }
    };
    Ok((maker, written))
}

fn setting(source: &Source<'_>, table: &Spanned<DeTable<'_>>, within: &[&str], error: &SettingError) -> FileError {
    let keys: Vec<Key<'_>> = within.iter().copied().chain([error.key]).map(Key::Name).collect();
    source.error_at(span_of(table, &keys), error.to_string())
}

/// What stands for the held-out scenarios of all runs.
pub(super) fn stand_in(protocol: &Protocol) -> SceneEntry {
    let [x, y] = protocol.field.map(|side| 0.5 * side);
    let scene = Scene {
        name: "held-out".into(),
        unit: "m".into(),
        robot_radius: protocol.robot_radius,
        start: [-0.5, 0.0],
        goal: [0.5, 0.0],
        field: Some(Field { min: [-x, -y], max: [x, y] }),
        obstacles: Vec::new(),
    };
    SceneEntry { scene, set: SceneSet::Test, simulation: None }
}

/// The table `[behaviour]` that says everything.
pub(super) fn to_toml(protocol: &Protocol) -> String {
    let table = toml::Table::try_from(protocol).expect("validated settings have a place in TOML");
    toml::Table::from_iter([("behaviour".to_owned(), toml::Value::Table(table))]).to_string()
}
