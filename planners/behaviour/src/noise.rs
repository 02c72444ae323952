//! A random heading that is held for a while (Balch & Arkin 1998, noise): against local minima.

use env_model::Vector;

use crate::dice::Dice;

/// The headings of one robot of the team, drawn as they are needed.
#[derive(Debug, Clone, Default)]
pub struct Noise {
    heading: Vector,
    /// For how many more steps it is held.
    left: u64,
    /// How many were drawn.
    drawn: u64,
}

impl Noise {
    /// The heading of the next step, a unit vector; each is held for `steps` ≥ 1. All randomness is `seed`'s.
    pub fn next(&mut self, steps: u64, seed: u64) -> Vector {
        if self.left == 0 {
            self.heading = Dice::new(seed, self.drawn).heading();
            self.drawn += 1;
            self.left = steps;
        }
        self.left -= 1;
        self.heading
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_heading_is_held_then_another_follows() {
        let mut noise = Noise::default();
        let headings: Vec<Vector> = (0..9).map(|_| noise.next(3, 5)).collect();
        for held in headings.chunks(3) {
            assert!(held.iter().all(|h| h == &held[0]));
        }
        assert!(headings[0] != headings[3] && headings[3] != headings[6]);
        assert_eq!(Noise::default().next(3, 5), headings[0], "the seed decides");
    }
}
