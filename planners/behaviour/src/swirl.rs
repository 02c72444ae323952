//! A turn round what repels, against deadlock: where goal and obstacle lie in one line, attraction and repulsion alone
//! have nothing to go aside for.

use env_model::Vector;

/// The vector at right angles to the repulsion `away`, on the side towards the goal (left where both sides are), as
/// long as `away` but no longer than 1.
pub fn swirl(away: Vector, to_goal: Vector) -> Vector {
    let aside = Vector::new(-away.y, away.x);
    let aside = if aside.dot(&to_goal) < 0.0 { -aside } else { aside };
    let length = aside.norm();
    if length > 1.0 { aside / length } else { aside }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_turns_towards_the_goal() {
        let away = Vector::new(-0.5, 0.0);
        assert_eq!(swirl(away, Vector::new(1.0, 1.0)), Vector::new(0.0, 0.5));
        assert_eq!(swirl(away, Vector::new(1.0, -1.0)), Vector::new(0.0, -0.5));
        assert_eq!(swirl(away, Vector::new(1.0, 0.0)).norm(), 0.5, "head on it chooses a side all the same");
        assert_eq!(swirl(away * 1e4, Vector::new(1.0, 1.0)), Vector::new(0.0, 1.0));
    }
}
