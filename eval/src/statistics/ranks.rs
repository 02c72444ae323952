//! Ranks, in which equal values share the mean of theirs.

/// Ranks of values, and how many shared each.
pub struct Ranks {
    /// Rank of each value, from 1, equal values with the mean of the ranks they fill.
    pub ranks: Vec<f64>,
    /// Σ(t³ − t) over groups of t equal values; 0 without ties.
    pub ties: f64,
}

/// Ranks `values`, the least first.
pub fn ranks(values: &[f64]) -> Ranks {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut out = Ranks { ranks: vec![0.0; values.len()], ties: 0.0 };
    let mut before = 0;
    for group in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let t = group.len() as f64;
        for &i in group {
            out.ranks[i] = before as f64 + (t + 1.0) / 2.0;
        }
        out.ties += t * t * t - t;
        before += group.len();
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_share_their_ranks() {
        let r = ranks(&[f64::INFINITY, 2.0, 0.0, -0.0, 2.0, 2.0, f64::INFINITY]);
        assert_eq!(r.ranks, [6.5, 4.0, 1.5, 1.5, 4.0, 4.0, 6.5]);
        assert_eq!(r.ties, 6.0 + 24.0 + 6.0);
        assert!(ranks(&[]).ranks.is_empty());
    }
}
