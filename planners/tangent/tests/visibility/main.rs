//! The exact optimum among every shape, judged by dense visibility graphs that bracket it.

mod families;
mod hand;
mod oracle;
mod properties;

use env_model::{Scene, Shape, World, path_length};
use families::FAMILIES;
use oracle::bracket;
use planner_api::Problem;
use planner_tangent::{NoOptimum, Optimum, optimum};

/// Corners a turn. The bracket of an arc is then 0.2 % wide.
const CORNERS: usize = 48;

/// Corners a turn where the bracket is to be narrow: arcs within 1e-4.
const FINE: usize = 256;

/// Sum over a few hundred rounded lengths, 1e-16 each.
const ROUNDING: f64 = 1e-13;

/// What is known of one scene.
struct Judged {
    low: Option<f64>,
    high: Option<f64>,
    best: Option<Optimum>,
}

/// Compiles a scene and poses its problem.
fn with_problem<T>(scene: &Scene, then: impl FnOnce(&Problem<'_>) -> T) -> T {
    let world = World::new(scene).unwrap_or_else(|e| panic!("{}: {e}", scene.name));
    let problem = Problem::new(&world, scene.start(), scene.goal());
    then(&problem.unwrap_or_else(|e| panic!("{}: {e}", scene.name)))
}

/// The optimum; `None` when infeasible.
fn solve(problem: &Problem<'_>) -> Option<Optimum> {
    match optimum(problem) {
        Ok(best) => Some(best),
        Err(NoOptimum::Infeasible) => None,
        Err(other) => panic!("{other}"),
    }
}

/// Holds the optimum of a scene against its bracket and checks its path.
fn judge(scene: &Scene, k: usize) -> Judged {
    with_problem(scene, |problem| {
        let (low, high) = bracket(problem, k);
        let best = solve(problem);
        let text = || {
            let length = best.as_ref().map(|b| b.length);
            format!("{}: optimum {length:?}, bracket {low:?} to {high:?}\n{}", scene.name, scene.to_toml())
        };
        // The bracket's own order, whatever the optimum says.
        assert!(low.is_some() || high.is_none(), "no bracket: {}", text());
        assert!(low.zip(high).is_none_or(|(low, high)| low <= high * (1.0 + ROUNDING)), "no bracket: {}", text());
        match &best {
            Some(best) => {
                assert!(low.is_some_and(|low| low <= best.length * (1.0 + ROUNDING)), "too short: {}", text());
                assert!(high.is_none_or(|high| best.length <= high * (1.0 + ROUNDING)), "too long: {}", text());
                check_path(best, problem, &text);
            }
            None => assert!(high.is_none(), "not infeasible: {}", text()),
        }
        Judged { low, high, best }
    })
}

/// The path is what `Optimum` says of it.
fn check_path(best: &Optimum, problem: &Problem<'_>, text: &dyn Fn() -> String) {
    let world = problem.world;
    assert_eq!((best.path[0], best.path[best.path.len() - 1]), (problem.start, problem.goal), "{}", text());
    let excess = path_length(&best.path) / best.length - 1.0;
    // A polyline at most a millionth longer than the arcs.
    assert!((-1e-12..1.001e-6).contains(&excess), "excess {excess:e}: {}", text());
    // It touches obstacles shrunk by ε; a hundredth of it is far above rounding.
    let depth = best.path.windows(2).map(|w| -world.segment_clearance(w[0], w[1])).fold(f64::NEG_INFINITY, f64::max);
    assert!(depth <= 1.01 * world.epsilon(), "{} ε deep: {}", depth / world.epsilon(), text());
}

/// Numbers of scenes.
#[derive(Debug, Default)]
struct Tally {
    scenes: u32,
    /// The shortest path is not straight.
    bent: u32,
    /// The bracket is at most 1 % wide.
    tight: u32,
    /// No path even among inscribed polygons: infeasible for sure.
    closed: u32,
    /// A path among inscribed polygons only.
    undecided: u32,
    /// Width of the widest bracket, relative.
    widest: f64,
}

#[test]
fn the_optimum_lies_in_its_bracket() {
    let mut all = Tally::default();
    for family in FAMILIES {
        let mut tally = Tally::default();
        for scene in family.scenes() {
            let Judged { low, high, .. } = judge(&scene, CORNERS);
            let straight = (scene.goal() - scene.start()).norm();
            tally.scenes += 1;
            tally.bent += u32::from(low.is_some_and(|low| low > straight * (1.0 + 1e-9)));
            tally.closed += u32::from(low.is_none());
            tally.undecided += u32::from(low.is_some() && high.is_none());
            if let Some((low, high)) = low.zip(high) {
                tally.tight += u32::from(high <= 1.01 * low);
                tally.widest = tally.widest.max(high / low - 1.0);
            }
        }
        println!("{:20} {tally:?}", family.name);
        all.scenes += tally.scenes;
        all.bent += tally.bent;
        all.tight += tally.tight;
        all.closed += tally.closed;
    }
    // A bracket that brackets nothing would let any optimum pass.
    assert!(all.scenes >= 500 && all.bent >= 300 && all.closed >= 40, "{all:?}");
    assert!(all.tight + all.closed >= all.scenes * 98 / 100, "{all:?}");
}

#[test]
fn it_lies_in_narrow_brackets_too() {
    let mut narrow = 0;
    for scene in FAMILIES.iter().flat_map(|family| family.scenes().step_by(20)) {
        let Judged { low, high, .. } = judge(&scene, FINE);
        let wide = judge(&scene, CORNERS);
        let ordered = |a: Option<f64>, b: Option<f64>| a.zip(b).is_none_or(|(a, b)| a <= b * (1.0 + ROUNDING));
        assert!(ordered(wide.low, high) && ordered(low, wide.high), "{}: two brackets do not meet", scene.name);
        narrow += u32::from(low.zip(high).is_some_and(|(low, high)| high <= low * (1.0 + 1e-4)));
    }
    assert!(narrow >= 30, "{narrow}");
}

/// Among sharp polygons the graphs differ by ε only.
#[test]
fn among_sharp_polygons_the_bracket_leaves_a_millionth() {
    let mut sharp = 0;
    for scene in FAMILIES.iter().flat_map(families::Family::scenes) {
        let polygons = scene.obstacles.iter().all(|o| matches!(o.shape, Shape::Polygon(_)));
        if scene.robot_radius == 0.0 && polygons {
            let Judged { low, high, .. } = judge(&scene, CORNERS);
            let width = low.zip(high).map_or(0.0, |(low, high)| high / low - 1.0);
            assert!(width < 1e-6, "{}: {width:e}", scene.name);
            sharp += 1;
        }
    }
    assert!(sharp >= 50, "{sharp}");
}
