//! The network: neurons, their links, and the way to the steady state.

use std::f64::consts::FRAC_1_SQRT_2;

use env_model::{CellGrid, World};

use crate::NeuralSettings;

/// Neurons on a cell grid. Buffers are reused from world to world.
#[derive(Debug, Clone, Default)]
pub struct Network {
    blocked: Vec<bool>,
    /// [Iᵢ]⁺ and [Iᵢ]⁻.
    excitation: Vec<f64>,
    inhibition: Vec<f64>,
    /// Links of neuron i: `links[first[i]..first[i + 1]]`, as (j, wᵢⱼ).
    first: Vec<u32>,
    links: Vec<(u32, f64)>,
    activity: Vec<f64>,
}

impl Network {
    /// Lays the network over `grid`, at rest, obstacles inhibited, no goal yet.
    /// Returns the number of cell–shape tests.
    ///
    /// A link is a move to a free neighbour that cuts no corner of a blocked cell:
    /// activity takes the ways that the robot can take, and no others.
    pub fn lay(&mut self, world: &World, grid: &CellGrid, settings: &NeuralSettings) -> u64 {
        let tests = grid.occupy(world, &mut self.blocked);
        let inhibition = |blocked: &bool| if *blocked { settings.input } else { 0.0 };
        self.inhibition.clear();
        self.inhibition.extend(self.blocked.iter().map(inhibition));
        for zeroed in [&mut self.excitation, &mut self.activity] {
            zeroed.clear();
            zeroed.resize(grid.len(), 0.0);
        }
        self.links.clear();
        self.first.clear();
        self.first.push(0);
        for cell in 0..grid.len() {
            grid.for_each_move(&self.blocked, cell, |to, diagonal| {
                let weight = settings.coupling * if diagonal { FRAC_1_SQRT_2 } else { 1.0 };
                self.links.push((to as u32, weight));
            });
            self.first.push(self.links.len() as u32);
        }
        tests
    }

    /// Gives a free cell the goal's input.
    pub fn excite(&mut self, cell: usize, settings: &NeuralSettings) {
        self.excitation[cell] = settings.input;
    }

    /// Cells that cannot be entered.
    pub fn blocked(&self) -> &[bool] {
        &self.blocked
    }

    /// x of every neuron, in the grid's numbering.
    pub fn activity(&self) -> &[f64] {
        &self.activity
    }

    /// Number of neurons.
    pub fn len(&self) -> usize {
        self.activity.len()
    }

    /// Whether there is no neuron.
    pub fn is_empty(&self) -> bool {
        self.activity.is_empty()
    }

    /// Sets every neuron once to the equilibrium of its equation,
    /// x = (B S − D [I]⁻)/(A + S + [I]⁻), S = [I]⁺ + Σ w [x]⁺, in the grid's order
    /// or against it. Returns the largest change, relative to the new value.
    ///
    /// Gauss–Seidel; alternating orders carry activity across the whole grid in
    /// a sweep wherever the way does not turn back on itself. O(neurons).
    pub fn sweep(&mut self, forward: bool, settings: &NeuralSettings) -> f64 {
        let n = self.len();
        let mut largest = 0.0_f64;
        for k in 0..n {
            let i = if forward { k } else { n - 1 - k };
            let links = &self.links[self.first[i] as usize..self.first[i + 1] as usize];
            // Links lead to free neurons, whose activity is never negative: no [x]⁺ is needed.
            let input: f64 = links.iter().map(|(j, weight)| weight * self.activity[*j as usize]).sum();
            let (s, inhibition) = (self.excitation[i] + input, self.inhibition[i]);
            let mut x = (settings.upper * s - settings.lower * inhibition) / (settings.decay + s + inhibition);
            // Subnormal numbers are slow and too coarse to be compared.
            if x.abs() < f64::MIN_POSITIVE {
                x = 0.0;
            }
            if x != self.activity[i] {
                largest = largest.max((x - self.activity[i]).abs() / x.abs());
                self.activity[i] = x;
            }
        }
        largest
    }

    /// The neighbour that a climb goes to from `cell`: that of the highest
    /// activity, the first in the order of moves among equals; `None` on a local maximum.
    pub fn uphill(&self, cell: usize) -> Option<usize> {
        let links = &self.links[self.first[cell] as usize..self.first[cell + 1] as usize];
        let mut best = (self.activity[cell], None);
        for (j, _) in links {
            let j = *j as usize;
            if self.activity[j] > best.0 {
                best = (self.activity[j], Some(j));
            }
        }
        best.1
    }
}
