//! The best path of one side class by the structured solver.
//!
//! The first solve has the arcs near its start; what its solution pierces of
//! the others joins, and it is solved again: mostly once is enough.

use env_model::{Point, path_length};

use crate::arc::{Arc, class_arcs};
use crate::interior::{Interior, Outcome, Target};
use crate::piece::Side;
use crate::polish::{Polish, polish, smooth_quadratic};
use crate::session::Session;
use crate::settings::{Objective, Settings};
use crate::smooth::smooth_cost;
use crate::strip::Strip;

/// Arcs with less room than this, in Δ, are in a solve from its beginning.
const NEAR: f64 = 1.0;

/// What is kept from class to class and from call to call.
#[derive(Debug, Clone, Default)]
pub(crate) struct Workspace {
    interior: Interior,
    arcs: Vec<Arc>,
    heights: Vec<f64>,
    path: Vec<Point>,
    recalled: Vec<Point>,
}

/// Polishes the class `sides` as [`polish`](crate::polish::polish) does.
pub(crate) fn polish_structured(
    strip: &Strip,
    sides: &[Side],
    initial: &[f64],
    reference: &[f64],
    settings: &Settings,
    workspace: &mut Workspace,
    session: &mut Session<'_, '_>,
) -> Polish {
    let Workspace { interior, arcs, heights, path, recalled } = workspace;
    let columns = &strip.columns;
    let spacing = columns.spacing();
    if !class_arcs(strip, sides, arcs) {
        return Polish::Nothing;
    }
    let smooth = settings.objective == Objective::Smooth;
    let quadratic = smooth.then(|| smooth_quadratic(reference, spacing, settings));
    let target = quadratic.as_ref().map_or(Target::Length, Target::Quadratic);
    interior.begin(initial, spacing);
    let within = 0.5 * strip.tolerance / spacing;
    for _ in 0..settings.max_rounds {
        if !session.allows() {
            return Polish::Stopped;
        }
        arcs.retain(|arc| {
            let far = interior.pass(arc).room >= NEAR;
            if !far {
                interior.add(*arc);
            }
            far
        });
        let outcome = interior.minimise(target, 0.1 * settings.tolerance, within, || session.in_time());
        session.count();
        let kept = outcome == Outcome::Optimal && arcs.iter().all(|arc| interior.pass(arc).room >= -within);
        if kept {
            heights.clear();
            heights.extend(interior.heights[1..=columns.count()].iter().map(|eta| eta * spacing));
            columns.write_path(heights, path);
            let cost = if smooth {
                columns.write_path(reference, recalled);
                smooth_cost(path, recalled, settings)
            } else {
                path_length(path)
            };
            let free = session.offer(path, cost);
            session.report();
            return if free { Polish::Done } else { Polish::Nothing };
        }
        session.report();
        match outcome {
            Outcome::Optimal => {}
            Outcome::Infeasible => return Polish::Nothing,
            // It does not converge, which some smooth programmes among a dozen obstacles do to it.
            Outcome::Failed => return polish(strip, sides, initial, reference, settings, session),
            Outcome::Stopped => return Polish::Stopped,
        }
    }
    Polish::Nothing
}
