//! Bio-inspired shunting neural network: activity spreads from the goal over a
//! grid of neurons, and the robot climbs it (Glasius, Komoda & Gielen 1995; Yang & Meng 2000).
//!
//! One neuron a cell, joined to its eight neighbours:
//!
//! `ẋᵢ = −A xᵢ + (B − xᵢ) ([Iᵢ]⁺ + Σⱼ wᵢⱼ [xⱼ]⁺) − (D + xᵢ) [Iᵢ]⁻`, wᵢⱼ = μ/dᵢⱼ,
//!
//! with I = E at the goal, −E at obstacles, 0 elsewhere; dᵢⱼ = 1 or √2 cells;
//! `[a]⁺` = max(a, 0), `[a]⁻` = max(−a, 0). Activity stays within [−D, B]. The
//! goal's spreads through free cells, obstacles' stays where it is. From the
//! start the path goes on to the neighbour of the highest activity.
//!
//! Here nothing moves, so only the steady state matters. It is found by setting
//! each neuron in turn to its own equilibrium, [`Network::sweep`]; integrating
//! the differential equation leads to the same state, more slowly.
//!
//! **Where this ends.** With A > W = B μ (4 + 2√2), the most that a neuron's
//! neighbours can give, the steady state is unique (the sweep contracts by W/A)
//! and falls off away from the goal: no neuron but the goal's is a local
//! maximum, for x = BS/(A + S) and S ≤ x W/B give x ≤ (W − A) B/W < 0. A
//! smaller A lets activity feed itself: it saturates into plateaus of equal
//! numbers, on which a climb can stop.
//! With the defaults activity falls by a factor of about 3 a cell in the open
//! and 10 in a corridor one cell wide, so it leaves the normal range of `f64`
//! (below 2.2·10⁻³⁰⁸ it is set to 0) after about 640 and 300 cells; from there the goal is not felt.
//!
//! Sources: R. Glasius, A. Komoda & S. Gielen, *Neural network dynamics for path
//! planning and obstacle avoidance*, Neural Networks 8(1):125–133, 1995, DOI
//! 10.1016/0893-6080(94)E0045-M; S. X. Yang & M. Meng, *An efficient neural network
//! approach to dynamic robot motion planning*, Neural Networks 13(2):143–148, 2000,
//! DOI 10.1016/S0893-6080(99)00103-3; the same, *Neural network approaches to dynamic
//! collision-free trajectory generation*, IEEE Trans. SMC B 31(3):302–318, 2001,
//! DOI 10.1109/3477.931512.

mod network;
mod planner;
mod settings;

pub use network::Network;
pub use planner::Neural;
pub use settings::NeuralSettings;
