//! Every word of the page, one dictionary a language.

use std::collections::BTreeMap;

use minijinja::Value;

use crate::results::Subject;

/// The language of a report.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Simplified Chinese.
    Chinese,
}

impl Language {
    /// The page's `lang` attribute (BCP 47).
    pub fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Chinese => "zh-Hans",
        }
    }

    fn source(self) -> &'static str {
        match self {
            Self::English => include_str!("strings/en.toml"),
            Self::Chinese => include_str!("strings/zh.toml"),
        }
    }
}

/// A dictionary.
#[derive(Debug, Clone)]
pub struct Strings {
    entries: BTreeMap<String, String>,
}

impl Strings {
    /// Reads the dictionary of `language`.
    pub fn new(language: Language) -> Self {
        Self::of(language, Subject::Paths)
    }

    /// That dictionary with the words that reports of `subject` have of their own in the place of others.
    pub fn of(language: Language, subject: Subject) -> Self {
        // The dictionaries are part of the program and tested: an unreadable one is
        // shown as its keys rather than ending a campaign in a panic.
        let all: toml::Table = toml::from_str(language.source()).unwrap_or_default();
        let own = all.get(subject.name()).and_then(toml::Value::as_table).cloned();
        let words = |(key, value): (String, toml::Value)| Some((key, value.as_str()?.to_owned()));
        Self { entries: all.into_iter().chain(own.into_iter().flatten()).filter_map(words).collect() }
    }

    /// The words for `key`; the key itself where the dictionary lacks it.
    pub fn get<'a>(&'a self, key: &'a str) -> &'a str {
        self.entries.get(key).map_or(key, String::as_str)
    }

    /// Whether there are words for `key`.
    pub fn has(&self, key: &str) -> bool {
        self.entries.contains_key(key)
    }

    /// The words for `key` with every `{name}` replaced. Plain text, not escaped.
    pub fn fill(&self, key: &str, values: &[(&str, &str)]) -> String {
        // One pass, so that a value that looks like a placeholder stays as it is.
        let (mut out, mut rest) = (String::new(), self.get(key));
        while let Some((before, after)) = rest.split_once('{') {
            out.push_str(before);
            let Some((name, tail)) = after.split_once('}') else {
                out.push('{');
                rest = after;
                continue;
            };
            match values.iter().find(|(n, _)| *n == name) {
                Some((_, value)) => out.push_str(value),
                None => out.push_str(&format!("{{{name}}}")),
            }
            rest = tail;
        }
        out + rest
    }

    /// `one` for a count of 1, else `many`, both with `{n}`.
    pub fn plural(&self, n: usize, one: &str, many: &str) -> String {
        self.fill(if n == 1 { one } else { many }, &[("n", &crate::format::count(n as f64))])
    }

    /// "a, b and c" for a list of words.
    pub fn list(&self, words: &[String]) -> String {
        match words {
            [] => String::new(),
            [one] => one.clone(),
            [first @ .., last] => first.join(self.get("list_comma")) + self.get("list_and") + last,
        }
    }

    /// The dictionary for templates.
    pub fn to_value(&self) -> Value {
        Value::from(self.entries.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn placeholders(text: &str) -> Vec<&str> {
        let mut names: Vec<&str> = text.split('{').skip(1).filter_map(|s| s.split_once('}')).map(|(n, _)| n).collect();
        names.sort_unstable();
        names.dedup();
        names
    }

    #[test]
    fn both_languages_have_the_same_keys_and_placeholders() {
        let keys = |s: &Strings| s.entries.keys().cloned().collect::<Vec<_>>();
        for subject in [Subject::Paths, Subject::Simulation, Subject::Behaviour] {
            let (en, zh) = (Strings::of(Language::English, subject), Strings::of(Language::Chinese, subject));
            assert!(en.entries.len() > 50, "the dictionary is there");
            assert_eq!(keys(&en), keys(&zh));
            for (key, text) in &en.entries {
                assert_eq!(placeholders(text), placeholders(zh.get(key)), "placeholders of {key}");
            }
        }
    }

    #[test]
    fn subjects_have_words_of_their_own_for_the_same_keys() {
        let base = Strings::new(Language::English);
        for subject in [Subject::Simulation, Subject::Behaviour] {
            let [en, zh] = [Language::English, Language::Chinese].map(|language| {
                let all: toml::Table = toml::from_str(language.source()).unwrap();
                all[subject.name()].as_table().unwrap().clone()
            });
            assert_eq!(en.keys().collect::<Vec<_>>(), zh.keys().collect::<Vec<_>>());
            for (key, words) in &en {
                assert!(base.has(key), "{key} is a key");
                let known = placeholders(base.get(key));
                let unknown = placeholders(words.as_str().unwrap()).into_iter().find(|name| !known.contains(name));
                assert_eq!(unknown, None, "{key}");
            }
        }
    }

    #[test]
    fn every_key_used_exists_and_every_key_is_used() {
        let templates = [
            include_str!("macros.html"),
            include_str!("evidence.html"),
            include_str!("moving/player.html"),
            include_str!("page.html"),
        ]
        .concat();
        let sources = [
            templates.as_str(),
            include_str!("answers.rs"),
            include_str!("backdrop.rs"),
            include_str!("convergence.rs"),
            include_str!("critical_difference.rs"),
            include_str!("ecdf.rs"),
            include_str!("ert.rs"),
            include_str!("evidence.rs"),
            include_str!("families.rs"),
            include_str!("fitness.rs"),
            include_str!("fixed_budget.rs"),
            include_str!("language.rs"),
            include_str!("missing.rs"),
            include_str!("mod.rs"),
            include_str!("moving/animation.rs"),
            include_str!("moving/answers.rs"),
            include_str!("moving/compute.rs"),
            include_str!("moving/events.rs"),
            include_str!("moving/legend.rs"),
            include_str!("moving/runs.rs"),
            include_str!("moving/scene.rs"),
            include_str!("moving/tables.rs"),
            include_str!("own_objective.rs"),
            include_str!("own_picture.rs"),
            include_str!("pairwise.rs"),
            include_str!("pareto.rs"),
            include_str!("phrases.rs"),
            include_str!("planner_card.rs"),
            include_str!("provenance.rs"),
            include_str!("scene_section.rs"),
            include_str!("strip.rs"),
            include_str!("svg.rs"),
            include_str!("tables.rs"),
            include_str!("tuning/answers.rs"),
            include_str!("tuning/generations.rs"),
            include_str!("tuning/parameters.rs"),
            include_str!("tuning/tables.rs"),
            include_str!("variants.rs"),
            include_str!("worst.rs"),
        ]
        .concat();
        let en = Strings::new(Language::English);
        for key in en.entries.keys() {
            let used = sources.contains(&format!("\"{key}\""))
                || sources.split(&format!("t.{key}")).skip(1).any(|s| s.starts_with([' ', ')', ',']))
                || key.starts_with("status_")
                || key.starts_with("quantity_")
                || key.starts_with("weight_")
                // Made of what is said and the measure.
                || key.starts_with("phrase_");
            assert!(used, "{key} is never used");
        }
        let page = templates.as_str();
        for (at, _) in page.match_indices("t.").filter(|(at, _)| !page[..*at].ends_with(|c: char| c.is_alphanumeric()))
        {
            let key: String = page[at + 2..].chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '_').collect();
            assert!(en.entries.contains_key(&key), "the page uses t.{key}");
        }
        for status in crate::results::RunStatus::ALL {
            assert!(en.entries.contains_key(&format!("status_{}", status.name())), "{}", status.name());
        }
    }

    #[test]
    fn filling_is_one_pass() {
        let mut s = Strings { entries: BTreeMap::new() };
        s.entries.insert("k".into(), "{a} of {b}".into());
        assert_eq!(s.fill("k", &[("a", "{b}"), ("b", "2")]), "{b} of 2");
        assert_eq!(s.fill("k", &[("a", "1")]), "1 of {b}");
    }
}
