//! Variants of one planner beside each other, and the best planner at each budget.

use std::collections::BTreeMap;

use minijinja::{Value, context};

use super::answers::{self, Answer};
use super::data_table::{number, planner_row, row, table, with_interval, words};
use super::evidence::Evidence;
use super::language::Strings;
use super::phrases;
use crate::analysis::{Effort, Measure};
use crate::config::BudgetSpec;
use crate::format;

/// Which planner at which budget; `None` unless budgets differ.
pub fn budgets(evidence: &Evidence<'_>, t: &Strings) -> Option<Value> {
    let planners = &evidence.results.planners;
    let mut all: Vec<(BudgetSpec, Vec<usize>)> = Vec::new();
    for (i, planner) in planners.iter().enumerate() {
        match all.iter_mut().find(|(budget, _)| *budget == planner.budget) {
            Some((_, members)) => members.push(i),
            None => all.push((planner.budget, vec![i])),
        }
    }
    if all.len() < 2 {
        return None;
    }
    let scenes = evidence.scenes();
    let rows = all.iter().map(|(budget, members)| {
        let shown = |answer: Option<Answer>| words(answer.map_or(t.get("nobody").to_owned(), |a| a.text(evidence, t)));
        // Whoever needs less than a number of evaluations is within it, whatever its own limit.
        let count = (*budget == BudgetSpec { evaluations: budget.evaluations, ..BudgetSpec::default() })
            .then_some(budget.evaluations)
            .flatten();
        let spent = |p: usize| evidence.grid.runs_in(p, None).map(|r| r.evaluations).max();
        let inside = |p: usize| members.contains(&p) || count.is_some_and(|n| spent(p).is_some_and(|most| most <= n));
        let best = match count {
            Some(n) if !evidence.curves.scenes().is_empty() => {
                answers::within(evidence, &scenes, Effort::Evaluations, n as f64)
            }
            _ => answers::best(evidence, &scenes, &inside),
        };
        row(vec![
            words(words_of(*budget, t)),
            shown(best),
            shown(answers::fastest(evidence, &scenes, &inside)),
            number(members.len().to_string(), members.len() as f64),
        ])
    });
    let heads = [t.get("variants_budget"), t.get("answer_best"), t.get("answer_fastest"), t.get("budgets_planners")];
    Some(table("budgets-table", t.get("budgets_title"), &heads, rows.collect()))
}

fn words_of(budget: BudgetSpec, t: &Strings) -> String {
    let parts = [
        budget.iterations.map(|n| t.fill("budget_iterations", &[("n", &format::count(n as f64))])),
        budget.evaluations.map(|n| t.fill("budget_evaluations", &[("n", &format::count(n as f64))])),
        budget.time_ms.map(|ms| format::time(1000.0 * ms)),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    if parts.is_empty() { t.get("budget_none").to_owned() } else { parts.join(", ") }
}

/// The variants of each planner that has several.
pub fn groups(evidence: &Evidence<'_>, t: &Strings) -> Vec<Value> {
    let mut groups: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (i, planner) in evidence.results.planners.iter().enumerate() {
        groups.entry(planner.group.as_str()).or_default().push(i);
    }
    let scenes = evidence.scenes();
    let quality = t.get(if evidence.quality.measure == Measure::Gap { "head_gap" } else { "head_length" });
    let heads = [t.get("variants_variant"), t.get("head_valid"), quality, t.get("head_time"), t.get("variants_budget")];
    let several = groups.into_iter().filter(|(_, members)| members.len() > 1);
    several
        .enumerate()
        .map(|(n, (group, members))| {
            let rows = members.iter().filter_map(|p| {
                let planner = &evidence.results.planners[*p];
                let (valid, runs) = evidence.valid(*p, &scenes);
                let (figure, time) = (evidence.quality_of(*p, &scenes)?, evidence.time_of(*p, &scenes)?);
                let measure = evidence.quality.measure;
                let varied = if planner.varied.is_empty() { &planner.label } else { &planner.varied };
                let cells = vec![
                    number(format!("{valid}/{runs}"), valid as f64 / runs.max(1) as f64),
                    with_interval(figure.median, figure.ends(), &|v| phrases::value(measure, v)),
                    with_interval(time.median, time.ends(), &format::time),
                    words(words_of(planner.budget, t)),
                ];
                Some(planner_row(varied, *p, cells))
            });
            let caption = t.fill("variants_of", &[("planner", group)]);
            context! { title => caption.as_str(), table => table(&format!("variants-{n}"), &caption, &heads, rows.collect()) }
        })
        .collect()
}
