//! The genetic algorithm that tunes the behaviours' parameters (Fang 2009, §5.3, whose text is lost: operators and
//! codings are those of the field).
//!
//! Generation 0 is drawn at random. All individuals of a generation play the same scenarios (common random numbers),
//! so that they differ by their parameters alone.

mod binary;
mod coding;
mod evolution;
mod genes;
mod real;
mod selection;
mod settings;

pub use evolution::{Generation, Tuned, tune};
pub use settings::{Coding, Selection, Tuning};
