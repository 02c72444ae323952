//! Sampled bang-bang trajectories, checked in time: the practice of the best teams of the Small Size League.
//!
//! Bang-bang trajectories cost a microsecond, contact in time is exact, so a robot can afford to try hundreds a frame:
//!
//! 1. straight to the goal; where that is free as far as movers are predicted, it is the answer;
//! 2. the way of the frame before, which others must beat by a little (hysteresis);
//! 3. to the goal more slowly;
//! 4. towards an intermediate destination, and from some moment on to the goal: a star of directions × distances ×
//!    moments round the robot, then random ones, half of them near the one of the frame before; while nothing arrives, a wider star;
//! 5. to an intermediate destination and no further, braking on the spot among them.
//!
//! The best is the free one that arrives first; failing that, the free one whose end is nearest to the goal in time;
//! failing that, the one that touches something last. All this only among motions on which the robot can still stop
//! after the first period ([`Foresight`](planner_control::Foresight)), as long as there is one.
//!
//! What movers do behind the horizon is unknown: a rest is free that lasts until then.
//!
//! Sources: TIGERs Mannheim, released code of Sumatra (package `edu.tigers.sumatra.pathfinder`: paths of connected
//! bang-bang trajectories over intermediate destinations) and extended team descriptions; ER-Force, extended team
//! descriptions (sampled trajectories).

mod controller;
mod settings;
mod trial;
mod way;

pub use controller::SampledBangBang;
pub use settings::SampledBangBangSettings;
