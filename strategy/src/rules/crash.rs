//! Crash fouls: who is guilty when two robots of different teams meet.

use env_model::motion::State;

/// "Crashing" (SSL rules 2026): relative speed along the line of the centres, in m/s, above which contact is a foul.
pub const CRASH_SPEED: f64 = 1.5;
/// "Crashing": where speeds differ by less, in m/s, both teams are guilty.
pub const CRASH_MARGIN: f64 = 0.3;

/// Who committed a crash foul.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Guilt {
    /// The first robot.
    First,
    /// The second.
    Second,
    /// Both.
    Both,
}

/// Speed at which two robots near each other along the line of their centres, in m/s: (v₁ − v₂)·n with n from the
/// first to the second; 0 where the centres coincide.
pub fn closing_speed(first: State, second: State) -> f64 {
    let line = (second.position - first.position).try_normalize(0.0);
    line.map_or(0.0, |n| (first.velocity - second.velocity).dot(&n))
}

/// Whose crash foul the contact of two robots of different teams is, if any.
pub fn crash(first: State, second: State) -> Option<Guilt> {
    let difference = first.velocity.norm() - second.velocity.norm();
    (closing_speed(first, second) > CRASH_SPEED).then_some(match difference {
        d if d.abs() < CRASH_MARGIN => Guilt::Both,
        d if d > 0.0 => Guilt::First,
        _ => Guilt::Second,
    })
}

#[cfg(test)]
mod tests {
    use env_model::{Point, Vector};

    use super::*;

    fn robot(x: f64, v: [f64; 2]) -> State {
        State { position: Point::new(x, 0.0), velocity: Vector::new(v[0], v[1]) }
    }

    fn verdict(v: [f64; 2], w: [f64; 2]) -> Option<Guilt> {
        crash(robot(0.0, v), robot(0.18, w))
    }

    #[test]
    fn the_faster_one_is_guilty() {
        assert_eq!(verdict([2.0, 0.0], [0.0, 0.0]), Some(Guilt::First));
        assert_eq!(verdict([0.0, 0.0], [-2.0, 0.0]), Some(Guilt::Second));
        assert_eq!(verdict([2.0, 0.0], [-1.0, 0.0]), Some(Guilt::First));
    }

    #[test]
    fn equals_are_both_guilty() {
        assert_eq!(verdict([1.0, 0.0], [-1.0, 0.0]), Some(Guilt::Both));
        // Speeds are those of the robots, not along the line: 1.25 and 1.
        assert_eq!(verdict([1.0, 0.75], [-1.0, 0.0]), Some(Guilt::Both));
        // 0.25 and 0.5 are exact in binary.
        assert_eq!(verdict([1.0, 0.0], [-1.25, 0.0]), Some(Guilt::Both));
        assert_eq!(verdict([1.0, 0.0], [-1.5, 0.0]), Some(Guilt::Second));
    }

    #[test]
    fn thresholds_are_exact() {
        // A closing speed of 1.5 is none, the next number is one.
        assert_eq!(verdict([1.5, 0.0], [0.0, 0.0]), None);
        assert_eq!(verdict([1.5f64.next_up(), 0.0], [0.0, 0.0]), Some(Guilt::First));
        // 1.9 − 1.6 rounds to just below 0.3, 1.8 − 1.5 to just above.
        assert_eq!(verdict([1.6, 0.0], [-1.9, 0.0]), Some(Guilt::Both));
        assert_eq!(verdict([1.5, 0.0], [-1.8, 0.0]), Some(Guilt::Second));
    }

    #[test]
    fn passing_by_is_none() {
        assert_eq!(verdict([0.0, 3.0], [0.0, -3.0]), None, "along each other");
        assert_eq!(verdict([-3.0, 0.0], [3.0, 0.0]), None, "away from each other");
        assert_eq!(crash(robot(0.0, [3.0, 0.0]), robot(0.0, [0.0, 0.0])), None, "no line");
    }
}
