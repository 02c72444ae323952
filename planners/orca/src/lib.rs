//! ORCA: optimal reciprocal collision avoidance.
//!
//! Every mover forbids the relative velocities that lead to contact within τ; the half-plane beside the least change u
//! that leaves them, shifted by half of u where the mover is a mate who does the other half, by all of u where it gives
//! no way, is what a robot permits itself. The velocity nearest to the preferred one in all half-planes is found by a
//! linear programme, or where there is none the one of least violation. Nothing is planned: it follows the straight
//! line to the goal, slides along what it meets, and stays in the pockets of obstacles that stand still.
//!
//! Beyond the paper, for robots that have inertia:
//!
//! - Velocities come from the lens of those that can be reached in one period ([`reach`]), so that each answer is kept
//!   to and the half-planes of the next period start from where the robot really is. A horizon longer than braking
//!   takes lets them bind while they can still be obeyed.
//! - The preferred velocity is that of the fastest motion to the goal ([`bang_bang`](env_model::motion::bang_bang())) one
//!   period on, which brakes in time; where every half-plane permits it, that motion is the answer.
//! - What stands still is a wall through its nearest point, approached no faster than one can stop before it
//!   ([`constraints::Wall`]); the fallback programme keeps these hard, as RVO2 does.
//! - A little distance is kept beyond contact ([`OrcaSettings::margin`]), shrunk where robots are nearer already.
//!
//! Sources: J. van den Berg, S. J. Guy, M. Lin & D. Manocha, *Reciprocal n-body collision avoidance*, Robotics Research
//! (ISRR 2009), STAR 70, 2011, pp. 3–19, DOI 10.1007/978-3-642-19457-3_1; the linear programmes and the perturbation
//! as in the authors' RVO2 library (Agent.cc, examples/Circle.cc).

pub mod constraints;
mod controller;
pub mod program;
pub mod reach;
mod settings;

pub use controller::Orca;
pub use settings::OrcaSettings;
