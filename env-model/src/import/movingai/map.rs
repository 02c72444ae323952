//! The `.map` file.

use super::super::{ImportError, Place};
use crate::{Aabb, CellGrid, Point};

/// Rows or columns; the largest map of the benchmarks has 1550.
pub(super) const MOST: usize = 10_000;

/// A map of unit cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    grid: CellGrid,
    /// By the number of the cell in `grid`.
    letters: Vec<u8>,
}

impl Map {
    /// Reads a map, which messages call `file`.
    ///
    /// # Errors
    /// The line, what is wrong with it and what was expected.
    pub fn parse(file: &str, text: &str) -> Result<Self, ImportError> {
        let mut lines = Lines { file, lines: text.lines(), number: 0 };
        let header = lines.next("type octile")?;
        if header.split_whitespace().ne(["type", "octile"]) {
            return Err(lines.error(format!("found {header:?}; expected \"type octile\"")));
        }
        let (mut height, mut width) = (None, None);
        loop {
            let line = lines.next("height, width and map")?;
            let words: Vec<&str> = line.split_whitespace().collect();
            let size = match words[..] {
                ["map"] => break,
                ["height", _] => &mut height,
                ["width", _] => &mut width,
                _ => return Err(lines.error(format!("found {line:?}; expected \"height H\", \"width W\" or \"map\""))),
            };
            *size = Some(words[1].parse().ok().filter(|n| (1..=MOST).contains(n)).ok_or_else(|| {
                lines.error(format!("{} {}; expected a whole number from 1 to {MOST}", words[0], words[1]))
            })?);
        }
        let (Some(height), Some(width)) = (height, width) else {
            return Err(lines.error("\"map\" before height and width are known".to_owned()));
        };
        let mut rows = Vec::with_capacity(height);
        for row in 0..height {
            let line = lines.next(&format!("row {} of {height}", row + 1))?;
            if let Some((column, letter)) = line.chars().enumerate().find(|(_, c)| !".GS@OTW".contains(*c)) {
                let expected = "expected one of . G S W @ O T";
                return Err(lines.error(format!("found {letter:?} in column {}; {expected}", column + 1)));
            }
            if line.len() != width {
                return Err(lines.error(format!("a row of {} cells; expected {width}", line.len())));
            }
            rows.push(line.as_bytes());
        }
        while let Ok(line) = lines.next("") {
            if !line.trim().is_empty() {
                return Err(lines.error(format!("{line:?} after the last row; expected the end, for height {height}")));
            }
        }
        rows.reverse();
        Ok(Self { grid: cells(width, height), letters: rows.concat() })
    }

    /// The map stretched to another size, cells repeated or left out: what the format asks for
    /// where a scenario states another size than the map.
    pub fn scaled(&self, width: usize, height: usize) -> Self {
        let grid = cells(width, height);
        let from = |y: usize, x: usize| self.cell(x * self.width() / width, y * self.height() / height);
        let letters = (0..height).rev().flat_map(|y| (0..width).map(move |x| (y, x)));
        Self { grid, letters: letters.map(|(y, x)| self.letters[from(y, x)]).collect() }
    }

    /// Cells a row.
    pub fn width(&self) -> usize {
        self.grid.columns()
    }

    /// Rows.
    pub fn height(&self) -> usize {
        self.grid.rows()
    }

    /// The cells, numbered from the lower left one; they have side 1.
    pub fn grid(&self) -> &CellGrid {
        &self.grid
    }

    /// The number of the cell that the map calls (x, y), y counted from the top.
    pub fn cell(&self, x: usize, y: usize) -> usize {
        self.grid.cell(x, self.height() - 1 - y)
    }

    /// What the file says of a cell.
    pub fn letter(&self, cell: usize) -> char {
        self.letters[cell].into()
    }

    /// The cells that a robot from `start` may not enter, by number.
    pub fn blocked_for(&self, start: usize) -> Vec<bool> {
        let free: &[u8] = if self.letters[start] == b'W' { b"W" } else { b".GS" };
        self.letters.iter().map(|letter| !free.contains(letter)).collect()
    }
}

fn cells(width: usize, height: usize) -> CellGrid {
    let max = Point::new(width as f64, height as f64);
    CellGrid::covering(&Aabb { min: Point::origin(), max }, width, height)
}

/// Numbered lines, without their ends (LF or CR LF).
struct Lines<'a> {
    file: &'a str,
    lines: std::str::Lines<'a>,
    number: u64,
}

impl<'a> Lines<'a> {
    fn next(&mut self, expected: &str) -> Result<&'a str, ImportError> {
        self.number += 1;
        self.lines.next().ok_or_else(|| self.error(format!("the file ends; expected {expected}")))
    }

    fn error(&self, message: String) -> ImportError {
        ImportError::Log { file: self.file.to_owned(), place: Place::Line(self.number), message }
    }
}
