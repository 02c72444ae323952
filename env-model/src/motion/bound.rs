//! How soon a robot could arrive at the earliest if nothing were in its way.

use super::axis::time;
use super::{Limits, State};
use crate::{Point, Vector};

/// Directions tried at first, over half a turn.
const DIRECTIONS: usize = 32;
/// Golden sections round the best: 0.618⁴⁰ of a step is below the rounding of a time.
const SECTIONS: usize = 40;

/// A lower bound on the time to rest at `goal`, in seconds, for any motion within `limits`.
///
/// Seen along any direction n the motion is one along an axis with the same limits, so T ≥ T₁(n·d, n·v); the bound is
/// the maximum over directions. Every direction tried gives a true bound; from rest the one towards the goal is exact.
/// A start above the speed limit first brakes down to it, straight on, as all motions here do: seen along another
/// direction than its own it may be too fast for longer than one axis would need.
pub fn least_time(state: State, goal: Point, limits: Limits) -> f64 {
    let speed = state.velocity.norm();
    if speed <= limits.speed {
        return within_limits(state, goal, limits);
    }
    let first = (speed - limits.speed) / limits.acceleration;
    let way = 0.5 * (speed + limits.speed) * first;
    let along = state.velocity / speed;
    let braked = State { position: state.position + along * way, velocity: along * limits.speed };
    first + within_limits(braked, goal, limits)
}

fn within_limits(state: State, goal: Point, limits: Limits) -> f64 {
    let d = goal - state.position;
    let along = |angle: f64| {
        let n = Vector::new(libm::cos(angle), libm::sin(angle));
        time(n.dot(&d), n.dot(&state.velocity), limits.speed, limits.acceleration)
    };
    // Half a turn: the opposite direction gives the same time. Begun towards the goal, for its exactness.
    let (towards, step) = (libm::atan2(d.y, d.x), std::f64::consts::PI / DIRECTIONS as f64);
    let tried = (0..DIRECTIONS).map(|i| towards + step * i as f64);
    let (mut best, mut most) = (towards, f64::NEG_INFINITY);
    for angle in tried {
        let t = along(angle);
        if t > most {
            (best, most) = (angle, t);
        }
    }
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut low, mut high) = (best - step, best + step);
    for _ in 0..SECTIONS {
        let [a, b] = [high - golden * (high - low), low + golden * (high - low)];
        let [ta, tb] = [along(a), along(b)];
        most = most.max(ta).max(tb);
        if ta > tb { high = b } else { low = a }
    }
    most
}
