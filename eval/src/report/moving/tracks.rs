//! Where everybody was, small enough to travel in the page: whole millimetres, each as its step from the one before.

use serde::Serialize;
use strategy::Trace;

/// Seconds between two places kept, at least; between them motion looks straight.
const FINEST_S: f64 = 0.045;
/// Millimetres in a metre.
const FINE: f64 = 1000.0;

/// The data of one animation, as the page's script reads it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Tracks {
    /// Milliseconds between places; the last two may be nearer to each other.
    pub step: f64,
    /// Milliseconds from the first place to the last.
    pub end: f64,
    /// Of every body x and y in millimetres at first, and by how much they grow from place to place.
    pub bodies: Vec<Vec<i32>>,
}

/// Numbers of the frames kept: every so many, and the last.
fn kept(trace: &Trace) -> (usize, Vec<usize>) {
    let every = (FINEST_S / trace.period_s).ceil().clamp(1.0, 1e6) as usize;
    let last = trace.frames.len().saturating_sub(1);
    let mut kept: Vec<usize> = (0..last).step_by(every).collect();
    kept.push(last);
    (every, kept)
}

impl Tracks {
    /// Of a trace that has a frame at least.
    pub fn new(trace: &Trace) -> Self {
        let (every, kept) = kept(trace);
        let whole = |v: f64| (v * FINE).round() as i32;
        let track = |body: usize| {
            let (mut line, mut last) = (Vec::with_capacity(2 * kept.len()), [0, 0]);
            for place in kept.iter().filter_map(|f| trace.frames.get(*f)?.get(body)) {
                let spot = place.map(whole);
                line.extend([spot[0].saturating_sub(last[0]), spot[1].saturating_sub(last[1])]);
                last = spot;
            }
            line
        };
        let ms = |frames: usize| (frames as f64 * trace.period_s * 1e4).round() / 10.0;
        let last = kept.last().copied().unwrap_or(0);
        Self { step: ms(every), end: ms(last), bodies: (0..trace.bodies.len()).map(track).collect() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use strategy::TraceBody;

    #[test]
    fn tracks_end_where_the_trace_ends() {
        let body = TraceBody { side: "own".to_owned(), radius: 0.09 };
        // 60 Hz: every third frame, and the last, which is the eleventh.
        let frames: Vec<Vec<[f64; 2]>> = (0..11).map(|k| vec![[-1.0 + 0.05 * f64::from(k), 0.25]]).collect();
        let trace = Trace { period_s: 1.0 / 60.0, bodies: vec![body], frames, events: Vec::new() };
        let tracks = Tracks::new(&trace);
        assert_eq!(tracks.bodies, [vec![-1000, 250, 150, 0, 150, 0, 150, 0, 50, 0]]);
        assert_eq!((tracks.step, tracks.end), (50.0, 166.7));
    }
}
