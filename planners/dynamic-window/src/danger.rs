//! When a motion meets something.

use env_model::motion::{Mover, Piece, Trajectory, contact};
use planner_api::Situation;

/// The first contact of `trajectory` before `until`, margins included, in seconds.
///
/// A margin that is not kept even now is shrunk to what is kept: nothing could be admissible otherwise.
pub fn first_contact(trajectory: &Trajectory, situation: &Situation<'_>, margin: f64, until: f64) -> Option<f64> {
    let mut first = trajectory.timed().take_while(|(begin, _)| *begin <= until).find_map(|(begin, piece)| {
        let piece = Piece { duration: piece.duration.min(until - begin), ..piece };
        contact::enters_world(&piece, situation.world).map(|(t, _)| begin + t)
    });
    let here = situation.state.position;
    for mover in situation.movers {
        let margin = kept(mover, margin, mover.shape.point_clearance(here));
        let met = contact::meets(trajectory, mover, margin, first.unwrap_or(until));
        first = met.or(first);
    }
    first
}

fn kept(mover: &Mover<'_>, margin: f64, clearance: f64) -> f64 {
    // A little less than the clearance, which rounding must not find entered.
    (margin * mover.shape.radius + mover.margin).min(clearance * (1.0 - 1e-9)).max(0.0)
}
