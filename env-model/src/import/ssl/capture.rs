//! Which packets of several cameras belong to one capture.
//!
//! Every camera sends its own packets, with frame numbers of its own. A packet joins
//! the frame that is open unless its camera is in it already (a camera is once in a
//! capture) or its time of capture is too far from the frame's first (then packets
//! in between were lost): four fifths of the capture period or more. Cameras that
//! run freely spread over less than one period, three quarters of it when four are
//! evenly spaced; cameras in step differ by a fraction of a millisecond, and by a
//! whole period from the next capture. The period is the shortest time yet between
//! two packets of one camera; until a camera is seen twice, 10 ms (the league's
//! 100 Hz).

/// Cameras have numbers below this; games have at most eight.
pub(super) const MOST_CAMERAS: usize = 64;

/// Seconds. Nearer packets of one camera are one that came twice, not two captures.
const SHORTEST_PERIOD: f64 = 0.001;

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
    period: Option<f64>,
}

impl Captures {
    pub(super) fn new() -> Self {
        Self { begun: 0, first: 0.0, seen: [false; MOST_CAMERAS], last: [None; MOST_CAMERAS], period: None }
    }

    /// How many frames there are so far.
    pub(super) fn count(&self) -> u64 {
        self.begun
    }

    /// The frame, counted from 0, of a packet that `camera` (< [`MOST_CAMERAS`]) captured at `time` (s).
    pub(super) fn frame_of(&mut self, camera: usize, time: f64) -> u64 {
        if let Some(last) = self.last[camera].replace(time) {
            let since = time - last;
            if since >= SHORTEST_PERIOD && self.period.is_none_or(|period| since < period) {
                self.period = Some(since);
            }
        }
        let near = (time - self.first).abs() < 0.8 * self.period.unwrap_or(0.01);
        if self.begun == 0 || self.seen[camera] || !near {
            self.begun += 1;
            self.first = time;
            self.seen = [false; MOST_CAMERAS];
        }
        self.seen[camera] = true;
        self.begun - 1
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
}
