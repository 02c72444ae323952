//! Small words beside marks, where they hide neither each other nor what they belong to.

/// Width of a character of a label and its height in picture units, as large as they get on small screens.
const CHARACTER: [f64; 2] = [9.5, 17.0];

/// The room that is taken.
#[derive(Debug, Default)]
pub struct Labels {
    bounds: [f64; 4],
    taken: Vec<[f64; 4]>,
}

/// Whether two boxes, each left, top, right and bottom, share room.
fn overlap(a: &[f64; 4], b: &[f64; 4]) -> bool {
    a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3]
}

impl Labels {
    /// Labels are within `bounds`: left, top, right, bottom.
    pub fn new(bounds: [f64; 4]) -> Self {
        Self { bounds, taken: Vec::new() }
    }

    /// Keeps labels off the square round a mark.
    pub fn avoid(&mut self, (x, y): (f64, f64), radius: f64) {
        self.taken.push([x - radius, y - radius, x + radius, y + radius]);
    }

    /// Where the base line of a label of so many characters begins, beside a mark of that radius: on the right, on the
    /// left, above or below; `None` where there is no room.
    pub fn place(&mut self, (x, y): (f64, f64), radius: f64, characters: usize) -> Option<(f64, f64)> {
        let (w, h) = (CHARACTER[0] * characters as f64, CHARACTER[1]);
        let away = radius + 3.0;
        let corner = 0.7 * radius + 1.0;
        let fits = |&(left, top): &(f64, f64)| {
            let room = [left, top, left + w, top + h];
            let inside = left >= self.bounds[0]
                && top >= self.bounds[1]
                && room[2] <= self.bounds[2]
                && room[3] <= self.bounds[3];
            inside && !self.taken.iter().any(|other| overlap(&room, other))
        };
        let places = [
            (x + away, y - 0.5 * h),
            (x - away - w, y - 0.5 * h),
            (x - 0.5 * w, y - away - h),
            (x - 0.5 * w, y + away),
            (x + corner, y - corner - h),
            (x - corner - w, y - corner - h),
            (x + corner, y + corner),
            (x - corner - w, y + corner),
        ];
        let (left, top) = places.into_iter().find(fits)?;
        self.taken.push([left, top, left + w, top + h]);
        Some((left, top + 0.78 * h))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_hide_nothing() {
        let mut labels = Labels::new([0.0, 0.0, 200.0, 200.0]);
        labels.avoid((100.0, 100.0), 6.0);
        let first = labels.place((100.0, 100.0), 6.0, 3).unwrap();
        assert!(first.0 > 106.0, "on the right");
        let second = labels.place((100.0, 100.0), 6.0, 3).unwrap();
        assert!(second.0 + 3.0 * CHARACTER[0] < 94.0, "on the left, since the right is taken");
        let mut crowded = Labels::new([0.0, 0.0, 30.0, 10.0]);
        assert_eq!(crowded.place((15.0, 5.0), 3.0, 3), None, "no room");
    }
}
