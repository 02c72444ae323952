//! The dynamic window approach, for omnidirectional robots among obstacles that move.
//!
//! Of the velocities that can be reached within a short interval (the window) those are admissible from which the robot
//! can brake before contact; among them G = α·heading + β·clearance + γ·velocity is maximised, each term in 0 … 1:
//!
//! - heading = 1 − θ/π, θ between the velocity and the goal as seen from where the robot is after the interval;
//! - clearance: the time until contact if the velocity is held, as a share of the prediction's horizon;
//! - velocity = 1 − |‖w‖ − w\*|/s with s the speed limit and w\* = min(s, √(2ad)) the speed from which the robot still
//!   stops at the goal.
//!
//! What differs from the paper, and why:
//!
//! - The paper's robot has a synchro-drive and moves on arcs; its window is a rectangle of translational and rotational
//!   velocities. An omnidirectional robot's window is a disc of radius a·interval round its velocity, sampled on rings;
//!   its heading is the direction in which it moves (0 where it stands).
//! - The paper's obstacles stand still, and clearance is a distance. Here movers go on with the velocities that they
//!   have, and contact is computed exactly ([`meets`](env_model::motion::contact::meets)): clearance is a time.
//! - The paper's velocity term is ‖w‖ alone; without w\* it orbits a goal where one must stand.
//! - The fastest motion to the goal is a candidate. Where it is free until the horizon it has all three terms at their
//!   greatest and is the answer.
//! - Objective smoothing (σ in the paper) widens clearances of sampled arcs seen by a sonar; exact contact needs none.
//! - Where nothing is admissible, the velocity whose contact comes last.
//!
//! Source: D. Fox, W. Burgard & S. Thrun, *The dynamic window approach to collision avoidance*, IEEE Robotics &
//! Automation Magazine 4(1):23–33, 1997, DOI 10.1109/100.580977.

mod controller;
mod danger;
mod settings;

pub use controller::DynamicWindow;
pub use settings::DynamicWindowSettings;
