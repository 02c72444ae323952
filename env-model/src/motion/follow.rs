//! Timing a path: from the polyline of any planner to a trajectory.

use super::{Limits, State, Trajectory, bang_bang};
use crate::{Point, World};

/// The motion along `path` that starts with `state` at its first point and ends at rest at its last one.
///
/// For now it stops at every corner.
pub fn follow(path: &[Point], state: State, limits: Limits, _world: &World, out: &mut Trajectory) {
    out.begin(state);
    let mut leg = Trajectory::default();
    for corner in path.iter().skip(1) {
        bang_bang(out.end(), *corner, limits, &mut leg);
        leg.pieces().iter().for_each(|p| out.push(p.duration, p.acceleration));
        out.end_at(leg.end());
    }
}
