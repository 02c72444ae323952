//! The dynamic window approach.
