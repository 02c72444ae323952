//! Touching, nested, equal and walling discs, exact contacts, extreme scales.

use std::f64::consts::PI;

use env_model::geometry::point_segment_distance;
use env_model::{Point, path_length};
use planner_tangent::{Outcome, Solver};

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// Solves, checks the polyline against every disc, returns the length.
fn length(discs: &[(Point, f64)], start: Point, goal: Point) -> Option<f64> {
    let mut solver = Solver::new();
    let mut path = Vec::new();
    let outcome = solver.shortest(discs, start, goal);
    solver.write_polyline(1e-6, &mut path);
    let Outcome::Found { length } = outcome else {
        assert_eq!(outcome, Outcome::Infeasible);
        assert!(path.is_empty());
        return None;
    };
    // The solver's tolerance is 1e-12 of the scene's diagonal.
    let reach = discs.iter().map(|(c, r)| (c - start).norm() + r).fold((goal - start).norm(), f64::max);
    for w in path.windows(2) {
        for &(c, r) in discs {
            let depth = r - point_segment_distance(c, w[0], w[1]);
            assert!(depth <= 4e-12 * reach, "enters ({c}, {r}) by {depth:e}");
        }
    }
    let found = path_length(&path) / length - 1.0;
    assert!(found > -1e-12 && found < 1.001e-6, "excess {found:e}");
    Some(length)
}

fn assert_close(a: Option<f64>, b: f64) {
    // Exact geometry: a dozen roundings; contacts within the tolerance of 1e-12.
    assert!(a.is_some_and(|a| (a / b - 1.0).abs() < 1e-11), "{a:?} against {b}");
}

/// A closed ring of overlapping discs round `centre`.
fn ring(centre: Point, radius: f64, count: usize) -> Vec<(Point, f64)> {
    let half = PI / count as f64;
    (0..count)
        .map(|i| 2.0 * half * i as f64)
        .map(|a| (centre + env_model::Vector::new(a.cos(), a.sin()) * radius, 1.2 * radius * half.sin()))
        .collect()
}

#[test]
fn without_obstacles_the_path_is_straight() {
    assert_eq!(length(&[], p(1.0, 2.0), p(4.0, 6.0)), Some(5.0));
    assert_eq!(Solver::new().shortest(&[], p(1.0, 2.0), p(1.0, 2.0)), Outcome::Found { length: 0.0 });
    assert_eq!(length(&[(p(2.5, 4.0), 0.0), (p(2.5, 4.0), -1.0)], p(1.0, 2.0), p(4.0, 6.0)), Some(5.0));
}

#[test]
fn one_disc_gives_the_closed_form() {
    // Two tangents of √(d² − r²) and an arc of π − 2 acos(r/d).
    let (d, r): (f64, f64) = (5.0, 1.5);
    let expected = 2.0 * (d * d - r * r).sqrt() + r * (PI - 2.0 * (r / d).acos());
    assert_close(length(&[(p(0.0, 0.0), r)], p(-d, 0.0), p(d, 0.0)), expected);
    for scale in [1e-3, 1e6] {
        assert_close(length(&[(p(0.0, 0.0), r * scale)], p(-d * scale, 0.0), p(d * scale, 0.0)), expected * scale);
    }
    // From border to border: half a turn.
    assert_close(length(&[(p(0.0, 0.0), r)], p(-r, 0.0), p(r, 0.0)), PI * r);
    // From the border: the arc to the point opposite the goal's, less acos(r/d), and one tangent.
    let expected = (d * d - r * r).sqrt() + r * (PI - (r / d).acos());
    assert_close(length(&[(p(0.3, 0.1), r)], p(0.3, 0.1 - r), p(0.3, 0.1 + d)), expected);
}

#[test]
fn grazing_a_row_of_equal_discs_is_free() {
    let row: Vec<_> = (0..8).map(|i| (p(2.5 * f64::from(i), 0.0), 1.0)).collect();
    assert_close(length(&row, p(-5.0, 1.0), p(25.0, 1.0)), 30.0);
    // Over the row: the common tangent of all discs carries the path.
    let d = (5.0_f64 * 5.0 - 1.0).sqrt();
    let turn = PI / 2.0 - (1.0_f64 / 5.0).acos();
    assert_close(length(&row, p(-5.0, 0.0), p(22.5, 0.0)), 2.0 * (d + turn) + 17.5);
    let touching: Vec<_> = (0..8).map(|i| (p(2.0 * f64::from(i), 0.0), 1.0)).collect();
    assert_close(length(&touching, p(-5.0, 0.0), p(19.0, 0.0)), 2.0 * (d + turn) + 14.0);
}

#[test]
fn touching_discs_let_the_path_through_and_overlapping_ones_do_not() {
    let pair = |gap: f64| [(p(-1.0, 0.0), 1.0), (p(1.0 + gap, 0.0), 1.0)];
    assert_close(length(&pair(0.0), p(0.0, -5.0), p(0.0, 5.0)), 10.0);
    assert!(length(&pair(-1e-6), p(0.0, -5.0), p(0.0, 5.0)).unwrap() > 10.3);
    // Along an arc that another disc touches: the polyline must squeeze through.
    let stacked = [(p(0.0, 0.0), 1.0), (p(0.0, 2.0), 1.0), (p(0.0, -40.0), 39.0)];
    let d = (25.0_f64 + 0.25 - 1.0).sqrt();
    let found = length(&stacked, p(-5.0, 0.5), p(5.0, 0.5));
    let rise = (1.0_f64 / 25.25_f64.sqrt()).asin() - (0.5_f64).atan2(5.0);
    assert_close(found, 2.0 * d + 2.0 * rise);
    // Internal tangent of no length: over one disc, under the next.
    let slalom = [(p(0.0, 0.0), 1.0), (p(2.0, 0.0), 1.0), (p(0.0, -40.0), 39.0), (p(2.0, 40.0), 39.0)];
    assert!(length(&slalom, p(-5.0, 1.0), p(7.0, -1.0)).is_some());
}

#[test]
fn nested_equal_and_concentric_discs_change_nothing() {
    let base = vec![(p(0.0, 0.0), 2.0), (p(3.0, 1.0), 1.5), (p(6.0, -1.0), 1.0)];
    let expected = length(&base, p(-6.0, 0.3), p(9.0, -0.2)).unwrap();
    let mut more = base.clone();
    more.extend(base.clone());
    more.extend([(p(0.0, 0.0), 1.0), (p(0.5, 0.0), 1.5), (p(1.0, 0.0), 1.0), (p(3.0, 1.0), 1.5 - 1e-13)]);
    more.extend(base);
    assert_close(length(&more, p(-6.0, 0.3), p(9.0, -0.2)), expected);
    more.reverse();
    assert_close(length(&more, p(-6.0, 0.3), p(9.0, -0.2)), expected);
}

#[test]
fn walled_in_ends_are_proved_infeasible() {
    for count in [5, 7, 24, 300] {
        let mut discs = ring(p(0.0, 0.0), 5.0, count);
        assert_eq!(length(&discs, p(0.1, 0.2), p(20.0, 3.0)), None, "start in a ring of {count}");
        assert_eq!(length(&discs, p(20.0, 3.0), p(0.1, 0.2)), None, "goal in a ring of {count}");
        assert!(length(&discs, p(0.1, 0.2), p(-0.3, 0.0)).is_some(), "both in a ring of {count}");
        discs.extend(ring(p(20.0, 3.0), 4.0, count));
        assert_eq!(length(&discs, p(0.1, 0.2), p(20.0, 3.0)), None, "two rings of {count}");
        discs.remove(count / 2);
        assert_eq!(length(&discs, p(0.1, 0.2), p(20.0, 3.0)), None, "one open ring of {count}");
        discs.remove(count - 1 + count / 3);
        assert!(length(&discs, p(0.1, 0.2), p(20.0, 3.0)).is_some(), "two open rings of {count}");
    }
    assert_eq!(length(&[(p(0.0, 0.0), 1.0)], p(0.5, 0.0), p(3.0, 0.0)), None, "start in a disc");
    assert_eq!(length(&[(p(0.0, 0.0), 1.0)], p(3.0, 0.0), p(0.5, 0.0)), None, "goal in a disc");
}

#[test]
fn a_spiral_needs_turns_of_more_than_half_a_circle() {
    // Thin discs on an Archimedean spiral, a thick one at its outer end.
    let spiral = |t: f64| p(t * t.cos(), t * t.sin());
    let mut discs: Vec<_> = (0..400).map(|i| spiral(2.0 + 0.03 * f64::from(i))).map(|c| (c, 0.3)).collect();
    discs.push((spiral(2.0 + 0.03 * 399.0), 1.2));
    let found = length(&discs, p(0.0, 0.0), p(30.0, 0.0)).unwrap();
    assert!(found > 40.0, "{found}");
    let back = length(&discs, p(30.0, 0.0), p(0.0, 0.0));
    assert_close(back, found);
}

#[test]
fn hundreds_of_overlapping_discs_are_solved_at_any_scale() {
    // A portable scatter: the fractional parts of multiples of two irrationals.
    let scatter = |n: usize| -> Vec<(Point, f64)> {
        let part = |i: usize, x: f64| (i as f64 * x).fract();
        (1..=n)
            .map(|i| (p(10.0 * part(i, 0.754_877_666), 10.0 * part(i, 0.569_840_291)), 0.12 + 0.2 * part(i, 0.618_034)))
            .collect()
    };
    let (start, goal) = (p(-1.0, -1.0), p(11.0, 11.0));
    for n in [100, 500] {
        let discs = scatter(n);
        let expected = length(&discs, start, goal).unwrap();
        for scale in [1e-3, 1e6] {
            let scaled: Vec<_> = discs.iter().map(|&(c, r)| (c * scale, r * scale)).collect();
            assert_close(length(&scaled, start * scale, goal * scale), expected * scale);
        }
    }
}

#[test]
fn a_grid_of_touching_discs_lets_the_path_through() {
    // Between four touching discs a point fits; more of them than the search remembers.
    let grid: Vec<_> = (0..720).map(|i| (p(f64::from(i % 30), f64::from(i / 30)), 0.5)).collect();
    let (start, goal) = (p(-1.0, -1.0), p(30.0, 24.0));
    let forth = length(&grid, start, goal).unwrap();
    assert_close(length(&grid, goal, start), forth);
    assert!(forth > (goal - start).norm() && forth < 31.0 + 25.0, "{forth}");
}
