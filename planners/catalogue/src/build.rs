//! From TOML to a planner, errors with their place.

use std::ops::Range;

use planner_api::{Planner, Refiner, SettingError};
use planner_qp::Qp;
use serde::de::{DeserializeOwned, IntoDeserializer};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table};

use crate::kinds::table;
use crate::{Refined, kinds};

/// A planner ready for use, and every setting in force (reserved keys apart from `refine` left out).
pub struct Built {
    /// The planner.
    pub planner: Box<dyn Planner>,
    /// Its settings, defaults written out: building from them gives the same planner.
    pub settings: Table,
}

/// Why a planner could not be built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum BuildError {
    /// No planner of that name.
    #[error("unknown planner \"{kind}\"; expected one of {}", known.join(", "))]
    UnknownKind {
        /// What was asked for.
        kind: String,
        /// What there is.
        known: Vec<&'static str>,
    },
    /// An unknown key or a wrong type.
    #[error("{message}")]
    At {
        /// Bytes of the document that the settings came from.
        span: Range<usize>,
        /// What is wrong and what was expected.
        message: String,
    },
    /// A value out of range.
    #[error("{error}")]
    Setting {
        /// Tables between the planner's own and the setting, outermost first.
        within: Vec<String>,
        /// The setting, its value and what it may be.
        error: SettingError,
    },
}

impl From<SettingError> for BuildError {
    fn from(error: SettingError) -> Self {
        Self::Setting { within: Vec::new(), error }
    }
}

impl BuildError {
    /// The same error, one table further in.
    pub(crate) fn within(mut self, key: &str) -> Self {
        if let Self::Setting { within, .. } = &mut self {
            within.insert(0, key.to_owned());
        }
        self
    }
}

/// Builds the planner `kind` from its TOML table. Of the reserved keys only
/// `refine` may be present: a list of refiners, `"qp"` or `{ kind = "qp", … }`.
///
/// # Errors
/// [`BuildError`]; spans refer to the document that `settings` was parsed from.
pub fn build(kind: &str, settings: Spanned<DeTable<'_>>) -> Result<Built, BuildError> {
    let entry = kinds().iter().find(|k| k.name == kind).ok_or_else(|| BuildError::UnknownKind {
        kind: kind.to_owned(),
        known: kinds().iter().map(|k| k.name).collect(),
    })?;
    let mut settings = Settings::new(settings);
    let refine = settings.take("refine");
    let (mut planner, mut settings) = (entry.make)(settings)?;
    if let Some(refine) = refine {
        let (refiners, resolved) = refiners(refine)?;
        if !refiners.is_empty() {
            planner = Box::new(Refined::new(planner, refiners));
        }
        settings.insert("refine".into(), resolved.into());
    }
    Ok(Built { planner, settings })
}

/// Builds the planner `kind` from TOML text such as `"particles = 30"`.
///
/// # Errors
/// [`BuildError`]; spans refer to `settings`.
pub fn build_str(kind: &str, settings: &str) -> Result<Built, BuildError> {
    build(kind, parse(settings)?)
}

/// Settings as TOML text.
pub(crate) fn parse(settings: &str) -> Result<Spanned<DeTable<'_>>, BuildError> {
    DeTable::parse(settings).map_err(|e| error(e.span().unwrap_or(0..0), e.message()))
}

/// The refiners of a `refine` list and their settings in full.
#[allow(clippy::type_complexity, reason = "used once, next to its definition")]
fn refiners(refine: Spanned<DeValue<'_>>) -> Result<(Vec<Box<dyn Refiner>>, Vec<toml::Value>), BuildError> {
    const EXPECTED: &str = "expected a list of refiners, each \"qp\" or { kind = \"qp\", … }";
    let span = refine.span();
    let DeValue::Array(items) = refine.into_inner() else { return Err(error(span, EXPECTED)) };
    let (mut refiners, mut resolved): (Vec<Box<dyn Refiner>>, Vec<toml::Value>) = (Vec::new(), Vec::new());
    for item in items {
        let span = item.span();
        let (kind, settings) = match item.into_inner() {
            DeValue::String(kind) => {
                (kind.into_owned(), Settings { table: Spanned::new(span.clone(), DeTable::new()) })
            }
            DeValue::Table(table) => {
                let mut settings = Settings { table: Spanned::new(span.clone(), table) };
                let kind = settings.take("kind").map(Spanned::into_inner);
                let Some(DeValue::String(kind)) = kind else { return Err(error(span, EXPECTED)) };
                (kind.into_owned(), settings)
            }
            _ => return Err(error(span, EXPECTED)),
        };
        if kind != "qp" {
            return Err(error(span, format!("unknown refiner \"{kind}\"; expected \"qp\"")));
        }
        let settings: planner_qp::Settings = settings.parse()?;
        let qp = Qp::new(settings.clone()).map_err(|e| BuildError::from(e).within("refine"))?;
        let mut full = table(&settings);
        full.insert("kind".into(), kind.into());
        refiners.push(Box::new(qp));
        resolved.push(full.into());
    }
    Ok((refiners, resolved))
}

fn error(span: Range<usize>, message: impl Into<String>) -> BuildError {
    BuildError::At { span, message: message.into() }
}

/// A planner's table while it is taken apart.
pub(crate) struct Settings<'i> {
    table: Spanned<DeTable<'i>>,
}

impl<'i> Settings<'i> {
    /// The whole table.
    pub(crate) fn new(table: Spanned<DeTable<'i>>) -> Self {
        Self { table }
    }

    /// Reads all remaining keys.
    pub(crate) fn parse<T: DeserializeOwned>(self) -> Result<T, BuildError> {
        let span = self.table.span();
        T::deserialize(self.table.into_deserializer())
            .map_err(|e| error(e.span().unwrap_or(span), e.message().replace('\n', "; ")))
    }

    /// Takes a key out.
    pub(crate) fn take(&mut self, key: &str) -> Option<Spanned<DeValue<'i>>> {
        self.table.get_mut().remove(key)
    }

    /// Takes a key out and reads it.
    pub(crate) fn take_parsed<T: DeserializeOwned>(&mut self, key: &str) -> Result<Option<T>, BuildError> {
        let Some(value) = self.take(key) else { return Ok(None) };
        let span = value.span();
        T::deserialize(value.into_deserializer())
            .map(Some)
            .map_err(|e| error(e.span().unwrap_or(span), e.message().replace('\n', "; ")))
    }

    /// Whether the key is there.
    pub(crate) fn has(&self, key: &str) -> bool {
        self.table.get_ref().contains_key(key)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(kind: &str, settings: &str) -> String {
        match build_str(kind, settings) {
            Ok(_) => panic!("{kind} accepts {settings}"),
            Err(BuildError::At { span, message }) => format!("{}: {message}", &settings[span]),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn every_kind_builds_from_nothing_and_from_its_own_settings() {
        for kind in kinds() {
            let first = build_str(kind.name, "").unwrap_or_else(|e| panic!("{}: {e}", kind.name));
            let text = toml::to_string(&first.settings).unwrap();
            let second = build_str(kind.name, &text).unwrap_or_else(|e| panic!("{}: {e}\n{text}", kind.name));
            assert_eq!(first.settings, second.settings);
        }
    }

    #[test]
    fn mistakes_say_what_was_expected() {
        assert!(message("psso", "").starts_with("unknown planner \"psso\"; expected one of straight-line, "));
        assert!(message("pso", "particle = 3").starts_with("particle: unknown field `particle`, expected one of"));
        assert_eq!(message("pso", "particles = 0"), "particles = 0; expected 1 to 10000");
        assert_eq!(message("pso", "columns = 0"), "columns = 0; expected 1 to 10000");
        for kind in ["pso", "pso-qp"] {
            let huge = message(kind, "iterations = 9223372036854775808");
            assert_eq!(huge, "iterations = 9223372036854775808; expected 0 to 10000000");
        }
        assert!(message("pso", "particles = -1").starts_with("-1: "));
        assert!(message("pso", "velocity_limit = \"some\"").contains("a fraction of H or \"none\""));
        assert!(message("pso", "velocity_limit = nan").contains("velocity_limit = NaN; expected a fraction of H"));
        assert!(message("pso", "rule = \"constriction\"\nc1 = 2.0").contains("beside rule = \"constriction\""));
        assert!(message("pso", "rule = \"spso\"").contains("unknown variant `spso`, expected one of `inertia`"));
        assert!(message("pso", "refine = [\"sqp\"]").contains("unknown refiner \"sqp\"; expected \"qp\""));
        assert!(message("pso", "refine = \"qp\"").contains("expected a list of refiners"));
        assert!(message("pso", "refine = [{ kind = \"qp\", max_rounds = 0 }]").contains("max_rounds = 0; expected"));
        assert!(message("pso-qp", "classes = \"all\"").contains("unknown variant `all`"));
        assert!(message("pso-qp", "qp = { modle = 1 }").contains("unknown field `modle`"));
        assert!(message("straight-line", "speed = 1").contains("unknown field `speed`"));
    }

    #[test]
    fn refinement_is_recorded_in_full() {
        let built = build_str("pso", "refine = [\"qp\", { kind = \"qp\", objective = \"smooth\" }]").unwrap();
        let refine = built.settings["refine"].as_array().unwrap();
        assert_eq!(refine.len(), 2);
        assert_eq!(refine[0]["objective"].as_str(), Some("shorten"));
        assert_eq!(refine[1]["objective"].as_str(), Some("smooth"));
    }
}
