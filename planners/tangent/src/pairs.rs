//! What is known of the tangents between circles.

/// A set of pairs of circles, as a matrix of bits.
#[derive(Debug, Default)]
pub(crate) struct PairSet {
    bits: Vec<u64>,
    /// Words a row.
    stride: usize,
    rows: usize,
}

impl PairSet {
    /// Empties the set.
    pub fn clear(&mut self) {
        self.rows = 0;
    }

    /// Makes room for pairs of numbers below `circles`; new rows are empty.
    pub fn resize(&mut self, circles: usize) {
        let words = circles.div_ceil(64);
        if words > self.stride {
            let stride = words.next_power_of_two();
            let mut bits = vec![0; stride * stride * 64];
            for row in 0..self.rows {
                bits[row * stride..][..self.stride].copy_from_slice(&self.bits[row * self.stride..][..self.stride]);
            }
            (self.bits, self.stride) = (bits, stride);
        }
        self.bits[self.rows * self.stride..circles * self.stride].fill(0);
        self.rows = circles;
    }

    /// Whether the pair is in the set.
    pub fn contains(&self, a: usize, b: usize) -> bool {
        self.bits[a * self.stride + b / 64] >> (b % 64) & 1 == 1
    }

    /// Puts the pair in.
    pub fn insert(&mut self, a: usize, b: usize) {
        self.bits[a * self.stride + b / 64] |= 1 << (b % 64);
    }
}
