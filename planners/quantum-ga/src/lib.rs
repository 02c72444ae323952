//! Quantum-inspired genetic algorithm.
