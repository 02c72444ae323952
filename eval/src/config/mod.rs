//! Comparison files: TOML to a validated [`Comparison`], with errors that name
//! file, line, column and what was expected.
//!
//! ```toml
//! name = "lu-sun-2012"
//! seed = 1                          # default 1
//! repeats = 30                      # default 30
//! scenes = ["scenes/lu-sun-2012.toml", { generate = "wall", count = 20, obstacles = 21, seed = 2 }]
//! budget = { iterations = 400 }     # optional; also evaluations, time_ms
//!
//! [planner.pso]                     # the key is the label; kind defaults to it
//! velocity_limit = 0.5
//! budget = { evaluations = 8000 }   # replaces single keys of the common budget
//! ```
//!
//! `{ sweep = [0.2, 0.5] }` in place of any value of a planner's table makes a planner of each value, and an array
//! of budgets one of each budget, all labelled by what they vary: `pso[velocity_limit=0.5, 400 iterations]`.
//! `tuning = […]` takes scenes like `scenes`, on which settings were chosen: they are run and shown, but no
//! statistic over scenes counts them.
//!
//! Paths are relative to the file. Scenes also come from match logs, see [`env_model::import`]:
//! `{ rcg = "game.rcg.gz", cycles = [120, 480], side = "left" }` and
//! `{ ssl-log = "game.log.gz", frames = [10], team = "blue", robot = 3 }`; and from grid maps, see
//! [`env_model::import::movingai`]: `{ movingai = "arena.map.scen", buckets = [0, 3], count = 10 }`.
//!
//! With a table `[simulation]` scenes move, and planners drive teams: see `simulation.rs`. With a table `[behaviour]`
//! planners are parameters of behaviour control, given or tuned: see `behaviour.rs`.

mod behaviour;
mod files;
mod logs;
mod movingai;
mod planners;
mod scenes;
mod simulation;
mod sweep;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use env_model::source::Source;
use env_model::{FileError, Scene};
use planner_behaviour::Protocol;
use serde::Deserialize;
use serde::de::IgnoredAny;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::results::{SceneSet, Subject};
use crate::store::Stored;

pub use files::{Disk, EMBEDDED_NAME, Embedded, Files, Kept, Opened};
pub use planners::{BudgetSpec, External, FOLDER, Factory, Limits, Maker, PlannerEntry, from_settings, single};
pub use scenes::refuse_motion;
pub use simulation::play_name;

/// A comparison, resolved: scenes read or generated, planners built once, every setting known.
pub struct Comparison {
    /// What results call it; also a folder's name.
    pub name: String,
    /// All randomness of runs comes from here; < 2⁶³, so that TOML holds it.
    pub seed: u64,
    /// Runs per planner and scene, ≥ 1.
    pub repeats: u32,
    /// What its runs are.
    pub subject: Subject,
    /// How parameters of behaviour control are judged, where they are.
    pub protocol: Option<Protocol>,
    /// The scenes, names unique, those of the tuning set last.
    pub scenes: Vec<SceneEntry>,
    /// The planners in the file's order, labels unique.
    pub planners: Vec<PlannerEntry>,
    /// What a reader ought to know of how the scenes came about.
    pub notes: Vec<String>,
}

/// A scene of a comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneEntry {
    /// The scene itself.
    pub scene: Scene,
    /// What it is for.
    pub set: SceneSet,
    /// What moves in it, where something does: `scene` then only stands for its field.
    pub simulation: Option<strategy::Settings>,
}

/// The file's own keys. `scenes` and `planner` are read by hand for the sake of their places.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Head {
    name: Spanned<String>,
    seed: Option<Spanned<i64>>,
    repeats: Option<Spanned<i64>>,
    scenes: Option<IgnoredAny>,
    #[expect(dead_code, reason = "here so that it is a known key")]
    tuning: Option<IgnoredAny>,
    #[expect(dead_code, reason = "here so that it is a known key")]
    budget: Option<IgnoredAny>,
    planner: Option<IgnoredAny>,
    simulation: Option<Spanned<IgnoredAny>>,
    behaviour: Option<Spanned<IgnoredAny>>,
}

impl Comparison {
    /// Reads a comparison. `path` is the file as the user named it; `files` reads its scenes.
    pub fn from_toml(path: &str, text: &str, files: &dyn Files) -> Result<Self, FileError> {
        let source = Source { path, text };
        let mut table = source.parse_toml()?;
        let head: Head = from_table(&source, table.clone())?;
        let subject = match (&head.simulation, &head.behaviour) {
            (Some(_), Some(behaviour)) => {
                let message = "[behaviour] beside [simulation]; expected one of the two";
                return Err(source.error_at(behaviour.span(), message));
            }
            (Some(_), None) => Subject::Simulation,
            (None, Some(_)) => Subject::Behaviour,
            (None, None) => Subject::Paths,
        };
        let scenes_said = head.scenes.is_some() || subject != Subject::Paths;
        for (key, found) in [("scenes", scenes_said), ("planner", head.planner.is_some())] {
            if !found {
                let expected =
                    if key == "scenes" { "scenes = [\"scene.toml\", …]" } else { "a table [planner.LABEL]" };
                return Err(source.error_at(0..0, format!("an empty comparison: no {key}; expected {expected}")));
            }
        }
        let name = folder_name(&source, &head.name)?;
        let seed = head.seed.map_or(Ok(1), |seed| {
            u64::try_from(*seed.get_ref()).map_err(|_| {
                source.error_at(seed.span(), format!("seed = {}; expected an integer of at least 0", seed.get_ref()))
            })
        })?;
        let repeats = head.repeats.map_or(Ok(30), |repeats| {
            u32::try_from(*repeats.get_ref()).ok().filter(|r| *r > 0).ok_or_else(|| {
                let found = repeats.get_ref();
                source.error_at(repeats.span(), format!("repeats = {found}; expected an integer of at least 1"))
            })
        })?;
        let entries = table.get_mut();
        let budget = entries.remove("budget");
        let planners = planners::read(&source, entries.remove("planner"), budget, files.folder(), subject)?;
        let sets = [(SceneSet::Test, entries.remove("scenes")), (SceneSet::Tuning, entries.remove("tuning"))];
        let protocol = entries.remove("behaviour").map(|table| behaviour::protocol(&source, table)).transpose()?;
        let (scenes, notes) = match (entries.remove("simulation"), &protocol) {
            (Some(common), _) => (simulation::read(&source, common, sets)?, Vec::new()),
            (None, Some(protocol)) => {
                if let Some(scenes) = sets.into_iter().find_map(|(_, scenes)| scenes) {
                    let message = "scenes beside [behaviour], which draws its own; expected none";
                    return Err(source.error_at(scenes.span(), message));
                }
                (vec![behaviour::stand_in(protocol)], Vec::new())
            }
            (None, None) => scenes::read(&source, sets, files)?,
        };
        Ok(Self { name: name.clone(), seed, repeats, subject, protocol, scenes, planners, notes })
    }

    /// The comparison that a store keeps.
    pub fn from_stored(stored: &Stored) -> Result<Self, FileError> {
        Self::from_toml("the stored comparison", &stored.comparison, &Kept::new(stored))
    }

    /// Keeps only the planners of these labels, in the file's order; `Err` names the first label that is none.
    /// What is no label itself may be several, separated by commas.
    pub fn keep_planners(&mut self, labels: &[String]) -> Result<(), String> {
        let names = |p: &PlannerEntry, text: &str| p.label == text || p.group == text;
        let is_label = |text: &str| self.planners.iter().any(|p| names(p, text));
        let split = |text: &String| match is_label(text) {
            true => vec![text.clone()],
            false => text.split(',').map(|part| part.trim().to_owned()).collect(),
        };
        let labels: Vec<String> = labels.iter().flat_map(split).collect();
        if let Some(unknown) = labels.iter().find(|label| !is_label(label)) {
            let known: Vec<String> = self.planners.iter().map(|p| format!("{:?}", p.label)).collect();
            let hint = if unknown.ends_with(".toml") { " (name the comparison before --planner)" } else { "" };
            return Err(format!(
                "--planner {unknown:?}: no such label in comparison {}{hint}; expected some of: {}",
                self.name,
                known.join(", ")
            ));
        }
        self.planners.retain(|p| labels.iter().any(|label| names(p, label)));
        Ok(())
    }

    /// The comparison with everything said: reading it back gives the same one. Its scenes are
    /// the files `scenes/<name>.toml` next to it, see [`Comparison::scene_files`].
    pub fn to_toml(&self) -> String {
        self.resolved(PlannerEntry::to_toml)
    }

    /// The same without what differs between machines: what identity is made of.
    pub fn portable_toml(&self) -> String {
        self.resolved(PlannerEntry::portable_toml)
    }

    fn resolved(&self, planner_toml: fn(&PlannerEntry) -> String) -> String {
        let text = |s: &str| toml::Value::String(s.to_owned()).to_string();
        let mut out = format!("name = {}\nseed = {}\nrepeats = {}\n", text(&self.name), self.seed, self.repeats);
        let files = self.scene_files();
        for (set, key) in [(SceneSet::Test, "scenes"), (SceneSet::Tuning, "tuning")] {
            let of_set = self.scenes.iter().zip(&files).filter(|(entry, _)| entry.set == set);
            let line = |(entry, file): (&SceneEntry, &String)| match &entry.simulation {
                Some(settings) => format!("    {},\n", simulation::to_toml(&entry.scene.name, settings)),
                None => format!("    {},\n", text(file)),
            };
            let lines: Vec<String> = of_set.map(line).collect();
            if !lines.is_empty() && self.subject != Subject::Behaviour {
                out.push_str(&format!("{key} = [\n{}]\n", lines.concat()));
            }
        }
        if self.subject == Subject::Simulation {
            out.push_str("\n[simulation]\n");
        }
        if let Some(protocol) = &self.protocol {
            out.push('\n');
            out.push_str(&behaviour::to_toml(protocol));
        }
        for planner in &self.planners {
            out.push('\n');
            out.push_str(&planner_toml(planner));
        }
        out
    }

    /// Where [`Comparison::to_toml`] expects each scene, relative to itself.
    pub fn scene_files(&self) -> Vec<String> {
        scene_files(self.scenes.iter().map(|entry| entry.scene.name.as_str()))
    }
}

/// Files of the scenes of these names beside a resolved comparison: names made safe for every file system, and
/// unique even where case does not count.
pub fn scene_files<'n>(names: impl Iterator<Item = &'n str>) -> Vec<String> {
    let mut taken: BTreeMap<String, u32> = BTreeMap::new();
    let files = names.map(|name| {
        let safe = |c: char| if c.is_alphanumeric() || "-_.".contains(c) { c } else { '_' };
        let mut stem: String = name.chars().take(80).map(safe).collect();
        if stem.starts_with('.') {
            stem.insert(0, '_'); // no hidden files
        }
        let count = taken.entry(stem.to_lowercase()).and_modify(|n| *n += 1).or_insert(1);
        // "~" is no safe character, so numbered names never meet others.
        if *count > 1 { format!("scenes/{stem}~{count}.toml") } else { format!("scenes/{stem}.toml") }
    });
    files.collect()
}

fn from_table<'i, T: Deserialize<'i>>(source: &Source<'_>, table: Spanned<DeTable<'i>>) -> Result<T, FileError> {
    T::deserialize(toml::Deserializer::from(table)).map_err(|e| source.toml_error(&e))
}

/// The table in `value`, or an error that says what else it is.
fn table_of<'i>(
    source: &Source<'_>,
    value: Spanned<DeValue<'i>>,
    expected: &str,
) -> Result<Spanned<DeTable<'i>>, FileError> {
    let span = value.span();
    match value.into_inner() {
        DeValue::Table(table) => Ok(Spanned::new(span, table)),
        other => Err(source.error_at(span, format!("found {}; expected {expected}", other.type_str()))),
    }
}

/// The text of a `name` that names folders or files too.
fn folder_name<'n>(source: &Source<'_>, name: &'n Spanned<String>) -> Result<&'n String, FileError> {
    let text = name.get_ref();
    is_folder_name(text).then_some(text).ok_or_else(|| {
        let expected = "letters, digits, spaces and . _ - (it names a folder)";
        source.error_at(name.span(), format!("name = {text:?}; expected {expected}"))
    })
}

fn is_folder_name(name: &str) -> bool {
    let safe = |c: char| c.is_alphanumeric() || " ._-".contains(c);
    !name.trim().is_empty()
        && name.len() <= 200
        && name.trim() == name
        && !name.starts_with('.')
        && !name.ends_with('.')
        && name.chars().all(safe)
}
