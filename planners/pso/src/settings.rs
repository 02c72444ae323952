//! The paper's numbers, and a setting for every gap it leaves.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

/// Settings of the swarm. Defaults are the paper's values and, where it is
/// silent, the reading marked so.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// Particles M, 1 … 10 000. Paper: 20.
    pub particles: usize,
    /// Iterations T, 0 … 10⁷. Paper: 400. The initial swarm is evaluated as well.
    pub iterations: u64,
    /// Columns m, 1 … 10 000. Paper: dim = 22 with both fixed ends counted, so 20.
    pub columns: usize,
    /// Weight of the personal best, ≥ 0. Paper: 2. Fixed by `constriction`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c1: Option<f64>,
    /// Weight of the social best, ≥ 0. Paper: 2. Fixed by `constriction`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c2: Option<f64>,
    /// Inertia w, linear from the first to the last iteration. Paper: 0.9 → 0.4.
    /// A single number is a constant inertia. Fixed by `constriction`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Inertia>,
    /// Clerc & Kennedy (2002) with φ = 4.1 instead of inertia: w = χ = 0.7298,
    /// c1 = c2 = 1.49618. Default false.
    pub constriction: bool,
    /// Largest speed a dimension, as a fraction of H = L/4 an iteration; or `"none"`.
    /// The paper says "limited to a range" without number; default 0.5.
    pub velocity_limit: VelocityLimit,
    /// What happens at |y'| = H. Not in the paper; default `"stop"`.
    pub bounds: Bounds,
    /// Fresh random numbers for each dimension, or one pair a particle and
    /// iteration. The paper's formula allows both; default `"per-dimension"`.
    pub random_numbers: RandomNumbers,
    /// Whose best attracts a particle. Paper: `"global"`.
    pub topology: Topology,
    /// λ of a colliding segment, ≥ 1. Paper: 1000.
    pub penalty: f64,
    /// How many side classes (ways past the obstacles) of personal bests to
    /// hand on as candidates, best of each class, oldest dropped first;
    /// 0 … 10 000. Default 0; `pso-qp` uses it.
    pub side_classes: usize,
}

/// Inertia weight over the iterations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number or { from = …, to = … }")]
pub enum Inertia {
    /// The same throughout.
    Constant(f64),
    /// Linear in the iteration: w = from + (to − from)·t/(T − 1), t = 0 … T − 1.
    Linear {
        /// At the first iteration.
        from: f64,
        /// At the last.
        to: f64,
    },
}

/// Largest speed a dimension.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a fraction of H or \"none\"")]
pub enum VelocityLimit {
    /// A fraction of H an iteration.
    Fraction(f64),
    /// A word: only `"none"`.
    Word(NoLimit),
}

/// The word for no limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoLimit {
    /// No limit.
    None,
}

/// What happens to a particle at the border of the search rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bounds {
    /// It flies on.
    None,
    /// Its position is clipped, its velocity kept.
    Clip,
    /// Its position is clipped, that component of its velocity zeroed.
    Stop,
    /// It bounces: position mirrored (then clipped), that component negated.
    Reflect,
}

/// How often random numbers are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RandomNumbers {
    /// A pair for every dimension of every particle.
    PerDimension,
    /// A pair for every particle.
    PerParticle,
}

/// Whose best attracts a particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Topology {
    /// The best of the whole swarm.
    Global,
    /// The best among itself and its two neighbours on a ring.
    Ring,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            particles: 20,
            iterations: 400,
            columns: 20,
            c1: None,
            c2: None,
            inertia: None,
            constriction: false,
            velocity_limit: VelocityLimit::Fraction(0.5),
            bounds: Bounds::Stop,
            random_numbers: RandomNumbers::PerDimension,
            topology: Topology::Global,
            penalty: 1000.0,
            side_classes: 0,
        }
    }
}

impl Settings {
    /// Checks every range.
    ///
    /// # Errors
    /// [`SettingError`] with the setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        let positive = |v: f64| v.is_finite() && v > 0.0;
        let weight = |v: f64| v.is_finite() && v >= 0.0;
        SettingError::check((1..=10_000).contains(&self.particles), "particles", self.particles, "1 to 10000")?;
        SettingError::check(self.iterations <= 10_000_000, "iterations", self.iterations, "0 to 10000000")?;
        SettingError::check((1..=10_000).contains(&self.columns), "columns", self.columns, "1 to 10000")?;
        SettingError::check(
            self.penalty.is_finite() && self.penalty >= 1.0,
            "penalty",
            self.penalty,
            "a finite number of at least 1",
        )?;
        SettingError::check(self.side_classes <= 10_000, "side_classes", self.side_classes, "0 to 10000")?;
        if let VelocityLimit::Fraction(f) = self.velocity_limit {
            SettingError::check(positive(f), "velocity_limit", f, "a fraction of H above 0, or \"none\"")?;
        }
        for (key, value) in [("c1", self.c1), ("c2", self.c2)] {
            if let Some(c) = value {
                SettingError::check(weight(c), key, c, "a finite number of at least 0")?;
                SettingError::check(!self.constriction, key, c, "no value beside constriction = true, which fixes it")?;
            }
        }
        if let Some(inertia) = self.inertia {
            let (from, to) = inertia.ends();
            SettingError::check(
                weight(from) && weight(to),
                "inertia",
                format!("{from} → {to}"),
                "finite numbers of at least 0",
            )?;
            SettingError::check(
                !self.constriction,
                "inertia",
                from,
                "no value beside constriction = true, which fixes it",
            )?;
        }
        Ok(())
    }

    /// The settings with the defaults of c1, c2 and inertia written out.
    #[must_use]
    pub fn filled(mut self) -> Self {
        if !self.constriction {
            self.c1 = self.c1.or(Some(2.0));
            self.c2 = self.c2.or(Some(2.0));
            self.inertia = self.inertia.or(Some(Inertia::Linear { from: 0.9, to: 0.4 }));
        }
        self
    }

    /// (c1, c2) in force.
    pub fn weights(&self) -> (f64, f64) {
        if self.constriction { (1.49618, 1.49618) } else { (self.c1.unwrap_or(2.0), self.c2.unwrap_or(2.0)) }
    }

    /// The inertia of iteration `t`, counted from 0.
    pub fn inertia_at(&self, t: u64) -> f64 {
        if self.constriction {
            return 0.7298;
        }
        let (from, to) = self.inertia.map_or((0.9, 0.4), Inertia::ends);
        let last = self.iterations.saturating_sub(1).max(1);
        from + (to - from) * t as f64 / last as f64
    }

    /// The largest speed for half width H; +∞ without limit.
    pub fn max_speed(&self, half_width: f64) -> f64 {
        match self.velocity_limit {
            VelocityLimit::Fraction(f) => f * half_width,
            VelocityLimit::Word(NoLimit::None) => f64::INFINITY,
        }
    }
}

impl Inertia {
    fn ends(self) -> (f64, f64) {
        match self {
            Self::Constant(w) => (w, w),
            Self::Linear { from, to } => (from, to),
        }
    }
}
