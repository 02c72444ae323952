//! What can be chosen.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of [`RrtConnect`](crate::RrtConnect).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct ConnectSettings {
    /// Samples after which it gives up, 1 … 10⁷. Default 10 000.
    pub samples: u64,
    /// Longest step ε of EXTEND, as a fraction of the diagonal of the sampled box,
    /// 0.001 … 1. Default 0.2, OMPL's fraction (the paper leaves ε to the problem).
    pub range: f64,
}

impl Default for ConnectSettings {
    fn default() -> Self {
        Self { samples: 10_000, range: 0.2 }
    }
}

impl ConnectSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_samples(self.samples)?;
        check_range(self.range)
    }
}

/// Settings of [`RrtStar`](crate::RrtStar), plain and informed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct StarSettings {
    /// Samples N, 1 … 10⁷. Default 4000: within 1 % of the optimum in the median on a
    /// pitch with 21 obstacles (the papers run as long as there is time).
    pub samples: u64,
    /// Longest step η of Steer and largest radius of Near, as a fraction of the
    /// diagonal of the sampled box, 0.001 … 1. Default 0.2, OMPL's fraction (the
    /// papers leave η to the problem).
    pub range: f64,
    /// Probability that a sample is the goal, until a path is found; above 0 and
    /// below 1, because only a sample of the goal joins it to the tree. Default
    /// 0.05, the usual choice (the papers sample a goal region instead).
    pub goal_bias: f64,
    /// Factor f on the least radius that keeps RRT* asymptotically optimal,
    /// 1 … 10: r = min(η, f·√(3 μ ln n / (π n))) for n nodes in area μ (Karaman &
    /// Frazzoli 2011, Theorem 38 with d = 2, which asks for f > 1). Default 1.1, OMPL's factor.
    pub rewire_factor: f64,
}

impl Default for StarSettings {
    fn default() -> Self {
        Self { samples: 4000, range: 0.2, goal_bias: 0.05, rewire_factor: 1.1 }
    }
}

impl StarSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// The setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_samples(self.samples)?;
        check_range(self.range)?;
        let (bias, factor) = (self.goal_bias, self.rewire_factor);
        SettingError::check(bias > 0.0 && bias < 1.0, "goal_bias", bias, "above 0 and below 1")?;
        SettingError::check((1.0..=10.0).contains(&factor), "rewire_factor", factor, "1 to 10")
    }
}

fn check_samples(samples: u64) -> Result<(), SettingError> {
    SettingError::check((1..=10_000_000).contains(&samples), "samples", samples, "1 to 10000000")
}

fn check_range(range: f64) -> Result<(), SettingError> {
    SettingError::check((0.001..=1.0).contains(&range), "range", range, "0.001 to 1")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn settings_out_of_range_are_errors_by_name() {
        let connect = ConnectSettings::default();
        let star = StarSettings::default();
        assert_eq!((connect.validate(), star.validate()), (Ok(()), Ok(())));
        for samples in [0, 10_000_001] {
            assert_eq!(ConnectSettings { samples, ..connect }.validate().unwrap_err().key, "samples");
            assert_eq!(StarSettings { samples, ..star.clone() }.validate().unwrap_err().key, "samples");
        }
        for range in [0.0, -0.1, 1.5, f64::NAN] {
            assert_eq!(ConnectSettings { range, ..connect }.validate().unwrap_err().key, "range");
            assert_eq!(StarSettings { range, ..star.clone() }.validate().unwrap_err().key, "range");
        }
        for goal_bias in [0.0, -0.1, 1.0, 1.1, f64::NAN] {
            assert_eq!(StarSettings { goal_bias, ..star.clone() }.validate().unwrap_err().key, "goal_bias");
        }
        for rewire_factor in [0.9, 11.0, f64::INFINITY, f64::NAN] {
            assert_eq!(StarSettings { rewire_factor, ..star.clone() }.validate().unwrap_err().key, "rewire_factor");
        }
    }
}
