//! Scenes of a comparison that are problems of a `MovingAI` scenario file.

use std::path::Path;

use env_model::import::movingai::{self, Map, Problem};
use env_model::source::Source;
use env_model::{FileError, Scene};
use serde::Deserialize;
use toml::Spanned;
use toml::de::DeTable;

use super::{Files, folder_name, from_table};

/// More would be a slip of the pen.
const MOST: usize = 10_000;

/// `{ movingai = "arena.map.scen", buckets = [0, 3], count = 10 }`
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MovingAi {
    movingai: Spanned<String>,
    /// Instead of the map that the scenario names.
    map: Option<Spanned<String>>,
    /// Only problems of these buckets.
    buckets: Option<Vec<u64>>,
    /// These problems, from 0 in the file's order.
    problems: Option<Vec<usize>>,
    /// So many of those chosen, spread evenly over them.
    count: Option<Spanned<usize>>,
    /// What names of scenes begin with; default: the file's name without its endings.
    name: Option<Spanned<String>>,
}

/// The scenes of `table`, and notes: the lengths of the shortest octile paths by our own search, and where the
/// file says otherwise.
pub(super) fn read(
    source: &Source<'_>,
    table: Spanned<DeTable<'_>>,
    files: &dyn Files,
) -> Result<(Vec<Scene>, Vec<String>), FileError> {
    let whole = table.span();
    let asked: MovingAi = from_table(source, table)?;
    let at = asked.movingai.span();
    let path = asked.movingai.get_ref();
    let name = match &asked.name {
        Some(name) => folder_name(source, name)?.clone(),
        None => stem(path),
    };
    let (file, text) =
        files.read(path).map_err(|e| source.error_at(at.clone(), format!("{e}; expected a scenario file")))?;
    let problems = movingai::problems(&file, &text).map_err(|e| source.error_at(at.clone(), e.to_string()))?;
    let Choice { chosen, trivial } = choose(&problems, &asked).map_err(|message| source.error_at(whole, message))?;
    let mut maps = Maps { source, at: &asked.movingai, instead: asked.map.as_ref(), files, read: Vec::new() };
    let (mut scenes, mut lengths, mut notes) = (Vec::new(), Vec::new(), Vec::new());
    for number in chosen {
        let problem = &problems[number];
        let scene = format!("{name}-p{number:04}");
        let error = |message: String| {
            let place = format!("{file}:{}: problem {number}: ", problem.line);
            source.error_at(at.clone(), place + &message)
        };
        let imported = movingai::scene(&scene, maps.of(problem)?, problem).map_err(error)?;
        let stated = problem.length;
        let Some(octile) = imported.octile else {
            return Err(error(format!(
                "there is no way on the map, and the file's has length {stated}; expected the map of this scenario"
            )));
        };
        if (octile - stated).abs() > problem.tolerance {
            notes.push(format!(
                "{scene}: the shortest octile path is {octile:.8} by our search and {stated} by {file}:{}; is it of \
                 this map, with diagonals of √2 and without cutting corners?",
                problem.line
            ));
        }
        lengths.push(format!("{scene} {octile:.8}"));
        scenes.push(imported.scene);
    }
    let agreement = if notes.is_empty() { "all as" } else { "not all as" };
    notes.insert(0, format!("shortest octile paths by our search, {agreement} in {file}: {}", lengths.join(", ")));
    if !trivial.is_empty() {
        let numbers: Vec<String> = trivial.iter().map(usize::to_string).collect();
        notes.push(format!("left out of {file}, their start is their goal: problems {}", numbers.join(", ")));
    }
    Ok((scenes, notes))
}

/// Numbers of problems.
struct Choice {
    /// Those asked for, at least one.
    chosen: Vec<usize>,
    /// Those left out because they end where they start. Nobody means these who asks for a whole bucket.
    trivial: Vec<usize>,
}

/// The choice that is asked for, or what is wrong with it.
fn choose(problems: &[Problem], asked: &MovingAi) -> Result<Choice, String> {
    let all: Vec<usize> = match (&asked.problems, &asked.buckets) {
        (Some(_), Some(_)) => return Err("both problems and buckets; expected at most one of them".to_owned()),
        (Some(numbers), None) => {
            if let Some(number) = numbers.iter().find(|number| **number >= problems.len()) {
                return Err(format!("problem {number} of {}; expected numbers from 0", problems.len()));
            }
            numbers.clone()
        }
        (None, Some(buckets)) => {
            if let Some(bucket) = buckets.iter().find(|bucket| problems.iter().all(|p| p.bucket != **bucket)) {
                let last = problems.iter().map(|p| p.bucket).max().unwrap_or(0);
                return Err(format!("no problem in bucket {bucket}; expected buckets up to {last}"));
            }
            (0..problems.len()).filter(|i| buckets.contains(&problems[*i].bucket)).collect()
        }
        (None, None) => (0..problems.len()).collect(),
    };
    let kept = |i: &usize| asked.problems.is_some() || problems[*i].start != problems[*i].goal;
    let (chosen, trivial): (Vec<usize>, Vec<usize>) = all.into_iter().partition(kept);
    let count = asked.count.as_ref().map_or(chosen.len(), |count| (*count.get_ref()).min(chosen.len()));
    if count == 0 || count > MOST {
        let left_out = match trivial.len() {
            0 => String::new(),
            n => format!(", besides {n} whose start is their goal"),
        };
        return Err(format!("{count} problems{left_out}; expected 1 to {MOST}"));
    }
    // The first and the last are among them, unless only one is wanted.
    let spread = |k: usize| chosen[if count == 1 { 0 } else { k * (chosen.len() - 1) / (count - 1) }];
    Ok(Choice { chosen: (0..count).map(spread).collect(), trivial })
}

/// The maps read so far, each in the sizes that were asked for.
struct Maps<'a> {
    source: &'a Source<'a>,
    /// The scenario.
    at: &'a Spanned<String>,
    instead: Option<&'a Spanned<String>>,
    files: &'a dyn Files,
    read: Vec<(String, [usize; 2], Map)>,
}

impl Maps<'_> {
    /// The map of a problem.
    fn of(&mut self, problem: &Problem) -> Result<&Map, FileError> {
        let known = self.read.iter().position(|(name, size, _)| *name == problem.map && *size == problem.size);
        let index = match known {
            Some(index) => index,
            None => {
                let (name, text) = self.open(&problem.map)?;
                let map = Map::parse(&name, &text).map_err(|e| self.source.error_at(self.at.span(), e.to_string()))?;
                let [width, height] = problem.size;
                let map = if problem.size == [map.width(), map.height()] { map } else { map.scaled(width, height) };
                self.read.push((problem.map.clone(), problem.size, map));
                self.read.len() - 1
            }
        };
        Ok(&self.read[index].2)
    }

    /// The map that the comparison names; else the scenario's, from the scenario's folder. Scenarios name maps by
    /// their place in the whole collection: where that leads nowhere, by the file's name alone.
    fn open(&self, named: &str) -> Result<(String, String), FileError> {
        if let Some(instead) = self.instead {
            let read = self.files.read(instead.get_ref());
            return read.map_err(|e| self.source.error_at(instead.span(), format!("{e}; expected a map")));
        }
        let folder = Path::new(self.at.get_ref()).parent().unwrap_or(Path::new(""));
        let beside = |path: &Path| self.files.read(&folder.join(path).to_string_lossy());
        beside(Path::new(named)).or_else(|first| {
            let alone = Path::new(named).file_name().unwrap_or_default();
            let expected = "expected the map beside the scenario, or its path as map = \"…\"";
            beside(Path::new(alone)).map_err(|_| self.source.error_at(self.at.span(), format!("{first}; {expected}")))
        })
    }
}

/// `maps/arena.map.scen` → `arena`
fn stem(path: &str) -> String {
    let name = Path::new(path).file_name().map_or(path.into(), |name| name.to_string_lossy());
    let name = name.strip_suffix(".scen").unwrap_or(&name);
    name.strip_suffix(".map").unwrap_or(name).to_owned()
}
