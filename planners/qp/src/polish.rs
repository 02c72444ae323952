//! The best path of one side class on the columns.
//!
//! Heights are solved for in units of the spacing Δ. Reweighting and new cuts
//! share the rounds, and the last round's multipliers bend the objective as
//! the curved borders bend the constraints (`add_bends`).
//!
//! Shorten: Σ wᵢ(yᵢ₊₁ − yᵢ)² with wᵢ ← 1/lenᵢ majorises the length Σ √(Δ² +
//! (yᵢ₊₁ − yᵢ)²), so for given cuts the length falls to its minimum (both are
//! convex), the error by sin⁴ of the steepest slope a round. Cuts are outer
//! approximations: lengths rise as they come in.

use env_model::path_length;

use crate::cuts::{Cut, Cuts};
use crate::piece::Side;
use crate::program::{Answer, Quadratic, Rows, solve};
use crate::session::Session;
use crate::settings::{Method, Objective, Settings};
use crate::smooth::smooth_cost;
use crate::strip::Strip;

/// How the polishing of a class ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Polish {
    /// At a path that keeps its sides.
    Done,
    /// The class has no path on these columns, or none was found.
    Nothing,
    /// By the budget.
    Stopped,
}

/// Polishes the class `sides`, beginning at the heights `initial`; `reference` are the heights that `smooth` recalls.
pub(crate) fn polish(
    strip: &Strip,
    sides: &[Side],
    initial: &[f64],
    reference: &[f64],
    settings: &Settings,
    session: &mut Session<'_, '_>,
) -> Polish {
    let columns = &strip.columns;
    let spacing = columns.spacing();
    let Some(mut cuts) = Cuts::new(strip, sides) else { return Polish::Nothing };
    let mut heights = initial.to_vec();
    // A cut too many costs little, one too few another round.
    cuts.separate(&heights, 0.25 * spacing);
    let mut recalled = Vec::new();
    columns.write_path(reference, &mut recalled);
    let mut path = Vec::new();
    let mut kept = Polish::Nothing;
    let mut last = f64::INFINITY;
    let exact = settings.objective == Objective::Smooth || settings.method == Method::Socp;
    let mut bends = vec![0.0; heights.len() + 1];
    for _ in 0..settings.max_rounds {
        if !session.allows() {
            return Polish::Stopped;
        }
        // Without bends the cone and the smooth programme are what is to be solved, not a step towards it.
        let straight = bends.iter().all(|&b| b == 0.0);
        let answer = match (settings.objective, settings.method) {
            (Objective::Shorten, Method::ReweightedQp) => shortest_qp(&cuts.list, &heights, &bends, spacing),
            (Objective::Shorten, Method::Socp) => shortest_socp(&cuts.list, &heights, &bends, spacing),
            (Objective::Smooth, _) => smoothest(&cuts.list, &heights, &bends, reference, spacing, settings),
        };
        session.count();
        let Answer::Point { x, multipliers } = answer else {
            session.report();
            return kept;
        };
        for (y, eta) in heights.iter_mut().zip(&x) {
            *y = eta * spacing;
        }
        bends.fill(0.0);
        for (cut, multiplier) in cuts.list.iter().zip(&multipliers) {
            bends[cut.segment] += multiplier.max(0.0) * cut.rounding / spacing;
        }
        let worst = cuts.separate(&heights, -strip.tolerance);
        columns.write_path(&heights, &mut path);
        let cost = match settings.objective {
            Objective::Shorten => path_length(&path),
            Objective::Smooth => smooth_cost(&path, &recalled, settings),
        };
        let settled = (exact && straight) || (last - cost).abs() <= settings.tolerance * cost;
        last = cost;
        if worst <= strip.tolerance {
            let free = session.offer(&path, cost);
            session.report();
            kept = if free { Polish::Done } else { kept };
            // What collides although it keeps its sides will do so again.
            if settled || !free {
                return kept;
            }
        } else {
            session.report();
        }
    }
    kept
}

/// −σ((1 − s) ηᵢ + s ηᵢ₊₁) + slack = −σ h/Δ; the fixed ends have height 0.
fn rows_of(cuts: &[Cut], count: usize, spacing: f64) -> Rows {
    let mut rows = Rows::default();
    for cut in cuts {
        let sigma = cut.side.sign();
        let ends = [(cut.segment, 1.0 - cut.s), (cut.segment + 1, cut.s)];
        let terms = ends.into_iter().filter(|&(i, a)| a != 0.0 && (1..=count).contains(&i));
        rows.push(terms.map(|(i, a)| (i - 1, -sigma * a)), -sigma * cut.height / spacing);
    }
    rows
}

/// The terms of ηᵢ₊₁ − ηᵢ; unknown k is column k + 1. Returns how many of the two are valid from the front.
fn difference(i: usize, count: usize) -> ([(usize, f64); 2], usize) {
    match i {
        0 => ([(0, 1.0), (0, 0.0)], 1),
        _ if i == count => ([(i - 1, -1.0), (0, 0.0)], 1),
        _ => ([(i - 1, -1.0), (i, 1.0)], 2),
    }
}

/// The slope of segment i.
fn slope(heights: &[f64], i: usize, spacing: f64) -> f64 {
    let height = |i: usize| if i == 0 || i > heights.len() { 0.0 } else { heights[i - 1] };
    (height(i + 1) - height(i)) / spacing
}

/// A segment that rolls on a rounded piece meets it elsewhere after a turn, so
/// the constraint bends: by r/(1 + μ²)^{3/2} times the square of the change of
/// slope μ, over 2. That times the last multiplier makes a round a Newton step on the
/// Lagrangian: cuts converge quadratically instead of by a factor of 4 a
/// round. The term vanishes at the current slopes, so it moves no fixed point.
fn add_bends(quadratic: &mut Quadratic, heights: &[f64], bends: &[f64], spacing: f64) {
    for (i, &bend) in bends.iter().enumerate() {
        if bend > 0.0 {
            let mu = slope(heights, i, spacing);
            let stretch = (1.0 + mu * mu).sqrt();
            let (terms, n) = difference(i, heights.len());
            quadratic.add_square(0.5 * bend / (stretch * stretch * stretch), &terms[..n], -mu);
        }
    }
}

fn shortest_qp(cuts: &[Cut], heights: &[f64], bends: &[f64], spacing: f64) -> Answer {
    let count = heights.len();
    let mut quadratic = Quadratic::new(count, 1);
    for i in 0..=count {
        let mu = slope(heights, i, spacing);
        let (terms, n) = difference(i, count);
        quadratic.add_square(1.0 / (1.0 + mu * mu).sqrt(), &terms[..n], 0.0);
    }
    add_bends(&mut quadratic, heights, bends, spacing);
    solve(&quadratic, &rows_of(cuts, count, spacing), 0)
}

fn shortest_socp(cuts: &[Cut], heights: &[f64], bends: &[f64], spacing: f64) -> Answer {
    let count = heights.len();
    let mut objective = Quadratic::new(2 * count + 1, 1);
    let mut rows = rows_of(cuts, count, spacing);
    for i in 0..=count {
        objective.add_linear(count + i, 1.0);
        rows.push([(count + i, -1.0)], 0.0);
        rows.push([], 1.0);
        let (terms, n) = difference(i, count);
        rows.push(terms.into_iter().take(n).map(|(k, a)| (k, -a)), 0.0);
    }
    add_bends(&mut objective, heights, bends, spacing);
    solve(&objective, &rows, count + 1)
}

fn smoothest(
    cuts: &[Cut],
    heights: &[f64],
    bends: &[f64],
    reference: &[f64],
    spacing: f64,
    settings: &Settings,
) -> Answer {
    let mut quadratic = smooth_quadratic(reference, spacing, settings);
    add_bends(&mut quadratic, heights, bends, spacing);
    solve(&quadratic, &rows_of(cuts, reference.len(), spacing), 0)
}

/// The three terms of the smooth objective over Δ, in η, less a constant:
/// `w_length`‖D₁η‖² + `w_smooth` Δ‖D₂η‖² + `w_reference` Δ‖η − η₀‖², over the sum of their
/// factors, so that it is of the order of 1 whatever the weights are.
pub(crate) fn smooth_quadratic(reference: &[f64], spacing: f64, settings: &Settings) -> Quadratic {
    let count = reference.len();
    let scale = 1.0 / (settings.w_length + (settings.w_smooth + settings.w_reference) * spacing);
    let mut quadratic = Quadratic::new(count, 2);
    for i in 0..=count {
        let (terms, n) = difference(i, count);
        quadratic.add_square(scale * settings.w_length, &terms[..n], 0.0);
    }
    for (k, &recalled) in reference.iter().enumerate() {
        let mut terms = vec![(k, -2.0)];
        if k > 0 {
            terms.push((k - 1, 1.0));
        }
        if k + 1 < count {
            terms.push((k + 1, 1.0));
        }
        quadratic.add_square(scale * settings.w_smooth * spacing, &terms, 0.0);
        quadratic.add_square(scale * settings.w_reference * spacing, &[(k, 1.0)], -recalled / spacing);
    }
    quadratic
}
