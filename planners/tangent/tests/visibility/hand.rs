//! Scenes with lengths worked by hand: the visibility graphs' own check, and the optimum's.

use std::f64::consts::PI;

use env_model::scene::Field;
use env_model::{Point, Scene, path_length};

use crate::{FINE, Judged, judge, solve, with_problem};

fn scene(robot_radius: f64, ends: [[f64; 2]; 2], obstacles: &str) -> Scene {
    let [start, goal] = ends;
    let head = format!("name = \"by hand\"\nrobot_radius = {robot_radius:?}\nstart = {start:?}\ngoal = {goal:?}\n");
    let obstacles: String = obstacles.lines().map(|line| format!("[[obstacle]]\n{}\n", line.trim())).collect();
    Scene::from_toml("by-hand.toml", &(head + &obstacles)).unwrap_or_else(|e| panic!("{e}"))
}

/// The bracket holds `expected` and is at most `width` wide, relative; the
/// optimum is `expected` less what shrinking by ε can shorten it.
fn expect(scene: &Scene, expected: f64, width: f64) {
    let Judged { low, high, best } = judge(scene, FINE);
    let (low, high) = low.zip(high).unwrap_or_else(|| panic!("{low:?} to {high:?} against {expected}"));
    assert!(low <= expected * (1.0 + 1e-12) && expected <= high * (1.0 + 1e-12), "{low} {expected} {high}");
    assert!(high - low <= width * expected, "{} wide", high / low - 1.0);
    let length = best.unwrap_or_else(|| panic!("infeasible, not {expected}")).length;
    // A path round m corners or turning by φ gets shorter by some (m + φ) ε: 100 ε is plenty.
    let short = 100.0 * scene.epsilon();
    assert!(length <= expected * (1.0 + 1e-12) && length >= expected - short, "{length} against {expected}");
}

fn expect_none(scene: &Scene) {
    let Judged { low, high, best } = judge(scene, FINE);
    assert_eq!((low, high), (None, None));
    assert_eq!(best, None);
}

const SQUARE: &str = "polygon = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]";
/// A square of side 4 with a notch from above between x = 1 and x = 3, down to y = 2.
const CUP: &str =
    "polygon = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [3.0, 4.0], [3.0, 2.0], [1.0, 2.0], [1.0, 4.0], [0.0, 4.0]]";

#[test]
fn a_point_goes_round_a_square() {
    let ends = [[-3.0, 0.0], [3.0, 0.0]];
    expect(&scene(0.0, ends, SQUARE), 2.0 * 5.0_f64.sqrt() + 2.0, 1e-7);
    // Along a side it is free, through the middle of the other two it is not.
    expect(&scene(0.0, [[-3.0, 1.0], [3.0, 1.0]], SQUARE), 6.0, 1e-7);
    // From one corner to the opposite one.
    expect(&scene(0.0, [[-1.0, -1.0], [1.0, 1.0]], SQUARE), 4.0, 1e-7);
}

#[test]
fn a_disc_goes_round_a_square_with_arcs_at_its_corners() {
    // Tangents from (−4, 0) to the disc round (−1, 1): d² = 10, and an arc from there to the upper side.
    let r: f64 = 0.5;
    let (d, rise) = (10.0_f64.sqrt(), (1.0_f64 / 3.0).atan());
    let tangent = (d * d - r * r).sqrt();
    let turn = rise + (r / d).asin();
    expect(&scene(r, [[-4.0, 0.0], [4.0, 0.0]], SQUARE), 2.0 * (tangent + r * turn) + 2.0, 1e-4);
}

#[test]
fn a_capsule_is_passed_over_one_of_its_caps() {
    // d² = 26 to the cap's centre (0, 1), so tangents of 5, which rise by 2 atan(1/5).
    let capsule = "capsule = { from = [0.0, -1.0], to = [0.0, 1.0], radius = 1.0 }";
    expect(&scene(0.0, [[-5.0, 0.0], [5.0, 0.0]], capsule), 10.0 + 4.0 * 0.2_f64.atan(), 1e-4);
    // The same when half of the radius is the robot's.
    let thin = "capsule = { from = [0.0, -1.0], to = [0.0, 1.0], radius = 0.5 }";
    expect(&scene(0.5, [[-5.0, 0.0], [5.0, 0.0]], thin), 10.0 + 4.0 * 0.2_f64.atan(), 1e-4);
    // From side to side: up the side, half a turn, down the side.
    expect(&scene(0.5, [[-1.0, 0.5], [1.0, 0.0]], thin), 1.5 + PI, 1e-4);
}

#[test]
fn out_of_a_cup_over_its_arm() {
    let length = 2.0_f64.sqrt() + 1.0 + 4.0 + 5.0_f64.sqrt();
    expect(&scene(0.0, [[2.0, 3.0], [2.0, -1.0]], CUP), length, 1e-7);
    // A lid that shares the arms' upper sides and no more: out along the shared side.
    let lid = format!("{CUP}\npolygon = [[0.0, 4.0], [4.0, 4.0], [4.0, 5.0], [0.0, 5.0]]");
    expect(&scene(0.0, [[2.0, 3.0], [2.0, -1.0]], &lid), length, 1e-7);
    // A lid that overlaps the arms.
    let lid = format!("{CUP}\npolygon = [[0.0, 3.9], [4.0, 3.9], [4.0, 5.0], [0.0, 5.0]]");
    expect_none(&scene(0.0, [[2.0, 3.0], [2.0, -1.0]], &lid));
    // A robot too large for the gap under the lid, which is 0.2 high.
    let lid = format!("{CUP}\npolygon = [[0.0, 4.2], [4.0, 4.2], [4.0, 5.0], [0.0, 5.0]]");
    expect_none(&scene(0.101, [[2.0, 3.0], [2.0, -1.0]], &lid));
    expect_open(&scene(0.099, [[2.0, 3.0], [2.0, -1.0]], &lid));
}

fn expect_open(scene: &Scene) {
    let Judged { low, high, best } = judge(scene, FINE);
    assert!(low.is_some() && high.is_some() && best.is_some());
}

#[test]
fn between_two_squares_that_touch() {
    let pair = "polygon = [[-1.0, 0.0], [1.0, 0.0], [1.0, 2.0], [-1.0, 2.0]]\npolygon = [[-1.0, -2.0], [1.0, -2.0], [1.0, 0.0], [-1.0, 0.0]]";
    expect(&scene(0.0, [[-3.0, 0.0], [3.0, 0.0]], pair), 6.0, 1e-7);
    // At a corner only: diagonally through.
    let pair = "polygon = [[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0], [-1.0, 1.0]]\npolygon = [[0.0, -1.0], [1.0, -1.0], [1.0, 0.0], [0.0, 0.0]]";
    expect(&scene(0.0, [[-1.0, -1.0], [1.0, 1.0]], pair), 8.0_f64.sqrt(), 1e-7);
}

#[test]
fn the_border_closes_a_side() {
    let mut walled =
        scene(0.0, [[-3.0, 0.0], [3.0, 0.0]], "polygon = [[-1.0, -1.0], [1.0, -1.0], [1.0, 2.0], [-1.0, 2.0]]");
    walled.field = Some(Field { min: [-4.0, -4.0], max: [4.0, 4.0] });
    expect(&walled, 2.0 * 5.0_f64.sqrt() + 2.0, 1e-7);
    // Below it is closed; above, √(4 + 4) to the upper corners.
    walled.field = Some(Field { min: [-4.0, -0.9], max: [4.0, 4.0] });
    expect(&walled, 2.0 * 8.0_f64.sqrt() + 2.0, 1e-7);
    walled.field = Some(Field { min: [-4.0, -0.9], max: [4.0, 1.9] });
    expect_none(&walled);
    // Just as wide as the robot: along the border.
    walled.field = Some(Field { min: [-4.0, -1.0], max: [4.0, 1.9] });
    expect(&walled, 2.0 * 5.0_f64.sqrt() + 2.0, 1e-7);
}

#[test]
fn no_path_that_the_judge_accepts_is_shorter_than_the_optimum() {
    let square = scene(0.0, [[-3.0, 0.0], [3.0, 0.0]], SQUARE);
    with_problem(&square, |problem| {
        // The judge accepts a depth of ε.
        let corner = 1.0 - 0.999 * problem.world.epsilon();
        let path = [[-3.0, 0.0], [-corner, corner], [corner, corner], [3.0, 0.0]].map(Point::from);
        assert_eq!(problem.world.first_violation(&path), None);
        // Two lengths of a few summands.
        assert!(solve(problem).unwrap().length <= path_length(&path) * (1.0 + 1e-14));
    });
}

/// Obstacles that overlap by twice the argument, as a scene file has them.
type Obstacles = fn(f64) -> String;

/// Two obstacles that overlap by less than 2 ε leave a gap when both shrink by ε, and by more they
/// do not; against the border, which yields by ε as well, it is the same.
#[test]
fn the_gap_opens_at_an_overlap_of_two_epsilon() {
    // Robot's radius, and obstacles that overlap by 2 `o`.
    let pairs: [(f64, Obstacles); 6] = [
        (0.0, |o| {
            let y = 4.0 - o;
            format!(
                "disc = {{ centre = [0.0, {y:?}], radius = 4.0 }}\ndisc = {{ centre = [0.0, -{y:?}], radius = 4.0 }}"
            )
        }),
        (0.5, |o| {
            let y = 1.0 - o;
            format!(
                "capsule = {{ from = [0.0, {y:?}], to = [0.0, 7.0], radius = 0.5 }}
                capsule = {{ from = [0.0, -{y:?}], to = [0.0, -7.0], radius = 0.5 }}"
            )
        }),
        (0.0, |o| format!("{}\n{}", bar(-7.0, o), bar(-o, 7.0))),
        (0.5, |o| format!("{}\n{}", bar(-7.0, o - 0.5), bar(0.5 - o, 7.0))),
        // Up to the border, which lies at 6 less the robot's radius.
        (0.0, |o| bar(-7.0, 6.0 + 2.0 * o)),
        (0.5, |o| format!("capsule = {{ from = [0.0, -7.0], to = [0.0, {:?}], radius = 0.5 }}", 4.5 + 2.0 * o)),
    ];
    for (i, (robot_radius, obstacles)) in pairs.into_iter().enumerate() {
        let walled = |overlap: f64| {
            let mut walled = scene(robot_radius, [[-3.0, 0.0], [3.0, 0.0]], &obstacles(0.5 * overlap));
            walled.field = Some(Field { min: [-8.0, -6.0], max: [8.0, 6.0] });
            walled
        };
        let epsilon = walled(0.0).epsilon();
        for overlap in [-1.0, 1.9, 2.1, 50.0] {
            with_problem(&walled(overlap * epsilon), |problem| {
                assert_eq!(solve(problem).is_some(), overlap < 2.0, "pair {i} overlapping by {overlap} ε");
            });
        }
    }
}

/// From y = `low` to `high`, 2 wide.
fn bar(low: f64, high: f64) -> String {
    format!("polygon = [[-1.0, {low:?}], [1.0, {low:?}], [1.0, {high:?}], [-1.0, {high:?}]]")
}
