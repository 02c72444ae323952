//! Motion along one axis in the least time.

/// Up to three stretches (seconds, acceleration) that end at rest on the target.
pub type Phases = [(f64, f64); 3];

/// The quickest way along one axis from velocity `v` to rest at distance `d`, |velocity| ≤ `speed`, |acceleration| ≤
/// `acceleration`, both > 0. A start above the speed limit first brakes down to it.
///
/// With σ = ±1 the side on which the target lies once one has braked, and all signs seen from there: accelerate to
/// v̂ = min(√(ad + v²/2), speed), cruise, brake (bang-coast-bang; Pontryagin).
pub fn quickest(d: f64, v: f64, speed: f64, acceleration: f64) -> Phases {
    let a = acceleration;
    let beyond = d - 0.5 * v * v.abs() / a;
    let sign = if beyond < 0.0 { -1.0 } else { 1.0 };
    let (d, v) = (sign * d, sign * v);
    let peak = (a * d + 0.5 * v * v).max(0.0).sqrt();
    if peak <= speed {
        // Rounding may put the peak below v where braking alone is enough.
        let peak = peak.max(v);
        return [((peak - v) / a, sign * a), (0.0, 0.0), (peak / a, -sign * a)];
    }
    let way = ((v - speed) * (v + speed)).abs() * 0.5 / a;
    let cruise =
        (d - if v <= speed { -0.5 * v * v / a + 0.5 * speed * speed / a } else { way } - 0.5 * speed * speed / a)
            .max(0.0)
            / speed;
    let to = if v <= speed { sign * a } else { -sign * a };
    [((speed - v).abs() / a, to), (cruise, 0.0), (speed / a, -sign * a)]
}

/// How long [`quickest`] takes, in seconds: the least time of any motion along the axis within the limits.
pub fn time(d: f64, v: f64, speed: f64, acceleration: f64) -> f64 {
    quickest(d, v, speed, acceleration).iter().map(|(duration, _)| duration).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn end(phases: Phases, v: f64) -> (f64, f64) {
        phases.iter().fold((0.0, v), |(x, v), (t, a)| (x + v * t + 0.5 * a * t * t, v + a * t))
    }

    #[test]
    fn hand_worked_cases() {
        // From rest, 1 m at 1 m/s²: two seconds.
        assert!((time(1.0, 0.0, 9.0, 1.0) - 2.0).abs() < 1e-15);
        // 10 m at 2 m/s and 1 m/s²: 2 s up, 2 s down on 4 m, 3 s for the 6 m between.
        assert!((time(10.0, 0.0, 2.0, 1.0) - 7.0).abs() < 1e-15);
        // Exactly the braking distance.
        assert!((time(2.0, 2.0, 2.0, 1.0) - 2.0).abs() < 1e-15);
        // Overshoot by 1 m: 2 s to stop 2 m on, 2 s back.
        assert!((time(1.0, 2.0, 9.0, 1.0) - 4.0).abs() < 1e-15);
        // Moving away.
        assert!((time(-2.0, 2.0, 9.0, 1.0) - (2.0 + 4.0)).abs() < 1e-15);
    }

    #[test]
    fn every_case_ends_at_rest_on_the_target() {
        let values = [-5.0, -1.3, -0.2, 0.0, 0.01, 0.7, 3.0];
        for d in values {
            for v in values {
                for speed in [0.5, 1.0, 4.0] {
                    let phases = quickest(d, v, speed, 1.5);
                    let (x, w) = end(phases, v);
                    // A few additions of numbers below 20.
                    assert!((x - d).abs() < 1e-13 && w.abs() < 1e-14, "{d} {v} {speed}: {x} {w}");
                    assert!(phases.iter().all(|(t, _)| *t >= 0.0), "{d} {v} {speed}");
                }
            }
        }
    }
}
