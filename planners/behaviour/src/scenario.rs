//! Seeded scenarios: where a team starts, where it goes, and what is in its way.

use env_model::{Point, Vector};

use crate::dice::Dice;
use crate::formation::oriented;
use crate::protocol::Protocol;

/// Which scenarios.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Set {
    /// Those that parameters are tuned on.
    Training,
    /// Those that no tuning sees.
    HeldOut,
}

/// The stream of random numbers that is not a scenario's.
pub const TUNING_STREAM: u64 = 0;

/// Places tried for each disc and each opponent.
const ATTEMPTS: usize = 100;
/// Between two discs a team's robots pass: so many robot radii, a robot's width and as much again.
const GAP: f64 = 4.0;
/// Opponents start at least so far from every robot of the team, hull to hull, in metres.
const HEAD_START: f64 = 0.5;

/// One crossing. Lengths in metres, the field's centre is the origin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scenario {
    /// Where each robot starts.
    pub starts: Vec<Point>,
    /// Where each robot goes.
    pub goals: Vec<Point>,
    /// Each robot's slot, in metres, y forward.
    pub slots: Vec<Vector>,
    /// Where the unit's centre goes.
    pub goal: Point,
    /// From its start there, a unit vector.
    pub heading: Vector,
    /// What stands: centres and radii.
    pub obstacles: Vec<(Point, f64)>,
    /// Where opponents start and how they move.
    pub opponents: Vec<(Point, Vector)>,
    /// Random headings: robot i holds number h · robots + i during its hold h.
    pub noise: Vec<Vector>,
}

impl Scenario {
    /// Scenario `index` of a set of `seed`: each has a stream of random numbers of its own, and no two sets share one.
    pub fn draw(protocol: &Protocol, set: Set, index: u64, seed: u64) -> Self {
        let stream = TUNING_STREAM + 1 + 2 * index + u64::from(set == Set::HeldOut);
        let mut dice = Dice::new(seed, stream);
        let [length, width] = protocol.field;
        let reach = protocol.formation_reach();
        let mut scenario = Self::default();
        protocol.formation.slots(protocol.robots, &mut scenario.slots);
        scenario.slots.iter_mut().for_each(|slot| *slot *= protocol.spacing);
        // From one end of the field to the other, within an eighth of its length.
        let side = if dice.chance(0.5) { 1.0 } else { -1.0 };
        let mut end = |side: f64| {
            let x = 0.5 * length - reach - dice.within(0.0, (0.125 * length - reach).max(0.0));
            let free = 0.5 * width - reach;
            Point::new(side * x, dice.within(-free, free))
        };
        let from = end(side);
        scenario.goal = end(-side);
        scenario.heading = (scenario.goal - from).normalize();
        let placed = |at: Point| scenario.slots.iter().map(|s| at + oriented(*s, scenario.heading)).collect();
        (scenario.starts, scenario.goals) = (placed(from), placed(scenario.goal));
        scenario.place_obstacles(protocol, &mut dice);
        scenario.place_opponents(protocol, &mut dice);
        scenario.noise = (0..protocol.steps * protocol.robots).map(|_| dice.heading()).collect();
        scenario
    }

    /// Discs away from starts and goals, from the border and from one another, so that a way through always exists.
    fn place_obstacles(&mut self, protocol: &Protocol, dice: &mut Dice) {
        let gap = GAP * protocol.robot_radius;
        for _ in 0..protocol.obstacles * ATTEMPTS {
            if self.obstacles.len() == protocol.obstacles {
                return;
            }
            let radius = dice.within(protocol.obstacle_radius[0], protocol.obstacle_radius[1]);
            let [x, y] = protocol.field.map(|side| (0.5 * side - radius - gap).max(0.0));
            let centre = Point::new(dice.within(-x, x), dice.within(-y, y));
            let ends = self.starts.iter().chain(&self.goals);
            let clear = ends.map(|p| (p - centre).norm() - protocol.robot_radius).all(|d| d > radius + gap)
                && self.obstacles.iter().all(|(c, r)| (c - centre).norm() > r + radius + gap);
            if clear {
                self.obstacles.push((centre, radius));
            }
        }
    }

    fn place_opponents(&mut self, protocol: &Protocol, dice: &mut Dice) {
        let [x, y] = protocol.field.map(|side| 0.5 * side);
        let apart = HEAD_START + 2.0 * protocol.robot_radius;
        for _ in 0..protocol.opponents * ATTEMPTS {
            if self.opponents.len() == protocol.opponents {
                return;
            }
            let at = Point::new(dice.within(-x, x), dice.within(-y, y));
            let velocity = dice.heading() * (protocol.opponent_speed * dice.within(0.25, 1.0));
            if self.starts.iter().all(|start| (start - at).norm() > apart) {
                self.opponents.push((at, velocity));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formation::Formation;

    #[test]
    fn starts_and_goals_are_free_and_robots_pass_everywhere() {
        let protocol = Protocol { obstacles: 12, robots: 5, formation: Formation::Wedge, ..Protocol::default() };
        let r = protocol.robot_radius;
        for index in 0..200 {
            let s = Scenario::draw(&protocol, Set::Training, index, 3);
            assert_eq!((s.starts.len(), s.goals.len(), s.opponents.len()), (5, 5, 6));
            for p in s.starts.iter().chain(&s.goals) {
                assert!(p.x.abs() <= 4.5 - r + 1e-12 && p.y.abs() <= 3.0 - r + 1e-12, "{p}");
                assert!(s.obstacles.iter().all(|(c, radius)| (p - c).norm() > radius + r));
            }
            assert!(s.starts.iter().all(|p| s.opponents.iter().all(|(o, _)| (p - o).norm() > 2.0 * r)));
            for (i, (a, ra)) in s.obstacles.iter().enumerate() {
                assert!(s.obstacles[..i].iter().all(|(b, rb)| (a - b).norm() > ra + rb + 2.0 * r));
            }
            assert!(s.opponents.iter().all(|(_, v)| (0.25..=1.0).contains(&(v.norm() * (1.0 + 1e-12)))));
        }
    }

    #[test]
    fn sets_are_disjoint_and_repeat() {
        let protocol = Protocol::default();
        let draw = |set, index, seed| Scenario::draw(&protocol, set, index, seed);
        let all: Vec<Scenario> = [Set::Training, Set::HeldOut]
            .into_iter()
            .flat_map(|set| (0..50).map(move |index| (set, index)))
            .map(|(set, index)| draw(set, index, 9))
            .collect();
        for (i, a) in all.iter().enumerate() {
            assert!(all[..i].iter().all(|b| a.goal != b.goal && a.obstacles != b.obstacles && a.noise != b.noise));
        }
        assert_eq!(draw(Set::HeldOut, 7, 9), all[57]);
        assert_ne!(draw(Set::HeldOut, 7, 8), all[57]);
    }
}
