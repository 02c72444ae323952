//! Who informs whom.
//!
//! Particle i follows the best of its informants, itself among them:
//! - ring: i ± 1;
//! - von Neumann (Kennedy & Mendes, CEC 2002): the four neighbours on a grid that
//!   closes on itself. Particles fill the grid row by row, ⌈√N⌉ a row; each row
//!   and each column closes on itself, so that any N will do: the last row may be
//!   shorter, and so the columns that end above it;
//! - random (the standards of 2006 to 2011: Clerc 2012): every other particle with
//!   probability 1 − (1 − 1/N)³, drawn anew after every iteration that did not
//!   improve the global best.

use crate::choices::Topology;
use crate::swarm::better;

/// How many particles each informs in the mean, about, with a random topology.
const K: f64 = 3.0;

/// The links of a topology, and the leaders that they make.
#[derive(Debug, Clone, Default)]
pub struct Neighbours {
    /// Informants of all particles; `ends[i]` ends those of particle i.
    informants: Vec<u32>,
    ends: Vec<usize>,
    /// The best informant of each particle; empty where the whole swarm is one neighbourhood.
    pub leaders: Vec<u32>,
}

impl Neighbours {
    /// Links `n` particles; `next` gives numbers uniform on [0, 1).
    pub fn link(&mut self, topology: Topology, n: usize, next: impl FnMut() -> f64) {
        self.informants.clear();
        self.ends.clear();
        self.leaders.clear();
        match topology {
            Topology::Global => return,
            Topology::Ring => {
                for i in 0..n {
                    self.push(&[i, (i + n - 1) % n, (i + 1) % n]);
                }
            }
            Topology::VonNeumann => {
                for i in 0..n {
                    self.push(&von_neumann(i, n));
                }
            }
            Topology::Random => self.link_at_random(n, next),
        }
        self.leaders.resize(n, 0);
    }

    fn push(&mut self, informants: &[usize]) {
        self.informants.extend(informants.iter().map(|&j| j as u32));
        self.ends.push(self.informants.len());
    }

    /// Walks the N × N matrix of links from hit to hit: the misses between two
    /// hits of probability p are geometric, ⌊ln u / ln(1 − p)⌋.
    fn link_at_random(&mut self, n: usize, mut next: impl FnMut() -> f64) {
        // 3N links are expected: far more than will ever be drawn, so that no later draw allocates.
        self.informants.reserve(n * n.min(16));
        let log_miss = K * libm::log(1.0 - 1.0 / n as f64);
        let mut misses = || (libm::log(1.0 - next()) / log_miss) as usize;
        let mut hit = misses();
        for i in 0..n {
            self.informants.push(i as u32);
            while hit < (i + 1) * n {
                if hit != i * n + i {
                    self.informants.push((hit - i * n) as u32);
                }
                hit = hit.saturating_add(1).saturating_add(misses());
            }
            self.ends.push(self.informants.len());
        }
    }

    /// Finds the leaders; ties go to the lower index.
    pub fn lead(&mut self, costs: &[f64]) {
        let mut begin = 0;
        for (i, (leader, &end)) in self.leaders.iter_mut().zip(&self.ends).enumerate() {
            let informants = &self.informants[begin..end];
            *leader = informants.iter().fold(i, |l, &j| better(costs, l, j as usize)) as u32;
            begin = end;
        }
    }
}

/// Particle `i` and its neighbours left, right, above and below among `n`.
fn von_neumann(i: usize, n: usize) -> [usize; 5] {
    let width = (1..).find(|w| w * w >= n).unwrap_or(n);
    let (row, column) = (i / width, i % width);
    let in_row = width.min(n - row * width);
    let in_column = (n - column).div_ceil(width);
    let at = |row: usize, column: usize| row * width + column;
    [
        i,
        at(row, (column + in_row - 1) % in_row),
        at(row, (column + 1) % in_row),
        at((row + in_column - 1) % in_column, column),
        at((row + 1) % in_column, column),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn informants(neighbours: &Neighbours, i: usize) -> Vec<u32> {
        let begin = if i == 0 { 0 } else { neighbours.ends[i - 1] };
        neighbours.informants[begin..neighbours.ends[i]].to_vec()
    }

    #[test]
    fn grid_of_four_by_five() {
        // Twenty particles in rows of ⌈√20⌉ = 5: 0 is a corner, 12 in the middle, 19 the last.
        assert_eq!(von_neumann(0, 20), [0, 4, 1, 15, 5]);
        assert_eq!(von_neumann(12, 20), [12, 11, 13, 7, 17]);
        assert_eq!(von_neumann(19, 20), [19, 18, 15, 14, 4]);
        // Seven in rows of three: the last row is 6 alone, under 0 and 3.
        assert_eq!(von_neumann(6, 7), [6, 6, 6, 3, 0]);
        assert_eq!(von_neumann(4, 7), [4, 3, 5, 1, 1]);
    }

    #[test]
    fn neighbourhood_is_mutual_for_any_number() {
        for n in 1..60 {
            for i in 0..n {
                for j in von_neumann(i, n) {
                    assert!(j < n && von_neumann(j, n).contains(&i), "{i} and {j} of {n}");
                }
            }
        }
    }

    #[test]
    fn leaders_are_the_best_informants() {
        let mut ring = Neighbours::default();
        ring.link(Topology::Ring, 5, || unreachable!());
        ring.lead(&[3.0, 1.0, 2.0, 2.0, 2.0]);
        assert_eq!(ring.leaders, [1, 1, 1, 2, 3]);
    }

    #[test]
    fn random_links_follow_the_given_numbers() {
        // N = 3: ln(1 − p) = 3 ln(2/3) = −1.2164. u = 1 − r; misses ⌊ln u/−1.2164⌋ for
        // r = 0.5, 0.8, 0.0, 0.99: 0, 1, 0, 3. Hits at cells 0, 2, 3, 7 of the 3 × 3: links
        // 0 ← 0 (its own anyway), 0 ← 2, 1 ← 0, 2 ← 1; then r = 0.9 (1 miss) leaves the matrix.
        let mut numbers = [0.5, 0.8, 0.0, 0.99, 0.9].into_iter();
        let mut random = Neighbours::default();
        random.link(Topology::Random, 3, || numbers.next().unwrap());
        assert_eq!([0, 1, 2].map(|i| informants(&random, i)), [vec![0, 2], vec![1, 0], vec![2, 1]]);
    }

    #[test]
    fn random_links_are_as_frequent_as_the_standard_says() {
        let (n, draws) = (20, 500);
        let mut generator = crate::lanes::Lanes::default();
        generator.seed(&mut 5, 1);
        let mut random = Neighbours::default();
        let mut links = 0;
        for _ in 0..draws {
            random.link(Topology::Random, n, || generator.one());
            links += random.informants.len() - n;
        }
        // p = 1 − 0.95³ = 0.142625, over 500 × 380 pairs: five standard errors are 0.004.
        let share = links as f64 / (draws * n * (n - 1)) as f64;
        assert!((share - 0.142_625).abs() < 0.004, "{share}");
        // One particle has no one else to hear.
        random.link(Topology::Random, 1, || generator.one());
        assert_eq!(random.informants, [0]);
    }
}
