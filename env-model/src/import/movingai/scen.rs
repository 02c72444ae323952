//! The `.scen` file.

use super::super::{ImportError, Place};

/// A problem of a scenario file.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// Its line, from 1.
    pub line: u64,
    /// The bucket: problems of like length.
    pub bucket: u64,
    /// The map as the file names it.
    pub map: String,
    /// Columns and rows of the map that the problem is meant for.
    pub size: [usize; 2],
    /// Column and row of the start, from the upper left cell, (0, 0).
    pub start: [usize; 2],
    /// Column and row of the goal.
    pub goal: [usize; 2],
    /// Length of the shortest path of octile moves.
    pub length: f64,
    /// How far the length may be off, as it is printed.
    pub tolerance: f64,
}

/// The problems of a scenario file, which messages call `file`, in its order.
///
/// # Errors
/// The line, what is wrong with it and what was expected.
pub fn problems(file: &str, text: &str) -> Result<Vec<Problem>, ImportError> {
    let error =
        |line: u64, message: String| ImportError::Log { file: file.to_owned(), place: Place::Line(line), message };
    let mut lines = (1..).zip(text.lines());
    let first = lines.next().map_or("", |(_, line)| line);
    let version: Vec<&str> = first.split_whitespace().collect();
    if !matches!(version[..], ["version", "1" | "1.0"]) {
        return Err(error(1, format!("found {first:?}; expected \"version 1\"")));
    }
    let filled = lines.filter(|(_, line)| !line.trim().is_empty());
    filled.map(|(number, line)| problem(number, line).map_err(|message| error(number, message))).collect()
}

fn problem(line: u64, text: &str) -> Result<Problem, String> {
    let fields: Vec<&str> = text.split('\t').map(str::trim).collect();
    let [bucket, map, width, height, start_x, start_y, goal_x, goal_y, length] = fields[..] else {
        let expected = "nine, separated by tabs: bucket, map, width, height, start x, start y, goal x, goal y, length";
        return Err(format!("{} fields; expected {expected}", fields.len()));
    };
    if map.is_empty() {
        return Err("no map; expected the name of a map file".to_owned());
    }
    let sides = [size("width", width)?, size("height", height)?];
    Ok(Problem {
        line,
        bucket: whole("bucket", bucket)?,
        map: map.to_owned(),
        size: sides,
        start: [whole("start x", start_x)?, whole("start y", start_y)?],
        goal: [whole("goal x", goal_x)?, whole("goal y", goal_y)?],
        length: length
            .parse()
            .ok()
            .filter(|v: &f64| v.is_finite() && *v >= 0.0)
            .ok_or_else(|| format!("optimal length {length:?}; expected a number of at least 0"))?,
        tolerance: tolerance(length),
    })
}

fn whole<T: std::str::FromStr>(what: &str, text: &str) -> Result<T, String> {
    text.parse().map_err(|_| format!("{what} {text:?}; expected a whole number of at least 0"))
}

fn size(what: &str, text: &str) -> Result<usize, String> {
    let side = whole(what, text)?;
    match side {
        1..=super::map::MOST => Ok(side),
        _ => Err(format!("{what} {side}; expected 1 to {}", super::map::MOST)),
    }
}

/// A unit of the last decimal that is printed, but at least 1e-6, and 1e-7 of the length: files were
/// made with a √2 of single precision, which is off by 2e-8.
fn tolerance(printed: &str) -> f64 {
    let decimals = printed.split_once('.').map_or(6, |(_, decimals)| decimals.len().min(6));
    let unit = [1.0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6][decimals];
    printed.parse().map_or(unit, |length: f64| unit.max(1e-7 * length))
}
