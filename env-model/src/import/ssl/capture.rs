//! Which packets of several cameras belong to one capture.
//!
//! Every camera sends its own packets, with frame numbers of its own. A packet joins
//! the frame that is open unless its camera is in it already (a camera is once in a
//! capture) or its time of capture is too far from the frame's first (then packets
//! in between were lost): four fifths of the capture period or more. Cameras that
//! run freely spread over less than one period, three quarters of it when four are
//! evenly spaced; cameras in step differ by a fraction of a millisecond, and by a
//! whole period from the next capture. The period is the median of the last times
//! between two packets of one camera, so that a packet that comes early or is lost
//! does not change it; until a camera is seen twice, 10 ms (the league's 100 Hz).

/// Cameras have numbers below this; games have at most eight.
pub(super) const MOST_CAMERAS: usize = 64;

/// Seconds. Nearer packets of one camera are one that came twice, not two captures.
const SHORTEST_PERIOD: f64 = 0.001;

/// Intervals that make the median. A pause in the log makes a long one for every camera:
/// eight must be a minority.
const INTERVALS: usize = 31;

/// Assigns packets to frames.
pub(super) struct Captures {
    /// Frames begun.
    begun: u64,
    /// Time of the open frame's first packet.
    first: f64,
    /// Cameras in the open frame.
    seen: [bool; MOST_CAMERAS],
    /// Time of each camera's last packet.
    last: [Option<f64>; MOST_CAMERAS],
    /// The last intervals between two packets of one camera, the oldest replaced first.
    intervals: [f64; INTERVALS],
    /// How many there have been.
    measured: usize,
    period: f64,
}

impl Captures {
    pub(super) fn new() -> Self {
        Self {
            begun: 0,
            first: 0.0,
            seen: [false; MOST_CAMERAS],
            last: [None; MOST_CAMERAS],
            intervals: [0.0; INTERVALS],
            measured: 0,
            period: 0.01,
        }
    }

    /// How many frames there are so far.
    pub(super) fn count(&self) -> u64 {
        self.begun
    }

    /// The frame, counted from 0, of a packet that `camera` (< [`MOST_CAMERAS`]) captured at `time` (s).
    pub(super) fn frame_of(&mut self, camera: usize, time: f64) -> u64 {
        if let Some(last) = self.last[camera].replace(time) {
            self.measure(time - last);
        }
        let near = (time - self.first).abs() < 0.8 * self.period;
        if self.begun == 0 || self.seen[camera] || !near {
            self.begun += 1;
            self.first = time;
            self.seen = [false; MOST_CAMERAS];
        }
        self.seen[camera] = true;
        self.begun - 1
    }

    /// Takes the time between two packets of one camera.
    fn measure(&mut self, interval: f64) {
        if interval < SHORTEST_PERIOD {
            return;
        }
        self.intervals[self.measured % INTERVALS] = interval;
        self.measured += 1;
        let mut known = self.intervals;
        let known = &mut known[..self.measured.min(INTERVALS)];
        // Of an even number the shorter: while there are two, one may span a lost packet.
        let middle = (known.len() - 1) / 2;
        self.period = *known.select_nth_unstable_by(middle, f64::total_cmp).1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(packets: &[(usize, f64)]) -> Vec<u64> {
        let mut captures = Captures::new();
        packets.iter().map(|&(camera, ms)| captures.frame_of(camera, 1.7e9 + 1e-3 * ms)).collect()
    }

    #[test]
    fn one_camera_makes_a_frame_of_every_packet() {
        assert_eq!(frames(&[(3, 0.0), (3, 16.0), (3, 33.0), (3, 33.0)]), [0, 1, 2, 3]);
    }

    #[test]
    fn cameras_in_step_are_merged_and_lost_packets_do_not_shift_them() {
        let all = [(0, 0.0), (1, 0.2), (0, 16.0), (1, 16.1), (0, 33.0), (1, 33.3), (0, 49.0), (1, 49.1)];
        assert_eq!(frames(&all), [0, 0, 1, 1, 2, 2, 3, 3]);
        let without_a_first = [&all[..2], &all[3..]].concat();
        assert_eq!(frames(&without_a_first), [0, 0, 1, 2, 2, 3, 3]);
        let without_the_very_first = &all[1..];
        assert_eq!(frames(without_the_very_first), [0, 1, 1, 2, 2, 3, 3]);
        let with_one_twice = [&all[..3], &[all[2]], &all[3..]].concat();
        assert_eq!(frames(&with_one_twice), [0, 0, 1, 2, 2, 3, 3, 4, 4]);
    }

    #[test]
    fn cameras_that_run_freely_are_merged_once_a_period() {
        let phase = [0.0, 4.0, 8.0, 12.0];
        let packets: Vec<_> = (0..40).map(|i| (i % 4, 16.0 * (i / 4) as f64 + phase[i % 4])).collect();
        let frames = frames(&packets);
        let mut sizes = vec![0; 1 + *frames.last().unwrap() as usize];
        frames.iter().for_each(|f| sizes[*f as usize] += 1);
        // The first two, before the period is known, may be smaller; so is the last, where the packets end.
        assert!(sizes[2..sizes.len() - 1].iter().all(|n| *n == 4), "{sizes:?}");
    }

    /// A thousand captures of four evenly spaced cameras, 16 ms apart, with packet `odd` captured `by` ms later.
    fn sizes_with_one(odd: usize, by: f64) -> Vec<usize> {
        let ms = |i: usize| 16.0 * (i / 4) as f64 + 4.0 * (i % 4) as f64 + if i == odd { by } else { 0.0 };
        let packets: Vec<_> = (0..4000).map(|i| (i % 4, ms(i))).collect();
        let mut sizes = vec![0; 1 + *frames(&packets).last().unwrap() as usize];
        frames(&packets).iter().for_each(|f| sizes[*f as usize] += 1);
        sizes
    }

    #[test]
    fn one_packet_out_of_time_does_not_break_the_rest() {
        for by in [-12.0, -8.0, -4.0, 4.0, 8.0, 12.0, 2e3] {
            let sizes = sizes_with_one(400, by);
            let odd = sizes.iter().filter(|n| **n != 4).count();
            // The log's first and last frame, and those that the packet itself is in or is missing from.
            assert!(sizes.len() <= 1003 && odd <= 6, "{by} ms: {} frames, {odd} of other sizes", sizes.len());
        }
    }

    #[test]
    fn a_pause_of_eight_cameras_is_not_the_period() {
        let ms = |i: usize| 16.0 * (i / 8) as f64 + 2.0 * (i % 8) as f64 + if i >= 400 { 6e4 } else { 0.0 };
        let mut packets: Vec<_> = (0..800).map(|i| (i % 8, ms(i))).collect();
        packets.remove(409); // camera 1, in the second capture after the pause
        let frames = frames(&packets);
        let of = |camera: usize, ms: f64| frames[packets.iter().position(|p| *p == (camera, ms)).unwrap()];
        // Were the pause the period, camera 1 of the third capture would join the second.
        let third = 16.0 * 52.0 + 6e4;
        assert_ne!(of(1, third + 2.0), of(2, third - 16.0 + 4.0));
    }
}
