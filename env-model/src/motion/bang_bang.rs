//! Trajectories of two independent axes that share the robot's limits (the practice of the Small Size League; TIGERs
//! Mannheim's `BangBangTrajectory2D`).
//!
//! The x axis gets cos α of speed and acceleration, the y axis sin α; α is chosen so that both arrive together. From
//! rest that is the straight line and optimal; from a moving start better motions exist by a few per cent. Unlike the
//! original, α is chosen so that the sum of both is never too fast, whatever the start.

use super::axis::{Phases, quickest, time};
use super::{Limits, State, Trajectory};
use crate::{Point, Vector};

/// Steps of the search for α at most; six or so are enough but for the oddest motions.
const STEPS: usize = 60;
/// Difference of the axes' arrivals, over their sum, at which the search ends: a robot's clock is not as good.
const TOGETHER: f64 = 1e-13;

/// Goes on from where `trajectory` ends now, as hard as possible, until its velocity is `to`.
pub fn change_velocity(trajectory: &mut Trajectory, to: Vector, limits: Limits) {
    let change = to - trajectory.end().velocity;
    let size = change.norm();
    if size > 0.0 {
        trajectory.push(size / limits.acceleration, change * (limits.acceleration / size));
    }
}

/// Brakes as hard as possible from where `trajectory` ends now until it stands.
pub fn stop(trajectory: &mut Trajectory, limits: Limits) {
    slow_down(trajectory, 0.0, limits);
    let end = trajectory.end();
    trajectory.end_at(State::at_rest(end.position));
}

/// Brakes as hard as possible, straight on, from where `trajectory` ends now until it is no faster than `to`.
pub fn slow_down(trajectory: &mut Trajectory, to: f64, limits: Limits) {
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
    let shares = shares(d, v, limits);
    let phases: [Phases; 2] =
        std::array::from_fn(|i| quickest(d[i], v[i], shares[i] * limits.speed, shares[i] * limits.acceleration));
    merge(phases, out);
    out.end_at(State::at_rest(goal));
}

/// cos α and sin α, with which both axes arrive together, as nearly as their speeds at the start allow.
fn shares(d: Vector, v: Vector, limits: Limits) -> [f64; 2] {
    // By u = sin α/(sin α + cos α), which needs no sine, and is as fine near 0 as 0 itself.
    let shares = |u: f64| {
        let (x, y) = (1.0 - u, u);
        let norm = (x * x + y * y).sqrt();
        // An axis without any share would never stand.
        [x / norm, y / norm].map(|share| share.max(1e-9))
    };
    let late = |u: f64| {
        let shares = shares(u);
        let [x, y]: [f64; 2] =
            std::array::from_fn(|i| time(d[i], v[i], shares[i] * limits.speed, shares[i] * limits.acceleration));
        if x + y > 0.0 { (x - y) / (x + y) } else { 0.0 }
    };
    let (mut low, mut high) = range(v, limits.speed);
    // From rest both arrive together on the straight line: a good guess otherwise.
    let mut u = (d.y.abs() / (d.x.abs() + d.y.abs())).max(low).min(high);
    let [mut at_low, mut at_high] = [late(low), late(high)];
    if at_low >= 0.0 || at_high <= 0.0 {
        return shares(if at_low >= 0.0 { low } else { high });
    }
    let (mut width, mut side) = (high - low, 0.0);
    for step in 0..STEPS {
        let f = late(u);
        if f.abs() <= TOGETHER {
            break;
        }
        // Regula falsi; the value at an end that stays twice is halved (Illinois), and the interval where that is slow.
        let halved = if f * side > 0.0 { 0.5 } else { 1.0 };
        side = f;
        if f > 0.0 {
            (high, at_high, at_low) = (u, f, halved * at_low);
        } else {
            (low, at_low, at_high) = (u, f, halved * at_high);
        }
        u = low - at_low * (high - low) / (at_high - at_low);
        if step % 3 == 2 {
            if high - low > 0.25 * width || !(u > low && u < high) {
                u = 0.5 * (low + high);
            }
            width = high - low;
        }
        if u <= low || u >= high {
            break;
        }
    }
    shares(u.max(low).min(high))
}

/// Bounds of u = sin α/(sin α + cos α) within which the sum of both axes' speeds is never above the limit V.
///
/// That is so for `|vₓ| ≤ V cos α` and `|v_y| ≤ V sin α`, and also where one axis must first brake down to its share, if it is
/// there before the other one has reached its own: `|vₓ|/cos α + |v_y|/sin α ≤ 2V` (until then the square of the speed is
/// convex in time, and at both ends at most V²). At full speed in the direction β that is α between β and (π − β)/3.
fn range(v: Vector, limit: f64) -> (f64, f64) {
    let u = |cos: f64, sin: f64| sin / (sin + cos);
    let other = |share: f64| (1.0 - share * share).sqrt();
    let [x, y] = [v.x, v.y].map(|v| (v.abs() / limit).min(1.0));
    let (low, high) = (u(other(y), y), u(x, other(x)));
    let beta = libm::atan2(y, x);
    let third = (std::f64::consts::PI - beta) / 3.0;
    let third = u(libm::cos(third), libm::sin(third));
    let low = low.min(third);
    (low, high.max(third).max(low))
}

/// Appends the motion whose axes follow `phases`.
fn merge(phases: [Phases; 2], out: &mut Trajectory) {
    let mut at = [0, 0];
    let mut left = [phases[0][0].0, phases[1][0].0];
    // Each step ends a phase of one axis at least.
    for _ in 0..6 {
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
    fn velocities_change_as_fast_as_they_can() {
        let limits = Limits::new(2.0, 5.0).unwrap();
        let start = State { position: Point::origin(), velocity: Vector::new(0.0, 3.0) };
        let mut out = Trajectory::new(start);
        slow_down(&mut out, limits.speed, limits);
        // 1 m/s at 5 m/s²; a change by (1.5, −2) is 2.5 long.
        assert!((out.duration() - 0.2).abs() < 1e-15 && (out.end().velocity.y - 2.0).abs() < 1e-15);
        change_velocity(&mut out, Vector::new(1.5, 0.0), limits);
        assert!((out.duration() - 0.7).abs() < 1e-15, "{}", out.duration());
        assert!((out.end().velocity - Vector::new(1.5, 0.0)).norm() < 1e-15, "a few roundings");
        assert!((out.pieces()[1].acceleration - Vector::new(3.0, -4.0)).norm() < 1e-14, "a few roundings");
        stop(&mut out, limits);
        assert!((out.duration() - 1.0).abs() < 1e-15 && out.end().velocity == Vector::zeros());
        let pieces = out.pieces().len();
        change_velocity(&mut out, Vector::zeros(), limits);
        stop(&mut out, limits);
        assert_eq!(out.pieces().len(), pieces, "nothing to change");
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
