//! Trajectories of two independent axes that share the robot's limits (the practice of the Small Size League; TIGERs
//! Mannheim's `BangBangTrajectory2D`).
//!
//! The x axis gets cos α of speed and acceleration, the y axis sin α; α is chosen so that both arrive together. From
//! rest that is the straight line and optimal; from a moving start better motions exist by a few per cent. Unlike the
//! original, α keeps both axes within their share of the speed from the beginning, else the sum could be too fast.

use super::axis::{Phases, quickest, time};
use super::{Limits, State, Trajectory};
use crate::{Point, Vector};

/// Halvings of the range of α: below the rounding of arrival times.
const HALVINGS: usize = 40;

/// Brakes as hard as possible from where `trajectory` ends now until it stands.
pub(super) fn stop(trajectory: &mut Trajectory, limits: Limits) {
    slow_down(trajectory, 0.0, limits);
    let end = trajectory.end();
    trajectory.end_at(State::at_rest(end.position));
}

pub(super) fn slow_down(trajectory: &mut Trajectory, to: f64, limits: Limits) {
    let v = trajectory.end().velocity;
    let speed = v.norm();
    if speed > to {
        trajectory.push((speed - to) / limits.acceleration, v * (-limits.acceleration / speed));
    }
}

/// Straight on, braking as hard as possible until it stands, into `out`.
pub fn brake(state: State, limits: Limits, out: &mut Trajectory) {
    out.begin(state);
    stop(out, limits);
}

/// From `state` to rest at `goal`, into `out`. A start above the speed limit first brakes down to it, straight on.
pub fn bang_bang(state: State, goal: Point, limits: Limits, out: &mut Trajectory) {
    out.begin(state);
    slow_down(out, limits.speed, limits);
    let from = out.end();
    let (d, v) = (goal - from.position, from.velocity);
    // cos α ≥ |vₓ|/speed and sin α ≥ |v_y|/speed; the ends meet at full speed.
    let [x, y] = [v.x, v.y].map(|v| (v.abs() / limits.speed).min(1.0));
    let (mut low, mut high) = (libm::asin(y), libm::acos(x).max(libm::asin(y)));
    let shares = |alpha: f64| [libm::cos(alpha), libm::sin(alpha)].map(|share: f64| share.max(1e-9));
    let axis = |i: usize, share: f64| (d[i], v[i], share * limits.speed, share * limits.acceleration);
    for _ in 0..HALVINGS {
        let alpha = 0.5 * (low + high);
        let [tx, ty] = std::array::from_fn(|i| {
            let (d, v, speed, acceleration) = axis(i, shares(alpha)[i]);
            time(d, v, speed, acceleration)
        });
        if tx > ty { high = alpha } else { low = alpha }
    }
    let alpha = 0.5 * (low + high);
    let phases: [Phases; 2] = std::array::from_fn(|i| {
        let (d, v, speed, acceleration) = axis(i, shares(alpha)[i]);
        quickest(d, v, speed, acceleration)
    });
    merge(phases, out);
    out.end_at(State::at_rest(goal));
}

/// Appends the motion whose axes follow `phases`.
fn merge(phases: [Phases; 2], out: &mut Trajectory) {
    let mut at = [0, 0];
    let mut left = [phases[0][0].0, phases[1][0].0];
    loop {
        for i in 0..2 {
            while left[i] <= 0.0 && at[i] < 3 {
                at[i] += 1;
                left[i] = phases[i].get(at[i]).map_or(f64::INFINITY, |p| p.0);
            }
        }
        let step = left[0].min(left[1]);
        if step.is_infinite() {
            return;
        }
        let acceleration = |i: usize| phases[i].get(at[i]).map_or(0.0, |p| p.1);
        out.push(step, Vector::new(acceleration(0), acceleration(1)));
        left = left.map(|l| l - step);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::motion::least_time;

    #[test]
    fn from_rest_it_is_straight_and_optimal() {
        let limits = Limits::new(3.0, 3.0).unwrap();
        let (from, goal) = (Point::new(1.0, -2.0), Point::new(4.0, 2.0));
        let mut out = Trajectory::default();
        bang_bang(State::at_rest(from), goal, limits, &mut out);
        // 5 m: 1 s up and 1 s down on 3 m, 2 m at 3 m/s.
        assert!((out.duration() - (2.0 + 2.0 / 3.0)).abs() < 1e-9, "{}", out.duration());
        assert!((least_time(State::at_rest(from), goal, limits) - out.duration()).abs() < 1e-9);
        let middle = out.state(0.5 * out.duration()).position;
        assert!((middle - nalgebra::center(&from, &goal)).norm() < 1e-9);
        assert_eq!(out.end(), State::at_rest(goal));
    }

    #[test]
    fn a_moving_start_keeps_the_limits() {
        let limits = Limits::new(2.0, 3.0).unwrap();
        let mut out = Trajectory::default();
        for (vx, vy) in [(1.8, 0.86), (-1.0, 1.0), (0.0, -2.0), (3.0, 1.0)] {
            let state = State { position: Point::new(0.3, 0.1), velocity: Vector::new(vx, vy) };
            bang_bang(state, Point::new(0.5, 4.0), limits, &mut out);
            let peaks = out.peaks();
            assert!(peaks.speed <= limits.speed.max(state.velocity.norm()) * (1.0 + 1e-12), "{peaks:?}");
            assert!(peaks.acceleration <= limits.acceleration * (1.0 + 1e-12), "{peaks:?}");
            let last = out.pieces().last().unwrap();
            let reached = last.state(last.duration);
            assert!((reached.position - out.end().position).norm() < 1e-9 && reached.velocity.norm() < 1e-9);
            assert!(out.duration() >= least_time(state, Point::new(0.5, 4.0), limits) * (1.0 - 1e-12));
        }
    }
}
