//! Attackers run to free positions round the opposing defence area while opponents shift to block their lines to goal.
//!
//! With four robots or more one is the keeper, with six or more two are defenders. Every other opponent blocks close
//! to its area, the rest on the way: each between an attacker and the middle of the goal, wherever the attacker is.
//! Blockers keep nearer to the goal than the positions, which so stay free.

use std::f64::consts::FRAC_PI_2;

use env_model::motion::State;
use env_model::{Point, Vector};
use planner_api::SettingError;
use rand_chacha::ChaCha8Rng;

use super::placing::Placing;
use super::{Conduct, Play, Setup};
use crate::league::ROBOT_RADIUS;
use crate::roles::{Assignment, Role};
use crate::rules::defence_area;
use crate::{League, Settings, Task, View, draw};

/// Attackers' positions from the opposing defence area, in metres.
const POSITIONS: f64 = 1.2;
/// Where opponents block close to it, and how near the others come to it, in metres.
const BLOCKS: [f64; 2] = [0.45, 0.75];
/// The others block at this part of the line from the goal to the attacker.
const ADVANCE: f64 = 0.6;
/// Distance that blockers of a ring keep from each other, in metres.
const BLOCKERS_APART: f64 = 0.24;

/// The play.
#[derive(Debug, Default)]
pub struct Attack {
    league: League,
    /// Where to stand in which role; the keeper's first, if there is one.
    spots: Vec<(Role, Point)>,
    assignment: Assignment,
    roles: Vec<Role>,
    goals: Vec<Point>,
}

/// Roles of `n` robots.
fn cast(n: usize) -> Vec<Role> {
    let (keepers, defenders) = (usize::from(n >= 4), if n >= 6 { 2 } else { 0 });
    let role = |i| match i {
        i if i < keepers => Role::Keeper,
        i if i < keepers + defenders => Role::Defender,
        _ => Role::Attacker,
    };
    (0..n).map(role).collect()
}

/// The point in the direction `angle` from the middle of the opposing goal, 0 being towards the other one and π/2
/// towards +y, that is `distance` before the defence area.
fn before_area(league: League, angle: f64, distance: f64) -> Point {
    let goal = Point::new(league.half_size()[0], 0.0);
    let direction = Vector::new(-libm::cos(angle), libm::sin(angle));
    let area = defence_area(league, 1.0, distance - ROBOT_RADIUS);
    // Within the area at first; at last out of it, whichever way.
    let (mut near, mut far) = (0.0, 2.0 * goal.x);
    while far - near > 1e-9 {
        let middle = 0.5 * (near + far);
        *(if area.point_clearance(goal + direction * middle) < 0.0 { &mut near } else { &mut far }) = middle;
    }
    goal + direction * far
}

/// Directions of `count` blockers who stand as near as they can to the lines to attackers in the directions `lines`,
/// those of a sorted sequence at least `gap` apart.
fn spread(lines: &[f64], count: usize, gap: f64) -> Vec<f64> {
    let mut angles: Vec<(f64, usize)> = (0..count).map(|j| (lines[j % lines.len()], j)).collect();
    angles.sort_by(|a, b| a.0.total_cmp(&b.0));
    let most = FRAC_PI_2 - 0.05;
    let mut least = -most;
    for (angle, _) in &mut angles {
        *angle = angle.max(least);
        least = *angle + gap;
    }
    let mut greatest = most;
    for (angle, _) in angles.iter_mut().rev() {
        *angle = angle.min(greatest);
        greatest = *angle - gap;
    }
    let mut by_blocker = vec![0.0; count];
    for (angle, j) in angles {
        by_blocker[j] = angle;
    }
    by_blocker
}

impl Attack {
    /// Where opponents stand to block attackers who are at `attackers`.
    fn blocks(&self, attackers: &[Point], opponents: usize) -> Vec<Point> {
        let goal = Point::new(self.league.half_size()[0], 0.0);
        let lines: Vec<f64> = attackers.iter().map(|p| libm::atan2(p.y, goal.x - p.x)).collect();
        // The nearest to the goal that the ring comes.
        let [depth, width] = self.league.defence_area();
        let gap = BLOCKERS_APART / (depth.min(0.5 * width) + BLOCKS[0]);
        let (close, advanced) = (opponents.div_ceil(2), opponents / 2);
        let close = spread(&lines, close, gap);
        let out = spread(&lines, advanced, gap);
        let mut blocks = Vec::with_capacity(opponents);
        for j in 0..opponents {
            blocks.push(if j % 2 == 0 {
                before_area(self.league, close[j / 2], BLOCKS[0])
            } else {
                let nearest = before_area(self.league, out[j / 2], BLOCKS[1]);
                let way = ADVANCE * (attackers[j / 2 % attackers.len()] - goal).norm();
                goal + (nearest - goal) * (way / (nearest - goal).norm()).max(1.0)
            });
        }
        blocks
    }

    /// Deals spots to robots that are at `own`.
    fn deal(&mut self, own: &[Point]) {
        let keepers = self.spots.iter().take_while(|(role, _)| *role == Role::Keeper).count();
        let open: Vec<Point> = self.spots[keepers..].iter().map(|(_, spot)| *spot).collect();
        let known = own.iter().all(|p| p.x.is_finite() && p.y.is_finite());
        if !known && !self.goals.is_empty() {
            return;
        }
        let dealt = self.assignment.update(&own[keepers..], &open);
        let all = (0..keepers).chain(dealt.iter().map(|j| j + keepers));
        (self.roles, self.goals) = all.map(|j| self.spots[j]).unzip();
    }

    fn attackers(&self, own: impl Iterator<Item = Point>) -> Vec<Point> {
        own.zip(&self.roles).filter(|(_, role)| **role == Role::Attacker).map(|(p, _)| p).collect()
    }
}

impl Play for Attack {
    fn setup(&mut self, settings: &Settings, rng: &mut ChaCha8Rng) -> Result<Setup, SettingError> {
        self.league = settings.league;
        let [x, y] = settings.league.half_size();
        let depth = settings.league.defence_area()[0];
        let ball = Point::origin();
        let mut placing = Placing::new(settings, Some(ball));
        let (n, m) = (settings.robots, settings.opponents);
        let roles = cast(n);
        let attackers = roles.iter().filter(|role| **role == Role::Attacker).count();
        let mut starts = Vec::new();
        let (mut defender, mut attacker) = (0, 0);
        for role in roles {
            let (start, spot) = match role {
                Role::Keeper => {
                    let start = Point::new(-x + 0.8, 0.0) + draw::in_disc(rng, settings.jitter.min(0.5));
                    (placing.take(start), Point::new(-x + 0.2, 0.0))
                }
                Role::Defender => {
                    defender += 1;
                    let side = if defender == 1 { 0.4 } else { -0.4 };
                    let start = placing.put("robots", n, |_| {
                        Point::new(draw::between(rng, -0.6 * x, -0.3 * x), draw::between(rng, -0.8 * y, 0.8 * y))
                    })?;
                    (start, Point::new(-x + depth + 0.35, side))
                }
                _ => {
                    let start = placing.put("robots", n, |_| {
                        Point::new(draw::between(rng, -0.4 * x, 0.15 * x), draw::between(rng, -0.9 * y, 0.9 * y))
                    })?;
                    let part = (f64::from(attacker) + draw::between(rng, 0.35, 0.65)) / attackers as f64;
                    attacker += 1;
                    (start, position(settings.league, part))
                }
            };
            starts.push(start);
            self.spots.push((role, spot));
        }
        self.deal(&starts);
        let blocks = self.blocks(&self.attackers(starts.iter().copied()), m);
        let mut opponents = Vec::new();
        for block in blocks {
            opponents.push(State::at_rest(placing.near("opponents", m, block, settings.jitter, rng)?));
        }
        Ok(Setup {
            own: starts.into_iter().map(State::at_rest).collect(),
            opponents,
            ball: Some(State::at_rest(ball)),
            placement: None,
        })
    }

    fn goals(&self) -> &[Point] {
        &self.goals
    }

    fn direct(&mut self, view: &View<'_>, tasks: &mut [Task]) {
        let own: Vec<Point> = view.own.iter().map(|state| state.position).collect();
        self.deal(&own);
        for (task, (role, goal)) in tasks.iter_mut().zip(self.roles.iter().zip(&self.goals)) {
            (task.role, task.goal) = (*role, *goal);
        }
    }

    fn oppose(&mut self, view: &View<'_>, conducts: &mut [Conduct]) {
        let attackers = self.attackers(view.own.iter().map(|state| state.position));
        for (conduct, block) in conducts.iter_mut().zip(self.blocks(&attackers, view.opponents.len())) {
            *conduct = Conduct::RunTo(block);
        }
    }
}

/// The point after a `part` of the way round the opposing defence area, at the attackers' distance: along one side,
/// round the corner, the front, and back on the other side.
fn position(league: League, part: f64) -> Point {
    let [depth, width] = league.defence_area();
    let (line, side, front) = (league.half_size()[0], depth - 2.0 * ROBOT_RADIUS, width);
    let quarter = FRAC_PI_2 * POSITIONS;
    let half = side + quarter + 0.5 * front;
    // By symmetry, from the middle of the front.
    let way = (2.0 * part - 1.0) * half;
    let (far, sign) = (way.abs(), way.signum());
    let corner = Point::new(line - depth, 0.5 * width);
    let p = if far <= 0.5 * front {
        Point::new(corner.x - POSITIONS, far)
    } else if far <= 0.5 * front + quarter {
        let angle = (far - 0.5 * front) / POSITIONS;
        corner + Vector::new(-libm::cos(angle), libm::sin(angle)) * POSITIONS
    } else {
        Point::new(corner.x + far - 0.5 * front - quarter, corner.y + POSITIONS)
    };
    Point::new(p.x, sign * p.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_round_the_area() {
        // Division A: the area begins at x = 4.2 and reaches to |y| = 1.8.
        let at = |part: f64| position(League::DivisionA, part);
        assert!((at(0.5) - Point::new(3.0, 0.0)).norm() < 1e-12);
        assert!((at(1.0) - Point::new(5.82, 3.0)).norm() < 1e-12);
        assert!((at(0.0) - Point::new(5.82, -3.0)).norm() < 1e-12);
        for i in 0..=20 {
            let area = defence_area(League::DivisionA, 1.0, 0.0);
            let clearance = area.point_clearance(at(f64::from(i) / 20.0));
            assert!((clearance - (POSITIONS - ROBOT_RADIUS)).abs() < 1e-12, "{i}: {clearance}");
        }
        // 45 cm before it straight on, and towards the corner at 45°: √2 · 1.8 + 0.45 where both sides are as long.
        assert!((before_area(League::DivisionA, 0.0, 0.45) - Point::new(3.75, 0.0)).norm() < 1e-8);
        let corner = before_area(League::DivisionA, FRAC_PI_2 / 2.0, 0.45);
        let reach = 1.8 + 0.45 * 0.5f64.sqrt();
        assert!((corner - Point::new(6.0 - reach, reach)).norm() < 1e-8, "{corner}");
    }

    #[test]
    fn blockers_stand_apart_and_in_the_way() {
        assert_eq!(spread(&[0.3, -0.4], 2, 0.1), [0.3, -0.4], "where there is room, on the lines");
        let crowded = spread(&[0.0], 3, 0.1);
        assert_eq!(crowded, [0.0, 0.1, 0.2]);
        let at_the_end = spread(&[1.5, 1.5], 2, 0.1);
        assert!((at_the_end[1] - at_the_end[0] - 0.1).abs() < 1e-12 && at_the_end[1] < FRAC_PI_2);
    }

    #[test]
    fn casts() {
        let count = |n: usize, role: Role| cast(n).iter().filter(|r| **r == role).count();
        assert_eq!([1, 3, 4, 5, 6, 11].map(|n| count(n, Role::Keeper)), [0, 0, 1, 1, 1, 1]);
        assert_eq!([1, 5, 6, 11].map(|n| count(n, Role::Defender)), [0, 0, 2, 2]);
        assert_eq!([1, 3, 4, 6, 11].map(|n| count(n, Role::Attacker)), [1, 3, 3, 3, 8]);
    }
}
