//! The command that replays one run, to be pasted into a shell in the report's folder.

use toml::{Table, Value};

use crate::config;
use crate::results::PlannerInfo;
use crate::shell::quoted;

/// The command; runs of kinds that this program does not know are replayed all together.
pub fn command(planner: &PlannerInfo, scene_file: &str, seed: u64) -> String {
    let mut words = vec!["touchline".to_owned()];
    match settings(planner) {
        Some(settings) => {
            words.extend(["plan", scene_file, "--planner", &planner.kind].map(quoted));
            for (key, value) in settings {
                words.extend(["--set".to_owned(), quoted(&format!("{key}={}", shown(&value)))]);
            }
            let budget = planner.budget;
            let counts = [("iterations", budget.iterations), ("evaluations", budget.evaluations)];
            for (key, count) in counts {
                words.extend(count.iter().flat_map(|n| ["--set".to_owned(), format!("budget.{key}={n}")]));
            }
            words.extend(budget.time_ms.iter().flat_map(|ms| ["--set".to_owned(), format!("budget.time_ms={ms:?}")]));
            words.extend(["--seed".to_owned(), seed.to_string()]);
        }
        None => words.extend(["run", "comparison.toml", "--planner", &planner.label].map(quoted)),
    }
    words.join(" ")
}

/// The settings that make this planner from its kind's defaults, the program of an external one included; `None`
/// where this program does not make it.
fn settings(planner: &PlannerInfo) -> Option<Table> {
    let mut wanted: Table = toml::from_str(&planner.settings).ok()?;
    // Said key by key.
    wanted.remove("budget");
    let made = |settings: &Table| config::single("", &planner.kind, &settings.to_string()).ok().map(|e| e.settings);
    let whole = made(&wanted)?;
    let defaults = made(&Table::new()).unwrap_or_default();
    let changed = wanted.iter().filter(|(key, value)| defaults.get(*key) != Some(*value));
    let changed: Table = changed.map(|(key, value)| (key.clone(), value.clone())).collect();
    // A default that follows from other settings would slip in: then everything is said.
    [changed, wanted.clone()].into_iter().find(|settings| made(settings).as_ref() == Some(&whole))
}

/// A value as `--set` reads it: TOML, and texts bare where they cannot be taken for anything else.
fn shown(value: &Value) -> String {
    match value {
        Value::String(text) if is_bare(text) => text.clone(),
        other => other.to_string(),
    }
}

fn is_bare(text: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphabetic() || c == '-' || c == '_';
    // Words that TOML itself knows.
    !text.is_empty() && text.chars().all(plain) && !["true", "false", "inf", "nan", "-inf", "-nan"].contains(&text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::BudgetSpec;

    /// A planner as the store describes it.
    fn info(kind: &str, settings: &str) -> PlannerInfo {
        let entry = config::single("test", kind, settings).unwrap();
        PlannerInfo { budget: entry.budget, ..PlannerInfo::plain("label", kind, &entry.settings_toml()) }
    }

    #[test]
    fn only_what_differs_is_set() {
        let seed = |p: &PlannerInfo| command(p, "scenes/a.toml", 7);
        assert_eq!(seed(&info("tangent", "")), "touchline plan scenes/a.toml --planner tangent --seed 7");
        let pso = info("pso", "particles = 31\nvelocity_limit = \"none\"\nbudget = { iterations = 9, time_ms = 5 }");
        let said = "--set particles=31 --set velocity_limit=none --set budget.iterations=9 --set budget.time_ms=5.0";
        assert_eq!(seed(&pso), format!("touchline plan scenes/a.toml --planner pso {said} --seed 7"));
        let refined = seed(&info("astar", "refine = [\"qp\"]"));
        assert!(refined.contains("--set 'refine=[") && refined.contains("\"qp\""), "{refined}");
    }

    #[test]
    fn commands_give_the_settings_back() {
        for (kind, settings) in [
            ("pso", "refine = [{ kind = \"qp\", solver = \"structured\" }]\ninertia = 0.5"),
            ("astar", "refine = [\"qp\"]"),
            ("rrt-star", "samples = 300"),
        ] {
            let planner = info(kind, settings);
            let set = super::settings(&planner).unwrap();
            let again = config::single("test", kind, &set.to_string()).unwrap();
            assert_eq!(again.settings_toml(), planner.settings, "{kind}");
            assert!(set.len() < planner.settings.lines().count(), "{kind}: not everything is said");
        }
    }

    #[test]
    fn texts_that_look_like_more_keep_their_quotes() {
        assert_eq!(shown(&Value::String("inf".to_owned())), "\"inf\"");
        assert_eq!(shown(&Value::String("12".to_owned())), "\"12\"");
    }

    #[test]
    fn external_planners_run_again() {
        let own = info(
            "external",
            "command = [\"sh\", \"my own.sh\"]\nfolder = \"/a b\"\ngain = 1\nbudget = { time_ms = 5 }",
        );
        let said =
            "--set 'command=[\"sh\", \"my own.sh\"]' --set 'folder=\"/a b\"' --set gain=1 --set budget.time_ms=5.0";
        let expected = format!("touchline plan scenes/a.toml --planner external {said} --seed 7");
        assert_eq!(command(&own, "scenes/a.toml", 7), expected);
        let unknown =
            PlannerInfo { budget: BudgetSpec::default(), ..PlannerInfo::plain("my own", "lost", "gain = 1\n") };
        assert_eq!(command(&unknown, "scenes/a.toml", 7), "touchline run comparison.toml --planner 'my own'");
    }
}
