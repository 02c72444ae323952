//! When each cell is safe.

use env_model::motion::polynomial::Polynomial;
use env_model::motion::{Mover, Path, Piece};
use env_model::{Aabb, CellGrid, Point, Vector};

/// A stretch of time, in seconds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    /// Its beginning.
    pub begin: f64,
    /// Its end, perhaps +∞.
    pub end: f64,
}

/// Calls `visit` with every stretch of motion of `mover` until `horizon`, and then with its rest where it is then: the
/// time at which it begins, and the motion of its displacement.
fn for_each_stretch(mover: &Mover<'_>, horizon: f64, mut visit: impl FnMut(f64, Piece)) {
    let rest = |t: f64| Piece {
        duration: f64::INFINITY,
        position: Point::from(mover.displacement(t)),
        velocity: Vector::zeros(),
        acceleration: Vector::zeros(),
    };
    match mover.path {
        Path::Velocity(velocity) if velocity == Vector::zeros() => visit(0.0, rest(0.0)),
        Path::Velocity(velocity) => {
            let position = Point::origin();
            visit(0.0, Piece { duration: horizon, position, velocity, acceleration: Vector::zeros() });
            visit(horizon, rest(horizon));
        }
        Path::Trajectory(trajectory) => {
            let from = trajectory.start().position;
            for (begin, piece) in trajectory.timed().take_while(|(begin, _)| *begin < horizon) {
                let duration = piece.duration.min(horizon - begin);
                visit(begin, Piece { duration, position: Point::from(piece.position - from), ..piece });
            }
            visit(horizon, rest(horizon));
        }
    }
}

/// The disc round the mover's shape: itself where it is one.
fn disc(mover: &Mover<'_>) -> (Point, f64) {
    mover.shape.as_disc().unwrap_or_else(|| {
        let aabb = mover.shape.aabb();
        (aabb.centre(), 0.5 * aabb.diagonal())
    })
}

/// The times at which `mover`, grown by its margin, covers `p`.
pub fn for_each_cover(mover: &Mover<'_>, p: Point, horizon: f64, mut visit: impl FnMut(Interval)) {
    let (centre, radius) = disc(mover);
    for_each_stretch(mover, horizon, |begin, piece| {
        covers(&piece, begin, centre, radius + mover.margin, p, &mut visit)
    });
}

fn covers(piece: &Piece, begin: f64, centre: Point, reach: f64, p: Point, visit: &mut impl FnMut(Interval)) {
    let (d, v, h) = (centre + piece.position.coords - p, piece.velocity, piece.acceleration * 0.5);
    let gap = d.norm_squared() - reach * reach;
    if piece.duration.is_infinite() {
        if gap < 0.0 {
            visit(Interval { begin, end: f64::INFINITY });
        }
        return;
    }
    let distance =
        Polynomial([gap, 2.0 * d.dot(&v), v.norm_squared() + 2.0 * d.dot(&h), 2.0 * v.dot(&h), h.norm_squared()]);
    let roots = distance.roots(0.0, piece.duration);
    let mut from = 0.0;
    for to in roots.iter().copied().chain([piece.duration]) {
        if distance.at(0.5 * (from + to)) < 0.0 {
            visit(Interval { begin: begin + from, end: begin + to });
        }
        from = to;
    }
}

/// The safe intervals of every cell of a grid. Its buffers are reused.
#[derive(Debug, Default)]
pub struct SafeIntervals {
    covers: Vec<(u32, Interval)>,
    safe: Vec<Interval>,
    /// Where the intervals of each cell begin in `safe`, and one more.
    first: Vec<u32>,
}

impl SafeIntervals {
    /// Computes them: when no mover, grown by its margin, is near enough to a cell's centre to touch the nearer half of
    /// a move from or to it. So whoever is on a move between two cells that both are safe is free, whatever its speed:
    /// a disc of radius r that enters a segment of length ℓ comes within √(r² + ℓ²/4) of one of its ends.
    ///
    /// After the horizon movers stand where they are then. Shapes other than discs count as the disc round them.
    pub fn compute(&mut self, grid: &CellGrid, blocked: &[bool], movers: &[Mover<'_>], horizon: f64) {
        self.covers.clear();
        let half = grid.size() * std::f64::consts::FRAC_1_SQRT_2;
        for mover in movers {
            let (centre, radius) = disc(mover);
            let grown = radius + mover.margin;
            let reach = (grown * grown + half * half).sqrt();
            for_each_stretch(mover, horizon, |begin, piece| {
                let swept = if piece.duration.is_finite() { piece.aabb() } else { Aabb::of_points([&piece.position]) };
                let near = Aabb { min: swept.min + centre.coords, max: swept.max + centre.coords }.inflated(reach);
                if !near.overlaps(&grid.aabb()) {
                    return;
                }
                let ((left, low), (right, high)) =
                    (grid.position(grid.cell_at(near.min)), grid.position(grid.cell_at(near.max)));
                for row in low..=high {
                    for column in left..=right {
                        let cell = grid.cell(column, row);
                        if !blocked[cell] {
                            covers(&piece, begin, centre, reach, grid.centre(cell), &mut |interval| {
                                self.covers.push((cell as u32, interval));
                            });
                        }
                    }
                }
            });
        }
        self.covers.sort_unstable_by(|(a, s), (b, t)| a.cmp(b).then(s.begin.total_cmp(&t.begin)));
        self.complement(blocked);
    }

    /// What the sorted covers leave.
    fn complement(&mut self, blocked: &[bool]) {
        self.safe.clear();
        self.first.clear();
        let mut covers = self.covers.iter().peekable();
        for (cell, blocked) in blocked.iter().enumerate() {
            self.first.push(self.safe.len() as u32);
            if *blocked {
                continue;
            }
            let mut begin = 0.0;
            while let Some((_, cover)) = covers.next_if(|(at, _)| *at == cell as u32) {
                if cover.begin > begin {
                    self.safe.push(Interval { begin, end: cover.begin });
                }
                begin = f64::max(begin, cover.end);
            }
            if begin < f64::INFINITY {
                self.safe.push(Interval { begin, end: f64::INFINITY });
            }
        }
        self.first.push(self.safe.len() as u32);
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.safe.len()
    }

    /// The numbers of a cell's intervals.
    pub fn of(&self, cell: usize) -> std::ops::Range<usize> {
        self.first[cell] as usize..self.first[cell + 1] as usize
    }

    /// An interval by its number.
    pub fn get(&self, interval: usize) -> Interval {
        self.safe[interval]
    }
}
