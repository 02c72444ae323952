//! The sum of the behaviours: V = Σ gₖ Vₖ, no longer than 1, which is full speed.

use env_model::Vector;

use crate::attraction::attraction;
use crate::avoidance::{Repulsions, repulsion};
use crate::parameters::Parameters;
use crate::swirl::swirl;

/// What one robot wishes in one step.
#[derive(Debug, Clone, Copy)]
pub struct Steering<'p> {
    parameters: &'p Parameters,
    to_goal: Vector,
    obstacles: Repulsions,
    robots: Repulsions,
    others: Vector,
}

impl<'p> Steering<'p> {
    /// A robot that sees nothing but its goal, which lies at `to_goal`: a unit vector towards it at any distance.
    pub fn new(parameters: &'p Parameters, to_goal: Vector) -> Self {
        let none = Repulsions::default();
        Self { parameters, to_goal, obstacles: none, robots: none, others: Vector::zeros() }
    }

    /// Something that stands, at this clearance; `away` from it.
    pub fn obstacle(&mut self, clearance: f64, away: Vector) {
        let p = self.parameters;
        self.obstacles.add(repulsion(clearance, p.obstacle_margin, p.obstacle_sphere), away);
    }

    /// Another robot at this clearance; `away` from it.
    pub fn robot(&mut self, clearance: f64, away: Vector) {
        let p = self.parameters;
        self.robots.add(repulsion(clearance, p.robot_margin, p.robot_sphere), away);
    }

    /// One's slot of the formation lies at `to`.
    pub fn slot(&mut self, to: Vector) {
        let p = self.parameters;
        self.others += attraction(to, p.formation_dead, p.formation_control) * p.formation_gain;
    }

    /// The random heading of this step.
    pub fn noise(&mut self, heading: Vector) {
        self.others += heading * self.parameters.noise_gain;
    }

    /// Whether nothing repels.
    pub fn is_undisturbed(&self) -> bool {
        self.obstacles.is_empty() && self.robots.is_empty()
    }

    /// V, at most 1 long.
    pub fn sum(&self) -> Vector {
        let p = self.parameters;
        let goal = attraction(self.to_goal, 0.0, 0.0) * p.goal_gain;
        let away = self.obstacles.total() * p.obstacle_gain + self.robots.total() * p.robot_gain;
        let mut sum = goal + away + self.others;
        if p.swirl_gain > 0.0 {
            sum += swirl(away, self.to_goal) * p.swirl_gain;
        }
        let length = sum.norm();
        if length > 1.0 { sum / length } else { sum }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PUBLISHED: Parameters = Parameters {
        goal_gain: 0.8,
        obstacle_gain: 1.5,
        obstacle_margin: 0.05,
        obstacle_sphere: 0.5,
        robot_gain: 2.0,
        robot_margin: 0.05,
        robot_sphere: 0.2,
        formation_gain: 1.0,
        formation_dead: 0.0,
        formation_control: 0.25,
        noise_gain: 0.1,
        noise_steps: 6,
        swirl_gain: 0.0,
    };

    fn near(v: Vector, x: f64, y: f64) -> bool {
        // A few roundings of numbers near 1.
        (v - Vector::new(x, y)).norm() < 1e-14
    }

    #[test]
    fn sums_by_hand() {
        assert_eq!(Parameters::default(), PUBLISHED);
        let mut s = Steering::new(&PUBLISHED, Vector::new(3.0, 0.0));
        assert!(near(s.sum(), 0.8, 0.0) && s.is_undisturbed());
        // (0.5 − 0.41)/0.45 = 0.2, times 1.5.
        s.obstacle(0.41, Vector::y());
        assert!(near(s.sum(), 0.8, 0.3) && !s.is_undisturbed());
        // (0.2 − 0.14)/0.15 = 0.4, times 2.
        s.robot(0.14, -Vector::x());
        assert!(near(s.sum(), 0.0, 0.3));
        // 0.05 of 0.25: 0.2, times 1.
        s.slot(Vector::new(0.05, 0.0));
        s.noise(-Vector::y());
        assert!(near(s.sum(), 0.2, 0.2));
        // Within the margin nothing else counts.
        s.robot(0.04, Vector::y());
        let escape = s.sum();
        assert!((escape.norm() - 1.0).abs() < 1e-14 && escape.y > 0.999, "{escape}");
    }

    #[test]
    fn full_speed_is_the_limit() {
        let mut s = Steering::new(&PUBLISHED, Vector::new(3.0, 0.0));
        s.slot(Vector::new(3.0, 0.0));
        assert!(near(s.sum(), 1.0, 0.0), "0.8 + 1 is cut");
    }
}
