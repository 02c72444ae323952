//! Planning in space and time every frame.

use env_model::motion::{State, Trajectory, bang_bang, brake};
use env_model::{CellGrid, Point, Vector};
use planner_api::{ControlError, Controller, Outcome, Run, SettingError, Situation};
use planner_control::Foresight;

use crate::SippSettings;
use crate::retime::Retime;
use crate::search::{Query, Search, Stop};

/// Safe interval path planning, replanned every frame.
///
/// An iteration, and an evaluation, is the expansion of a safe interval.
#[derive(Debug)]
pub struct Sipp {
    settings: SippSettings,
    foresight: Foresight,
    search: Search,
    retime: Retime,
    way: Vec<Stop>,
    /// The way from the start to a cell.
    join: Trajectory,
}

impl Sipp {
    /// A controller with validated settings.
    ///
    /// # Errors
    /// The setting that is out of range.
    pub fn new(settings: SippSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            foresight: Foresight::default(),
            search: Search::default(),
            retime: Retime::default(),
            way: Vec::new(),
            join: Trajectory::default(),
        })
    }

    /// The stops of the last search, from where the robot can begin at rest.
    pub fn way(&self) -> &[Stop] {
        &self.way
    }
}

impl Controller for Sipp {
    fn control(
        &mut self,
        situation: &Situation<'_>,
        run: &mut Run<'_>,
        trajectory: &mut Trajectory,
    ) -> Result<Outcome, ControlError> {
        let Situation { world, movers, state, goal, limits, horizon, .. } = *situation;
        self.foresight.begin(situation);
        self.way.clear();
        bang_bang(state, goal, limits, trajectory);
        if self.foresight.contact(situation, trajectory, f64::MAX).is_infinite()
            && self.foresight.can_stop(situation, trajectory)
        {
            return Ok(Outcome::Arrives);
        }
        // A moving robot can wait only after braking, so that is where the search begins.
        brake(state, limits, trajectory);
        let State { position: stand, .. } = trajectory.end();
        let start = if self.foresight.can_stop(situation, trajectory) {
            (stand, trajectory.duration())
        } else {
            trajectory.begin(State::at_rest(state.position));
            (state.position, 0.0)
        };
        let extent = world.extent().including(start.0).including(goal);
        let grid = CellGrid::along_longer_side(&extent, self.settings.cells);
        let query = Query { world, movers, horizon, start, goal, speed: self.settings.cruise * limits.speed };
        let (foresight, join) = (&mut self.foresight, &mut self.join);
        let free = |to: Point, depart: f64, arrive: f64| {
            join.copy_from(trajectory);
            join.push(depart - start.1, Vector::zeros());
            join.end_at(State {
                position: start.0,
                velocity: (to - start.0) / (arrive - depart).max(f64::MIN_POSITIVE),
            });
            join.push(arrive - depart, Vector::zeros());
            join.end_at(State::at_rest(to));
            foresight.contact(situation, join, arrive) >= arrive
        };
        let found = self.search.run(&grid, &query, free, run, &mut self.way);
        let whole = self.retime.run(situation, &mut self.foresight, &self.way, trajectory);
        let moves = trajectory.duration() > 0.0;
        if !moves || !self.foresight.can_stop(situation, trajectory) {
            brake(state, limits, trajectory);
            return Ok(if self.way.is_empty() { Outcome::NotFound } else { Outcome::Partial });
        }
        Ok(if found && whole { Outcome::Arrives } else { Outcome::Partial })
    }
}
