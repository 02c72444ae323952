//! Pages of tunings: curves, tables, and an honest sentence on what tuning was worth.

use super::super::tests::{check, scene};
use super::super::{Language, html};
use crate::results::{
    GenerationRecord, Manifest, Optimum, PlannerInfo, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
    TuningRun,
};

/// Given parameters of fitness about 0.6, and tuned ones that are `better` by so much; 12 pairs.
fn results(better: &[f64]) -> Results {
    let mut runs = Vec::new();
    let planners: Vec<String> = [0.0]
        .iter()
        .chain(better)
        .enumerate()
        .map(|(k, _)| if k == 0 { "given".to_owned() } else { format!("ga-{k}") })
        .collect();
    for (k, (gain, planner)) in [0.0].iter().chain(better).zip(&planners).enumerate() {
        for repeat in 0..12 {
            let seed = f64::from(repeat);
            // A gain of 0 is as often a little better as a little worse.
            let noise = if k > 0 && *gain == 0.0 { (seed - 5.5) * 1e-3 } else { 0.0 };
            let held_out = 0.6 + 0.01 * seed + gain + noise;
            let generation =
                |g: i32| GenerationRecord { max: 0.5 + 0.02 * f64::from(g), mean: 0.3 + 0.02 * f64::from(g) };
            let tuning = TuningRun {
                generations: if k > 0 { (0..12).map(generation).collect() } else { Vec::new() },
                parameters: vec![("goal_gain".to_owned(), 0.8 + gain * seed), ("noise_steps".to_owned(), 6.0)],
                training: (k > 0).then_some(0.72),
                held_out,
                each: vec![held_out],
                arrived: 0.9,
                collided: 0.1,
            };
            runs.push(RunRecord {
                status: RunStatus::Solved,
                valid: true,
                length: Some(1.0 - held_out),
                time_us: 1e6,
                tuning: Some(tuning),
                ..RunRecord::empty("held-out", planner, repeat, 1)
            });
        }
    }
    let optimum =
        Optimum { length: None, path: Vec::new(), reason: Subject::Behaviour.no_optimum().map(str::to_owned) };
    Results {
        name: "test".into(),
        seed: 1,
        repeats: 12,
        subject: Subject::Behaviour,
        protocol: "robots = 4\n[weights]\npath = 0.25\navoidance = 0.75\n".into(),
        planners: planners.iter().map(|p| PlannerInfo::plain(p, "behaviour", "")).collect(),
        scenes: vec![SceneResult { scene: scene("held-out"), optimum, set: SceneSet::Test, simulation: None }],
        runs,
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest: Manifest { version: "0.1.0".into(), jobs: 1, cores: 2, ..Manifest::default() },
    }
}

#[test]
fn curves_and_tables_are_there() {
    for language in [Language::English, Language::Chinese] {
        let page = html(&results(&[0.1, 0.0]), language);
        check(&page);
        assert_eq!(page.matches("class=\"milestone\"").count(), 2 * 2, "generations 4 and 9 of two planners");
        let generations = page.split_once("id=\"generations-data\"").unwrap().1.split_once("</table>").unwrap().0;
        // 0.5 + 0.02 · 4, 0.5 + 0.02 · 9, 0.3 + 0.02 · 4, 0.3 + 0.02 · 9.
        for fitness in ["0.58", "0.68", "0.38", "0.48"] {
            assert_eq!(generations.matches(&format!(">{fitness}<")).count(), 2, "{fitness}");
        }
        let weights = page.split_once("id=\"weights-table\"").unwrap().1.split_once("</table>").unwrap().0;
        assert!(weights.contains(">0.25<") && weights.contains(">0.75<"), "{weights}");
        let parameters = page.split_once("id=\"parameters-table\"").unwrap().1.split_once("</table>").unwrap().0;
        // Median of 0.8 + 0.1 · 0 … 11, and its ends.
        assert!(parameters.contains(">1.35<") && parameters.contains("0.8\u{a0}… 1.9"), "{parameters}");
    }
}

#[test]
fn it_says_whether_tuning_was_worth_it() {
    let page = html(&results(&[0.1, 0.0, -0.1]), Language::English);
    assert!(page.contains("<li>ga-1 is better than given on held-out scenarios, beyond noise"), "better");
    assert!(page.contains("<li>No improvement beyond noise: ga-2"), "the same");
    assert!(page.contains("<li>ga-3 is worse than given on held-out scenarios, beyond noise"), "worse");
}

#[test]
fn poor_data_make_poor_pages_but_pages() {
    let mut bare = results(&[0.1]);
    bare.runs.iter_mut().for_each(|r| r.tuning = None);
    bare.protocol = "weights = 3".to_owned();
    check(&html(&bare, Language::English));
    bare.runs.clear();
    check(&html(&bare, Language::English));
}

#[test]
fn a_search_and_none_are_not_compared_by_time() {
    let mut results = results(&[0.1]);
    results.runs.iter_mut().filter(|r| r.planner == "given").for_each(|r| r.time_us = 100.0);
    let page = html(&results, Language::English);
    let pairs = page.split_once("id=\"pairwise-table\"").unwrap().1.split_once("</table>").unwrap().0;
    assert!(pairs.contains("ratio A&#x2f;B") && !pairs.contains("time"), "{pairs}");
    assert!(page.contains("fitness") && !page.contains("times faster than"));
}
