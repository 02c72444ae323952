//! The bench: config → runs → verdicts → scores → statistics → report.

pub mod report;
pub mod results;
pub mod stats;
