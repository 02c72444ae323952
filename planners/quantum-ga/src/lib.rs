//! A quantum-inspired evolutionary algorithm on the columns of the 2012 paper.
//!
//! Han & Kim, "Quantum-inspired evolutionary algorithm for a class of combinatorial
//! optimization", *IEEE Trans. Evolutionary Computation* 6(6), 2002, 580–593,
//! doi:10.1109/TEVC.2002.804320. An individual is a string of qubits, each 1 with
//! probability |β|². Observing it gives a binary string; rotation gates turn the
//! qubits towards the best string that the individual has seen. The papers that
//! this project follows name the method and give no encoding; that of
//! [`QuantumGa`] is ours.

mod migration;
mod planner;
mod qubits;
mod settings;

pub use planner::QuantumGa;
pub use settings::QuantumGaSettings;
