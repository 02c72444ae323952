//! The list of controllers: what moves a robot among obstacles that move.

use planner_api::Controller;
use planner_behaviour::Behaviour;
use planner_control::Replan;
use planner_dynamic_window::DynamicWindow;
use planner_orca::Orca;
use planner_potential_field::MovingPotentialField;
use planner_sampled_bang_bang::SampledBangBang;
use planner_space_time::Sipp;
use toml::de::DeTable;
use toml::{Spanned, Table};

use crate::build::{BuildError, Settings, build, parse};
use crate::kinds;

/// One kind of controller of its own; every planner is one besides, replanning each frame.
#[derive(Debug, Clone, Copy)]
pub struct ControllerKind {
    /// Its name in configurations.
    pub name: &'static str,
    /// What it does, in a sentence.
    pub summary: &'static str,
    /// Where it comes from.
    pub source: &'static str,
    make: Make,
}

/// Builds a controller from its settings; returns every setting in force as well.
type Make = fn(Settings<'_>) -> Result<(Box<dyn Controller>, Table), BuildError>;

/// A controller ready for use, and every setting in force.
pub struct BuiltController {
    /// The controller.
    pub controller: Box<dyn Controller>,
    /// Its settings, defaults written out: building from them gives the same controller.
    pub settings: Table,
}

/// The controllers that are no planners, in the order of the documentation.
pub fn controllers() -> &'static [ControllerKind] {
    const KINDS: &[ControllerKind] = &[
        ControllerKind {
            name: "behaviour",
            summary: "The weighted sum of simple behaviours: to the goal, away from obstacles and robots, into formation",
            source: "Fang 2009, chapter 5; Balch & Arkin 1998",
            make: |settings| plain(settings, Behaviour::new),
        },
        ControllerKind {
            name: "orca",
            summary: "Of the velocities that leave each mate half of the evasion and take all of it from opponents, the \
                      one nearest to the goal's",
            source: "van den Berg, Guy, Lin & Manocha 2011",
            make: |settings| plain(settings, Orca::new),
        },
        ControllerKind {
            name: "dynamic-window",
            summary: "Of the velocities in short reach from which one can brake before contact, the one of best heading, \
                      clearance and speed",
            source: "Fox, Burgard & Thrun 1997",
            make: |settings| plain(settings, DynamicWindow::new),
        },
        ControllerKind {
            name: "moving-potential-field",
            summary: "The force of a potential in which obstacles repel by how near they are and how fast they approach",
            source: "Ge & Cui 2002",
            make: |settings| plain(settings, MovingPotentialField::new),
        },
        ControllerKind {
            name: "bang-bang",
            summary: "The best of many bang-bang trajectories by way of intermediate destinations, checked in time",
            source: "practice of TIGERs Mannheim and ER-Force in the Small Size League",
            make: |settings| plain(settings, SampledBangBang::new),
        },
        ControllerKind {
            name: "sipp",
            summary: "A* over grid cells and the times at which they are safe, then legs within the robot's limits",
            source: "Phillips & Likhachev 2011, ICRA, 5628-5635",
            make: |settings| plain(settings, Sipp::new),
        },
    ];
    KINDS
}

/// Every name that [`build_controller`] knows: the controllers of their own, then the planners.
pub fn controller_names() -> Vec<&'static str> {
    controllers().iter().map(|k| k.name).chain(kinds().iter().map(|k| k.name)).collect()
}

/// Builds the controller `kind` from its TOML table: one of [`controllers`], or any planner, which then plans anew
/// every frame as if all stood still.
///
/// # Errors
/// [`BuildError`]; spans refer to the document that `settings` was parsed from.
pub fn build_controller(kind: &str, settings: Spanned<DeTable<'_>>) -> Result<BuiltController, BuildError> {
    if let Some(entry) = controllers().iter().find(|k| k.name == kind) {
        let (controller, settings) = (entry.make)(Settings::new(settings))?;
        return Ok(BuiltController { controller, settings });
    }
    if !kinds().iter().any(|k| k.name == kind) {
        return Err(BuildError::UnknownKind { kind: kind.to_owned(), known: controller_names() });
    }
    let built = build(kind, settings)?;
    Ok(BuiltController { controller: Box::new(Replan::new(built.planner)), settings: built.settings })
}

/// Builds the controller `kind` from TOML text such as `"particles = 30"`.
///
/// # Errors
/// [`BuildError`]; spans refer to `settings`.
pub fn build_controller_str(kind: &str, settings: &str) -> Result<BuiltController, BuildError> {
    build_controller(kind, parse(settings)?)
}

/// The controller that `new` makes of validated settings, and those settings.
fn plain<S, C>(
    settings: Settings<'_>,
    new: impl FnOnce(S) -> Result<C, planner_api::SettingError>,
) -> Result<(Box<dyn Controller>, Table), BuildError>
where
    S: serde::de::DeserializeOwned + serde::Serialize + Clone,
    C: Controller + 'static,
{
    let settings: S = settings.parse()?;
    let controller = new(settings.clone())?;
    Ok((Box::new(controller), kinds::table(&settings)))
}
