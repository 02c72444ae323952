//! Ant colony on a cell grid: Ant System for paths.
//!
//! m ants walk from start to goal over free cells (eight moves, no corner cutting).
//! An ant in cell i goes on to the free cell j, not visited by it before (tabu), with probability
//!
//! pᵢⱼ = τᵢⱼ^α ηⱼ^β / Σₖ τᵢₖ^α ηₖ^β,  ηⱼ = 1/d(j, goal).
//!
//! When all have walked, the trails evaporate and every ant of tour length L lays Q/L on its edges:
//! τᵢⱼ ← (1 − ρ) τᵢⱼ + Σ Q/L, and with elitists e·Q/L* on the best tour so far.
//!
//! M. Dorigo, V. Maniezzo & A. Colorni, "Ant System: optimization by a colony of cooperating
//! agents", IEEE Trans. Systems, Man, and Cybernetics B 26(1), 1996, 29–41,
//! [doi:10.1109/3477.484436](https://doi.org/10.1109/3477.484436): eqs. 1–4 (the
//! ant-cycle algorithm; its ρ is what stays, 1 − ρ here) and §V for elitists.
//!
//! A pitch is not a complete graph, hence three customs of the path-planning
//! literature: η looks at the distance to the goal, not at the next edge's length;
//! an ant in a dead end steps back (or dies); loops are cut out of a tour before
//! it is valued (Dorigo & Stützle, *Ant Colony Optimization*, 2004, §1.3.1).

mod map;
mod planner;
mod settings;
mod tour;
mod trails;
mod walk;

pub use planner::AntColony;
pub use settings::{DeadEnd, Settings};
