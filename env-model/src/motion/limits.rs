//! What a robot can do.

use crate::Vector;

/// Bounds on speed and acceleration, the same in every direction (an omnidirectional robot).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Limits {
    /// Units per second, > 0.
    pub speed: f64,
    /// Units per second², > 0.
    pub acceleration: f64,
}

/// What makes a motion unusable.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// A number that must be positive and finite is not.
    #[error("{what} = {value}; expected a finite number above 0")]
    NotPositive {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number that must be 0 or more, and finite, is not.
    #[error("{what} = {value}; expected a finite number, at least 0")]
    Negative {
        /// What it is.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A position, velocity or acceleration is NaN or infinite.
    #[error("{what} ({x}, {y}) is not finite")]
    NotFinite {
        /// What it is.
        what: &'static str,
        /// Its x.
        x: f64,
        /// Its y.
        y: f64,
    },
}

impl MotionError {
    /// `value`, if it is positive and finite.
    ///
    /// # Errors
    /// [`MotionError::NotPositive`] names it.
    pub fn positive(what: &'static str, value: f64) -> Result<f64, Self> {
        if value.is_finite() && value > 0.0 { Ok(value) } else { Err(Self::NotPositive { what, value }) }
    }

    /// `value`, if it is finite and not negative.
    ///
    /// # Errors
    /// [`MotionError::Negative`] names it.
    pub fn not_negative(what: &'static str, value: f64) -> Result<f64, Self> {
        if value.is_finite() && value >= 0.0 { Ok(value) } else { Err(Self::Negative { what, value }) }
    }

    /// `v`, if it is finite.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`] names it.
    pub fn finite(what: &'static str, v: Vector) -> Result<Vector, Self> {
        if v.x.is_finite() && v.y.is_finite() { Ok(v) } else { Err(Self::NotFinite { what, x: v.x, y: v.y }) }
    }
}

impl Limits {
    /// A robot that keeps to `speed` (units per second) and `acceleration` (units per second²).
    ///
    /// # Errors
    /// [`MotionError::NotPositive`] where one is not finite and above 0.
    pub fn new(speed: f64, acceleration: f64) -> Result<Self, MotionError> {
        Ok(Self {
            speed: MotionError::positive("speed limit", speed)?,
            acceleration: MotionError::positive("acceleration limit", acceleration)?,
        })
    }

    /// Where a robot of `speed` units per second can stop at the soonest: v²/(2a).
    pub fn braking_distance(&self, speed: f64) -> f64 {
        0.5 * speed * speed / self.acceleration
    }
}
