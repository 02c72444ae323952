//! The paper's numbers, a setting for every gap it leaves, and the numbers of its family.

use planner_api::SettingError;
use serde::{Deserialize, Serialize};

use crate::choices::{Bounds, NoLimit, RandomNumbers, Rule, Schedule, Topology, VelocityLimit};

/// Settings of the swarm. Defaults are the paper's values and, where it is
/// silent, the reading marked so; beside another `rule`, those of its authors.
///
/// | key | `inertia` | `constriction` | `quantum` | `spso-2011` | `comprehensive` |
/// |---|---|---|---|---|---|
/// | `c1`, `c2` | 2 | fixed | – | – | – |
/// | `inertia` | 0.9 → 0.4 | fixed | – | 1/(2 ln 2) | 0.9 → 0.4 |
/// | `c` | – | – | – | 1/2 + ln 2 | 1.49445 |
/// | `alpha` | – | – | 1 → 0.5 | – | – |
/// | `refresh_gap` | – | – | – | – | 7 |
/// | `velocity_limit` | 0.5 | 0.5 | – | none | 0.4 |
/// | `bounds` | stop | stop | stop | rebound | invisible |
/// | `random_numbers` | per-dimension | per-dimension | – | – | – |
/// | `topology` | global | global | global | random | – |
///
/// A key given beside a rule that has none (–) or fixes it is an error.
///
/// `particles`·`columns` is at most 10⁷, and so is `side_classes`·`columns`. A height of a
/// particle takes at most 52 bytes (position, velocity, bests, two random numbers,
/// an exemplar), 24 more under an observer of the state; one of a side class 8, and
/// 16 in the candidates: at most 760 MB and 240 MB.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Settings {
    /// How particles move. Paper: `"inertia"`.
    pub rule: Rule,
    /// Particles M, 1 … 10 000. Paper: 20.
    pub particles: usize,
    /// Iterations T, 0 … 10⁷. Paper: 400. The initial swarm is evaluated as well.
    pub iterations: u64,
    /// Columns m, 1 … 10 000. Paper: dim = 22 with both fixed ends counted, so 20.
    pub columns: usize,
    /// Weight of the personal best, ≥ 0. Paper: 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c1: Option<f64>,
    /// Weight of the social best, ≥ 0. Paper: 2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c2: Option<f64>,
    /// Inertia w ≥ 0, linear from the first to the last iteration, or constant. Paper: 0.9 → 0.4.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub inertia: Option<Schedule>,
    /// The weight c of a rule with a single one, ≥ 0: how far beyond the bests
    /// the standard of 2011 looks (1/2 + ln 2), the pull of an exemplar in
    /// comprehensive learning (1.49445).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub c: Option<f64>,
    /// Contraction–expansion coefficient α ≥ 0 of quantum-behaved particles,
    /// linear or constant. Sun et al. 2004: 1 → 0.5.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha: Option<Schedule>,
    /// Evaluations without improvement before a particle gets new exemplars in
    /// comprehensive learning, 1 … 10⁷. Liang et al. 2006: 7.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refresh_gap: Option<u64>,
    /// Largest speed a dimension, as a fraction of H = L/4 an iteration; or `"none"`.
    /// The paper says "limited to a range" without number; default 0.5.
    /// Comprehensive learning: 0.2 of the range 2 H, so 0.4.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub velocity_limit: Option<VelocityLimit>,
    /// What happens at |y'| = H. Not in the paper; default `"stop"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bounds: Option<Bounds>,
    /// Fresh random numbers for each dimension, or one pair a particle and
    /// iteration. The paper's formula allows both; default `"per-dimension"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub random_numbers: Option<RandomNumbers>,
    /// Whose best attracts a particle. Paper: `"global"`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub topology: Option<Topology>,
    /// λ of a colliding segment, ≥ 1. Paper: 1000.
    pub penalty: f64,
    /// How many side classes (ways past the obstacles) of personal bests to
    /// hand on as candidates, best of each class, oldest dropped first;
    /// 0 … 10 000. Default 0; `pso-qp` uses it.
    pub side_classes: usize,
}

/// Heights of all particles, or of all side classes, so that a run fits into memory.
const MOST_HEIGHTS: usize = 10_000_000;

impl Default for Settings {
    fn default() -> Self {
        Self {
            rule: Rule::Inertia,
            particles: 20,
            iterations: 400,
            columns: 20,
            c1: None,
            c2: None,
            inertia: None,
            c: None,
            alpha: None,
            refresh_gap: None,
            velocity_limit: None,
            bounds: None,
            random_numbers: None,
            topology: None,
            penalty: 1000.0,
            side_classes: 0,
        }
    }
}

/// The table of [`Settings`]: every key that `rule` reads, with its default.
fn defaults(rule: Rule) -> Settings {
    let none = Settings { rule, ..Settings::default() };
    let linear = |from, to| Some(Schedule::Linear { from, to });
    let classic = Settings {
        velocity_limit: Some(VelocityLimit::Fraction(0.5)),
        bounds: Some(Bounds::Stop),
        random_numbers: Some(RandomNumbers::PerDimension),
        topology: Some(Topology::Global),
        ..none.clone()
    };
    match rule {
        Rule::Inertia => Settings { c1: Some(2.0), c2: Some(2.0), inertia: linear(0.9, 0.4), ..classic },
        Rule::Constriction => classic,
        Rule::Quantum => {
            Settings { alpha: linear(1.0, 0.5), bounds: Some(Bounds::Stop), topology: Some(Topology::Global), ..none }
        }
        Rule::Spso2011 => Settings {
            inertia: Some(Schedule::Constant(0.5 / std::f64::consts::LN_2)),
            c: Some(0.5 + std::f64::consts::LN_2),
            velocity_limit: Some(VelocityLimit::Word(NoLimit::None)),
            bounds: Some(Bounds::Rebound),
            topology: Some(Topology::Random),
            ..none
        },
        Rule::Comprehensive => Settings {
            inertia: linear(0.9, 0.4),
            c: Some(1.49445),
            refresh_gap: Some(7),
            velocity_limit: Some(VelocityLimit::Fraction(0.4)),
            bounds: Some(Bounds::Invisible),
            ..none
        },
    }
}

impl Settings {
    /// Checks every range, and that the rule reads every key given.
    ///
    /// # Errors
    /// [`SettingError`] with the setting, its value and what it may be.
    pub fn validate(&self) -> Result<(), SettingError> {
        const WEIGHT: &str = "a finite number of at least 0";
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
        SettingError::check(
            self.particles.saturating_mul(self.columns) <= MOST_HEIGHTS,
            "particles",
            format_args!("{} beside columns = {}", self.particles, self.columns),
            "particles·columns of at most 10000000",
        )?;
        SettingError::check(
            self.side_classes.saturating_mul(self.columns) <= MOST_HEIGHTS,
            "side_classes",
            format_args!("{} beside columns = {}", self.side_classes, self.columns),
            "side_classes·columns of at most 10000000",
        )?;
        let read = defaults(self.rule);
        self.check("c1", self.c1, read.c1, weight, WEIGHT)?;
        self.check("c2", self.c2, read.c2, weight, WEIGHT)?;
        self.check("c", self.c, read.c, weight, WEIGHT)?;
        self.check("inertia", self.inertia, read.inertia, |s| s.ends().into_iter().all(weight), WEIGHT)?;
        self.check("alpha", self.alpha, read.alpha, |s| s.ends().into_iter().all(weight), WEIGHT)?;
        let gap = |gap| (1..=10_000_000).contains(&gap);
        self.check("refresh_gap", self.refresh_gap, read.refresh_gap, gap, "1 to 10000000")?;
        let speed = |limit| match limit {
            VelocityLimit::Fraction(f) => f.is_finite() && f > 0.0,
            VelocityLimit::Word(NoLimit::None) => true,
        };
        let fraction = "a fraction of H above 0, or \"none\"";
        self.check("velocity_limit", self.velocity_limit, read.velocity_limit, speed, fraction)?;
        self.check("random_numbers", self.random_numbers, read.random_numbers, |_| true, "")?;
        self.check("topology", self.topology, read.topology, |_| true, "")
    }

    /// A key's value, if given, must be `ok`, and one that the rule reads: one with a default.
    fn check<T: Copy + std::fmt::Display>(
        &self,
        key: &'static str,
        given: Option<T>,
        default: Option<T>,
        ok: impl Fn(T) -> bool,
        expected: &'static str,
    ) -> Result<(), SettingError> {
        let Some(value) = given else { return Ok(()) };
        SettingError::check(ok(value), key, value, expected)?;
        SettingError::check(default.is_some(), key, value, self.rule.reads_no_such_key())
    }

    /// The settings with every default that the rule reads written out.
    #[must_use]
    pub fn filled(self) -> Self {
        let read = defaults(self.rule);
        Self {
            c1: self.c1.or(read.c1),
            c2: self.c2.or(read.c2),
            inertia: self.inertia.or(read.inertia),
            c: self.c.or(read.c),
            alpha: self.alpha.or(read.alpha),
            refresh_gap: self.refresh_gap.or(read.refresh_gap),
            velocity_limit: self.velocity_limit.or(read.velocity_limit),
            bounds: self.bounds.or(read.bounds),
            random_numbers: self.random_numbers.or(read.random_numbers),
            topology: self.topology.or(read.topology),
            ..self
        }
    }

    /// The largest speed for half width H; +∞ without limit. Of filled settings.
    pub fn max_speed(&self, half_width: f64) -> f64 {
        match self.velocity_limit {
            Some(VelocityLimit::Fraction(f)) => f * half_width,
            Some(VelocityLimit::Word(NoLimit::None)) | None => f64::INFINITY,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(settings: &Settings) -> String {
        settings.validate().map_or_else(|error| error.to_string(), |()| "fine".into())
    }

    const RULES: [Rule; 5] = [Rule::Inertia, Rule::Constriction, Rule::Quantum, Rule::Spso2011, Rule::Comprehensive];

    #[test]
    fn filled_settings_are_valid_and_stay_as_they_are() {
        for rule in RULES {
            let filled = Settings { rule, ..Settings::default() }.filled();
            assert_eq!(message(&filled), "fine");
            assert_eq!(filled.clone().filled(), filled);
        }
    }

    #[test]
    fn keys_that_the_rule_does_not_read_are_errors() {
        let none = Settings::default();
        let schedule = Some(Schedule::Constant(0.5));
        let given = [
            ("c1", Settings { c1: Some(2.0), ..none.clone() }),
            ("c2", Settings { c2: Some(2.0), ..none.clone() }),
            ("c", Settings { c: Some(2.0), ..none.clone() }),
            ("inertia", Settings { inertia: schedule, ..none.clone() }),
            ("alpha", Settings { alpha: schedule, ..none.clone() }),
            ("refresh_gap", Settings { refresh_gap: Some(3), ..none.clone() }),
            ("velocity_limit", Settings { velocity_limit: Some(VelocityLimit::Fraction(1.0)), ..none.clone() }),
            ("random_numbers", Settings { random_numbers: Some(RandomNumbers::PerParticle), ..none.clone() }),
            ("topology", Settings { topology: Some(Topology::VonNeumann), ..none.clone() }),
        ];
        // Whether inertia, constriction, quantum, spso-2011, comprehensive read the key.
        let reads = [
            [true, false, false, false, false],
            [true, false, false, false, false],
            [false, false, false, true, true],
            [true, false, false, true, true],
            [false, false, true, false, false],
            [false, false, false, false, true],
            [true, true, false, true, true],
            [true, true, false, false, false],
            [true, true, true, true, false],
        ];
        for ((key, settings), reads) in given.into_iter().zip(reads) {
            for (rule, reads) in RULES.into_iter().zip(reads) {
                let message = message(&Settings { rule, ..settings.clone() });
                assert_eq!(message == "fine", reads, "{key} beside {rule:?}: {message}");
                assert!(reads || message.starts_with(&format!("{key} = ")), "{message}");
            }
        }
    }

    #[test]
    fn values_out_of_range_are_errors_by_name() {
        let of = |rule| Settings { rule, ..Settings::default() };
        for (settings, expected) in [
            (Settings { c1: Some(-1.0), ..of(Rule::Inertia) }, "c1 = -1; expected a finite number of at least 0"),
            (Settings { c2: Some(f64::NAN), ..of(Rule::Inertia) }, "c2 = NaN; expected a finite number of at least 0"),
            (
                Settings { inertia: Some(Schedule::Linear { from: 0.9, to: -0.1 }), ..of(Rule::Inertia) },
                "inertia = 0.9 → -0.1; expected a finite number of at least 0",
            ),
            (
                Settings { alpha: Some(Schedule::Constant(f64::INFINITY)), ..of(Rule::Quantum) },
                "alpha = inf; expected a finite number of at least 0",
            ),
            (Settings { c: Some(-1.0), ..of(Rule::Spso2011) }, "c = -1; expected a finite number of at least 0"),
            (Settings { refresh_gap: Some(0), ..of(Rule::Comprehensive) }, "refresh_gap = 0; expected 1 to 10000000"),
            (
                Settings { velocity_limit: Some(VelocityLimit::Fraction(0.0)), ..of(Rule::Inertia) },
                "velocity_limit = 0; expected a fraction of H above 0, or \"none\"",
            ),
            (
                Settings { topology: Some(Topology::Ring), ..of(Rule::Comprehensive) },
                "topology = ring; expected no value beside rule = \"comprehensive\", which does not read it",
            ),
            (
                Settings { c1: Some(2.0), ..of(Rule::Constriction) },
                "c1 = 2; expected no value beside rule = \"constriction\", which fixes it",
            ),
            (Settings { penalty: 0.5, ..Settings::default() }, "penalty = 0.5; expected a finite number of at least 1"),
        ] {
            assert_eq!(message(&settings), expected);
        }
    }

    #[test]
    fn more_heights_than_fit_into_memory_are_an_error() {
        let of = |particles, columns, side_classes| {
            message(&Settings { particles, columns, side_classes, ..Settings::default() })
        };
        assert_eq!(of(10_000, 1000, 10_000), "fine");
        assert_eq!(
            of(10_000, 10_000, 0),
            "particles = 10000 beside columns = 10000; expected particles·columns of at most 10000000"
        );
        assert_eq!(
            of(20, 10_000, 1001),
            "side_classes = 1001 beside columns = 10000; expected side_classes·columns of at most 10000000"
        );
    }
}
