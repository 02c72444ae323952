//! Scenes from other programs' files: match logs of `RoboCup` 2D ([`rcg`]) and the Small Size
//! League ([`ssl`]), grid maps of the `MovingAI` benchmarks ([`movingai`]).
//!
//! An instant of a match becomes a scene: one robot is the start, the centre of
//! the goal mouth it attacks (or a target) is the goal, every other robot is a
//! disc. Logs are streamed, gzip or not (told by the first bytes, not by the
//! name); memory does not grow with them. What is wrong with a log is an error
//! with its line or byte, never a panic.

mod instant;
pub mod movingai;
pub mod rcg;
pub mod ssl;
mod stream;

use std::fmt;

use serde::Deserialize;

use crate::Scene;

/// A half of the pitch, in the log's own coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    /// x < 0.
    Left,
    /// x > 0.
    Right,
}

impl Side {
    /// The name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }

    /// The other half.
    pub const fn opposite(self) -> Self {
        match self {
            Self::Left => Self::Right,
            Self::Right => Self::Left,
        }
    }

    /// −1 or 1: the sign of x there.
    const fn sign(self) -> f64 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// What a log gave.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// A scene for each instant that was asked for, in that order; start and goal are free.
    pub scenes: Vec<Scene>,
    /// Where the scenes are not simply what the log says, in words for their reader.
    pub notes: Vec<String>,
}

/// A place in a log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// A line of text, from 1.
    Line(u64),
    /// A byte, from 0.
    Byte {
        /// Bytes before it, after decompression.
        offset: u64,
        /// Whether the file is compressed, so that the offset is not the file's own.
        decompressed: bool,
    },
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "{line}:"),
            Self::Byte { offset, decompressed: false } => write!(f, " byte {offset}:"),
            Self::Byte { offset, decompressed: true } => write!(f, " byte {offset} (decompressed):"),
        }
    }
}

/// Why a log gives no scenes.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum ImportError {
    /// The log cannot be read from `place` on: cut short, corrupt, not such a log.
    #[error("{file}:{place} {message}")]
    Log {
        /// The file as the user named it.
        file: String,
        /// Where.
        place: Place,
        /// What is wrong and what was expected.
        message: String,
    },
    /// The log is sound but has no such instant, or none that makes a scene.
    #[error("{file}:{} {unit} {number}: {message}", place.map_or(String::new(), |place| place.to_string()))]
    Instant {
        /// The file as the user named it.
        file: String,
        /// Where the instant is, when it is in the log.
        place: Option<Place>,
        /// `cycle` or `frame`.
        unit: &'static str,
        /// Which of them.
        number: u64,
        /// What is wrong and what was expected.
        message: String,
    },
}
