//! `ssl-a`, `ssl-b`: a plausible instant of a Small Size League game.
//!
//! We attack to the right with the ball in play. Each team has its keeper in its
//! defence area and defenders side by side along that area's edge, between ball and
//! goal; two robots fight for the ball, opponents mark our attackers, the rest cover
//! the middle. One of our field players is the robot to plan for; its target is a
//! place in the opponents' half that a pass could reach. Dimensions: SSL rules 2026.
//!
//! Defence areas are forbidden to field players and so are obstacles, each with the
//! goal behind it (nobody drives through the goal): eight corners, not convex. The
//! robot may leave the pitch by 0.3 m, the field's boundary.

use super::ROBOT_RADIUS;
use super::crowd::{Crowd, scene};
use super::draw::Draw;
use crate::scene::Field;
use crate::{Obstacle, Point, Scene, Shape, Vector};

/// What the rules and the line-ups say of a division; lengths in metres.
pub(super) struct Division {
    /// Half the pitch: length, width.
    half: Vector,
    /// Defence area, from the goal line into the pitch.
    area_depth: f64,
    area_half_width: f64,
    goal_half_width: f64,
    ours: LineUp,
    theirs: LineUp,
    /// Start and goal are at least this far apart.
    least_way: f64,
}

/// How many robots do what, besides keeper and the one at the ball.
struct LineUp {
    defenders: usize,
    /// Attackers for us; as many opponents mark them.
    forward: usize,
    midfield: usize,
}

impl LineUp {
    const fn robots(&self) -> usize {
        2 + self.defenders + self.forward + self.midfield
    }
}

/// 11 against 11 on 12 × 9 m.
pub(super) const DIVISION_A: Division = Division {
    half: Vector::new(6.0, 4.5),
    area_depth: 1.8,
    area_half_width: 1.8,
    goal_half_width: 0.9,
    ours: LineUp { defenders: 3, forward: 3, midfield: 3 },
    theirs: LineUp { defenders: 4, forward: 3, midfield: 2 },
    least_way: 3.0,
};

/// 6 against 6 on 9 × 6 m.
pub(super) const DIVISION_B: Division = Division {
    half: Vector::new(4.5, 3.0),
    area_depth: 1.0,
    area_half_width: 1.0,
    goal_half_width: 0.5,
    ours: LineUp { defenders: 1, forward: 2, midfield: 1 },
    theirs: LineUp { defenders: 2, forward: 1, midfield: 1 },
    least_way: 2.0,
};

/// From the lines to the wall round the field.
const BOUNDARY: f64 = 0.3;
const GOAL_DEPTH: f64 = 0.18;
/// Field players' centres keep this far from the defence areas.
const OFF_THE_AREA: f64 = ROBOT_RADIUS + 0.03;
/// The target keeps this far: the distance the rules ask for at free kicks.
const TARGET_OFF_THE_AREA: f64 = ROBOT_RADIUS + 0.2;
/// Tries to find room for one robot.
const TRIES: usize = 200;

impl Division {
    /// All robots but the planner's own, and two defence areas.
    pub const fn obstacles(&self) -> usize {
        self.ours.robots() + self.theirs.robots() - 1 + 2
    }

    /// Whether `p` is nearer than `margin` to a defence area, by box distance.
    fn near_area(&self, p: Point, margin: f64) -> bool {
        p.x.abs() > self.half.x - self.area_depth - margin && p.y.abs() < self.area_half_width + margin
    }

    /// Defence area and goal on the `side` −1 (left, ours) or 1.
    fn area(&self, side: f64) -> Vec<[f64; 2]> {
        let (line, front, back) = (self.half.x, self.half.x - self.area_depth, self.half.x + GOAL_DEPTH);
        let (wide, narrow) = (self.area_half_width, self.goal_half_width);
        [
            [front, -wide],
            [line, -wide],
            [line, -narrow],
            [back, -narrow],
            [back, narrow],
            [line, narrow],
            [line, wide],
            [front, wide],
        ]
        .map(|[x, y]| [side * x, y])
        .to_vec()
    }

    /// A point on the edge of the defence area on `side`, pushed out by `margin`; `s` runs from
    /// the goal line below over the front to the goal line above, and is clamped.
    fn on_edge(&self, side: f64, margin: f64, s: f64) -> Point {
        let (depth, wide) = (self.area_depth + margin, self.area_half_width + margin);
        let s = s.clamp(ROBOT_RADIUS, 2.0 * (depth + wide) - ROBOT_RADIUS);
        let (from_line, y) = if s < depth {
            (s, -wide)
        } else if s < depth + 2.0 * wide {
            (depth, s - depth - wide)
        } else {
            (2.0 * (depth + wide) - s, wide)
        };
        Point::new(side * (self.half.x - from_line), y)
    }

    /// Where on that edge the line from `ball` to the middle of the goal crosses it.
    fn edge_towards(&self, side: f64, margin: f64, ball: Point) -> f64 {
        let (depth, wide) = (self.area_depth + margin, self.area_half_width + margin);
        let out = (self.half.x - side * ball.x).max(1e-3);
        // Along the ray from the goal, the front is met at x = depth, a flank at |y| = wide.
        let y_at_front = ball.y * depth / out;
        if y_at_front.abs() <= wide {
            return depth + wide + y_at_front;
        }
        let x_at_flank = out * wide / ball.y.abs();
        if ball.y < 0.0 { x_at_flank } else { 2.0 * (depth + wide) - x_at_flank }
    }
}

/// The team being placed.
struct Team {
    name: &'static str,
    /// The end it defends: −1 left, 1 right.
    side: f64,
}

/// Robots of both teams as they take their places: `labels[i]` stands at `places[i]`.
struct Game<'a> {
    division: &'a Division,
    draw: &'a mut Draw,
    crowd: Crowd,
    labels: Vec<String>,
    places: Vec<Point>,
    next_id: usize,
}

impl Game<'_> {
    /// Places the team's next robot where `place` says, with new random numbers until there is room.
    fn add(&mut self, team: &Team, keeper: bool, mut place: impl FnMut(&mut Draw) -> Point) -> Option<()> {
        let label = format!("{} {}", team.name, self.next_id);
        self.next_id += 1;
        for _ in 0..TRIES {
            let p = place(self.draw);
            if (keeper || !self.division.near_area(p, OFF_THE_AREA)) && self.crowd.try_add(p, ROBOT_RADIUS) {
                self.labels.push(label);
                self.places.push(p);
                return Some(());
            }
        }
        None
    }

    /// Keeper and defenders, between `ball` and their goal.
    fn add_defence(&mut self, team: &Team, defenders: usize, ball: Point) -> Option<()> {
        let Division { half, goal_half_width, .. } = *self.division;
        self.next_id = 0;
        let y = goal_half_width * (ball.y / half.y).clamp(-0.8, 0.8);
        self.add(team, true, |d| Point::new(team.side * (half.x - d.between(0.1, 0.4)), y + d.between(-0.1, 0.1)))?;
        let spacing = self.draw.between(0.2, 0.32);
        for i in 0..defenders {
            let division = self.division;
            let place = (i as f64 - 0.5 * (defenders - 1) as f64) * spacing;
            self.add(team, false, |d| {
                let margin = OFF_THE_AREA + d.between(0.0, 0.1);
                let s = division.edge_towards(team.side, margin, ball) + place;
                division.on_edge(team.side, margin, s + d.between(-0.05, 0.05))
            })?;
        }
        Some(())
    }

    /// The robot at the ball.
    fn add_at_ball(&mut self, team: &Team, ball: Point) -> Option<()> {
        // On its own side of the ball, its body 0.02 to 0.2 m off.
        self.add(team, false, |d| {
            let towards_own_goal = Vector::new(team.side, d.between(-1.0, 1.0)).normalize();
            ball + towards_own_goal * (ROBOT_RADIUS + d.between(0.04, 0.22))
        })
    }

    /// Robots in a band of the pitch, x from `near` to `far` as shares of the half length.
    fn add_band(&mut self, team: &Team, count: usize, near: f64, far: f64) -> Option<()> {
        let half = self.division.half;
        for _ in 0..count {
            self.add(team, false, |d| {
                let x = half.x * d.between(near, far);
                Point::new(x, half.y * d.between(-0.9, 0.9))
            })?;
        }
        Some(())
    }
}

pub(super) fn draw(draw: &mut Draw, division: &Division) -> Option<Scene> {
    let half = division.half;
    let ball = Point::new(half.x * draw.between(-0.3, 0.55), half.y * draw.between(-0.8, 0.8));
    let goal = Point::new(half.x * draw.between(0.2, 0.9), half.y * draw.between(-0.85, 0.85));
    if division.near_area(goal, TARGET_OFF_THE_AREA) {
        return None;
    }
    let ours = Team { name: "own", side: -1.0 };
    let theirs = Team { name: "opponent", side: 1.0 };
    // The start is one of ours, known only once all stand: until then the goal counts for both.
    let crowd = Crowd::with_ends(half, goal, goal);
    let mut game = Game { division, draw, crowd, labels: Vec::new(), places: Vec::new(), next_id: 0 };

    game.add_defence(&ours, division.ours.defenders, ball)?;
    game.add_at_ball(&ours, ball)?;
    let first_runner = game.places.len();
    game.add_band(&ours, division.ours.forward, 0.1, 0.8)?;
    let attackers = first_runner..game.places.len();
    game.add_band(&ours, division.ours.midfield, -0.6, 0.2)?;
    let runners = first_runner..game.places.len();

    game.add_defence(&theirs, division.theirs.defenders, ball)?;
    game.add_at_ball(&theirs, ball)?;
    for i in 0..division.theirs.forward {
        let marked = game.places[attackers.start + i % attackers.len()];
        let towards_goal = Point::new(half.x, 0.0) - marked;
        game.add(&theirs, false, |d| marked + towards_goal.normalize() * d.between(0.3, 0.6) + d.in_unit_disc() * 0.1)?;
    }
    game.add_band(&theirs, division.theirs.midfield, -0.3, 0.5)?;

    let Game { draw, labels, places, .. } = game;
    let runner = runners.start + draw.below(runners.len());
    if (goal - places[runner]).norm() < division.least_way {
        return None;
    }
    let mut obstacles: Vec<Obstacle> = places
        .iter()
        .zip(labels)
        .map(|(&p, label)| Obstacle { label: Some(label), ..Obstacle::disc(p, ROBOT_RADIUS) })
        .collect();
    obstacles.remove(runner);
    for team in [&ours, &theirs] {
        let label = Some(format!("{} defence area", team.name));
        obstacles.push(Obstacle { label, ..Shape::Polygon(division.area(team.side)).into() });
    }
    let edge = half + Vector::new(BOUNDARY, BOUNDARY);
    let field = Field { min: [-edge.x, -edge.y], max: [edge.x, edge.y] };
    Some(scene(places[runner], goal, field, obstacles))
}
