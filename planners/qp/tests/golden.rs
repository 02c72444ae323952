//! Optima of the column model on the 2012 scene, known from separate programs.

mod support;

use planner_api::Refinement;
use planner_qp::{Classes, Method, Objective, Settings, Solver};
use support::{paper, paper_path, refine};

fn shorten(columns: usize, method: Method, above: [bool; 3]) -> (f64, Refinement) {
    let settings = Settings { columns: Some(columns), method, classes: Classes::Final, ..Settings::default() };
    let (plan, outcome) = refine(&paper(), settings, paper_path(above));
    (env_model::path_length(&plan.path), outcome)
}

#[test]
fn class_optima_of_twenty_columns() {
    for (above, expected, digits) in [
        ([true, false, false], 231.950_044, 1e-6),
        ([true, true, true], 236.078, 6e-4),
        ([true, true, false], 237.980, 6e-4),
        ([false, false, false], 239.217, 6e-4),
    ] {
        for method in [Method::ReweightedQp, Method::Socp] {
            let (length, outcome) = shorten(20, method, above);
            println!("{above:?} {method:?} {length:.9} {outcome:?}");
            // As many digits as were published, and one unit for the margin of ε/2 = 1.2e-7.
            assert!((length - expected).abs() < digits, "{above:?} {method:?}: {length}");
        }
    }
}

#[test]
fn optima_of_other_numbers_of_columns() {
    for (columns, expected) in [(5, 233.407), (10, 232.150), (40, 231.741), (80, 231.624)] {
        let (length, _) = shorten(columns, Method::ReweightedQp, [true, false, false]);
        println!("{columns} {length:.9}");
        assert!((length - expected).abs() < 6e-4, "m = {columns}: {length}; three decimals were published");
    }
}

/// One is a sequence of quadratic programmes, the other one cone programme a round of cuts.
#[test]
fn both_methods_agree_in_all_classes() {
    let mut feasible = 0;
    for bits in 0..8 {
        let above = [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0];
        let (qp, outcome_qp) = shorten(20, Method::ReweightedQp, above);
        let (socp, outcome_socp) = shorten(20, Method::Socp, above);
        println!("{above:?} {outcome_qp:?} {qp:.9} {socp:.9} {:.1e}", (qp - socp) / socp);
        assert_eq!(outcome_qp, outcome_socp, "{above:?}");
        if outcome_qp != Refinement::NotRepaired {
            feasible += 1;
            assert!((qp - socp).abs() < 1e-8 * socp, "{above:?}: {qp} {socp}");
        }
    }
    assert!(feasible >= 4, "{feasible} classes have a path");
}

/// One programme with curved borders a class against rounds of cutting planes, in 0, 1, 2 … side classes.
#[test]
fn the_structured_solver_agrees_in_all_classes() {
    for bits in 0..8 {
        let above = [bits & 1 != 0, bits & 2 != 0, bits & 4 != 0];
        for columns in [1, 2, 5, 20, 80] {
            let settings = Settings { columns: Some(columns), classes: Classes::Final, ..Settings::default() };
            let structured = Settings { solver: Solver::Structured, ..settings.clone() };
            let (one, one_outcome) = refine(&paper(), settings, paper_path(above));
            let (two, two_outcome) = refine(&paper(), structured, paper_path(above));
            assert_eq!(one_outcome, two_outcome, "{above:?} {columns}");
            if one_outcome != Refinement::NotRepaired {
                // Both stop within 1e-9 of the optimum.
                assert!(
                    (one.cost - two.cost).abs() < 3e-9 * one.cost,
                    "{above:?} {columns}: {} {}",
                    one.cost,
                    two.cost
                );
                if columns == 20 {
                    assert_eq!(two.counters.iterations, 1, "every arc is in the first programme");
                }
            }
        }
    }
}

/// A lower bound on min ‖D₁y‖²/Δ + w‖D₂y‖² in the best class: Hildreth's (1957) dual coordinate ascent under
/// samples of every segment's constraint. Any multipliers λ ≥ 0 bound from below by λᵀb − ½yᵀPy, y = P⁻¹Aᵀλ.
fn bound_by_hildreth(w_smooth: f64) -> f64 {
    use nalgebra::{DMatrix, DVector};
    let scene = paper();
    let columns = env_model::Columns::new(scene.start(), scene.goal(), 20);
    let (m, spacing) = (columns.count(), columns.spacing());
    // Difference operators over all 22 heights; columns of the fixed ends dropped.
    let first = DMatrix::from_fn(m + 1, m, |i, k| f64::from(i32::from(k == i)) - f64::from(i32::from(k + 1 == i)));
    let second = DMatrix::from_fn(m, m, |i, k| match k.abs_diff(i) {
        0 => -2.0,
        1 => 1.0,
        _ => 0.0,
    });
    let p = first.transpose() * &first * (2.0 / spacing) + second.transpose() * &second * (2.0 * w_smooth);
    let inverse = p.clone().try_inverse().unwrap();
    let mut constraints = Vec::new();
    for (c, sign) in [([240.0, 160.0], 1.0), ([280.0, 200.0], -1.0), ([320.0, 230.0], -1.0)] {
        let c = columns.frame().to_local(c.into());
        for k in 0..=160 {
            let x = c.x - 16.0 + 32.0 * f64::from(k) / 160.0;
            let reach = sign * c.y + (256.0 - (x - c.x).powi(2)).max(0.0).sqrt();
            let (i, s) = ((x / spacing) as usize, (x / spacing).fract());
            let mut a = DVector::zeros(m);
            if i > 0 {
                a[i - 1] = sign * (1.0 - s);
            }
            a[i] = sign * s;
            let ha = &inverse * &a;
            let gain = a.dot(&ha);
            constraints.push((a, ha, gain, reach, 0.0));
        }
    }
    let mut y = DVector::zeros(m);
    for _ in 0..6000 {
        for (a, ha, gain, reach, dual) in &mut constraints {
            let step = ((*reach - a.dot(&y)) / *gain).max(-*dual);
            *dual += step;
            y.axpy(step, ha, 1.0);
        }
    }
    constraints.iter().map(|(_, _, _, reach, dual)| reach * dual).sum::<f64>() - 0.5 * y.dot(&(&p * &y))
}

#[test]
fn smoothing_trades_length_for_turning() {
    let scene = paper();
    let best = {
        let settings = Settings { columns: Some(20), ..Settings::default() };
        refine(&scene, settings, paper_path([true, false, false])).0.path
    };
    for (w_smooth, length, turn) in
        [(0.0, 231.951, 0.336), (0.1, 232.086, 0.243), (1.0, 232.789, 0.187), (10.0, 233.715, 0.173)]
    {
        let settings = Settings { objective: Objective::Smooth, w_smooth, ..Settings::default() };
        let (plan, _) = refine(&scene, settings, best.clone());
        let got = env_model::path_length(&plan.path);
        let sharpest = plan.path.windows(3).map(|w| (w[1] - w[0]).angle(&(w[2] - w[1]))).fold(0.0, f64::max);
        // The published values came with coarser cuts; length and turn are not
        // what is minimised, so they move to first order with the path's error.
        assert!((got - length).abs() < 4e-3 && (sharpest - turn).abs() < 3e-3, "{w_smooth}: {got} {sharpest}");
        // The cost without the constant |goal − start| of motion along start → goal.
        let cost = plan.cost - (scene.goal() - scene.start()).norm();
        let bound = bound_by_hildreth(w_smooth);
        println!("{w_smooth} {got} {sharpest} {cost} {bound}");
        // Sampling at 0.2 of a radius of 16 misses at most 0.1²/32 in height; the rest is the slow ascent.
        assert!(cost > bound && cost - bound < 2e-3 * cost, "{w_smooth}: {cost} {bound}");
    }
}
