//! Chromosomes and their fitness, in buffers that are kept.

/// A gene: the number of a cell or of a vertex.
pub type Gene = u32;

/// A list of individuals.
#[derive(Debug, Clone, Default)]
pub struct Population {
    /// The chromosomes; only the first `fitness.len()` have been evaluated.
    pub genes: Vec<Vec<Gene>>,
    /// Their fitness.
    pub fitness: Vec<f64>,
}

impl Population {
    /// Empties `size` chromosomes and makes room for `capacity` genes in each:
    /// the same room in all, so that swapping populations never costs an allocation.
    pub fn prepare(&mut self, size: usize, capacity: usize) {
        self.genes.resize_with(size, Vec::new);
        for genes in &mut self.genes {
            genes.clear();
            genes.reserve_exact(capacity);
        }
        self.fitness.clear();
        self.fitness.reserve_exact(size);
    }

    /// The fittest individual, the first of equals; `None` while none is evaluated.
    pub fn best(&self) -> Option<usize> {
        (0..self.fitness.len()).reduce(|best, i| if self.fitness[i] > self.fitness[best] { i } else { best })
    }

    /// Mean fitness.
    pub fn mean(&self) -> f64 {
        self.fitness.iter().sum::<f64>() / self.fitness.len() as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_of_equals_is_best() {
        let mut population = Population::default();
        population.prepare(3, 4);
        assert_eq!(population.best(), None);
        population.fitness.extend([1.0, 2.5, 2.5]);
        assert_eq!((population.best(), population.mean()), (Some(1), 2.0));
    }
}
