//! Formations and their slots (Balch & Arkin 1998, unit-centre referenced).

use env_model::Vector;
use serde::{Deserialize, Serialize};

/// How a team stands while it moves. Slots are in units of the spacing, y forward, x to the right, their mean at the
/// unit's centre; robot 0 is the first of each list. The source gives four robots; other numbers continue its pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formation {
    /// Side by side: x = 0.5, 1.5, −0.5, −1.5.
    Line,
    /// One behind the other: y = 1.5, −0.5, 0.5, −1.5.
    Column,
    /// (0, 1), (1, 0), (−1, 0), (0, −1). Of n robots, evenly along the border of |x| + |y| ≤ n/4.
    #[default]
    Diamond,
    /// A V, its point ahead: (0.5, 0.5), (1.5, −0.5), (−0.5, 0.5), (−1.5, −0.5).
    Wedge,
}

impl Formation {
    /// Its name in configurations.
    pub fn name(self) -> &'static str {
        match self {
            Self::Line => "line",
            Self::Column => "column",
            Self::Diamond => "diamond",
            Self::Wedge => "wedge",
        }
    }

    /// The slots of `count` robots into `slots`.
    pub fn slots(self, count: usize, slots: &mut Vec<Vector>) {
        slots.clear();
        let half = count.div_ceil(2);
        let aside = |k: usize| {
            // The right half from the middle outwards, then the left half.
            let middle = if count.is_multiple_of(2) { 0.5 } else { 0.0 };
            if k < half { k as f64 + middle } else { -((k - half) as f64) - 1.0 + middle }
        };
        slots.extend((0..count).map(|k| match self {
            Self::Line => Vector::new(aside(k), 0.0),
            Self::Column => {
                let place = if k < half { 2 * k } else { 2 * (k - half) + 1 };
                Vector::new(0.0, 0.5 * (count as f64 - 1.0) - place as f64)
            }
            Self::Diamond => {
                // How far down the right or the left border, of 2: 1 is the corner aside.
                let down = 4.0 * k.div_ceil(2) as f64 / count as f64;
                let side = if k % 2 == 1 { 1.0 } else { -1.0 };
                Vector::new(side * (1.0 - (1.0 - down).abs()), 1.0 - down) * (0.25 * count as f64)
            }
            Self::Wedge => Vector::new(aside(k), -aside(k).abs()),
        }));
        let centre = slots.iter().sum::<Vector>() / count.max(1) as f64;
        slots.iter_mut().for_each(|slot| *slot -= centre);
    }
}

/// A slot as seen by a unit that heads along the unit vector `heading`: right is heading turned clockwise.
pub fn oriented(slot: Vector, heading: Vector) -> Vector {
    heading * slot.y + Vector::new(heading.y, -heading.x) * slot.x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slots(formation: Formation, count: usize) -> Vec<[f64; 2]> {
        let mut slots = Vec::new();
        formation.slots(count, &mut slots);
        slots.iter().map(|s| [s.x, s.y]).collect()
    }

    #[test]
    fn four_robots_stand_as_published() {
        assert_eq!(slots(Formation::Line, 4), [[0.5, 0.0], [1.5, 0.0], [-0.5, 0.0], [-1.5, 0.0]]);
        assert_eq!(slots(Formation::Column, 4), [[0.0, 1.5], [0.0, -0.5], [0.0, 0.5], [0.0, -1.5]]);
        assert_eq!(slots(Formation::Diamond, 4), [[0.0, 1.0], [1.0, 0.0], [-1.0, 0.0], [0.0, -1.0]]);
        assert_eq!(slots(Formation::Wedge, 4), [[0.5, 0.5], [1.5, -0.5], [-0.5, 0.5], [-1.5, -0.5]]);
    }

    #[test]
    fn any_number_stands_apart_round_its_centre() {
        for formation in [Formation::Line, Formation::Column, Formation::Diamond, Formation::Wedge] {
            for count in 1..=16 {
                let all = slots(formation, count);
                assert_eq!(all.len(), count);
                let sum = all.iter().fold([0.0, 0.0], |s, p| [s[0] + p[0], s[1] + p[1]]);
                assert!(sum[0].abs() < 1e-12 && sum[1].abs() < 1e-12, "{formation:?} {count}: a few additions");
                for (i, a) in all.iter().enumerate() {
                    for b in &all[..i] {
                        // Neighbours are one spacing apart; across a diamond's corner a little less.
                        assert!((a[0] - b[0]).hypot(a[1] - b[1]) > 0.7, "{formation:?} {count}: {a:?} {b:?}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_slot_turns_with_the_heading() {
        let slot = Vector::new(1.0, 2.0);
        assert_eq!(oriented(slot, Vector::y()), slot);
        // Eastward: forward is +x, right is −y.
        assert_eq!(oriented(slot, Vector::x()), Vector::new(2.0, -1.0));
    }
}
