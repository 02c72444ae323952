//! What individuals tell each other (Han & Kim 2002, §III-C).

/// The best string of every individual: n × `bits`, and their costs, n.
#[derive(Debug, Clone, Default)]
pub struct Bests {
    /// The strings, one after the other.
    pub strings: Vec<bool>,
    /// Their costs.
    pub costs: Vec<f64>,
}

impl Bests {
    /// The cheapest among individuals `from` … `to` − 1, the first of equals.
    pub fn least(&self, from: usize, to: usize) -> usize {
        (from..to).reduce(|least, i| if self.costs[i] < self.costs[least] { i } else { least }).expect("from < to")
    }

    /// In every group of `size` neighbours all take over the best string of the group.
    /// One group of all is the global migration.
    pub fn share(&mut self, size: usize) {
        let n = self.costs.len();
        let bits = self.strings.len() / n;
        for from in (0..n).step_by(size) {
            let to = from.saturating_add(size).min(n);
            let least = self.least(from, to);
            let cost = self.costs[least];
            for i in from..to {
                // Those as cheap keep their own string.
                if self.costs[i] > cost {
                    self.strings.copy_within(least * bits..(least + 1) * bits, i * bits);
                    self.costs[i] = cost;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_take_over_their_best_string() {
        let (o, i) = (false, true);
        let five = Bests { strings: vec![o, o, o, i, i, o, i, i, o, o], costs: vec![3.0, 2.0, 5.0, 4.0, 9.0] };
        let mut pairs = five.clone();
        pairs.share(2);
        assert_eq!(pairs.costs, [2.0, 2.0, 4.0, 4.0, 9.0], "the last group is one alone");
        assert_eq!(pairs.strings, [o, i, o, i, i, i, i, i, o, o]);
        let mut all = five;
        all.share(5);
        assert_eq!((all.costs, all.strings), (vec![2.0; 5], [o, i].repeat(5)));
    }
}
