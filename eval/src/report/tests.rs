//! The page as a whole: complete, escaped, well formed, and whole with poor data.

use env_model::{Obstacle, Point, Scene, Shape};

use super::svg::{PathLayer, scene_svg};
use super::*;
use crate::results::{Optimum, PlannerInfo, Progress, RunRecord, RunStatus, SceneSet, Subject};
use crate::snapshot::{Heat, Mesh, Ruler, Snapshot, State, Tree};

/// A run with a path of that length, or without path.
pub fn run(scene: &str, planner: &str, repeat: u32, length: Option<f64>) -> RunRecord {
    let path =
        length.map_or(Vec::new(), |l| vec![Point::new(0.0, 0.0), Point::new(5.0, l - 10.0), Point::new(10.0, 0.0)]);
    RunRecord {
        scene: scene.to_owned(),
        planner: planner.to_owned(),
        repeat,
        seed: 1000 + u64::from(repeat),
        status: if length.is_some() { RunStatus::Solved } else { RunStatus::NotFound },
        valid: length.is_some(),
        length,
        gap: length.map(|l| l / 10.0 - 1.0),
        clearance_min: length.map(|_| 0.1),
        turning: length.map(|_| 0.5),
        iterations: 10,
        evaluations: 200,
        collision_checks: 4000,
        time_us: 12.5,
        cpu_us: 12.0,
        error: None,
        cost: length,
        terms: Vec::new(),
        path,
        progress: Vec::new(),
        overhead_us: None,
        moving: None,
        tuning: None,
    }
}

pub fn scene(name: &str) -> Scene {
    let mut scene = Scene {
        name: name.to_owned(),
        unit: "cm".to_owned(),
        robot_radius: 0.5,
        start: [0.0, 0.0],
        goal: [10.0, 0.0],
        field: None,
        obstacles: vec![
            Obstacle::disc(Point::new(3.0, 3.0), 1.0),
            Shape::Capsule { from: [5.0, -3.0], to: [7.0, -4.0], radius: 0.5 }.into(),
            Shape::Polygon(vec![[6.0, 4.0], [8.0, 4.0], [7.0, 6.0]]).into(),
        ],
    };
    scene.obstacles[0].label = Some("<b>opponent & \"3\"</b>".to_owned());
    scene
}

pub fn results(planners: &[&str], scenes: &[&str], repeats: u32) -> Results {
    let mut runs = Vec::new();
    for s in scenes {
        for (i, p) in planners.iter().enumerate() {
            for k in 0..repeats {
                let mut r = run(s, p, k, (k % 5 != 4 || i == 0).then_some(10.0 + 0.1 * f64::from(k) + i as f64));
                r.progress = (0..8)
                    .map(|j| Progress {
                        evaluations: 1 << j,
                        time_us: f64::from(j),
                        cost: 10.0 + 1e4 / f64::from(1 << (2 * j)),
                    })
                    .collect();
                runs.push(r);
            }
        }
    }
    let optimum = Optimum { length: Some(10.0), path: vec![Point::new(0.0, 0.0), Point::new(10.0, 0.0)], reason: None };
    let planner = |p: &&str| PlannerInfo::plain(p, "pso", "particles = 20\n");
    Results {
        name: "test".into(),
        seed: 1,
        repeats,
        subject: Subject::Paths,
        protocol: String::new(),
        planners: planners.iter().map(planner).collect(),
        scenes: scenes
            .iter()
            .map(|s| SceneResult { scene: scene(s), optimum: optimum.clone(), set: SceneSet::Test, simulation: None })
            .collect(),
        runs,
        snapshots: Vec::new(),
        traces: Vec::new(),
        manifest: Manifest { version: "0.1.0".into(), jobs: 1, cores: 2, ..Manifest::default() },
    }
}

/// Every tag in `markup` is closed in order. Returns what is wrong.
fn unbalanced(markup: &str) -> Option<String> {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = markup;
    while let Some((_, after)) = rest.split_once('<') {
        let Some((tag, tail)) = after.split_once('>') else { return Some(format!("unfinished <{after}")) };
        if tag.matches('"').count() % 2 == 1 {
            return Some(format!("odd quotes in <{tag}>"));
        }
        if let Some(name) = tag.strip_prefix('/') {
            if open.pop() != Some(name) {
                return Some(format!("</{name}> closes nothing"));
            }
        } else if !tag.ends_with('/') {
            open.push(tag.split([' ', '\n']).next().unwrap_or(tag));
        }
        rest = tail;
    }
    open.pop().map(|tag| format!("<{tag}> is not closed"))
}

/// Checks that hold for every page.
pub fn check(page: &str) {
    assert!(page.starts_with("<!doctype html>"), "{}", &page[..page.len().min(300)]);
    assert!(page.trim_end().ends_with("</html>"));
    for bad in ["NaN", ">inf<", ">None<", ">none<", "undefined:", "http:", "https:", "//cdn", "@import"] {
        assert!(
            !page.contains(bad),
            "{bad:?} near {:?}",
            page.split_once(bad).map(|(b, _)| &b[b.len().saturating_sub(80)..])
        );
    }
    for svg in page.split("<svg").skip(1) {
        let svg = format!("<svg{}</svg>", svg.split_once("</svg>").expect("closed").0);
        assert_eq!(unbalanced(&svg), None, "{svg:.400}");
    }
    let mut ids: Vec<&str> = page.split(" id=\"").skip(1).filter_map(|s| s.split_once('"')).map(|(id, _)| id).collect();
    let all = ids.len();
    ids.sort_unstable();
    ids.dedup();
    assert_eq!(ids.len(), all, "ids are unique");
    for target in page.split("href=\"#").skip(1).filter_map(|s| s.split_once('"')).map(|(id, _)| id) {
        assert!(ids.binary_search(&target).is_ok(), "#{target} leads somewhere");
    }
}

#[test]
fn the_page_holds_every_planner_and_figure() {
    let results = results(&["straight-line", "pso", "pso-qp"], &["one"], 10);
    for language in [Language::English, Language::Chinese] {
        let page = html(&results, language);
        check(&page);
        assert!(page.contains(&format!("<html lang=\"{}\"", language.tag())));
        for planner in ["straight-line", "pso", "pso-qp"] {
            assert!(page.contains(&format!("<span>{planner}</span>")), "{planner}");
        }
        // Two pictures a planner, convergence, gaps, times; targets, expected times and budgets by evaluations and by
        // time, ranks; of each planner the largest gap, of two a run without path.
        let charts: Vec<&str> =
            page.split("class=\"chart-block\" id=\"").skip(1).filter_map(|s| Some(s.split_once('"')?.0)).collect();
        assert_eq!(page.matches("<figcaption>").count(), 3 * 2 + 3 + 7 + 5, "{charts:?}");
        assert_eq!(page.matches("class=\"fig").count(), 3 * 2 + 3 + 7 + 5);
    }
}

/// Every kind of state, as small as it gets, and as odd as a damaged record may hold it.
fn states() -> Vec<State> {
    let mesh = |columns, rows| Mesh { min: [-1.0, -6.0], size: 3.0, columns, rows, every: 2, whole: None };
    let line = vec![[0, 0], [9000, 9000], [20_000, 12_000]];
    let heat = |levels| Heat { quantity: "risk".to_owned(), log: false, min: 0.0, max: 100.0, levels };
    let cells = |mesh, marks: &str, heat| State::Cells {
        mesh,
        marks: marks.to_owned(),
        counts: None,
        heat,
        borders: vec![[[0, 0], [100, 100]]],
        path: line.clone(),
    };
    let tree = |parents| Tree { nodes: line.clone(), parents, total: 99 };
    vec![
        State::Swarm {
            rectangle: line.clone(),
            particles: vec![line.clone(), Vec::new()],
            bests: vec![line.clone()],
            best: line.clone(),
            total: 300,
        },
        cells(mesh(4, 3), "#ox.#ox.#ox.", Some(heat(vec![0, 255, 254, 127, 1, 2, 3, 4, 5, 6, 7, 8]))),
        cells(mesh(4, 3), "#o", Some(Heat { log: true, min: 1e-120, quantity: "<b>".to_owned(), ..heat(vec![3]) })),
        cells(mesh(0, 3), "", None),
        State::Trees(vec![tree(vec![0, 0, 1]), tree(vec![1, 2, 1]), tree(vec![7])]),
        State::Population { paths: vec![line.clone(); 3], mesh: Some(mesh(2, 2)), best: line.clone(), total: 3 },
        State::Forces { mesh: mesh(4, 3), directions: vec![[70, 70]; 12], trail: line.clone(), stuck: Some([5, 5]) },
        State::Forces { mesh: mesh(4, 3), directions: vec![[70, 70]], trail: Vec::new(), stuck: None },
    ]
}

#[test]
fn what_planners_did_is_drawn() {
    let states = states();
    let labels: Vec<String> = (0..states.len()).map(|i| format!("planner-{i}")).collect();
    let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
    let mut results = results(&labels, &["one", "two", "three", "four"], 2);
    for obstacles in [1, 200] {
        results.snapshots.clear();
        for scene in &mut results.scenes {
            let disc = |k: usize| Obstacle::disc(Point::new(3.0, 3.0 + 0.01 * k as f64), 1.0);
            scene.scene.obstacles = (0..obstacles).map(disc).collect();
            results.snapshots.extend(states.iter().zip(&labels).map(|(state, label)| Snapshot {
                scene: scene.scene.name.clone(),
                planner: (*label).to_owned(),
                repeat: 1,
                seed: 1001,
                stage: "stage".to_owned(),
                iteration: 12,
                evaluations: 345,
                faithful: *label != "planner-0",
                ruler: Ruler { origin: [0.0, 0.0], step: 0.0005 },
                state: state.clone(),
                generations: if matches!(state, State::Population { .. }) {
                    vec![(0, 0.5, 0.25), (12, 0.75, 0.5)]
                } else {
                    Vec::new()
                },
            }));
        }
        for language in [Language::English, Language::Chinese] {
            let page = html(&results, language);
            check(&page);
            // In the three scenes that are shown in full, not in the fourth.
            assert_eq!(page.matches("<figure class=\"own\">").count(), 3 * states.len());
            assert_eq!(page.matches("class=\"heat bar\"").count(), 3 * 2);
            assert_eq!(page.matches("class=\"line c5 mean\"").count(), 3);
        }
        let page = html(&results, Language::English);
        let said = [
            (
                "the run and the frame",
                "after 12 iterations and 345 evaluations, from an untimed replay of repeat 1 (seed 1001)",
            ),
            ("another path", "path differs from the run"),
            ("what is left out", "Only the first 2 of 300 are drawn."),
            ("an unknown quantity", "Colour is &lt;b&gt;, from 10⁻¹²⁰ to 100"),
            ("where it is stuck", "The cross marks (0.0025, 0.0025)"),
        ];
        for (what, words) in said {
            assert!(page.contains(words), "{what}");
        }
    }
}

#[test]
fn marks_of_cells_do_not_depend_on_the_ground() {
    let css = include_str!("figure.css");
    for class in [".dotted", ".closed", ".across", ".down"] {
        let rules: Vec<&str> = css.split_inclusive('}').filter(|rule| rule.trim_start().starts_with(class)).collect();
        assert!(!rules.is_empty() && rules.iter().all(|rule| !rule.contains("var(")), "{class}: {rules:?}");
    }
}

/// The page of one planner that showed `state`.
fn shown(state: State) -> String {
    let mut results = results(&["planner"], &["one"], 1);
    results.snapshots.push(Snapshot {
        scene: "one".to_owned(),
        planner: "planner".to_owned(),
        repeat: 0,
        seed: 1000,
        stage: "stage".to_owned(),
        iteration: 12,
        evaluations: 345,
        faithful: true,
        ruler: Ruler { origin: [0.0, 0.0], step: 0.0005 },
        state,
        generations: Vec::new(),
    });
    html(&results, Language::English)
}

#[test]
fn keys_show_the_marks_of_the_picture() {
    let page = shown(states().swap_remove(1));
    let figure = page.split_once("class=\"own\"").unwrap().1.split_once("</figure>").unwrap().0;
    for class in ["closed", "closed core", "across", "down", "across core", "down core"] {
        assert_eq!(figure.matches(&format!("<path class=\"{class}\"")).count(), 2, "{class}: once in each");
    }
}

#[test]
fn thinned_grids_are_described_as_the_planner_had_them() {
    let mut state = states().swap_remove(1);
    let State::Cells { mesh, counts, .. } = &mut state else { panic!() };
    (mesh.whole, *counts) = (Some([7, 5]), Some([9, 8, 0]));
    let page = shown(state);
    let figure = page.split_once("class=\"own\"").unwrap().1;
    assert!(figure.contains("grid of 7 × 5 cells. One row and one column in 2 of"), "size");
    let table = figure.split_once("expanded cell</t").unwrap().1.split_once("</tr>").unwrap().0;
    assert!(table.contains(">8<"), "{table}");
}

#[test]
fn the_cross_lies_over_start_and_goal() {
    let page = shown(states().swap_remove(6));
    let figure = page.split_once("class=\"own\"").unwrap().1.split_once("</svg>").unwrap().0;
    assert!(figure.rfind("class=\"cross\"").unwrap() > figure.rfind("class=\"goal").unwrap());
    assert_eq!(unbalanced(&format!("{}</svg>", &figure[figure.find("<svg").unwrap()..])), None);
}

#[test]
fn one_run_is_not_many() {
    let one = html(&results(&["a"], &["one"], 1), Language::English);
    assert!(one.contains("The path of the only run, which is valid: ") && one.contains("1 run, which is valid."));
    let mut failed = results(&["a"], &["one"], 1);
    (failed.runs[0].valid, failed.runs[0].gap) = (false, None);
    let invalid = html(&failed, Language::English);
    assert!(invalid.contains("1 run, which is not valid.") && invalid.contains("The only run gave no valid path."));
    failed.runs[0].path.clear();
    let empty = html(&failed, Language::English);
    assert!(empty.contains("The only run gave no path at all."));
    let mut two = results(&["a"], &["one"], 2);
    two.runs[0].valid = false;
    let two = html(&two, Language::English);
    assert!(two.contains("The only valid path in 2 runs:") && two.contains("2 runs overlaid, 1 of them valid."));
    for page in [one, invalid, empty, two] {
        for bad in ["1 runs", "1 valid paths", "1 are "] {
            let hit = page
                .match_indices(bad)
                .find(|(at, _)| !page[..*at].ends_with(|c: char| c.is_ascii_digit()) && !page[..*at].ends_with("of "));
            assert!(hit.is_none(), "{bad:?} in {:?}", hit.map(|(at, _)| &page[at.saturating_sub(60)..at + 20]));
        }
    }
}

#[test]
fn labels_cannot_break_out() {
    let evil = "<script>alert(\"1\")</script>'&规划器";
    let mut results = results(&["pso", evil], &[evil], 5);
    results.name = evil.to_owned();
    results.runs[0].error = Some(evil.to_owned());
    results.scenes[0].optimum = Optimum { length: None, path: Vec::new(), reason: Some(evil.to_owned()) };
    results.planners[1].settings = format!("command = [\"{evil}\"]");
    results.manifest.cpu = evil.to_owned();
    let page = html(&results, Language::English);
    check(&page);
    assert!(!page.contains("<script>alert"), "escaped everywhere");
    assert_eq!(page.matches("<script>").count(), 1, "only our own");
    assert!(page.contains("规划器"));
    let picture = scene_svg(
        &results.scenes[0].scene,
        None,
        &[PathLayer { label: evil, points: &results.runs[0].path, valid: true, series: 0 }],
    );
    assert_eq!(unbalanced(&picture), None, "{picture}");
    assert!(!picture.contains("<script"));
}

#[test]
fn poor_data_does_not_break_the_page() {
    let full = || results(&["a", "b"], &["one"], 6);
    let mut nothing_valid = full();
    for r in &mut nothing_valid.runs {
        (r.valid, r.gap, r.clearance_min) = (false, None, Some(-0.3));
    }
    let mut no_paths = full();
    for r in &mut no_paths.runs {
        (r.valid, r.gap, r.length, r.status) = (false, None, None, RunStatus::Infeasible);
        r.path.clear();
        r.progress.clear();
    }
    let mut hostile = full();
    for (k, r) in hostile.runs.iter_mut().enumerate() {
        r.path = vec![Point::new(0.0, 0.0), Point::new([f64::NAN, f64::INFINITY, 1e300][k % 3], 0.0)];
        r.progress[0].cost = [f64::NAN, f64::INFINITY, -1.0][k % 3];
        r.time_us = 0.0;
        (r.valid, r.gap, r.length, r.turning) = (false, None, Some(f64::NAN), Some(f64::NAN));
    }
    let mut no_runs = full();
    no_runs.runs.clear();
    let mut nothing = results(&[], &[], 0);
    nothing.manifest = Manifest::default();
    let one_run = results(&["a"], &["one"], 1);
    let mut no_optimum = full();
    no_optimum.scenes[0].optimum = Optimum { length: None, path: Vec::new(), reason: None };
    let cases = [nothing_valid, no_paths, hostile, no_runs, nothing, one_run, no_optimum];
    for (i, results) in cases.iter().enumerate() {
        let page = html(results, Language::English);
        assert!(page.contains("id=\"machine\""), "case {i} has its end");
        check(&page);
    }
}

#[test]
fn notes_on_scenes_are_shown_up_to_ten() {
    let mut results = results(&["a"], &["one"], 1);
    results.manifest.notes = (1..=10).map(|n| format!("scene-{n}: <drawn> smaller")).collect();
    let page = html(&results, Language::English);
    check(&page);
    assert_eq!(page.matches("&lt;drawn&gt; smaller").count(), 10);
    assert!(!page.contains("manifest.json</p>"), "nothing is left out");
    results.manifest.notes.extend(["one".to_owned(), "two".to_owned()]);
    assert!(html(&results, Language::Chinese).contains("+ 2: manifest.json</p>"));
}

#[test]
fn absurd_scenes_are_drawn_somehow() {
    for size in [1e-320, 1e-310, 1e-200, 1e-20, 1e20, 1e200, 1e307] {
        let mut results = results(&["a", "b"], &["one"], 6);
        let scene = &mut results.scenes[0].scene;
        (scene.start, scene.goal, scene.robot_radius) = ([0.0, 0.0], [10.0 * size, 0.0], 0.5 * size);
        scene.obstacles = vec![
            Obstacle::disc(Point::new(3.0 * size, 3.0 * size), size),
            Shape::Capsule { from: [5.0 * size, -size], to: [7.0 * size, -size], radius: 0.5 * size }.into(),
        ];
        scene.field = Some(env_model::scene::Field { min: [-size, -6.0 * size], max: [12.0 * size, 8.0 * size] });
        for r in &mut results.runs {
            r.path = vec![Point::new(0.0, 0.0), Point::new(5.0 * size, 2.0 * size), Point::new(10.0 * size, 0.0)];
            r.length = r.length.map(|l| l * size);
            r.time_us *= size;
            r.progress.iter_mut().for_each(|p| p.cost *= size);
        }
        for optimum in [Some(10.0 * size), None] {
            results.scenes[0].optimum.length = optimum;
            check(&html(&results, Language::English));
        }
    }
}

#[test]
fn an_unfinished_campaign_says_so_first() {
    let mut results = results(&["a", "b"], &["one", "two"], 400);
    results.manifest.finished = "2026-01-01T00:00:00Z".to_owned();
    let complete = html(&results, Language::English);
    assert!(!complete.contains("class=\"unfinished\"") && !complete.contains("has not ended"));
    results.manifest.finished.clear();
    results.runs.truncate(630);
    for (language, notice, end) in [
        (Language::English, "Unfinished: 630 of 1600 runs are there", "<dd>has not ended</dd>"),
        (Language::Chinese, "尚未完成：1600 次运行中已有 630 次", "<dd>尚未结束</dd>"),
    ] {
        let page = html(&results, language);
        check(&page);
        assert!(page.find(notice).unwrap() < page.find("class=\"size\"").unwrap());
        assert!(page.contains(end));
    }
    assert!(html(&results, Language::English).contains("So far: 630 runs."));
}

#[test]
fn gaps_of_some_scenes_crown_nobody() {
    let mut results = results(&["a", "b"], &["one", "two", "three"], 10);
    let best = |results: &Results| {
        let page = html(results, Language::English);
        page.split_once("<dt>Best paths</dt>").unwrap().1.split_once("</dd>").unwrap().0.to_owned()
    };
    assert!(best(&results).contains("median gap"));
    results.scenes[1].optimum = Optimum { length: None, path: Vec::new(), reason: Some("no way".to_owned()) };
    for r in results.runs.iter_mut().filter(|r| r.scene == "two") {
        r.gap = None;
    }
    let page = html(&results, Language::English);
    check(&page);
    assert!(!best(&results).contains("gap") && best(&results).contains("× the shortest path found"));
    assert!(page.contains("—: no median gap, because the exact optimum is not known in every scene."));
    assert!(
        page.contains("In this figure: 40 runs. Left out, because the optimum of their scene is not known: 20 runs.")
    );
    let table = page.split_once("id=\"overall-table\"").unwrap().1.split_once("</table>").unwrap().0;
    assert_eq!(table.matches(">—</td>").count(), 2, "no gap for either planner");
}

#[test]
fn many_scenes_are_folded() {
    let names: Vec<String> = (0..30).map(|i| format!("wall-s2-{i:02}")).collect();
    let names: Vec<&str> = names.iter().map(String::as_str).collect();
    let page = html(&results(&["a", "b"], &names, 2), Language::English);
    check(&page);
    assert_eq!(page.matches("<section class=\"scene\"").count(), FULL);
    assert_eq!(page.matches("<details class=\"scene\"").count(), 30 - FULL);
    for name in names {
        assert!(page.contains(&format!("<summary>{name}</summary>")) || page.contains(&format!("</span> {name}</h2>")));
    }
}

#[test]
fn large_campaigns_stay_small() {
    let labels: Vec<String> = (0..20).map(|i| format!("planner-{i}")).collect();
    let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
    let mut results = results(&labels, &["one"], 200);
    for (i, r) in results.runs.iter_mut().enumerate() {
        // Different paths of 22 points, as the 2012 planner's are.
        r.path = (0..22)
            .map(|k| Point::new(10.0 * f64::from(k) / 21.0, ((i * 31 + k as usize * 17) % 97) as f64 * 0.03))
            .collect();
    }
    let size = html(&results, Language::English).len();
    // The target for the largest page that a browser still opens at once is 12 MB; one scene may take half.
    assert!(size < 6_000_000, "{size} bytes");
}

#[test]
fn a_picture_stands_alone() {
    let scene = Scene { field: Some(env_model::scene::Field { min: [-2.0, -6.0], max: [12.0, 8.0] }), ..scene("one") };
    let path = [Point::new(0.0, 0.0), Point::new(10.0, 0.0)];
    let layers = [
        PathLayer { label: "pso", points: &path, valid: true, series: 1 },
        PathLayer { label: "bad", points: &path, valid: false, series: 2 },
    ];
    let picture = scene_svg(&scene, Some(&path), &layers);
    assert_eq!(unbalanced(&picture), None, "{picture}");
    assert!(picture.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\""));
    assert!(!picture.contains("var(") && !picture.contains("NaN"));
    for words in ["pso", "bad (invalid)", "exact optimum", "start", "goal"] {
        assert!(picture.contains(&format!(">{words}</text>")), "{words}");
    }
    // y points up: the field's top edge (y = 8) is drawn above its bottom edge, so its rectangle has a height.
    let field = picture.split_once("class=\"field\"").unwrap().1.split_once("/>").unwrap().0;
    let height: f64 = field.split_once("height=\"").unwrap().1.split_once('"').unwrap().0.parse().unwrap();
    assert!(height > 100.0, "{field}");
    assert_eq!(scene_svg(&scene, None, &[]).matches("</text>").count(), picture.matches("</text>").count() - 3);
}

#[test]
fn tuning_scenes_are_kept_apart() {
    let mut results = results(&["a", "b"], &["one", "two", "three"], 10);
    let everything = html(&results, Language::English);
    assert!(!everything.contains("Kept apart") && everything.contains("Over 3 scenes."));
    results.scenes[1].set = SceneSet::Tuning;
    // What happens there must not matter, however bad.
    for r in results.runs.iter_mut().filter(|r| r.scene == "two" && r.planner == "a") {
        (r.valid, r.gap, r.length, r.cost) = (false, None, None, None);
        r.path.clear();
    }
    let page = html(&results, Language::English);
    check(&page);
    assert!(page.contains("Kept apart: 1 scene on which settings were chosen (two)."));
    assert!(page.contains("Over 2 scenes that the planners are compared on; without 1 tuning scene."));
    assert_eq!(page.matches("A tuning scene: settings were chosen on it").count(), 1);
    let table = page.split_once("id=\"overall-table\"").unwrap().1.split_once("</table>").unwrap().0;
    assert!(table.contains("20&#x2f;20"), "{table}");
    results.scenes.iter_mut().for_each(|s| s.set = SceneSet::Tuning);
    check(&html(&results, Language::Chinese));
}

#[test]
fn every_kind_of_failure_is_told() {
    let mut results = results(&["a", "b"], &["one", "two"], 10);
    let kinds = [RunStatus::Error, RunStatus::Crashed, RunStatus::Timeout, RunStatus::OutOfMemory];
    for (r, status) in results.runs.iter_mut().filter(|r| r.planner == "b" && r.scene == "one").zip(kinds) {
        (r.valid, r.gap, r.length, r.cost, r.status) = (false, None, None, None, status);
        r.path.clear();
        r.error = Some(format!("<{}>", status.name()));
    }
    let lost = |r: &RunRecord| r.planner == "b" && r.scene == "two" && r.repeat >= 7;
    results.runs.retain(|r| !lost(r));
    let page = html(&results, Language::English);
    check(&page);
    let table = page.split_once("id=\"missing-scenes\"").unwrap().1.split_once("</table>").unwrap().0;
    let row = |scene: &str| {
        let row = table.split("<tr>").find(|r| r.contains("b</th>") && r.contains(&format!(">{scene}</td>"))).unwrap();
        let shown = |c: &str| c.split_once('>').unwrap().1.split_once('<').unwrap().0.to_owned();
        row.split("<td ").skip(2).map(shown).collect::<Vec<_>>()
    };
    // Not run, error, crashed, timed out, out of memory, no path (repeats 4 and 9), of.
    assert_eq!(row("one"), ["—", "1", "1", "1", "1", "2", "10"], "{table}");
    assert_eq!(row("two"), ["3", "—", "—", "—", "—", "1", "10"], "{table}");
    let worst = page.split_once("id=\"worst\"").unwrap().1.split_once("id=\"missing\"").unwrap().0;
    assert!(worst.contains("error: &lt;error&gt;"), "the first failure of the planner");
    assert!(worst.contains("touchline plan scenes&#x2f;one.toml --planner pso --seed 1000"), "{worst}");
}

#[test]
fn variants_and_budgets_are_set_side_by_side() {
    let mut results = results(&["pso[400 iterations]", "pso[5 ms]", "other"], &["one", "two"], 6);
    for (planner, varied) in results.planners.iter_mut().zip(["400 iterations", "5 ms"]) {
        (planner.group, planner.varied) = ("pso".to_owned(), varied.to_owned());
    }
    results.planners[0].budget.iterations = Some(400);
    results.planners[1].budget.time_ms = Some(5.0);
    results.planners[2].budget.time_ms = Some(5.0);
    let page = html(&results, Language::English);
    check(&page);
    let budgets = page.split_once("id=\"budgets-table\"").unwrap().1.split_once("</table>").unwrap().0;
    assert!(budgets.contains(">400 iterations<") && budgets.contains(">5\u{a0}ms<"), "{budgets}");
    assert!(page.contains("Variants of pso"));
    let variants = page.split_once("id=\"variants-0\"").unwrap().1.split_once("</table>").unwrap().0;
    assert_eq!(variants.matches("<tr>").count(), 3, "a head and two variants");
}

#[test]
fn the_entry_answers_for_each_count_budget() {
    let labels = ["a[10 evaluations]", "a[1000 evaluations]", "quick", "quick-2"];
    let mut results = results(&labels, &["one", "two"], 3);
    for (p, (group, budget)) in results.planners.iter_mut().zip([("a", 10), ("a", 1000), ("q", 1000), ("q", 1000)]) {
        (p.group, p.budget.evaluations) = (group.to_owned(), Some(budget));
    }
    // The last two need 4 evaluations of their 1000; the other 1000 are spent for a better path.
    for r in &mut results.runs {
        r.progress.clear();
        (r.evaluations, r.length) = match r.planner.as_str() {
            "a[10 evaluations]" => (10, Some(10.9)),
            "a[1000 evaluations]" => (1000, Some(10.05)),
            "quick" => (4, Some(10.5)),
            _ => (4, Some(10.6)),
        };
        (r.valid, r.cost, r.gap) = (true, r.length, r.length.map(|l| l / 10.0 - 1.0));
    }
    let page = html(&results, Language::English);
    check(&page);
    let best = |question: &str| {
        let answer = page.split_once(&format!("<dt>{question}</dt>")).expect(question).1.split_once("</dd>").unwrap().0;
        labels.iter().copied().filter(|l| answer.contains(&format!("<span>{l}</span>"))).collect::<Vec<_>>()
    };
    assert_eq!(best("Best within 10 evaluations"), ["quick"]);
    assert_eq!(best("Best within 1000 evaluations"), ["a[1000 evaluations]"]);
    assert_eq!(best("Fastest good planner"), ["a[1000 evaluations]"], "no other is within 1 %");
    let budgets = page.split_once("id=\"budgets-table\"").unwrap().1.split_once("</table>").unwrap().0;
    let row = |budget: &str| budgets.split_once(&format!(">{budget}<")).unwrap().1.split_once("</tr>").unwrap().0;
    assert!(row("10 evaluations").contains("quick: 5") && row("10 evaluations").contains(">nobody<"), "{budgets}");
    assert!(row("1000 evaluations").contains("a[1000 evaluations]: 0.5"), "{budgets}");
    let quotes = page.split_once("<ul class=\"quotes\">").unwrap().1.split_once("</ul>").unwrap().0;
    assert_eq!(quotes.matches("<li>").count(), 2, "one of each group: {quotes}");
}

/// What stands between two marks.
fn between<'a>(page: &'a str, from: &str, to: &str) -> &'a str {
    page.split_once(from).expect(from).1.split_once(to).expect(to).0
}

/// The cells of the row about `label` in a table.
fn cells(table: &str, label: &str) -> Vec<String> {
    let row = table.split("<tr>").find(|r| r.contains(&format!("<span>{label}</span>"))).expect(label);
    row.split("<td ").skip(1).map(|c| between(c, ">", "<").to_owned()).collect()
}

fn fail(run: &mut RunRecord, status: RunStatus, error: Option<&str>) {
    (run.valid, run.gap, run.status) = (false, None, status);
    run.error = error.map(str::to_owned);
}

#[test]
fn failures_in_tuning_scenes_are_told_apart() {
    let mut results = results(&["a", "b"], &["one", "two", "three"], 3);
    results.scenes[0].set = SceneSet::Tuning;
    for r in results.runs.iter_mut().filter(|r| r.planner == "b" && (r.scene == "one" || r.repeat == 0)) {
        fail(r, RunStatus::NotFound, Some("the path ends at (9, 0) instead of (10, 0)"));
    }
    let page = html(&results, Language::English);
    check(&page);
    let table = between(&page, "id=\"missing-planners\"", "</table>");
    let rows: Vec<Vec<String>> = table
        .split("<tr>")
        .skip(2)
        .map(|row| row.split("<td ").skip(1).map(|c| between(c, ">", "<").to_owned()).collect())
        .collect();
    // Set, scenes with any, invalid paths, of.
    assert_eq!(rows, [["test", "2", "2", "6"], ["tuning", "1", "3", "3"]], "{table}");
    let worst = between(&page, "id=\"worst\"", "id=\"missing\"");
    assert!(worst.contains("not found: the path ends at (9, 0) instead of (10, 0)"), "{worst}");
    let scenes: Vec<&str> = worst.split("class=\"where\"").skip(1).map(|c| between(c, "\">", "</p>")).collect();
    let first_tuning = scenes.iter().position(|s| s.contains("tuning")).expect("marked");
    assert!(first_tuning > 0 && scenes[..first_tuning].iter().all(|s| !s.contains("one")), "{scenes:?}");
    assert!(scenes[first_tuning..].iter().all(|s| s.contains("one")), "{scenes:?}");
    results.scenes[0].set = SceneSet::Test;
    let page = html(&results, Language::English);
    assert!(!between(&page, "id=\"missing-planners\"", "</table>").contains("set of scenes"));
}

#[test]
fn scenes_without_runs_are_not_counted() {
    let mut results = results(&["a", "b"], &["wall-0", "wall-1", "wall-2", "dense-0"], 3);
    results.runs.retain(|r| r.scene == "wall-0" || r.scene == "wall-2");
    let page = html(&results, Language::English);
    check(&page);
    assert!(page.contains("Over 2 scenes."));
    assert!(!page.contains("wall (3)"));
    results.scenes[0].scene.name = "dense-1".to_owned();
    results.runs.iter_mut().filter(|r| r.scene == "wall-0").for_each(|r| r.scene = "dense-1".to_owned());
    results.runs.extend((0..3).map(|k| run("wall-1", "a", k, Some(11.0))));
    let page = html(&results, Language::English);
    let families = between(&page, "id=\"families-table\"", "</table>");
    assert!(families.contains("wall (2)") && families.contains(">dense-1<"), "{families}");
}

#[test]
fn failures_count_as_the_worst_in_every_table() {
    let one = html(&results(&["a"], &["one"], 3), Language::English);
    assert!(!one.contains("box and bar are of these runs"), "of one scene nothing is pooled");
    let mut results = results(&["a", "b"], &["one", "two"], 3);
    for r in results.runs.iter_mut().filter(|r| r.planner == "b") {
        fail(r, RunStatus::NotFound, None);
        r.terms = vec![("bend".to_owned(), 2.5)];
    }
    let page = html(&results, Language::English);
    check(&page);
    let own = between(&page, "id=\"own-table\"", "</table>");
    assert_eq!(cells(own, "b"), ["∞", "∞", "bend ∞"], "{own}");
    assert!(cells(own, "a")[1].starts_with("10.1"), "{own}");
    let times = between(&page, "id=\"all-time-t\"", "</table>");
    let b = cells(times, "b");
    assert_eq!(b[b.len() - 2..], ["6", "6"], "failed and runs: {b:?}");
    let a = cells(times, "a");
    assert_eq!(a[a.len() - 2..], ["0", "6"], "{a:?}");
    assert_eq!(page.matches("box and bar are of these runs").count() % 2, 0, "in captions and descriptions");
    assert!(page.contains("box and bar are of these runs"));
}

#[test]
fn captions_name_who_is_charged_or_absent() {
    let all_well = html(&results(&["a", "b"], &["one"], 3), Language::English);
    assert!(!all_well.contains("charged the whole run") && !all_well.contains("Not in the figure"));
    let mut results = results(&["curve", "silent", "never"], &["one", "two"], 3);
    for r in &mut results.runs {
        match r.planner.as_str() {
            "silent" => r.progress.clear(),
            "never" => fail(r, RunStatus::NotFound, None),
            _ => {}
        }
    }
    let page = html(&results, Language::English);
    check(&page);
    let charged = "they are charged the whole run: silent.";
    for (figure, absent) in [
        ("ecdf-evaluations", "because they reach no target: never."),
        ("ert-time", "because they reach no target: never."),
        ("fixed-evaluations", "stay without a valid path: never."),
    ] {
        let chart = between(&page, &format!("id=\"{figure}\""), "</section>");
        let caption = between(chart, "<figcaption>", "</figcaption>");
        assert!(caption.contains(charged) && caption.contains(absent), "{figure}: {caption}");
    }
}

#[test]
fn merged_parts_name_their_machines() {
    let mut results = results(&["a"], &["one"], 2);
    let part =
        |shard: &str, cpu: &str| Manifest { shard: shard.to_owned(), cpu: cpu.to_owned(), ..results.manifest.clone() };
    let shards = vec![part("1/2", "left <cpu>"), part("2/2", "right cpu")];
    (results.manifest.shards, results.manifest.resumed, results.manifest.isolated) = (shards, 2, true);
    for (r, us) in results.runs.iter_mut().zip([300.0, 1500.0]) {
        r.overhead_us = Some(us);
    }
    let page = html(&results, Language::English);
    check(&page);
    assert!(page.contains("left &lt;cpu&gt; × 2") && page.contains(">right cpu × 2<"));
    assert!(page.contains("every planner in a process of its own"));
    assert!(page.contains("took 900\u{a0}µs in the median and 1.5\u{a0}ms at most"), "isolation is priced");
    assert!(page.contains("50\u{a0}% of them at most 1\u{a0}ms"));
}
