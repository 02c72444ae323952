//! The `[planner.LABEL]` tables of a comparison.

use std::time::{Duration, Instant};

use env_model::FileError;
use env_model::source::{Key, Source, span_of};
use planner_api::{Budget, Planner};
use planner_catalogue::BuildError;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{from_table, table_of};

/// Makes instances of one planner, one for each thread.
pub type Factory = Box<dyn Fn() -> Box<dyn Planner> + Send + Sync>;

/// A planner of a comparison.
pub struct PlannerEntry {
    /// What tables call it.
    pub label: String,
    /// What the catalogue calls it.
    pub kind: String,
    /// Every setting, defaults included.
    pub settings: toml::Table,
    /// What a run may spend.
    pub budget: BudgetSpec,
    /// Makes instances with these settings.
    pub make: Factory,
}

/// A budget as the file spells it; every key is optional.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BudgetSpec {
    /// Most iterations of the planner's outer loop.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub iterations: Option<u64>,
    /// Most evaluations of the planner's own objective.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub evaluations: Option<u64>,
    /// Most wall time, milliseconds, > 0.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub time_ms: Option<f64>,
}

impl BudgetSpec {
    /// This budget with the keys of the table `value` in place of its own.
    pub(super) fn overridden(self, source: &Source<'_>, value: Spanned<DeValue<'_>>) -> Result<Self, FileError> {
        let span = value.span();
        let table = table_of(source, value, "a table such as { iterations = 400 }")?;
        let over: Self = from_table(source, table)?;
        if let Some(time_ms) = over.time_ms
            // A day is more than any run lasts, and small enough for `Instant` everywhere.
            && !(time_ms > 0.0 && time_ms <= 86_400_000.0)
        {
            return Err(source.error_at(span, format!("time_ms = {time_ms}; expected a number above 0, at most a day")));
        }
        for (key, count) in [("iterations", over.iterations), ("evaluations", over.evaluations)] {
            // What a TOML integer can hold, so that the resolved comparison can be written.
            if let Some(count) = count.filter(|c| i64::try_from(*c).is_err()) {
                return Err(source.error_at(span, format!("{key} = {count}; expected less than 2⁶³")));
            }
        }
        if over == Self::default() {
            return Err(source.error_at(span, "an empty budget; expected iterations, evaluations or time_ms"));
        }
        Ok(Self {
            iterations: over.iterations.or(self.iterations),
            evaluations: over.evaluations.or(self.evaluations),
            time_ms: over.time_ms.or(self.time_ms),
        })
    }

    /// The budget of a run that begins now.
    pub fn begin(&self) -> Budget {
        let deadline = self.time_ms.map(|ms| Instant::now() + Duration::from_secs_f64(ms / 1000.0));
        Budget { iterations: self.iterations, evaluations: self.evaluations, deadline }
    }
}

impl PlannerEntry {
    /// Its `[planner.LABEL]` table with everything said.
    pub fn to_toml(&self) -> String {
        let mut table = toml::Table::new();
        table.insert("kind".into(), self.kind.clone().into());
        if self.budget != BudgetSpec::default() {
            let budget = toml::Table::try_from(self.budget).expect("integers below 2⁶³ came from TOML");
            table.insert("budget".into(), budget.into());
        }
        table.extend(self.settings.clone());
        let label = toml::Table::from_iter([(self.label.clone(), toml::Value::Table(table))]);
        toml::Table::from_iter([("planner".to_owned(), toml::Value::Table(label))]).to_string()
    }

    /// The settings as the report prints them.
    pub fn settings_toml(&self) -> String {
        self.settings.to_string()
    }
}

pub(super) fn read(
    source: &Source<'_>,
    value: Option<Spanned<DeValue<'_>>>,
    budget: BudgetSpec,
) -> Result<Vec<PlannerEntry>, FileError> {
    let Some(value) = value else { return Ok(Vec::new()) };
    let table = table_of(source, value, "tables [planner.LABEL]")?;
    if table.get_ref().is_empty() {
        return Err(source.error_at(table.span(), "an empty comparison: no planner; expected a table [planner.LABEL]"));
    }
    let mut entries: Vec<_> = table.into_inner().into_iter().collect();
    // The map is sorted by key; the file's order is the reader's.
    entries.sort_by_key(|(label, _)| label.span().start);
    let read_one = |(label, value): (Spanned<toml::de::DeString<'_>>, _)| {
        let name = label.get_ref();
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            let message = format!("planner label {name:?}; expected printable text");
            return Err(source.error_at(label.span(), message));
        }
        let table = table_of(source, value, "a table of settings")?;
        entry(source, name, label.span(), table, budget)
    };
    entries.into_iter().map(read_one).collect()
}

/// One planner from its table, reserved keys included; `at` is where it is named.
fn entry(
    source: &Source<'_>,
    label: &str,
    at: std::ops::Range<usize>,
    mut table: Spanned<DeTable<'_>>,
    budget: BudgetSpec,
) -> Result<PlannerEntry, FileError> {
    let keys = table.get_mut();
    let (kind, kind_at) = match keys.remove("kind") {
        None => (label.to_owned(), at),
        Some(kind) => match kind.get_ref() {
            DeValue::String(name) => (name.clone().into_owned(), kind.span()),
            other => {
                let message = format!("kind is of type {}; expected a planner's name in quotes", other.type_str());
                return Err(source.error_at(kind.span(), message));
            }
        },
    };
    if kind == "external" {
        return Err(source.error_at(kind_at, "not yet: planners of kind \"external\""));
    }
    for reserved in ["command", "hard_limit_ms", "memory_mb"] {
        if let Some(value) = keys.remove(reserved) {
            return Err(source.error_at(value.span(), format!("not yet: the key {reserved}")));
        }
    }
    let budget = match keys.remove("budget") {
        Some(value) => budget.overridden(source, value)?,
        None => budget,
    };
    let places = table.clone();
    let built = planner_catalogue::build(&kind, table).map_err(|e| located(source, kind_at, &places, &e))?;
    let settings = built.settings;
    let text = settings.to_string();
    let make_kind = kind.clone();
    // Every instance comes from the resolved settings, which are thereby proved to say everything.
    let make = move || from_settings(&make_kind, &text).expect("settings that the catalogue itself wrote");
    Ok(PlannerEntry { label: label.to_owned(), kind, settings, budget, make: Box::new(make) })
}

/// The catalogue's error with its place: the kind's name, or the value at fault in `table`.
fn located(
    source: &Source<'_>,
    kind_at: std::ops::Range<usize>,
    table: &Spanned<DeTable<'_>>,
    error: &BuildError,
) -> FileError {
    match error {
        BuildError::At { span, message } => source.error_at(span.clone(), message.as_str()),
        BuildError::Setting { within, error: setting } => {
            let keys: Vec<Key<'_>> = within.iter().map(String::as_str).chain([setting.key]).map(Key::Name).collect();
            source.error_at(span_of(table, &keys), error.to_string())
        }
        other => source.error_at(kind_at, other.to_string()),
    }
}

/// A planner from resolved settings.
pub fn from_settings(kind: &str, settings: &str) -> Result<Box<dyn Planner>, BuildError> {
    planner_catalogue::build_str(kind, settings).map(|built| built.planner)
}

/// One planner outside of a comparison: `settings` is the text of its table, reserved keys included.
/// `path` is what messages call it.
pub fn single(path: &str, kind: &str, settings: &str) -> Result<PlannerEntry, FileError> {
    let source = Source { path, text: settings };
    entry(&source, kind, 0..0, source.parse_toml()?, BudgetSpec::default())
}
