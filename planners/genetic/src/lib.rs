//! Genetic planners: paths of cells, sequences of vertices.
//!
//! Fang, "Dynamic obstacle avoidance path planning of soccer robots based on
//! genetic algorithms", master's thesis, 2009, chapter 4: [`GridGa`] is §4.5,
//! [`VertexGa`] is §4.4. Both are one loop, selection, breeding, evaluation, over
//! different chromosomes; what the thesis leaves open is a setting, and the
//! settings say which of their values are the thesis's.

mod cells;
mod crossover;
mod dice;
mod evolution;
mod fitness;
mod grid_ga;
mod mutation;
mod population;
mod rates;
mod repair;
mod roulette;
mod settings;
mod vertex_ga;
mod vertices;

pub use fitness::{CellsPassed, GridFitness};
pub use grid_ga::GridGa;
pub use settings::{GridGaSettings, VertexFitness, VertexGaSettings};
pub use vertex_ga::VertexGa;
