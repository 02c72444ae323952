//! How a swarm moves: one update rule a file.
//!
//! A rule gives velocities. Limit, move and border ([`crate::border`]), evaluation
//! and bests ([`crate::swarm`]) are common, so that rules differ in their formula alone.

mod comprehensive;
mod inertia;
mod quantum;
mod spso2011;

#[cfg(test)]
mod by_hand;

use crate::border::Border;
use crate::choices::Rule;
use crate::settings::Settings;
use crate::swarm::Swarm;

pub use inertia::Weights;

/// An update rule and what it remembers between iterations.
pub trait UpdateRule: Send {
    /// Rows of pairs of random numbers that a step takes in `dims` dimensions:
    /// so much of `swarm.random` is fresh when [`UpdateRule::steer`] is called.
    fn rows(&self, dims: usize) -> usize {
        dims
    }

    /// Takes over a swarm that has just been placed, at rest and not yet
    /// evaluated: forgets the last run, sets initial velocities.
    fn begin(&mut self, swarm: &mut Swarm, border: Border) {
        let _ = (swarm, border);
    }

    /// The velocities of iteration `t`, counted from 0: written to `swarm.v`, or
    /// the weights of equation (1), with which evaluation moves the particles in
    /// the same sweep.
    fn steer(&mut self, swarm: &mut Swarm, t: u64) -> Option<Weights>;
}

/// The rule that `settings`, filled, ask for.
pub fn rule(settings: &Settings) -> Box<dyn UpdateRule> {
    match settings.rule {
        Rule::Inertia | Rule::Constriction => Box::new(inertia::Inertia::new(settings)),
        Rule::Quantum => Box::new(quantum::Quantum::new(settings)),
        Rule::Spso2011 => Box::new(spso2011::Spso2011::new(settings)),
        Rule::Comprehensive => Box::new(comprehensive::Comprehensive::new(settings)),
    }
}
