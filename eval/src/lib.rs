//! The bench: config → runs → verdicts → scores → statistics → report.

pub mod analysis;
mod behaviour;
pub mod campaign;
pub mod cli;
pub mod compare;
pub mod config;
pub mod differences;
pub mod error;
pub mod estimate;
pub mod export;
mod format;
mod json;
pub mod lock;
pub mod machine;
pub mod merge;
pub mod metrics;
pub mod optimum;
pub mod progress;
pub mod recorder;
pub mod replay;
pub mod report;
pub mod results;
pub mod runner;
pub mod seeds;
mod shell;
mod simulate;
pub mod snapshot;
pub mod statistics;
pub mod status;
pub mod store;
pub mod table;
pub mod trace;
pub mod verdict;
pub mod work;
pub mod worker;

#[cfg(test)]
mod testing;

pub use error::Error;
