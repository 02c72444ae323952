//! What tells one campaign from another of a different identity.

use std::collections::{BTreeMap, BTreeSet};

use env_model::Scene;

use crate::campaign::Campaign;
use crate::config::FOLDER;
use crate::store::Stored;

/// All that an identity is made of.
pub struct Signature {
    version: String,
    comparison: toml::Table,
    scenes: BTreeMap<String, String>,
}

impl Signature {
    /// Of a campaign that may be run.
    pub fn of(campaign: &Campaign) -> Self {
        let scenes = campaign.comparison.scenes.iter().map(|entry| (&entry.scene, &entry.simulation));
        Self::new(env!("CARGO_PKG_VERSION"), &campaign.comparison.portable_toml(), scenes)
    }

    /// Of a campaign that is kept.
    pub fn of_stored(stored: &Stored) -> Self {
        let scenes = stored.results.scenes.iter().map(|result| (&result.scene, &result.simulation));
        Self::new(&stored.results.manifest.version, &stored.comparison, scenes)
    }

    fn new<'s>(
        version: &str,
        comparison: &str,
        scenes: impl Iterator<Item = (&'s Scene, &'s Option<strategy::Settings>)>,
    ) -> Self {
        let mut comparison: toml::Table = comparison.parse().unwrap_or_default();
        let planners = comparison.get_mut("planner").and_then(toml::Value::as_table_mut);
        for planner in planners.into_iter().flatten().filter_map(|(_, planner)| planner.as_table_mut()) {
            // No part of an identity; planners of the catalogue have no such key.
            planner.remove(FOLDER);
        }
        Self {
            version: version.to_owned(),
            comparison,
            scenes: scenes
                .map(|(scene, moving)| (scene.name.clone(), format!("{}{moving:?}", scene.to_toml())))
                .collect(),
        }
    }
}

/// In words, what `this` has instead of what `that` has: `seed 2 instead of 1; no planner tangent`.
pub fn differences(this: &Signature, that: &Signature) -> String {
    let mut found = Vec::new();
    if this.version != that.version {
        found.push(format!("version {} instead of {}", this.version, that.version));
    }
    for key in ["name", "seed", "repeats", "behaviour"] {
        let [a, b] = [this, that].map(|s| s.comparison.get(key).map(ToString::to_string).unwrap_or_default());
        if a != b {
            found.push(format!("{key} {a} instead of {b}"));
        }
    }
    let planners = |s: &Signature| s.comparison.get("planner").and_then(toml::Value::as_table).cloned();
    let [a, b] = [this, that].map(|s| planners(s).unwrap_or_default());
    sets(&mut found, "planner", a.keys(), b.keys());
    for (label, settings) in &a {
        if let (Some(ours), Some(theirs)) = (settings.as_table(), b.get(label).and_then(toml::Value::as_table)) {
            let mut keys: Vec<&String> =
                ours.keys().chain(theirs.keys()).filter(|k| ours.get(*k) != theirs.get(*k)).collect();
            keys.sort();
            keys.dedup();
            for key in keys {
                let [x, y] = [ours, theirs].map(|t| t.get(key).map_or_else(|| "none".to_owned(), ToString::to_string));
                found.push(format!("planner {label} with {key} = {} instead of {}", x.trim_end(), y.trim_end()));
            }
        }
    }
    sets(&mut found, "scene", this.scenes.keys(), that.scenes.keys());
    let changed = this.scenes.iter().filter(|(name, text)| that.scenes.get(*name).is_some_and(|t| t != *text));
    found.extend(changed.map(|(name, _)| format!("another content of scene {name}")));
    if found.is_empty() {
        // Nothing else is left that an identity is made of.
        found.push("another order of planners or scenes, or other sets of scenes".to_owned());
    }
    found.join("; ")
}

/// Which names only one side has.
fn sets<'k>(
    found: &mut Vec<String>,
    what: &str,
    this: impl Iterator<Item = &'k String>,
    that: impl Iterator<Item = &'k String>,
) {
    let [this, that]: [BTreeSet<&String>; 2] = [this.collect(), that.collect()];
    for (word, names) in [("the additional", &this - &that), ("no", &that - &this)] {
        if !names.is_empty() {
            let plural = if names.len() == 1 { "" } else { "s" };
            let names: Vec<&str> = names.into_iter().map(String::as_str).collect();
            found.push(format!("{word} {what}{plural} {}", names.join(", ")));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{campaign, entry, straight};

    #[test]
    fn every_part_of_an_identity_is_told() {
        let of = |labels: &[&'static str], change: fn(&mut Campaign)| {
            let mut campaign = campaign(labels.iter().map(|label| entry(label, straight)).collect());
            change(&mut campaign);
            Signature::of(&campaign)
        };
        let plain = of(&["a", "b"], |_| ());
        let told = |labels: &[&'static str], change| differences(&of(labels, change), &plain);
        assert_eq!(told(&["a", "b"], |c| c.comparison.seed = 9), "seed 9 instead of 3");
        assert_eq!(told(&["a", "b"], |c| c.comparison.repeats = 6), "repeats 6 instead of 5");
        assert_eq!(told(&["a", "c", "d"], |_| ()), "the additional planners c, d; no planner b");
        assert_eq!(told(&["b", "a"], |_| ()), "another order of planners or scenes, or other sets of scenes");
        let gain = |c: &mut Campaign| {
            c.comparison.planners[1].settings.insert("gain".into(), 0.75.into());
        };
        assert_eq!(told(&["a", "b"], gain), "planner b with gain = 0.75 instead of 0.5");
        let moved = |c: &mut Campaign| c.comparison.scenes[0].scene.goal = [11.0, 0.0];
        assert_eq!(told(&["a", "b"], moved), "another content of scene b-scene");
        let older = Signature { version: "0.0.1".into(), ..of(&["a", "b"], |_| ()) };
        assert_eq!(differences(&plain, &older), format!("version {} instead of 0.0.1", env!("CARGO_PKG_VERSION")));
    }
}
