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
    /// The neighbours of each neuron, four straight, then four diagonal ones.
    /// Where one is missing stands the number of a neuron beyond the last, always at rest.
    links: Vec<[u32; 8]>,
    /// x of every neuron and of that one.
    activity: Vec<f64>,
}

impl Network {
    /// Lays the network over `grid`, at rest, obstacles inhibited, no goal yet.
    /// Returns the number of cell–shape tests.
    ///
    /// A link is a move to a free neighbour that cuts no corner of a blocked cell:
    /// activity takes the ways that the robot can take, and no others.
    ///
    /// `go_on` is asked once the cells are tested; when it declines, there are no links.
    pub fn lay(
        &mut self,
        world: &World,
        grid: &CellGrid,
        settings: &NeuralSettings,
        go_on: impl FnOnce() -> bool,
    ) -> u64 {
        let tests = grid.occupy(world, &mut self.blocked);
        self.links.clear();
        if !go_on() {
            return tests;
        }
        let inhibition = |blocked: &bool| if *blocked { settings.input } else { 0.0 };
        self.inhibition.clear();
        self.inhibition.extend(self.blocked.iter().map(inhibition));
        self.excitation.clear();
        self.excitation.resize(grid.len(), 0.0);
        self.activity.clear();
        self.activity.resize(grid.len() + 1, 0.0);
        self.links.extend((0..grid.len()).map(|cell| {
            let mut links = [grid.len() as u32; 8];
            let mut ends = [0, 4];
            grid.for_each_move(&self.blocked, cell, |to, diagonal| {
                let end = &mut ends[usize::from(diagonal)];
                links[*end] = to as u32;
                *end += 1;
            });
            links
        }));
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
        &self.activity[..self.len()]
    }

    /// Number of neurons.
    pub fn len(&self) -> usize {
        self.links.len()
    }

    /// Whether there is no neuron.
    pub fn is_empty(&self) -> bool {
        self.links.is_empty()
    }

    /// Sets every neuron once to the equilibrium of its equation,
    /// `x = (B S − D [I]⁻)/(A + S + [I]⁻), S = [I]⁺ + Σ w [x]⁺`, in the grid's order
    /// or against it. Returns the largest change, relative to the new value.
    ///
    /// Gauss–Seidel; alternating orders carry activity across the whole grid in
    /// a sweep wherever the way does not turn back on itself. O(neurons).
    pub fn sweep(&mut self, forward: bool, settings: &NeuralSettings) -> f64 {
        let n = self.len();
        let mut largest = 0.0_f64;
        for k in 0..n {
            let i = if forward { k } else { n - 1 - k };
            // Links lead to free neurons, whose activity is never negative: no [x]⁺ is needed.
            let links = &self.links[i];
            let x = |k: usize| self.activity[links[k] as usize];
            let straight = (x(0) + x(1)) + (x(2) + x(3));
            let diagonal = (x(4) + x(5)) + (x(6) + x(7));
            let s = self.excitation[i] + settings.coupling * (straight + FRAC_1_SQRT_2 * diagonal);
            let inhibition = self.inhibition[i];
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
    /// activity (among equals straight before diagonal, then anticlockwise from the
    /// right); `None` on a local maximum.
    pub fn uphill(&self, cell: usize) -> Option<usize> {
        let mut best = (self.activity[cell], None);
        // The neuron at rest that fills gaps is never higher than a free one.
        for j in self.links[cell].map(|j| j as usize) {
            if self.activity[j] > best.0 {
                best = (self.activity[j], Some(j));
            }
        }
        best.1
    }
}
