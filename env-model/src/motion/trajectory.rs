//! Motions of piecewise constant acceleration.

use super::{Limits, MotionError};
use crate::{Aabb, Point, Vector};

/// Where something is and how it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State {
    /// Scene units.
    pub position: Point,
    /// Units per second.
    pub velocity: Vector,
}

impl State {
    /// At rest.
    pub fn at_rest(position: Point) -> Self {
        Self { position, velocity: Vector::zeros() }
    }

    /// The same state, if all its numbers are finite.
    ///
    /// # Errors
    /// [`MotionError::NotFinite`] names what is not.
    pub fn finite(self) -> Result<Self, MotionError> {
        MotionError::finite("position", self.position.coords)?;
        MotionError::finite("velocity", self.velocity)?;
        Ok(self)
    }
}

/// Motion of constant acceleration: p(t) = p₀ + v₀t + ½at², 0 ≤ t ≤ duration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Piece {
    /// Seconds, ≥ 0; may be infinite.
    pub duration: f64,
    /// p₀.
    pub position: Point,
    /// v₀.
    pub velocity: Vector,
    /// a.
    pub acceleration: Vector,
}

impl Piece {
    /// The state `t` seconds after the piece's beginning.
    pub fn state(&self, t: f64) -> State {
        State {
            position: self.position + (self.velocity + self.acceleration * (0.5 * t)) * t,
            velocity: self.velocity + self.acceleration * t,
        }
    }

    /// The smallest box round all positions; the duration must be finite.
    pub fn aabb(&self) -> Aabb {
        let mut aabb = Aabb::of_segment(self.position, self.state(self.duration).position);
        for axis in 0..2 {
            // Where the velocity's component vanishes.
            let t = -self.velocity[axis] / self.acceleration[axis];
            if t > 0.0 && t < self.duration {
                aabb = aabb.including(self.state(t).position);
            }
        }
        aabb
    }
}

/// A motion from now on: pieces of constant acceleration one after the other. After the last one it goes on with the
/// velocity that it has then, mostly none.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    pieces: Vec<Piece>,
    end: State,
    duration: f64,
}

impl Default for Trajectory {
    fn default() -> Self {
        Self::new(State::at_rest(Point::origin()))
    }
}

impl Trajectory {
    /// A motion that goes on as it begins.
    pub fn new(start: State) -> Self {
        Self { pieces: Vec::new(), end: start, duration: 0.0 }
    }

    /// Forgets everything but its buffer, and begins anew.
    pub fn begin(&mut self, start: State) {
        self.pieces.clear();
        (self.end, self.duration) = (start, 0.0);
    }

    /// Becomes a copy of `other` in its own buffer.
    pub fn copy_from(&mut self, other: &Self) {
        self.pieces.clone_from(&other.pieces);
        (self.end, self.duration) = (other.end, other.duration);
    }

    /// Goes on for `duration` seconds with constant `acceleration`; nothing for a duration of 0.
    pub fn push(&mut self, duration: f64, acceleration: Vector) {
        if duration > 0.0 {
            let State { position, velocity } = self.end;
            let piece = Piece { duration, position, velocity, acceleration };
            self.end = piece.state(duration);
            self.duration += duration;
            self.pieces.push(piece);
        }
    }

    /// Goes on as `leg` does in its first `time` seconds, wherever that begins.
    pub fn append(&mut self, leg: &Self, time: f64) {
        let mut left = time;
        for piece in &leg.pieces {
            self.push(piece.duration.min(left), piece.acceleration);
            left -= piece.duration;
            if left <= 0.0 {
                return;
            }
        }
        // What the sums give but for their rounding.
        self.end = leg.end;
    }

    /// Says where exactly it ends: what the sums of its pieces give but for their rounding.
    pub fn end_at(&mut self, end: State) {
        self.end = end;
    }

    /// The pieces in the order of time.
    pub fn pieces(&self) -> &[Piece] {
        &self.pieces
    }

    /// When the last piece ends, in seconds.
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The state at time 0.
    pub fn start(&self) -> State {
        self.pieces.first().map_or(self.end, |p| State { position: p.position, velocity: p.velocity })
    }

    /// The state at the end of the last piece.
    pub fn end(&self) -> State {
        self.end
    }

    /// The state at `t` ≥ 0 seconds.
    pub fn state(&self, t: f64) -> State {
        let mut begin = 0.0;
        for piece in &self.pieces {
            if t < begin + piece.duration {
                return piece.state(t - begin);
            }
            begin += piece.duration;
        }
        let State { position, velocity } = self.end;
        State { position: position + velocity * (t - self.duration).max(0.0), velocity }
    }

    /// The acceleration at `t` ≥ 0 seconds, that after a change where there is one; 0 after the end.
    pub fn acceleration(&self, t: f64) -> Vector {
        let mut begin = 0.0;
        for piece in &self.pieces {
            begin += piece.duration;
            if t < begin {
                return piece.acceleration;
            }
        }
        Vector::zeros()
    }

    /// Drops the first `time` ≥ 0 seconds: what was then is now.
    pub fn advance(&mut self, time: f64) {
        if time >= self.duration {
            let state = self.state(time);
            self.begin(state);
            return;
        }
        let mut left = time;
        let gone = self.pieces.iter().take_while(|piece| {
            let over = piece.duration <= left;
            left -= if over { piece.duration } else { 0.0 };
            over
        });
        let gone = gone.count();
        self.pieces.drain(..gone);
        if let Some(first) = self.pieces.first_mut() {
            let State { position, velocity } = first.state(left);
            *first = Piece { duration: first.duration - left, position, velocity, ..*first };
        }
        self.duration = self.pieces.iter().map(|p| p.duration).sum();
    }

    /// The pieces with the times at which they begin, the last one the endless motion after the end.
    pub fn timed(&self) -> impl Iterator<Item = (f64, Piece)> + '_ {
        let State { position, velocity } = self.end;
        let after = Piece { duration: f64::INFINITY, position, velocity, acceleration: Vector::zeros() };
        let mut begin = 0.0;
        self.pieces.iter().copied().chain([after]).map(move |piece| {
            let at = begin;
            begin += piece.duration;
            (at, piece)
        })
    }

    /// Checks that all its numbers are finite.
    ///
    /// # Errors
    /// [`MotionError`] names what is not.
    pub fn check(&self) -> Result<(), MotionError> {
        for piece in &self.pieces {
            MotionError::not_negative("duration", piece.duration)?;
            State { position: piece.position, velocity: piece.velocity }.finite()?;
            MotionError::finite("acceleration", piece.acceleration)?;
        }
        self.end.finite().map(|_| ())
    }

    /// The greatest speed and the greatest acceleration on the way.
    pub fn peaks(&self) -> Limits {
        // A speed is greatest at an end of its piece: its square is a convex function of time.
        let mut peaks = Limits { speed: self.end.velocity.norm(), acceleration: 0.0 };
        for piece in &self.pieces {
            let speeds = [piece.velocity.norm(), piece.state(piece.duration).velocity.norm()];
            peaks.speed = peaks.speed.max(speeds[0]).max(speeds[1]);
            peaks.acceleration = peaks.acceleration.max(piece.acceleration.norm());
        }
        peaks
    }
}
