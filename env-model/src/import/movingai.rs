//! Grid maps and scenarios of the `MovingAI` benchmarks: `.map` and `.scen`.
//!
//! A map's cells are unit squares, the robot a point, start and goal centres of
//! cells, the field the map's box. Maps count rows from the top, scenes count y
//! upwards: cell (x, y) of a map of height H has its centre at (x + ½, H − y − ½).
//!
//! | letter | is | taken as |
//! |---|---|---|
//! | `.` `G` | passable terrain | free |
//! | `S` | swamp, passable from regular terrain | free, like `.` |
//! | `W` | water, traversable, but not passable from terrain | free for a start on water, else blocked |
//! | `@` `O` `T` | out of bounds, trees | blocked |
//!
//! A start on water finds all other terrain blocked. Blocked cells become open
//! rectangles whose union is exactly the interior of what is blocked ([`cover`]),
//! so no path slips between two of them. Where two blocked cells touch at a
//! corner only, the benchmark lets nothing pass, but a point robot would fit
//! through between open sets: a small square on the corner closes it.
//!
//! Format: Sturtevant, *Benchmarks for Grid-Based Pathfinding*, IEEE TCIAIG 4(2) (2012) 144–148,
//! [doi](https://doi.org/10.1109/TCIAIG.2012.2197681), and movingai.com/benchmarks/formats.html.

mod cover;
mod map;
mod octile;
mod scen;

use crate::scene::Field;
use crate::{Scene, Shape, World};

pub use map::Map;
pub use scen::{Problem, problems};

/// A problem of a scenario file as a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Imported {
    /// The scene; start and goal are free.
    pub scene: Scene,
    /// Length of the shortest path of octile moves (8 neighbours, no corner cutting) by our
    /// own search; `None` where there is none.
    pub octile: Option<f64>,
}

/// The scene of `problem` on `map`, which must have the problem's size ([`Map::scaled`]).
///
/// # Errors
/// What makes no scene of it: an end off the map or blocked, both ends in one cell.
pub fn scene(name: &str, map: &Map, problem: &Problem) -> Result<Imported, String> {
    let end = |what: &str, [x, y]: [usize; 2]| {
        if x >= map.width() || y >= map.height() {
            let (width, height) = (map.width(), map.height());
            return Err(format!("{what} ({x}, {y}) is off the map; expected less than ({width}, {height})"));
        }
        Ok(map.cell(x, y))
    };
    let (start, goal) = (end("start", problem.start)?, end("goal", problem.goal)?);
    let blocked = map.blocked_for(start);
    for (what, cell, [x, y]) in [("start", start, problem.start), ("goal", goal, problem.goal)] {
        if blocked[cell] {
            let letter = map.letter(cell);
            return Err(format!("{what} ({x}, {y}) is on {letter:?}, blocked for this start; expected a free cell"));
        }
    }
    let grid = map.grid();
    let centre = |cell| grid.centre(cell).into();
    let mut obstacles: Vec<Shape> = Vec::new();
    obstacles.extend(cover::rectangles(grid, &blocked).iter().map(cover::polygon));
    obstacles.extend(cover::pinches(grid, &blocked).into_iter().map(cover::plug));
    let scene = Scene {
        name: name.to_owned(),
        unit: "cell".to_owned(),
        robot_radius: 0.0,
        start: centre(start),
        goal: centre(goal),
        field: Some(Field { min: [0.0, 0.0], max: [map.width() as f64, map.height() as f64] }),
        obstacles: obstacles.into_iter().map(Into::into).collect(),
    };
    let world = World::new(&scene).map_err(|e| e.to_string())?;
    scene.validate_ends(&world).map_err(|e| e.to_string())?;
    Ok(Imported { scene, octile: octile::length(grid, &blocked, start, goal) })
}

#[cfg(test)]
mod tests;
