//! Scenes of one kind: those whose names begin alike.

use minijinja::Value;

use super::answers::{self, Answer};
use super::data_table::{row, table, words};
use super::evidence::Evidence;
use super::language::Strings;
use crate::analysis::Effort;

/// What a scene's name begins with, up to the first number: `wall` of `wall-s3-07`, `game` of `game-c0120-left`.
fn family(name: &str) -> &str {
    let counts = |part: &str| {
        let digits = part.strip_prefix(['s', 'c', 'f']).unwrap_or(part);
        !digits.is_empty() && digits.bytes().all(|b| b.is_ascii_digit())
    };
    let mut end = 0;
    for part in name.split('-') {
        if counts(part) {
            break;
        }
        end += part.len() + 1;
    }
    if end == 0 { name } else { &name[..(end - 1).min(name.len())] }
}

/// The families in the scenes' order, each with the positions of its scenes.
fn families<'a>(evidence: &'a Evidence<'_>) -> Vec<(&'a str, Vec<usize>)> {
    let mut all: Vec<(&str, Vec<usize>)> = Vec::new();
    for i in evidence.scenes() {
        let name = family(&evidence.grid.scenes[i].scene.name);
        match all.iter_mut().find(|(known, _)| *known == name) {
            Some((_, scenes)) => scenes.push(i),
            None => all.push((name, vec![i])),
        }
    }
    all
}

/// Which planner for which scenes; `None` unless there are several families, at least one of several scenes.
pub fn figure(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let families = families(evidence);
    if families.len() < 2 || families.iter().all(|(_, scenes)| scenes.len() < 2) {
        return None;
    }
    let times = answers::decades(evidence);
    let rows: Vec<Value> = families
        .iter()
        .map(|(name, scenes)| {
            let shown =
                |answer: Option<Answer>| words(answer.map_or(t.get("nobody").to_owned(), |a| a.text(evidence, t)));
            let name = match scenes.as_slice() {
                [scene] => evidence.grid.scenes[*scene].scene.name.clone(),
                _ => format!("{name} ({})", scenes.len()),
            };
            let within = times.iter().map(|us| shown(answers::within(evidence, scenes, Effort::Time, *us)));
            let cells = [words(name), shown(answers::best(evidence, scenes, &|_| true))].into_iter().chain(within);
            row(cells.chain([shown(answers::fastest(evidence, scenes, &|_| true))]).collect())
        })
        .collect();
    let within: Vec<String> =
        times.iter().map(|us| t.fill("answer_within", &[("time", &crate::format::time(*us))])).collect();
    let mut heads = vec![t.get("families_scenes"), t.get("answer_best")];
    heads.extend(within.iter().map(String::as_str));
    heads.push(t.get("answer_fastest"));
    Some(table("families-table", t.get("families_title"), &heads, rows))
}

#[cfg(test)]
mod tests {
    use super::family;

    #[test]
    fn names_end_at_their_first_number() {
        for (name, expected) in [
            ("wall-s3-07", "wall"),
            ("ssl-a-s3-00", "ssl-a"),
            ("game-c0120-left", "game"),
            ("ssl-divB-6v6-simulated-f0050-blue3", "ssl-divB-6v6-simulated"),
            ("dense-0", "dense"),
            ("corridor", "corridor"),
            ("2012", "2012"),
            ("-", "-"),
            ("", ""),
        ] {
            assert_eq!(family(name), expected, "{name}");
        }
    }
}
