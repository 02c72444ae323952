//! The `[planner.LABEL]` tables of a comparison.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use env_model::FileError;
use env_model::source::{Key, Source, span_of};
use planner_api::{Budget, Planner};
use planner_behaviour::{Parameters, Tuning};
use planner_catalogue::BuildError;
use serde::{Deserialize, Serialize};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::sweep::{Variant, expand};
use super::{behaviour, from_table, table_of};
use crate::results::Subject;

/// The key that names an external planner's folder; no part of a campaign's identity.
pub const FOLDER: &str = "folder";

/// The key under which a resolved comparison says of which planner another is a variant, and by what.
const VARIANT: &str = "variant";

/// Makes instances of one planner, one for each thread.
pub type Factory = Box<dyn Fn() -> Box<dyn Planner> + Send + Sync>;

/// Who plans.
pub enum Maker {
    /// A planner of the catalogue.
    Catalogue(Factory),
    /// A command that speaks the worker protocol, in a process of its own.
    External(External),
    /// A controller of the catalogue, one for each robot of a team.
    Controller,
    /// Given parameters of behaviour control.
    Parameters(Parameters),
    /// Parameters of behaviour control that are searched for.
    Tuning(Tuning),
}

/// The command of an external planner.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct External {
    /// Program and arguments.
    pub command: Vec<String>,
    /// Where it runs, absolute: the comparison's folder unless its table says another.
    pub folder: PathBuf,
}

/// What ends a run in a process of its own.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Limits {
    /// Wall time after which its process is killed, ms; `None` for [`PlannerEntry::hard_limit`]'s default.
    pub hard_limit_ms: Option<f64>,
    /// Resident memory beyond which its process is killed, MiB.
    pub memory_mb: Option<u64>,
}

/// A planner of a comparison.
pub struct PlannerEntry {
    /// What tables call it.
    pub label: String,
    /// Label of the table it was written in: variants of a sweep share it.
    pub group: String,
    /// What tells it from the others of its group, as in its label; empty for an only one.
    pub varied: String,
    /// What the catalogue calls it, or `external`.
    pub kind: String,
    /// Every setting, defaults included.
    pub settings: toml::Table,
    /// What a run may spend.
    pub budget: BudgetSpec,
    /// What ends a run of its own process.
    pub limits: Limits,
    /// Who plans with these settings.
    pub maker: Maker,
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

    /// `400 iterations, 5 ms`; empty without limits.
    pub fn words(&self) -> String {
        let counts = [(self.iterations, "iterations"), (self.evaluations, "evaluations")];
        let counts = counts.into_iter().filter_map(|(n, what)| n.map(|n| format!("{n} {what}")));
        counts.chain(self.time_ms.map(|ms| format!("{ms} ms"))).collect::<Vec<_>>().join(", ")
    }

    /// The budget of a run that begins now.
    pub fn begin(&self) -> Budget {
        let deadline = self.time_ms.map(|ms| Instant::now() + Duration::from_secs_f64(ms / 1000.0));
        Budget { iterations: self.iterations, evaluations: self.evaluations, deadline }
    }
}

impl PlannerEntry {
    /// An instance for one thread; `None` for anything but a planner of the catalogue.
    pub fn instance(&self) -> Option<Box<dyn Planner>> {
        match &self.maker {
            Maker::Catalogue(make) => Some(make()),
            _ => None,
        }
    }

    /// Whether its runs go to a process of their own even where isolation was not asked for.
    pub fn isolated(&self) -> bool {
        matches!(self.maker, Maker::External(_)) || self.limits != Limits::default()
    }

    /// After how long a run in a process of its own is ended: by default twice the time budget and a second, or a
    /// minute without one.
    pub fn hard_limit(&self) -> Duration {
        let default = self.budget.time_ms.map_or(60_000.0, |ms| 2.0 * ms + 1000.0);
        Duration::from_secs_f64(self.limits.hard_limit_ms.unwrap_or(default) / 1000.0)
    }

    /// Its `[planner.LABEL]` table with everything said.
    pub fn to_toml(&self) -> String {
        self.labelled(self.table())
    }

    /// The same without what differs between machines: the folder of an external planner.
    pub fn portable_toml(&self) -> String {
        let mut table = self.table();
        if matches!(self.maker, Maker::External(_)) {
            table.remove(FOLDER);
        }
        self.labelled(table)
    }

    fn labelled(&self, table: toml::Table) -> String {
        let label = toml::Table::from_iter([(self.label.clone(), toml::Value::Table(table))]);
        toml::Table::from_iter([("planner".to_owned(), toml::Value::Table(label))]).to_string()
    }

    fn table(&self) -> toml::Table {
        let mut table = toml::Table::new();
        table.insert("kind".into(), self.kind.clone().into());
        if self.group != self.label {
            let written = [("of", &self.group), ("by", &self.varied)];
            let variant = written.map(|(key, text)| (key.to_owned(), text.clone().into()));
            table.insert(VARIANT.into(), toml::Table::from_iter(variant).into());
        }
        table.extend(self.program());
        if let Some(ms) = self.limits.hard_limit_ms {
            table.insert("hard_limit_ms".into(), ms.into());
        }
        if let Some(mb) = self.limits.memory_mb {
            table.insert("memory_mb".into(), i64::try_from(mb).unwrap_or(i64::MAX).into());
        }
        if self.budget != BudgetSpec::default() {
            let budget = toml::Table::try_from(self.budget).expect("integers below 2⁶³ came from TOML");
            table.insert("budget".into(), budget.into());
        }
        table.extend(self.settings.clone());
        table
    }

    /// The keys that say which program an external planner is.
    fn program(&self) -> toml::Table {
        let Maker::External(External { command, folder }) = &self.maker else { return toml::Table::new() };
        let folder = folder.display().to_string();
        toml::Table::from_iter([("command".to_owned(), command.clone().into()), (FOLDER.to_owned(), folder.into())])
    }

    /// The settings as the report prints them, with the program of an external planner.
    pub fn settings_toml(&self) -> String {
        let mut table = self.program();
        table.extend(self.settings.clone());
        table.to_string()
    }
}

pub(super) fn read(
    source: &Source<'_>,
    value: Option<Spanned<DeValue<'_>>>,
    budget: Option<Spanned<DeValue<'_>>>,
    folder: &Path,
    subject: Subject,
) -> Result<Vec<PlannerEntry>, FileError> {
    let common = budgets(source, budget, &[BudgetSpec::default()])?;
    let Some(value) = value else { return Ok(Vec::new()) };
    let table = table_of(source, value, "tables [planner.LABEL]")?;
    if table.get_ref().is_empty() {
        return Err(source.error_at(table.span(), "an empty comparison: no planner; expected a table [planner.LABEL]"));
    }
    let mut entries: Vec<_> = table.into_inner().into_iter().collect();
    // The map is sorted by key; the file's order is the reader's.
    entries.sort_by_key(|(label, _)| label.span().start);
    let mut planners: Vec<PlannerEntry> = Vec::new();
    for (label, value) in entries {
        let name = label.get_ref();
        if name.trim().is_empty() || name.chars().any(char::is_control) {
            let message = format!("planner label {name:?}; expected printable text");
            return Err(source.error_at(label.span(), message));
        }
        let table = table_of(source, value, "a table of settings")?;
        for planner in variants(source, name, label.span(), table, &common, (folder, subject))? {
            if planners.iter().any(|p| p.label == planner.label) {
                let message = format!("a second planner labelled {:?}; expected different labels", planner.label);
                return Err(source.error_at(label.span(), message));
            }
            planners.push(planner);
        }
    }
    Ok(planners)
}

/// The budgets that `value` stands for, an array of them or one, each in place of the keys of every one of `common`.
fn budgets(
    source: &Source<'_>,
    value: Option<Spanned<DeValue<'_>>>,
    common: &[BudgetSpec],
) -> Result<Vec<BudgetSpec>, FileError> {
    let Some(value) = value else { return Ok(common.to_vec()) };
    let span = value.span();
    let written = match value.into_inner() {
        DeValue::Array(values) if values.is_empty() => {
            return Err(source.error_at(span, "no budget; expected one or more, such as [{ iterations = 400 }]"));
        }
        DeValue::Array(values) => values.into_iter().collect(),
        other => vec![Spanned::new(span, other)],
    };
    let mut all = Vec::new();
    for value in written {
        for (_, value) in expand(source, "budget", value)? {
            let at = value.span();
            for base in common {
                let budget = base.overridden(source, value.clone())?;
                if all.contains(&budget) && common.len() == 1 {
                    return Err(source.error_at(at, format!("a second budget of {}", budget.words())));
                }
                if !all.contains(&budget) {
                    all.push(budget);
                }
            }
        }
    }
    Ok(all)
}

/// Every planner that the table `[planner.LABEL]` stands for: one for each combination of its sweeps and budgets.
fn variants(
    source: &Source<'_>,
    label: &str,
    at: Range<usize>,
    table: Spanned<DeTable<'_>>,
    common: &[BudgetSpec],
    context: (&Path, Subject),
) -> Result<Vec<PlannerEntry>, FileError> {
    let span = table.span();
    let mut keys = table.into_inner();
    let budgets = budgets(source, keys.remove("budget"), common)?;
    let written: Vec<Variant<'_>> = expand(source, "", Spanned::new(span, DeValue::Table(keys)))?;
    let mut all = Vec::new();
    for (names, value) in written {
        let table = table_of(source, value, "a table of settings")?;
        for budget in &budgets {
            let several = (budgets.len() > 1).then(|| budget.words());
            let varied = names.iter().cloned().chain(several).collect::<Vec<_>>().join(", ");
            let mut planner = entry(source, label, at.clone(), table.clone(), *budget, context)?;
            if !varied.is_empty() {
                planner.label = format!("{label}[{varied}]");
                planner.varied = varied;
            }
            all.push(planner);
        }
    }
    Ok(all)
}

/// One planner from its table without sweeps and budget; `at` is where it is named.
fn entry(
    source: &Source<'_>,
    label: &str,
    at: Range<usize>,
    mut table: Spanned<DeTable<'_>>,
    budget: BudgetSpec,
    (folder, subject): (&Path, Subject),
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
    if subject != Subject::Paths {
        refuse_processes(source, &kind, kind_at.clone(), keys)?;
    }
    let limits = limits(source, keys)?;
    let (group, varied) = match keys.remove(VARIANT) {
        Some(value) => variant(source, value)?,
        None => (label.to_owned(), String::new()),
    };
    let label = label.to_owned();
    let command = keys.remove("command");
    if kind == "external" {
        let command = command_of(source, kind_at, command)?;
        let folder = text(source, keys.remove(FOLDER))?.map_or_else(|| folder.to_owned(), |own| folder.join(own));
        // Fails where not even the current folder is known.
        let folder = std::path::absolute(&folder).unwrap_or(folder);
        let maker = Maker::External(External { command, folder });
        if let Some(refine) = keys.remove("refine") {
            let message = "refine in an external planner's table; expected a planner of the catalogue";
            return Err(source.error_at(refine.span(), message));
        }
        let settings = from_table(source, table)?;
        return Ok(PlannerEntry { label, group, varied, kind, settings, budget, limits, maker });
    }
    if let Some(command) = command {
        return Err(
            source.error_at(command.span(), format!("a command for kind {kind:?}; expected kind = \"external\""))
        );
    }
    if subject == Subject::Behaviour {
        let (maker, settings) = behaviour::planner(source, &kind, kind_at, &table)?;
        return Ok(PlannerEntry { label, group, varied, kind, settings, budget, limits, maker });
    }
    let places = table.clone();
    if subject == Subject::Simulation {
        let built =
            planner_catalogue::build_controller(&kind, table).map_err(|e| located(source, kind_at, &places, &e))?;
        let (settings, maker) = (built.settings, Maker::Controller);
        return Ok(PlannerEntry { label, group, varied, kind, settings, budget, limits, maker });
    }
    if planner_catalogue::controllers().iter().any(|k| k.name == kind) {
        let message = format!(
            "{kind:?} moves a robot among what moves, and plans no path; expected a planner, or a table [simulation]"
        );
        return Err(source.error_at(kind_at, message));
    }
    let built = planner_catalogue::build(&kind, table).map_err(|e| located(source, kind_at, &places, &e))?;
    let settings = built.settings;
    let text = settings.to_string();
    let make_kind = kind.clone();
    // Every instance comes from the resolved settings, which are thereby proved to say everything.
    let make = move || from_settings(&make_kind, &text).expect("settings that the catalogue itself wrote");
    Ok(PlannerEntry { label, group, varied, kind, settings, budget, limits, maker: Maker::Catalogue(Box::new(make)) })
}

fn text(source: &Source<'_>, value: Option<Spanned<DeValue<'_>>>) -> Result<Option<String>, FileError> {
    let Some(value) = value else { return Ok(None) };
    match value.get_ref() {
        DeValue::String(text) => Ok(Some(text.to_string())),
        other => Err(source.error_at(value.span(), format!("found {}; expected text", other.type_str()))),
    }
}

/// What a resolved comparison says of a variant: its group, and what tells it from the others.
fn variant(source: &Source<'_>, value: Spanned<DeValue<'_>>) -> Result<(String, String), FileError> {
    const EXPECTED: &str = "variant = { of = \"pso\", by = \"inertia=0.5\" }, as resolved comparisons have it";
    let span = value.span();
    let mut table = table_of(source, value, EXPECTED)?.into_inner();
    let (of, by) = (text(source, table.remove("of"))?, text(source, table.remove("by"))?);
    match (of, by) {
        (Some(of), Some(by)) if table.is_empty() => Ok((of, by)),
        _ => Err(source.error_at(span, format!("expected {EXPECTED}"))),
    }
}

/// What moves is driven in the bench's own process.
fn refuse_processes(
    source: &Source<'_>,
    kind: &str,
    kind_at: Range<usize>,
    keys: &DeTable<'_>,
) -> Result<(), FileError> {
    let expected =
        "expected a planner of the catalogue without limits of a process, for what moves runs in the bench's";
    if kind == "external" {
        return Err(source.error_at(kind_at, format!("an external planner; {expected}")));
    }
    match ["command", "hard_limit_ms", "memory_mb"].iter().find_map(|key| keys.get_key_value(*key)) {
        Some((key, _)) => Err(source.error_at(key.span(), format!("{}: {expected}", key.get_ref()))),
        None => Ok(()),
    }
}

/// The reserved keys that limit a planner's process, taken out of its table.
fn limits(source: &Source<'_>, keys: &mut DeTable<'_>) -> Result<Limits, FileError> {
    let mut number = |key: &str, most: f64, expected: &str| match keys.remove(key) {
        None => Ok(None),
        Some(value) => {
            let found = match value.get_ref() {
                DeValue::Integer(n) => n.as_str().replace('_', "").parse::<f64>().ok().filter(|_| n.radix() == 10),
                DeValue::Float(x) => x.as_str().replace('_', "").parse::<f64>().ok(),
                _ => None,
            };
            let found = found.filter(|x| *x > 0.0 && *x <= most);
            found.map(Some).ok_or_else(|| source.error_at(value.span(), format!("{key}: expected {expected}")))
        }
    };
    // A day is more than any run lasts, and a pebibyte more than any machine holds.
    let hard_limit_ms = number("hard_limit_ms", 86_400_000.0, "milliseconds above 0, at most a day")?;
    let memory_mb = number("memory_mb", 1e9, "mebibytes, a whole number of at least 1")?;
    Ok(Limits { hard_limit_ms, memory_mb: memory_mb.map(|mb| mb.ceil() as u64) })
}

/// The words of an external planner's `command`.
fn command_of(
    source: &Source<'_>,
    kind_at: Range<usize>,
    value: Option<Spanned<DeValue<'_>>>,
) -> Result<Vec<String>, FileError> {
    const EXPECTED: &str = "command = [\"python3\", \"my_planner.py\"]";
    let Some(value) = value else {
        return Err(source.error_at(kind_at, format!("an external planner without command; expected {EXPECTED}")));
    };
    let span = value.span();
    let words = match value.into_inner() {
        DeValue::Array(words) if !words.is_empty() => words,
        other => return Err(source.error_at(span, format!("found {}; expected {EXPECTED}", other.type_str()))),
    };
    let word = |word: Spanned<DeValue<'_>>| {
        let span = word.span();
        let found = text(source, Some(word))?.filter(|w| !w.contains('\0'));
        found.ok_or_else(|| source.error_at(span, format!("expected {EXPECTED}")))
    };
    let words = words.into_iter().map(word).collect::<Result<Vec<String>, _>>()?;
    if words[0].is_empty() {
        return Err(source.error_at(span, format!("an empty program; expected {EXPECTED}")));
    }
    Ok(words)
}

/// The catalogue's error with its place: the kind's name, or the value at fault in `table`.
fn located(source: &Source<'_>, kind_at: Range<usize>, table: &Spanned<DeTable<'_>>, error: &BuildError) -> FileError {
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
    let mut table = source.parse_toml()?;
    let budgets = budgets(&source, table.get_mut().remove("budget"), &[BudgetSpec::default()])?;
    let [budget] = budgets.as_slice() else {
        return Err(source.error_at(0..0, "several budgets; expected one"));
    };
    entry(&source, kind, 0..0, table, *budget, (Path::new("."), Subject::Paths))
}
