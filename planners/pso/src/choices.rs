//! The values that settings may take.

use std::fmt;

use serde::{Deserialize, Serialize};

/// How particles move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// The paper's: v ← w v + c1 r1 (pbest − x) + c2 r2 (gbest − x).
    Inertia,
    /// The same with Clerc & Kennedy's weights (2002) for φ = 4.1: w = χ = 0.7298, c1 = c2 = 1.49618.
    Constriction,
    /// Quantum-behaved particles (Sun, Feng & Xu 2004): x ← p ± α |mbest − x| ln(1/u).
    Quantum,
    /// The standard of 2011 (Zambrano-Bigiarini, Clerc & Rojas 2013): a random point in a ball round G.
    #[serde(rename = "spso-2011")]
    Spso2011,
    /// Comprehensive learning (Liang et al. 2006): an exemplar for each dimension.
    Comprehensive,
}

impl Rule {
    /// What a setting may be that this rule has none of.
    pub(crate) fn reads_no_such_key(self) -> &'static str {
        match self {
            Self::Inertia => "no value beside rule = \"inertia\", which does not read it",
            Self::Constriction => "no value beside rule = \"constriction\", which fixes it",
            Self::Quantum => "no value beside rule = \"quantum\", which does not read it",
            Self::Spso2011 => "no value beside rule = \"spso-2011\", which does not read it",
            Self::Comprehensive => "no value beside rule = \"comprehensive\", which does not read it",
        }
    }
}

/// A weight over the iterations.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(untagged, expecting = "a number or { from = …, to = … }")]
pub enum Schedule {
    /// The same throughout.
    Constant(f64),
    /// Linear in the iteration: from + (to − from)·t/(T − 1), t = 0 … T − 1.
    Linear {
        /// At the first iteration.
        from: f64,
        /// At the last.
        to: f64,
    },
}

impl Default for Schedule {
    fn default() -> Self {
        Self::Constant(0.0)
    }
}

impl Schedule {
    /// The values at the first and the last iteration.
    pub(crate) fn ends(self) -> [f64; 2] {
        match self {
            Self::Constant(w) => [w, w],
            Self::Linear { from, to } => [from, to],
        }
    }

    /// The value at iteration `t` of `iterations`, counted from 0.
    pub(crate) fn at(self, t: u64, iterations: u64) -> f64 {
        let [from, to] = self.ends();
        let last = iterations.saturating_sub(1).max(1);
        from + (to - from) * t as f64 / last as f64
    }
}

impl fmt::Display for Schedule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(w) => write!(f, "{w}"),
            Self::Linear { from, to } => write!(f, "{from} → {to}"),
        }
    }
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

impl fmt::Display for VelocityLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Fraction(fraction) => write!(f, "{fraction}"),
            Self::Word(NoLimit::None) => f.write_str("none"),
        }
    }
}

/// The word for no limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum NoLimit {
    /// No limit.
    None,
}

/// What happens to a particle at the border of the search rectangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Bounds {
    /// It flies on.
    None,
    /// Its position is clipped, its velocity kept.
    Clip,
    /// Its position is clipped, that component of its velocity zeroed.
    #[default]
    Stop,
    /// Its position is clipped, that component of its velocity reversed and
    /// halved, as in the standard of 2011.
    Rebound,
    /// It bounces: position mirrored (then clipped), that component negated.
    Reflect,
    /// It flies on, and is not evaluated while outside (Robinson & Rahmat-Samii
    /// 2004: invisible walls).
    Invisible,
}

/// How often random numbers are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum RandomNumbers {
    /// A pair for every dimension of every particle.
    #[default]
    PerDimension,
    /// A pair for every particle.
    PerParticle,
}

impl fmt::Display for RandomNumbers {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::PerDimension => "per-dimension",
            Self::PerParticle => "per-particle",
        })
    }
}

/// Whose best attracts a particle: the best among its informants and itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Topology {
    /// The whole swarm.
    #[default]
    Global,
    /// Its two neighbours on a ring.
    Ring,
    /// Its four neighbours on a grid that closes on itself: ⌈√N⌉ particles a
    /// row, row by row; the last row may be shorter (Kennedy & Mendes 2002).
    VonNeumann,
    /// Every other particle with probability 1 − (1 − 1/N)³, drawn anew after
    /// every iteration that did not improve the global best (the standards of
    /// 2006 to 2011, Clerc 2012).
    Random,
}

impl fmt::Display for Topology {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Global => "global",
            Self::Ring => "ring",
            Self::VonNeumann => "von-neumann",
            Self::Random => "random",
        })
    }
}
