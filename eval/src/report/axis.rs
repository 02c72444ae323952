//! Axes: linear and logarithmic scales with round ticks.

/// A map from values to a coordinate of the picture.
#[derive(Debug, Clone, Copy)]
pub struct Axis {
    lo: f64,
    hi: f64,
    log: bool,
    from: f64,
    to: f64,
}

impl Axis {
    /// Maps [lo, hi] linearly to [from, to]. An empty range is widened; one without finite ends is [0, 1].
    pub fn linear(lo: f64, hi: f64, from: f64, to: f64) -> Self {
        let (lo, hi) = if lo.is_finite() && hi.is_finite() && lo <= hi { (lo, hi) } else { (0.0, 1.0) };
        let pad = if hi > lo { 0.0 } else { 0.5 * lo.abs().max(1.0) };
        Self { lo: (lo - pad).max(f64::MIN), hi: (hi + pad).min(f64::MAX), log: false, from, to }
    }

    /// Maps [lo, hi], 0 < lo, logarithmically to [from, to]. Less than half a decade is widened.
    pub fn log(lo: f64, hi: f64, from: f64, to: f64) -> Self {
        let pad = if hi > 3.0 * lo { 1.0 } else { 2.0 };
        // Within these bounds the ratio of any two values is finite; what lies beyond is drawn on the edge.
        let lo = (lo / pad).clamp(1e-150, 1e149);
        Self { lo, hi: (hi * pad).clamp(3.0 * lo, 1e150), log: true, from, to }
    }

    /// Maps [lo, hi], 0 < lo < hi, logarithmically to [from, to], as they are.
    pub fn log_exact(lo: f64, hi: f64, from: f64, to: f64) -> Self {
        Self { lo, hi, log: true, from, to }
    }

    /// A logarithmic axis when `values` span more than `ratio`, else a linear one; `None` without finite values.
    ///
    /// Values from 0 to `floor` are as good as 0: a logarithmic axis draws them on
    /// its edge, which then lies well below the least of the others.
    pub fn fitting(values: impl Iterator<Item = f64>, ratio: f64, floor: f64, from: f64, to: f64) -> Option<Self> {
        let (mut lo, mut hi, mut positive) = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY);
        for v in values.filter(|v| v.is_finite()) {
            lo = lo.min(v);
            hi = hi.max(v);
            if v >= floor {
                positive = positive.min(v);
            }
        }
        if lo > hi {
            return None;
        }
        if lo >= 0.0 && positive.is_finite() && (hi > ratio * positive || lo < floor && hi > ratio * floor) {
            let edge = if lo < floor { positive / 5.0 } else { positive };
            return Some(Self::log(edge, hi, from, to));
        }
        let pad = 0.04 * (hi - lo);
        Some(Self::linear(if lo >= 0.0 { (lo - pad).max(0.0) } else { lo - pad }, hi + pad, from, to))
    }

    /// Whether it is logarithmic.
    pub fn is_log(&self) -> bool {
        self.log
    }

    /// The coordinate of `value`; what lies outside is drawn on the edge.
    pub fn at(&self, value: f64) -> f64 {
        let v = value.clamp(self.lo, self.hi);
        let share = if self.log {
            (v / self.lo).ln() / (self.hi / self.lo).ln()
        } else {
            // Halves, since hi − lo may overflow.
            (0.5 * v - 0.5 * self.lo) / (0.5 * self.hi - 0.5 * self.lo)
        };
        // 0/0 where even the halves of the ends are equal.
        let share = if share.is_nan() { 0.5 } else { share };
        self.from + share * (self.to - self.from)
    }

    /// The value at share 0 ≤ s ≤ 1 of the axis.
    pub fn value_at(&self, s: f64) -> f64 {
        if self.log { self.lo * (self.hi / self.lo).powf(s) } else { self.lo * (1.0 - s) + self.hi * s }
    }

    /// About `wanted` round values inside the range.
    pub fn ticks(&self, wanted: usize) -> Vec<f64> {
        let wanted = wanted.max(1) as f64;
        let slack = 1e-9;
        if self.log {
            let decades = (self.hi / self.lo).log10();
            let exponents = || (self.lo.log10() - slack).ceil() as i32..=(self.hi.log10() + slack).floor() as i32;
            if decades >= 2.0 {
                let step = (decades / wanted).ceil().max(1.0) as i32;
                return exponents().filter(|e| e.rem_euclid(step) == 0).map(|e| 10f64.powi(e)).collect();
            }
            let inside = |v: &f64| *v >= self.lo * (1.0 - slack) && *v <= self.hi * (1.0 + slack);
            let first = self.lo.log10().floor() as i32;
            let last = self.hi.log10().ceil() as i32;
            return (first..=last).flat_map(|e| [1.0, 2.0, 5.0].map(|m| m * 10f64.powi(e))).filter(inside).collect();
        }
        let span = self.hi - self.lo;
        let raw = if span.is_finite() { span / wanted } else { self.hi / wanted - self.lo / wanted };
        let magnitude = 10f64.powf(raw.log10().floor());
        let step = [1.0, 2.0, 5.0, 10.0].map(|m| m * magnitude).into_iter().find(|s| *s >= raw).unwrap_or(raw);
        let (first, last) = ((self.lo / step - slack).ceil(), (self.hi / step + slack).floor());
        // Where steps underflow or overflow, or are lost beside the values, there are no round values to show.
        if !step.is_finite() || !(0.0..=10.0 * wanted).contains(&(last - first)) {
            return Vec::new();
        }
        (0..=(last - first) as u32).map(|k| (first + f64::from(k)) * step).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn linear_ticks_are_round() {
        let ticks = Axis::linear(0.0, 8020.0, 0.0, 1.0).ticks(5);
        assert_eq!(ticks, [0.0, 2000.0, 4000.0, 6000.0, 8000.0]);
    }

    #[test]
    fn log_ticks_are_decades_or_1_2_5() {
        assert_eq!(Axis::log(1.0, 1e4, 0.0, 1.0).ticks(5).len(), 5);
        assert_eq!(Axis::log(1e-7, 1e5, 0.0, 1.0).ticks(6).len(), 6, "every second decade");
        assert_eq!(Axis::log(1.5, 30.0, 0.0, 1.0).ticks(5), [2.0, 5.0, 10.0, 20.0]);
    }

    #[test]
    fn absurd_ranges_have_few_ticks_and_finite_places() {
        let tiny = f64::from_bits(1);
        let ends = [-f64::MAX, -1e300, -1.0, 0.0, tiny, 1e-320, 1e-300, 1.0, 1.0 + f64::EPSILON, 1e16, 1e300, f64::MAX];
        for lo in ends {
            for hi in ends.into_iter().chain([f64::NAN, f64::INFINITY]) {
                let fitting = Axis::fitting([lo, hi].into_iter(), 20.0, 1e-8, 0.0, 100.0);
                for axis in [Some(Axis::linear(lo, hi, 0.0, 100.0)), fitting].into_iter().flatten() {
                    for wanted in [0, 5, 8] {
                        let ticks = axis.ticks(wanted);
                        // The log axes with 1, 2 and 5 a decade span less than two decades.
                        assert!(ticks.len() <= 10 * wanted.max(1) + 1, "{axis:?}: {}", ticks.len());
                        assert!(ticks.iter().all(|v| v.is_finite()), "{axis:?}: {ticks:?}");
                    }
                    for v in [lo, hi, 0.5] {
                        assert!(v.is_nan() || (0.0..=100.0).contains(&axis.at(v)), "{axis:?} {v}");
                    }
                }
            }
        }
    }

    #[test]
    fn range_decides_the_kind() {
        let fit = |v: &[f64]| Axis::fitting(v.iter().copied(), 50.0, 1e-8, 0.0, 100.0);
        assert!(fit(&[1e-6, 0.05]).is_some_and(|a| a.is_log()));
        assert!(fit(&[230.0, 260.0]).is_some_and(|a| !a.is_log()));
        assert!(fit(&[0.0, 0.0]).is_some_and(|a| !a.is_log()), "one value");
        assert!(fit(&[f64::INFINITY]).is_none(), "failures alone");
        let axis = fit(&[0.0, 1e-6, 0.05]).unwrap();
        assert_eq!(axis.at(0.0), 0.0, "zero is drawn on the edge of a logarithmic axis");
        assert!(axis.at(1e-6) > 5.0, "apart from the least value");
    }
}
