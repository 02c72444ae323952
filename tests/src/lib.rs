//! What tests and benchmarks share: scenes, planners, order statistics, tables, pictures of growth.
//!
//! Integration tests of the whole project live in `suite/`, benchmarks in
//! `benches/`, reference scenes in `reference/`.

pub mod growth;
pub mod planners;
pub mod random;
pub mod report;
pub mod scenes;
pub mod statistics;
