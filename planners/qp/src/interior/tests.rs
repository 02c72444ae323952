//! Answers worked out by hand, degenerate and infeasible cuts, and the optimality conditions at random.

use super::*;
use crate::piece::Side;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const GAP: f64 = 1e-10;
const WITHIN: f64 = 1e-10;

fn solve(start: &[f64], arcs: &[Arc], target: Target<'_>) -> (Interior, Outcome) {
    let mut interior = Interior::default();
    interior.begin(start, 1.0);
    arcs.iter().for_each(|arc| interior.add(*arc));
    let outcome = interior.minimise(target, GAP, WITHIN, || true);
    (interior, outcome)
}

fn point(segment: usize, side: Side, s: f64, height: f64) -> Arc {
    Arc::point(segment, side, s, height)
}

fn length(heights: &[f64]) -> f64 {
    heights.windows(2).map(|w| (1.0 + (w[1] - w[0]).powi(2)).sqrt()).sum()
}

/// Over a post of height 1 halfway: 2√2 long, pushed up with twice the sine of 45°.
#[test]
fn a_post_by_hand() {
    let (interior, outcome) = solve(&[0.0], &[point(0, Side::Above, 1.0, 1.0)], Target::Length);
    assert_eq!(outcome, Outcome::Optimal);
    // The gap is linear in the height: 1e-10·2.8 over the multiplier √2.
    assert!((interior.heights[1] - 1.0).abs() < 1e-9, "{:?}", interior.heights);
    assert!((interior.rows[0].dual - 2.0_f64.sqrt()).abs() < 1e-8, "{:?}", interior.rows[0].dual);
}

#[test]
fn without_constraints_the_straight_line() {
    let (interior, outcome) = solve(&[3.0, -40.0, 7.0], &[], Target::Length);
    assert_eq!(outcome, Outcome::Optimal);
    // Stationary to 1e-9, curvature of the order of 1.
    assert!(interior.heights.iter().all(|y| y.abs() < 1e-8), "{:?}", interior.heights);
}

/// No interior, the same cut many times, slits down to the tolerance.
#[test]
fn degenerate_cuts() {
    for width in [1e-3, 1e-6, 1e-8, 0.0] {
        for copies in [1, 3] {
            let mut arcs = Vec::new();
            for _ in 0..copies {
                arcs.push(point(1, Side::Above, 0.5, 0.5));
                arcs.push(point(1, Side::Below, 0.5, 0.5 + width));
                arcs.push(point(2, Side::Below, 1.0, -0.25));
            }
            let (interior, outcome) = solve(&[0.0; 4], &arcs, Target::Length);
            assert_eq!(outcome, Outcome::Optimal, "{width} {copies}");
            let middle = 0.5 * (interior.heights[1] + interior.heights[2]);
            assert!((middle - 0.5).abs() < 1e-8, "the string pulls down: {middle}");
        }
    }
}

#[test]
fn infeasible_cuts_are_proved() {
    for lack in [1.0, 1e-2, 1e-5] {
        // The two posts are on one segment, the bar between them: no line passes.
        let bent =
            [point(1, Side::Above, 0.0, 0.5), point(1, Side::Above, 1.0, 0.5), point(1, Side::Below, 0.5, 0.5 - lack)];
        let closed = [point(1, Side::Above, 1.0, 0.5 + lack), point(2, Side::Below, 0.0, 0.5)];
        for arcs in [&bent[..], &closed[..]] {
            for target in [Target::Length, Target::Quadratic(&smooth(3))] {
                assert_eq!(solve(&[0.0; 3], arcs, target).1, Outcome::Infeasible, "{lack}");
            }
        }
    }
}

/// ‖D₁η‖² + ‖D₂η‖² + ½‖η − 1‖², less a constant.
fn smooth(count: usize) -> Quadratic {
    let mut quadratic = Quadratic::new(count, 2);
    for k in 0..count {
        let near = [(k, -2.0)].into_iter().chain((k > 0).then(|| (k - 1, 1.0)));
        let terms: Vec<(usize, f64)> = near.chain((k + 1 < count).then_some((k + 1, 1.0))).collect();
        quadratic.add_square(1.0, &terms, 0.0);
        quadratic.add_square(0.5, &[(k, 1.0)], -1.0);
        let difference = [(k, 1.0), (k.saturating_sub(1), -1.0)];
        quadratic.add_square(1.0, &difference[..1 + k.min(1)], 0.0);
    }
    quadratic
}

/// Arcs of random discs, some of them cut at the columns.
fn random_arcs(random: &mut ChaCha8Rng, columns: usize) -> Vec<Arc> {
    let mut uniform = |lo: f64, hi: f64| lo + (hi - lo) * random.random::<f64>();
    let count = uniform(1.0, 12.0) as usize;
    (0..count)
        .filter_map(|_| {
            let side = if uniform(0.0, 1.0) < 0.5 { Side::Above } else { Side::Below };
            let segment = uniform(1.0, columns as f64) as usize;
            let radius = uniform(0.0, 2.0);
            // Mostly on the side away from the path.
            let b = side.sign() * (uniform(-1.5, 0.6) - radius);
            Arc::disc(segment, side, (uniform(-0.5, 1.5), b), radius)
        })
        .collect()
}

/// The conditions of Karush, Kuhn and Tucker, every derivative by differences of values computed here.
#[test]
fn optima_satisfy_the_conditions() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut optimal = 0;
    for case in 0..400 {
        let columns = 2 + case % 17;
        let arcs = random_arcs(&mut random, columns);
        let quadratic = smooth(columns);
        let target = if case % 3 == 0 { Target::Quadratic(&quadratic) } else { Target::Length };
        let (interior, outcome) = solve(&vec![0.0; columns], &arcs, target);
        assert_ne!(outcome, Outcome::Failed, "{case}");
        if outcome != Outcome::Optimal {
            continue;
        }
        optimal += 1;
        let value = |y: &[f64]| match target {
            Target::Quadratic(quadratic) => quadratic.evaluate(&y[1..=columns], &mut vec![0.0; columns]),
            _ => length(y),
        };
        let y = &interior.heights;
        for row in &interior.rows {
            let room = least_room(&row.arc, y);
            assert!(row.dual >= 0.0 && room > -1e-8, "{case}: {room}");
            assert!(row.dual * room < 1e-6 * (1.0 + row.dual), "{case}: {} {room}", row.dual);
        }
        for i in 1..=columns {
            // Central differences of exact values: the error is h² of third derivatives.
            let moved = |by: f64| {
                let mut moved = y.clone();
                moved[i] += by;
                let arcs: f64 = interior.rows.iter().map(|row| row.dual * least_room(&row.arc, &moved)).sum();
                value(&moved) - arcs
            };
            let slope = (moved(1e-5) - moved(-1e-5)) / 2e-5;
            let scale = interior.rows.iter().fold(1.0, |m: f64, row| m.max(row.dual));
            assert!(slope.abs() < 1e-5 * scale, "{case}: {slope} of {scale}");
        }
    }
    assert!(optimal > 200, "{optimal} cases have a path");
}

/// The least room by ternary search: the room is convex in s.
fn least_room(arc: &Arc, y: &[f64]) -> f64 {
    let room = |s: f64| {
        let dx = s - arc.centre.0;
        let height = arc.centre.1 + arc.sigma * (arc.radius * arc.radius - dx * dx).max(0.0).sqrt();
        arc.sigma * ((1.0 - s) * y[arc.segment] + s * y[arc.segment + 1] - height)
    };
    let (mut lo, mut hi) = (arc.ends[0].0, arc.ends[1].0);
    for _ in 0..100 {
        let (a, b) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        if room(a) < room(b) { hi = b } else { lo = a }
    }
    room(0.5 * (lo + hi))
}
