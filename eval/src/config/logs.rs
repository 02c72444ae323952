//! Scenes of a comparison that are instants of logged matches.

use std::ops::Range;
use std::path::Path;

use env_model::FileError;
use env_model::import::{ImportError, Imported, Side, rcg, ssl};
use env_model::source::Source;
use serde::Deserialize;
use toml::Spanned;
use toml::de::DeTable;

use super::{Files, Opened, folder_name, from_table};

/// More would be a slip of the pen.
const MOST: usize = 10_000;

/// `{ rcg = "game.rcg.gz", cycles = [120, 480], side = "left" }`
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RcgSource {
    rcg: Spanned<String>,
    cycles: Spanned<Vec<Spanned<u64>>>,
    side: Side,
    target: Option<Spanned<Vec<f64>>>,
    /// What names of scenes begin with; default: the file's name without its endings.
    name: Option<Spanned<String>>,
}

/// `{ ssl-log = "game.log.gz", frames = [10], team = "blue", robot = 3 }`
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct SslSource {
    ssl_log: Spanned<String>,
    frames: Spanned<Vec<Spanned<u64>>>,
    team: ssl::Team,
    robot: u32,
    attack: Option<Side>,
    target: Option<Spanned<Vec<f64>>>,
    name: Option<Spanned<String>>,
}

/// The scenes of `table`; `None` when it names no log.
pub(super) fn read(
    source: &Source<'_>,
    table: &Spanned<DeTable<'_>>,
    files: &dyn Files,
) -> Result<Option<Imported>, FileError> {
    let has = |key: &str| table.get_ref().contains_key(key);
    if has("rcg") {
        let asked: RcgSource = from_table(source, table.clone())?;
        let target = target(source, asked.target)?;
        let cycles = instants(source, "cycles", &asked.cycles)?;
        let (file, log) = open(source, &asked.rcg, files)?;
        let name = name(source, asked.name.as_ref(), asked.rcg.get_ref())?;
        let request = rcg::Request { name: &name, cycles: &cycles, side: asked.side, target };
        let imported = rcg::scenes(&file, log, &request);
        return imported.map(Some).map_err(|e| located(source, &e, asked.rcg.span(), &asked.cycles));
    }
    if has("ssl-log") {
        let asked: SslSource = from_table(source, table.clone())?;
        let target = target(source, asked.target)?;
        let frames = instants(source, "frames", &asked.frames)?;
        let (file, log) = open(source, &asked.ssl_log, files)?;
        let name = name(source, asked.name.as_ref(), asked.ssl_log.get_ref())?;
        let SslSource { team, robot, attack, .. } = asked;
        let request = ssl::Request { name: &name, frames: &frames, team, robot, attack, target };
        let imported = ssl::scenes(&file, log, &request);
        return imported.map(Some).map_err(|e| located(source, &e, asked.ssl_log.span(), &asked.frames));
    }
    Ok(None)
}

fn open(source: &Source<'_>, path: &Spanned<String>, files: &dyn Files) -> Result<Opened, FileError> {
    files.open(path.get_ref()).map_err(|e| source.error_at(path.span(), format!("{e}; expected a match log")))
}

/// What names of scenes begin with.
fn name(source: &Source<'_>, asked: Option<&Spanned<String>>, path: &str) -> Result<String, FileError> {
    asked.map_or_else(|| Ok(stem(path)), |asked| folder_name(source, asked).cloned())
}

/// `logs/game.rcg.gz` → `game`
fn stem(path: &str) -> String {
    let name = Path::new(path).file_name().map_or(path.into(), |name| name.to_string_lossy());
    let name = name.strip_suffix(".gz").unwrap_or(&name);
    [".rcg", ".log"].iter().find_map(|ending| name.strip_suffix(ending)).unwrap_or(name).to_owned()
}

fn instants(source: &Source<'_>, key: &str, asked: &Spanned<Vec<Spanned<u64>>>) -> Result<Vec<u64>, FileError> {
    let numbers: Vec<u64> = asked.get_ref().iter().map(|number| *number.get_ref()).collect();
    if numbers.is_empty() || numbers.len() > MOST {
        let message = format!("{} {key}; expected 1 to {MOST}, such as {key} = [120, 480]", numbers.len());
        return Err(source.error_at(asked.span(), message));
    }
    Ok(numbers)
}

fn target(source: &Source<'_>, asked: Option<Spanned<Vec<f64>>>) -> Result<Option<[f64; 2]>, FileError> {
    asked.map_or(Ok(None), |asked| {
        let span = asked.span();
        let numbers = asked.into_inner();
        let count = numbers.len();
        let pair = numbers.try_into().ok().filter(|pair: &[f64; 2]| pair.iter().all(|v| v.is_finite()));
        pair.map(Some).ok_or_else(|| {
            source.error_at(span, format!("a target of {count} numbers; expected two finite ones, [x, y]"))
        })
    })
}

/// The log's error at the instant that cannot be had, or at the log's name.
fn located(
    source: &Source<'_>,
    error: &ImportError,
    log: Range<usize>,
    asked: &Spanned<Vec<Spanned<u64>>>,
) -> FileError {
    let span = match error {
        ImportError::Instant { number, .. } => {
            asked.get_ref().iter().find(|asked| asked.get_ref() == number).map_or(log, Spanned::span)
        }
        ImportError::Log { .. } => log,
    };
    source.error_at(span, error.to_string())
}
