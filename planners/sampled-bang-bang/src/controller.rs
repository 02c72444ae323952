//! Which ways are tried.

use std::f64::consts::TAU;

use env_model::Vector;
use env_model::motion::Trajectory;
use planner_api::seed::{splitmix64, unit};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};

use crate::SampledBangBangSettings;
use crate::trial::{Call, Trial};
use crate::way::Way;

/// How far samples stray from the intermediate destination of the frame before, in units of v²/a, and from its switch,
/// as a share of that.
const SPREAD: f64 = 0.1;

/// Sampled bang-bang trajectories.
///
/// An iteration is an intermediate destination, an evaluation a trajectory that is checked in time.
#[derive(Debug)]
pub struct SampledBangBang {
    settings: SampledBangBangSettings,
    /// What was followed last, as of now.
    memory: Option<Way>,
    frame: u64,
    trial: Trial,
}

impl SampledBangBang {
    /// A controller with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: SampledBangBangSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, memory: None, frame: 0, trial: Trial::default() })
    }

    /// The way of the frame before, which others must then beat by a little.
    fn remember(&mut self, call: &mut Call<'_, '_, '_>) {
        let Some(way) = self.memory else { return };
        match way {
            Way::Through { via, switch } => self.trial.via(via, &[switch], call),
            Way::Rest(via) => self.trial.via(via, &[], call),
            Way::Direct(share) if share < 1.0 => self.trial.direct(share, call),
            Way::Direct(_) => {}
        }
        if let Some(best) = call.best.as_mut().filter(|best| best.way == way) {
            best.worth = best.worth.favoured(self.settings.hysteresis);
        }
    }

    /// The star of intermediate destinations, random ones, and the wider star where nothing has arrived.
    fn search(&mut self, call: &mut Call<'_, '_, '_>) {
        let Self { settings, memory, frame, trial } = self;
        let Situation { state, goal, limits, .. } = *call.situation;
        let length = limits.speed * limits.speed / limits.acceleration;
        let towards = goal - state.position;
        let heading = libm::atan2(towards.y, towards.x);
        let off = |angle: f64, distance: f64| Vector::new(libm::cos(angle), libm::sin(angle)) * (distance * length);
        for i in 0..settings.directions {
            for distance in &settings.distances {
                if !call.run.allows(1) {
                    return;
                }
                let angle = heading + TAU * i as f64 / settings.directions as f64;
                trial.via(state.position + off(angle, *distance), &settings.switches, call);
            }
        }
        let mut word = call.run.seed ^ frame.rotate_left(32);
        let mut uniform = || unit(splitmix64(&mut word));
        let greatest = |values: &[f64]| values.iter().fold(0.0, |a: f64, b| a.max(*b));
        let (farthest, latest) = (greatest(&settings.distances), greatest(&settings.switches));
        for i in 0..settings.samples {
            if !call.run.allows(1) {
                return;
            }
            let [angle, distance, time] = [TAU * uniform(), uniform(), uniform()];
            match *memory {
                Some(Way::Through { via, switch }) if i % 2 == 0 => {
                    let switch = switch * (1.0 + SPREAD * (2.0 * time - 1.0));
                    trial.via(via + off(angle, SPREAD * distance), &[switch], call);
                }
                _ => trial.via(state.position + off(angle, farthest * distance), &[latest * time], call),
            }
        }
        for share in &settings.far {
            for i in 0..settings.directions {
                if call.arrives() || !call.run.allows(1) {
                    return;
                }
                let angle = heading + TAU * i as f64 / settings.directions as f64;
                let distance = share * towards.norm();
                // After d/v a motion from rest over at least v²/a begins to brake.
                trial.via(state.position + off(angle, distance / length), &[distance / limits.speed], call);
            }
        }
    }
}

impl Controller for SampledBangBang {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        self.frame = self.frame.wrapping_add(1);
        self.trial.foresight.begin(situation);
        let mut call = Call { situation, run, out: trajectory, best: None };
        self.trial.direct(1.0, &mut call);
        if !call.arrives() {
            self.remember(&mut call);
            self.trial.brake(&mut call);
            for share in &self.settings.slower {
                self.trial.direct(*share, &mut call);
            }
            self.search(&mut call);
        }
        self.memory = call.best.map(|b| b.way.later(situation.period));
        Ok(match call.best {
            _ if call.arrives() => Outcome::Arrives,
            Some(_) => Outcome::Partial,
            None => Outcome::NotFound,
        })
    }

    fn reset(&mut self) {
        self.memory = None;
        self.frame = 0;
    }
}

#[cfg(test)]
mod tests {
    use env_model::motion::{Limits, State};
    use env_model::{Obstacle, Point, Scene, World};

    use super::*;

    #[test]
    fn a_slow_robot_gets_round_what_is_large() {
        // The ball's distance in STOP, half a metre, at its speed: v²/a is 0.7 m.
        let ball = Obstacle::disc(Point::origin(), 0.5);
        let world = World::new(&Scene {
            name: "stop".into(),
            unit: "m".into(),
            robot_radius: 0.09,
            start: [-2.7, 0.0],
            goal: [2.7, 0.0],
            field: None,
            obstacles: vec![ball],
        })
        .unwrap();
        let limits = Limits::new(1.45, 3.0).unwrap();
        let (period, goal) = (1.0 / 60.0, Point::new(2.7, 0.0));
        for (seed, y) in [-0.1, 0.0, 0.1].into_iter().enumerate() {
            let mut state = State::at_rest(Point::new(-2.7, y));
            let mut controller = SampledBangBang::new(SampledBangBangSettings::default()).unwrap();
            let mut trajectory = Trajectory::default();
            // Straight it would take 5.4/1.45 + 1.45/3 = 4.2 s; half as much again.
            for frame in 0..380 {
                let situation = Situation::new(&world, &[], state, goal, limits, 2.0, period).unwrap();
                let mut run = Run::new(1000 * seed as u64 + frame);
                let outcome = controller.control(&situation, &mut run, &mut trajectory).unwrap();
                assert_eq!(outcome, Outcome::Arrives, "frame {frame} from y = {y}");
                state = trajectory.state(period);
            }
            assert_eq!(state, State::at_rest(goal), "from y = {y}");
        }
    }
}
