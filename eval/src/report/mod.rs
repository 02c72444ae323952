//! `report.html`: one self-contained page, readable without JavaScript.
//!
//! Answer first, evidence after: which planner, for which scenes, at which budget, and the
//! comparison table; then the statistics over all test scenes, scene by scene, worst cases with
//! the commands that replay them, and what is missing; for each scene every planner's best path,
//! all its runs and what it did, convergence, and how gaps and times spread; settings, seeds and
//! machine at the end. Every figure has a paragraph that says what it shows and a table with its data.

mod answers;
mod axis;
mod backdrop;
mod camera;
mod chart;
mod convergence;
mod critical_difference;
mod data_table;
mod ecdf;
mod effort;
mod ert;
mod evidence;
mod families;
mod fitness;
mod fixed_budget;
mod heat;
mod language;
mod lines;
mod missing;
mod own_objective;
mod own_picture;
mod pairwise;
mod palette;
mod pareto;
mod phrases;
mod planner_card;
mod provenance;
mod replay_command;
mod scene_section;
mod streamlines;
mod strip;
pub mod svg;
mod tables;
mod variants;
mod worst;

use std::collections::BTreeSet;

use minijinja::{AutoEscape, Environment, UndefinedBehavior, Value, context};

use evidence::Evidence;
pub use language::Language;
use language::Strings;
use scene_section::Extent;

use crate::analysis::{Effort, Measure};
use crate::results::{Manifest, Results, SceneResult, SceneSet};

/// Scenes shown with every figure.
pub const FULL: usize = 3;
/// Scenes beyond these that get small pictures; the rest have their tables alone.
const SMALL: usize = 24;
/// Notes on scenes shown; a log of thousands of cycles has hundreds.
const MOST_NOTES: usize = 10;

/// The report of a campaign as one HTML file without outside references.
pub fn html(results: &Results, language: Language) -> String {
    let t = Strings::new(language);
    let evidence = Evidence::new(results);
    let one = results.scenes.len() == 1;
    let unit = common_unit(results);
    let extent = |i: usize| match i {
        i if i < FULL => Extent::Full,
        i if i < FULL + SMALL => Extent::Small,
        _ => Extent::Table,
    };
    let scenes: Vec<Value> =
        (0..results.scenes.len()).map(|i| scene_section::section(&evidence, i, extent(i), &t)).collect();
    let overall = if results.scenes.len() > 1 {
        let every: Vec<&SceneResult> = results.scenes.iter().filter(|s| s.set == SceneSet::Test).collect();
        context! {
            spread => scene_section::spread(results, &every, "all-spread", &t),
            times => scene_section::times(results, None, "all-time", &t),
        }
    } else {
        Value::from(())
    };
    let planners: Vec<Value> = results
        .planners
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let (label, kind, settings) = (p.label.as_str(), p.kind.as_str(), p.settings.trim_end());
            context! { label, kind, settings, swatch => Value::from_safe_string(palette::swatch(i)) }
        })
        .collect();
    let css =
        [&palette::css_variables(), svg::FIGURE_CSS, &palette::series_css(), &heat::css(), include_str!("style.css")]
            .concat();
    let name = results.scenes.first().filter(|_| one).map(|s| s.scene.name.as_str());
    let page = context! {
        lang => language.tag(), t => t.to_value(), name => results.name.as_str(),
        css => Value::from_safe_string(css),
        script => Value::from_safe_string(include_str!("script.js").to_owned()),
        answers => answers::answers(&evidence, &t), unfinished => unfinished(results, &t),
        table => tables::comparison(&evidence, name, unit, &t),
        warnings => warnings(&results.manifest, &t),
        matrix => if one { Value::from(()) } else { tables::matrix(results) },
        small_first => t.fill("scene_small_first", &[("n", &scene_section::DRAWN_SMALL.to_string())]),
        others => results.scenes.len() > FULL,
        overall, scenes, planners, runs => results.runs.len(),
        keys => Value::from_safe_string(palette::keys(results.planners.len())),
        evidence => statistics(&evidence, &t), tuning => tuning(results, &t),
        worst => worst::figure(results, &t), missing => missing::figure(results, &t),
        seed => results.seed.to_string(), repeats => results.repeats, seeds => seeds(results),
        manifest => provenance::manifest(&results.manifest, &t), machines => provenance::machines(results, &t),
    };
    render(&page).unwrap_or_else(|error| {
        // Only a mistake in the template gets here, and the tests render it.
        format!("<!doctype html><title>report</title><pre>{}</pre>", svg::escape(&error.to_string()))
    })
}

/// The figures and tables over all test scenes.
fn statistics(evidence: &Evidence<'_>, t: &Strings) -> Value {
    let both = |figure: &dyn Fn(Effort) -> Option<Value>| -> Vec<Value> {
        [Effort::Evaluations, Effort::Time].into_iter().filter_map(figure).collect()
    };
    let tuning = evidence.results.scenes.len() - evidence.grid.scenes.len();
    let scenes = t.plural(evidence.scenes().len(), "scenes_one", "scenes");
    let mut scope = t.fill(
        if tuning > 0 { "scope_tuning" } else { "scope" },
        &[("scenes", &scenes), ("tuning", &t.plural(tuning, "tuning_scenes_one", "tuning_scenes"))],
    );
    if evidence.quality.measure == Measure::Length && evidence.grid.scenes.len() > 1 {
        scope += t.get("sentence_gap");
        scope += t.get("scope_lengths");
    }
    context! {
        scope,
        families => families::figure(evidence, t),
        budgets => variants::budgets(evidence, t), variants => variants::groups(evidence, t),
        ecdf => both(&|effort| ecdf::figure(evidence, effort, t)),
        ert => both(&|effort| ert::figure(evidence, effort, t)),
        fixed => both(&|effort| fixed_budget::figure(evidence, effort, t)),
        critical => critical_difference::figure(evidence, t),
        pairwise => pairwise::figure(evidence, t), sentences => answers::sentences(evidence, t),
        own => own_objective::figure(evidence, t), noise => provenance::times(evidence, t),
    }
}

/// Which scenes take no part in statistics.
fn tuning(results: &Results, t: &Strings) -> Option<String> {
    let tuning = results.scenes.iter().filter(|s| s.set == SceneSet::Tuning);
    let names: Vec<String> = tuning.map(|s| s.scene.name.clone()).collect();
    let scenes = t.plural(names.len(), "scenes_one", "scenes");
    (!names.is_empty()).then(|| t.fill("tuning_note", &[("scenes", &scenes), ("names", &t.list(&names))]))
}

/// The id of a scene's section.
fn scene_anchor(index: usize) -> String {
    format!("scene-{index}")
}

fn render(page: &Value) -> Result<String, minijinja::Error> {
    let mut environment = Environment::new();
    environment.set_auto_escape_callback(|_| AutoEscape::Html);
    environment.set_undefined_behavior(UndefinedBehavior::Strict);
    let parts = [include_str!("macros.html"), include_str!("evidence.html"), include_str!("page.html")].concat();
    environment.add_template_owned("page.html", parts)?;
    environment.get_template("page.html")?.render(page)
}

/// The scenes' unit, empty when they differ.
fn common_unit(results: &Results) -> &str {
    let units: BTreeSet<&str> = results.scenes.iter().map(|s| s.scene.unit.as_str()).collect();
    if units.len() == 1 { units.first().copied().unwrap_or("") } else { "" }
}

/// What to know before anything else of a campaign that lacks runs.
fn unfinished(results: &Results, t: &Strings) -> Option<String> {
    let (runs, planned) = (results.runs.len(), results.planned());
    let count = |n: usize| crate::format::count(n as f64);
    (runs < planned).then(|| t.fill("unfinished", &[("runs", &count(runs)), ("planned", &count(planned))]))
}

fn warnings(manifest: &Manifest, t: &Strings) -> Vec<String> {
    let mut warnings = Vec::new();
    if !manifest.shard.is_empty() {
        warnings.push(t.fill("note_shard", &[("shard", &manifest.shard)]));
    }
    if manifest.jobs > 1 {
        warnings.push(t.fill("note_jobs", &[("n", &manifest.jobs.to_string())]));
    }
    if manifest.profile == "debug" {
        warnings.push(t.get("note_debug").to_owned());
    }
    warnings.extend(manifest.notes.iter().take(MOST_NOTES).cloned());
    if let Some(more @ 1..) = manifest.notes.len().checked_sub(MOST_NOTES) {
        warnings.push(format!("+ {more}: manifest.json"));
    }
    warnings
}

/// Seeds are the same for every planner: one line a scene and repeat.
fn seeds(results: &Results) -> Vec<Value> {
    let seeds: BTreeSet<(&str, u32, u64)> = results.runs.iter().map(|r| (r.scene.as_str(), r.repeat, r.seed)).collect();
    seeds.into_iter().map(|(scene, repeat, seed)| context! { scene, repeat, seed => seed.to_string() }).collect()
}

#[cfg(test)]
mod tests;
