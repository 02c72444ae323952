//! The taut string through vertical gates: a lower bound on the length of a
//! side class, from any path that passes the gates.
//!
//! Lee & Preparata, *Euclidean shortest paths in the presence of rectilinear
//! barriers* (1984), doi 10.1002/net.3230140304: the funnel, here between
//! vertical intervals, so that it is a window of slopes seen from the apex.

use env_model::Point;

/// The path must cross x at a height in [lo, hi]; either may be infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gate {
    pub(crate) x: f64,
    pub(crate) lo: f64,
    pub(crate) hi: f64,
}

/// The shortest polyline from the origin to (`length`, 0) through `gates`
/// (ascending, 0 < x < `length`) into `string`, and its length; +∞ and no
/// string when a gate is empty. About O(n); O(n²) at worst.
pub(crate) fn taut_string(gates: &[Gate], length: f64, string: &mut Vec<Point>) -> f64 {
    string.clear();
    if gates.iter().any(|g| g.lo > g.hi) {
        return f64::INFINITY;
    }
    let goal = Gate { x: length, lo: 0.0, hi: 0.0 };
    let mut apex = Point::origin();
    string.push(apex);
    let mut total = 0.0;
    let mut next = 0;
    while next <= gates.len() {
        // The window of slopes, each with the gate that narrowed it.
        let (mut lo, mut hi) = ((f64::NEG_INFINITY, next), (f64::INFINITY, next));
        let mut turn = None;
        for at in next..=gates.len() {
            let gate = gates.get(at).unwrap_or(&goal);
            let dx = gate.x - apex.x;
            let (low, high) = ((gate.lo - apex.y) / dx, (gate.hi - apex.y) / dx);
            if low > hi.0 {
                turn = Some((hi.1, Point::new(gates[hi.1].x, gates[hi.1].hi)));
                break;
            }
            if high < lo.0 {
                turn = Some((lo.1, Point::new(gates[lo.1].x, gates[lo.1].lo)));
                break;
            }
            if low >= lo.0 {
                lo = (low, at);
            }
            if high <= hi.0 {
                hi = (high, at);
            }
        }
        let (at, corner) = turn.unwrap_or((gates.len(), Point::new(length, 0.0)));
        total += (corner - apex).norm();
        apex = corner;
        string.push(corner);
        next = at + 1;
    }
    total
}

/// The height of a polyline with non-decreasing x at `x`; `from` is a segment
/// at or before the one sought, and becomes it.
pub(crate) fn height_at(path: &[Point], x: f64, from: &mut usize) -> f64 {
    while *from + 2 < path.len() && path[*from + 1].x < x {
        *from += 1;
    }
    let (a, b) = (path[*from], path[*from + 1]);
    let dx = b.x - a.x;
    if dx > 0.0 { a.y + (b.y - a.y) * ((x - a.x) / dx).clamp(0.0, 1.0) } else { b.y }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gate(x: f64, lo: f64, hi: f64) -> Gate {
        Gate { x, lo, hi }
    }

    #[test]
    fn a_string_turns_where_it_must() {
        let mut string = Vec::new();
        let open = f64::INFINITY;
        assert_eq!(taut_string(&[gate(1.0, -1.0, open)], 4.0, &mut string), 4.0);
        // Over a post of height 3 at x = 4 and under a bar at −4 at x = 11, 8 and 7 long.
        let length = taut_string(&[gate(4.0, 3.0, open), gate(11.0, -open, -4.0)], 14.0, &mut string);
        let expected = 5.0 + (49.0_f64 + 49.0).sqrt() + 5.0;
        assert!((length - expected).abs() < 1e-12, "{length}");
        assert_eq!(string, [(0.0, 0.0), (4.0, 3.0), (11.0, -4.0), (14.0, 0.0)].map(|(x, y)| Point::new(x, y)));
        assert_eq!(taut_string(&[gate(1.0, 1.0, 0.5)], 4.0, &mut string), f64::INFINITY);
    }

    /// Against a dense search over heights on a grid, which can only be longer.
    #[test]
    fn no_string_through_the_gates_is_shorter() {
        let gates = [gate(1.0, 0.5, 2.0), gate(2.0, -1.0, 0.25), gate(3.0, 1.0, 3.0), gate(4.0, 0.75, 0.8)];
        let mut string = Vec::new();
        let length = taut_string(&gates, 5.0, &mut string);
        // Dynamic programme: heights on a grid of 0.05, within which the corners lie.
        let grid: Vec<f64> = (0..=80).map(|i| -1.0 + 0.05 * f64::from(i)).collect();
        let mut reach: Vec<(f64, f64)> = vec![(0.0, 0.0)];
        let mut x = 0.0;
        for g in gates.iter().chain(&[gate(5.0, 0.0, 0.0)]) {
            let dx: f64 = g.x - x;
            reach = grid
                .iter()
                .filter(|&&y| y >= g.lo - 1e-9 && y <= g.hi + 1e-9)
                .map(|&y| (y, reach.iter().map(|(z, d)| d + dx.hypot(y - z)).fold(f64::INFINITY, f64::min)))
                .collect();
            x = g.x;
        }
        // Where the string passes a gate freely the grid is off by up to 0.025: 0.025²/dx longer a gate.
        assert!(length <= reach[0].1 + 1e-12 && length > reach[0].1 - 2e-3, "{length} {reach:?}");
    }
}
