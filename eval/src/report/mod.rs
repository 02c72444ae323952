//! `report.html`: one self-contained page, readable without JavaScript.
//!
//! Answer first, evidence after: which planner, for which scenes, at which budget, and the
//! comparison table; then the statistics over all test scenes, scene by scene, worst cases with
//! the commands that replay them, and what is missing; for each scene every planner's best path,
//! all its runs and what it did, convergence, and how gaps and times spread; settings, seeds and
//! machine at the end. Every figure has a paragraph that says what it shows and a table with its data.
//!
//! Moving scenes and tunings have the same page with figures of their own ([`moving`], [`tuning`]) and words of their
//! own for what is compared.

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
mod moving;
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
mod tuning;
mod variants;
mod worst;

use std::collections::BTreeSet;

use minijinja::{AutoEscape, Environment, UndefinedBehavior, Value, context};

use evidence::Evidence;
pub use language::Language;
use language::Strings;
use scene_section::Extent;

use crate::analysis::{Effort, Measure};
use crate::results::{Manifest, Results, RunRecord, SceneResult, SceneSet, Subject};

/// Scenes shown with every figure.
pub const FULL: usize = 3;
/// Scenes beyond these that get small pictures; the rest have their tables alone.
const SMALL: usize = 24;
/// Notes on scenes shown; a log of thousands of cycles has hundreds.
const MOST_NOTES: usize = 10;

/// The report of a campaign as one HTML file without outside references.
pub fn html(results: &Results, language: Language) -> String {
    let (subject, t) = (results.subject, Strings::of(language, results.subject));
    let evidence = Evidence::new(results);
    let one = results.scenes.len() == 1;
    let unit = common_unit(results);
    let extent = |i: usize| match i {
        i if i < FULL => Extent::Full,
        i if i < FULL + SMALL => Extent::Small,
        _ => Extent::Table,
    };
    let section = |i: usize| match subject {
        Subject::Paths => Some(scene_section::section(&evidence, i, extent(i), &t)),
        Subject::Simulation => Some(moving::scene::section(results, i, extent(i) == Extent::Full, &t)),
        Subject::Behaviour => None,
    };
    let scenes: Vec<Value> = (0..results.scenes.len()).filter_map(section).collect();
    let every: Vec<&SceneResult> = results.scenes.iter().filter(|s| s.set == SceneSet::Test).collect();
    let overall = if scenes.len() > 1 {
        context! {
            spread => match subject {
                Subject::Simulation => moving::scene::spread(results, &every, "all-spread", &t),
                _ => scene_section::spread(results, &every, "all-spread", &t),
            },
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
    let (own_css, own_script) = match subject {
        Subject::Paths => ("", ""),
        Subject::Simulation => (moving::CSS, moving::SCRIPT),
        Subject::Behaviour => (tuning::CSS, ""),
    };
    let css = [
        &palette::css_variables(),
        svg::FIGURE_CSS,
        &palette::series_css(),
        &heat::css(),
        include_str!("style.css"),
        own_css,
    ]
    .concat();
    let by_planner = by_planner(results, &every);
    let paths = subject == Subject::Paths;
    let answers = match subject {
        Subject::Paths => answers::answers(&evidence, &t),
        Subject::Simulation => moving::answers::answers(&evidence, &by_planner, answers::size(&evidence, &t), &t),
        Subject::Behaviour => tuning::answers::answers(&evidence, answers::size(&evidence, &t), &t),
    };
    let figures = match subject {
        Subject::Paths => None,
        Subject::Simulation => Some(moving::tables::comparison(results, &by_planner, "overall-table", &t)),
        Subject::Behaviour => Some(tuning::tables::comparison(results, "overall-table", &t)),
    };
    let name = results.scenes.first().filter(|_| one).map(|s| s.scene.name.as_str());
    let page = context! {
        lang => language.tag(), t => t.to_value(), name => results.name.as_str(),
        css => Value::from_safe_string(css),
        script => Value::from_safe_string([include_str!("script.js"), own_script].concat()),
        subject => subject.name(), answers, unfinished => unfinished(results, &t),
        table => paths.then(|| tables::comparison(&evidence, name, unit, &t)), figures,
        search => (subject == Subject::Behaviour).then(|| search(results, &t)),
        warnings => warnings(&results.manifest, &t),
        matrix => if one { Value::from(()) } else { tables::matrix(results) },
        small_first => t.fill("scene_small_first", &[("n", &scene_section::DRAWN_SMALL.to_string())]),
        others => results.scenes.len() > FULL,
        overall, scenes, planners, runs => results.runs.len(),
        keys => Value::from_safe_string(palette::keys(results.planners.len())),
        evidence => statistics(&evidence, &by_planner, &t), tuning => tuning_note(results, &t),
        worst => paths.then(|| worst::figure(results, &t)).flatten(), missing => missing::figure(results, &t),
        seed => results.seed.to_string(), repeats => results.repeats, seeds => seeds(results),
        manifest => provenance::manifest(&results.manifest, &t), machines => provenance::machines(results, &t),
    };
    render(&page).unwrap_or_else(|error| {
        // Only a mistake in the template gets here, and the tests render it.
        format!("<!doctype html><title>report</title><pre>{}</pre>", svg::escape(&error.to_string()))
    })
}

/// The figures and tables over all test scenes.
fn statistics(evidence: &Evidence<'_>, by_planner: &[moving::ByScene<'_>], t: &Strings) -> Value {
    let subject = evidence.results.subject;
    let paths = subject == Subject::Paths;
    let both = |figure: &dyn Fn(Effort) -> Option<Value>| -> Vec<Value> {
        [Effort::Evaluations, Effort::Time].into_iter().filter(|_| paths).filter_map(figure).collect()
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
        families => paths.then(|| families::figure(evidence, t)).flatten(),
        compute => (subject == Subject::Simulation)
            .then(|| moving::compute::figure(evidence.results, by_planner, "compute", t)).flatten(),
        budgets => paths.then(|| variants::budgets(evidence, t)).flatten(), variants => variants::groups(evidence, t),
        ecdf => both(&|effort| ecdf::figure(evidence, effort, t)),
        ert => both(&|effort| ert::figure(evidence, effort, t)),
        fixed => both(&|effort| fixed_budget::figure(evidence, effort, t)),
        critical => critical_difference::figure(evidence, t),
        pairwise => pairwise::figure(evidence, t), sentences => answers::sentences(evidence, t),
        own => paths.then(|| own_objective::figure(evidence, t)).flatten(), noise => provenance::times(evidence, t),
    }
}

/// Every planner's runs in `scenes`, scene by scene.
fn by_planner<'a>(results: &'a Results, scenes: &[&'a SceneResult]) -> Vec<moving::ByScene<'a>> {
    let runs =
        |planner: &'a str, scene: &'a str| -> Vec<&'a RunRecord> { results.runs_of(planner, Some(scene)).collect() };
    let of = |planner: &'a str| scenes.iter().map(|s| runs(planner, &s.scene.name)).collect();
    results.planners.iter().map(|p| of(&p.label)).collect()
}

/// How behaviour control was tuned, and what came of it.
fn search(results: &Results, t: &Strings) -> Value {
    context! {
        spread => tuning::tables::spread(results, t), generations => tuning::generations::figure(results, t),
        parameters => tuning::parameters::parameters(results, t), weights => tuning::parameters::weights(results, t),
        protocol => results.protocol.trim_end(),
    }
}

/// Which scenes take no part in statistics.
fn tuning_note(results: &Results, t: &Strings) -> Option<String> {
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
    let parts = [
        include_str!("macros.html"),
        include_str!("evidence.html"),
        include_str!("moving/player.html"),
        include_str!("page.html"),
    ]
    .concat();
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
