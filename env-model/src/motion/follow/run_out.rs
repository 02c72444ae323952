//! Where a moving robot turns: how far it runs out before the corner that leads it to a point.

use crate::Vector;

/// Steps of the search for the corner; Newton's method doubles its digits with most of them.
const STEPS: usize = 10;

/// A corner on the line of the robot's velocity.
#[derive(Debug, Clone, Copy)]
pub struct RunOut {
    /// How far ahead.
    pub way: f64,
    /// The unit direction from there to the point.
    pub ahead: Vector,
    /// How far that is.
    pub length: f64,
    /// |u₂ − u₁|.
    pub turn: f64,
}

/// The first corner, on the line in the unit direction `along`, of a robot that brakes to `share` of its squared speed
/// and then at once turns towards the point at `target` from it. `braking` is its braking distance B.
///
/// With c(L) the turn at distance L: L = B(1 − share + share·c(L)), found from below, where c is convex mostly, by
/// Newton's steps kept within an interval, and left a little beyond, so that the blend has room. `None` where the point
/// is the corner itself.
pub fn run_out(target: Vector, along: Vector, braking: f64, share: f64) -> Option<RunOut> {
    let corner = |way: f64| {
        let rest = target - along * way;
        let length = rest.norm();
        let ahead = rest / length;
        RunOut { way, ahead, length, turn: (ahead - along).norm() }
    };
    // How much too near a corner is, and the change of that with its distance.
    let lack = |at: &RunOut| {
        let cos = at.ahead.dot(&along);
        // dc/dL = cos(φ/2) sin φ/length for the angle φ of the turn.
        let bend = (0.5 * (1.0 + cos)).max(0.0).sqrt() * (1.0 - cos * cos).max(0.0).sqrt() / at.length;
        (braking * (1.0 - share + share * at.turn) - at.way, braking * share * bend - 1.0)
    };
    let (mut low, mut high) = (braking * (1.0 - share), braking * (1.0 + share));
    let mut at = corner(low);
    for _ in 0..STEPS {
        let (gap, slope) = lack(&at);
        if gap <= 0.0 {
            high = at.way;
        } else {
            low = at.way;
        }
        // A tolerance of the way, made up for below.
        if gap.abs() <= 1e-11 * braking {
            break;
        }
        let newton = at.way - gap / slope;
        at = corner(if newton > low && newton < high { newton } else { 0.5 * (low + high) });
    }
    let (gap, slope) = lack(&at);
    if gap > 0.0 {
        // Twice Newton's step lands beyond the root.
        let beyond = at.way - 2.0 * gap / slope;
        at = corner(if beyond > at.way && beyond < high { beyond } else { high });
        if lack(&at).0 > 0.0 {
            at = corner(high);
        }
    }
    at.turn.is_finite().then_some(at)
}
