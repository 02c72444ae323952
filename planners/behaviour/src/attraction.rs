//! Attraction to a point: the goal, or a slot of the formation (Balch & Arkin 1998, maintain-formation).

use env_model::Vector;

/// The unit vector along `to`, which leads to the point, times its strength at d = ‖to‖:
/// 0 up to `dead` (the dead zone), (d − dead)/(control − dead) up to `control` (the controlled zone), 1 beyond.
pub fn attraction(to: Vector, dead: f64, control: f64) -> Vector {
    let d = to.norm();
    if d <= dead {
        Vector::zeros()
    } else if d < control {
        to * ((d - dead) / ((control - dead) * d))
    } else {
        to / d
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_zone_by_hand() {
        // (3, 4): d = 5.
        let to = Vector::new(3.0, 4.0);
        assert_eq!(attraction(to, 5.0, 9.0), Vector::zeros(), "dead zone, its border included");
        // (5 − 1)/(9 − 1) = ½ of (0.6, 0.8).
        assert!((attraction(to, 1.0, 9.0) - Vector::new(0.3, 0.4)).norm() < 1e-15, "a few roundings");
        assert!((attraction(to, 1.0, 5.0) - Vector::new(0.6, 0.8)).norm() < 1e-15, "ballistic zone");
        assert_eq!(attraction(Vector::zeros(), 0.0, 0.0), Vector::zeros(), "on the point");
    }
}
