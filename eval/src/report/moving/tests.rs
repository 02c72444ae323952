//! Pages of moving scenes: every robot is drawn where it ended, every contact is marked, nothing is empty.

use strategy::{Compute, Event, Metrics, RobotRecord, Settings, Trace, TraceBody};

use super::super::tests::{check, scene};
use super::super::{Language, html};
use crate::results::{
    Manifest, Moving, MovingTrace, Optimum, PlannerInfo, Results, RunRecord, RunStatus, SceneResult, SceneSet, Subject,
    TraceOf,
};

/// Two robots change places past an opponent and the ball; where `touch`, they meet after a second.
fn trace(touch: bool) -> Trace {
    let body = |side: &str| TraceBody { side: side.to_owned(), radius: 0.09 };
    let frame = |k: usize| {
        let x = -1.0 + 0.01 * k as f64;
        vec![[x, 0.3], [-x, -0.3], [0.0, 1.0], [0.2, -1.0]]
    };
    let event = Event { time_s: 1.0, bodies: [0, 1], at: [0.0, 0.0], closing: 2.0, foul: true };
    Trace {
        period_s: 0.01,
        bodies: vec![body("own"), body("own"), body("opponent"), body("ball")],
        frames: (0..=200).map(frame).collect(),
        events: if touch {
            vec![event, Event { foul: false, bodies: [0, 2], time_s: 1.5, ..event }]
        } else {
            Vec::new()
        },
    }
}

fn moving(clean: bool) -> Moving {
    let robot = |x: f64| RobotRecord {
        start: [-x, 0.3],
        goal: [x, 0.3],
        arrival_s: Some(2.0),
        least_s: 1.6,
        travelled: 2.1,
        collisions: u32::from(!clean),
    };
    let metrics = Metrics {
        duration_s: 2.0,
        robots: 2,
        arrived: 2,
        arrival_s: Some(2.0),
        least_s: 1.6,
        collisions: if clean { 0 } else { 2 },
        fouls: u32::from(!clean),
        least_clearance: Some(0.02),
        calls: 400,
        ..Metrics::default()
    };
    let compute =
        Compute { call_us: [1.0, 2.0, 3.0, 4.0], frame_us: [2.0, 4.0, 6.0, 20_000.0], misses: 1, total_us: 800.0 };
    Moving { metrics, compute, robots: vec![robot(1.0), robot(-1.0)] }
}

fn results(planners: &[&str], scenes: &[&str], repeats: u32) -> Results {
    let (mut runs, mut traces) = (Vec::new(), Vec::new());
    for name in scenes {
        for (p, planner) in planners.iter().enumerate() {
            for repeat in 0..repeats {
                // The first planner never fails, the last one always.
                let clean = p == 0 || p + 1 < planners.len() && repeat % 3 != 2;
                runs.push(RunRecord {
                    status: RunStatus::Solved,
                    valid: clean,
                    length: Some(2.0 + 0.01 * f64::from(repeat) + 0.1 * p as f64),
                    gap: clean.then_some(0.25),
                    time_us: 800.0,
                    moving: Some(moving(clean)),
                    ..RunRecord::empty(name, planner, repeat, u64::from(repeat))
                });
                let of = if clean { TraceOf::Median } else { TraceOf::FirstFailure };
                let kept = |k: &MovingTrace| k.scene == *name && k.planner == *planner && k.of == of;
                if !traces.iter().any(kept) {
                    let (scene, planner) = ((*name).to_owned(), (*planner).to_owned());
                    traces.push(MovingTrace {
                        scene,
                        planner,
                        repeat,
                        seed: 1,
                        of,
                        faithful: clean,
                        trace: trace(!clean),
                    });
                }
            }
        }
    }
    let optimum =
        Optimum { length: None, path: Vec::new(), reason: Subject::Simulation.no_optimum().map(str::to_owned) };
    let scene = |name: &&str| SceneResult {
        scene: scene(name),
        optimum: optimum.clone(),
        set: SceneSet::Test,
        simulation: Some(Settings::default()),
    };
    Results {
        name: "test".into(),
        seed: 1,
        repeats,
        subject: Subject::Simulation,
        protocol: String::new(),
        planners: planners.iter().map(|p| PlannerInfo::plain(p, "orca", "horizon_s = 2.0\n")).collect(),
        scenes: scenes.iter().map(scene).collect(),
        runs,
        snapshots: Vec::new(),
        traces,
        manifest: Manifest { version: "0.1.0".into(), jobs: 1, cores: 2, ..Manifest::default() },
    }
}

/// What stands between `from` and `to` in `page`, everywhere.
fn between<'a>(page: &'a str, from: &str, to: &'a str) -> Vec<&'a str> {
    page.split(from).skip(1).filter_map(|s| Some(s.split_once(to)?.0)).collect()
}

#[test]
fn pages_are_whole() {
    for scenes in [&["one"][..], &["one", "two", "three", "four"]] {
        for language in [Language::English, Language::Chinese] {
            let page = html(&results(&["a", "b", "<c>"], scenes, 8), language);
            check(&page);
            // A median of a and b, a first failure of b and c; scenes beyond the third have no pictures.
            let full = scenes.len().min(3);
            assert_eq!(page.matches("<figure class=\"clip\"").count(), 4 * full);
            assert_eq!(page.matches("class=\"tracks\"").count(), 4 * full);
            assert_eq!(page.matches("class=\"fig").count(), page.matches("<figcaption>").count());
            assert_eq!(page.matches("id=\"compute\"").count(), 1);
            for key in ["{clean}", "{ratio}", "moving_", "player_", "compute_"] {
                assert!(!page.contains(&format!(">{key}")), "{key} is filled in");
            }
        }
    }
}

#[test]
fn the_answer_says_who_loses_least_and_where_others_fail() {
    let page = html(&results(&["a", "b", "c"], &["one"], 9), Language::English);
    let first = page.split_once("<dt>Loses least</dt>").unwrap().1.split_once("</dd>").unwrap().0;
    assert!(first.contains("<span>a</span>") && first.contains("9 of 9 runs clean"), "{first}");
    assert!(page.contains("1.25\u{a0}× the lower bound"));
    let quote = between(&page, "<li>b: ", "</li>");
    assert!(quote[0].starts_with("6 of 9 runs clean"), "{quote:?}");
    assert!(
        quote[0].ends_with("first failure (one, repeat 2): 1 and 2 touch after 1\u{a0}s, closing at 2 m&#x2f;s"),
        "{quote:?}"
    );
    assert!(page.contains("<li>c: 0 of 9 runs clean"), "without a ratio");
}

#[test]
fn the_picture_as_written_is_the_end_with_every_contact() {
    let results = results(&["a", "b"], &["one"], 3);
    let page = html(&results, Language::English);
    let pictures = between(&page, "<svg class=\"fig moving\"", "</svg>");
    assert_eq!(pictures.len(), 2);
    for (picture, hits) in pictures.iter().zip([0, 2]) {
        let places = between(picture, "transform=\"translate(", ")");
        let [first, second] = [0, 1].map(|k| {
            let (x, y) = places[k].split_once(' ').unwrap();
            [x.parse::<f64>().unwrap(), y.parse::<f64>().unwrap()]
        });
        assert_eq!(places.len(), 4, "everybody has a place");
        // They end 2 m apart across and 0.6 m along; the region is 2.9 m wide, 2 m and 0.45 m on either side, and
        // drawn 500 wide. Coordinates are written to a tenth.
        let metre = 500.0 / 2.9;
        assert!((first[0] - second[0] - 2.0 * metre).abs() <= 0.11, "{first:?} {second:?}");
        assert!((second[1] - first[1] - 0.6 * metre).abs() <= 0.11, "y is up in the field and down in pictures");
        assert_eq!(picture.matches("class=\"hit\"").count(), hits);
        assert_eq!(picture.matches("class=\"foul\"").count(), hits / 2);
        assert_eq!(picture.matches("line target").count(), 2, "goals");
        // 2 s of motion: a tick after one, the end has none.
        assert_eq!(picture.matches("trail second").count(), 2);
    }
    assert!(pictures[1].contains(">1\u{a0}s</text>"), "its time");
    let table = page.split_once("-events\"").unwrap().1.split_once("</table>").unwrap().0;
    assert!(table.contains("1 and 2") && table.contains("1 and opponent 1"), "{table}");
}

#[test]
fn poor_data_make_poor_pages_but_pages() {
    let mut bare = results(&["a"], &["one"], 1);
    bare.traces.clear();
    bare.runs[0].moving = None;
    bare.runs[0].valid = false;
    check(&html(&bare, Language::English));
    bare.runs.clear();
    check(&html(&bare, Language::English));
    let mut odd = results(&["a"], &["one"], 1);
    odd.traces[0].trace.frames.clear();
    check(&html(&odd, Language::English));
    odd.traces[0].trace.frames = vec![vec![[f64::NAN, 0.0]; 4]];
    odd.traces[0].trace.events = vec![Event { time_s: 0.0, bodies: [9, 7], at: [0.0; 2], closing: 0.0, foul: true }];
    check(&html(&odd, Language::English));
}

#[test]
fn twenty_seconds_of_eight_robots_and_ten_planners_stay_small() {
    let planners: Vec<String> = (0..10).map(|k| format!("planner-{k}")).collect();
    let mut big = results(&planners.iter().map(String::as_str).collect::<Vec<_>>(), &["one"], 100);
    for kept in &mut big.traces {
        kept.trace.bodies = vec![TraceBody { side: "own".to_owned(), radius: 0.09 }; 8];
        kept.trace.period_s = 1.0 / 60.0;
        let at = |k: usize, i: usize| {
            let angle = 0.01 * k as f64 + i as f64;
            [2.7 * libm::cos(angle), 2.7 * libm::sin(1.1 * angle)]
        };
        kept.trace.frames = (0..1200).map(|k| (0..8).map(|i| at(k, i)).collect()).collect();
    }
    let page = html(&big, Language::English);
    assert!(page.len() < 1_500_000, "{} bytes", page.len());
}

/// The cells of the first row of the table `id`.
fn first_row(page: &str, id: &str) -> Vec<String> {
    let table = page.split_once(&format!("id=\"{id}\"")).unwrap().1.split_once("</table>").unwrap().0;
    let row = table.split_once("<tbody>").unwrap().1.split_once("</tr>").unwrap().0;
    between(row, "<td", "</td>").iter().map(|cell| cell.split_once('>').unwrap().1.to_owned()).collect()
}

#[test]
fn the_table_counts_violations_and_missed_frames() {
    let mut results = results(&["a"], &["one"], 1);
    let metrics = &mut results.runs[0].moving.as_mut().unwrap().metrics;
    // Waves and halts: robots and calls say nothing of the frames.
    (metrics.violations, metrics.robots, metrics.arrived, metrics.calls) = (3, 6, 6, 10);
    results.runs[0].valid = false;
    results.traces.clear();
    let page = html(&results, Language::English);
    let heads = page.split_once("id=\"overall-table\"").unwrap().1.split_once("</tr>").unwrap().0;
    let places = ["collisions", "fouls", "violations", "time over bound", "plan changes", "stuck", "way over straight"]
        .map(|head| heads.find(&format!(">{head}")).unwrap());
    assert!(places.is_sorted(), "{places:?}");
    let row = first_row(&page, "overall-table");
    // 3 in 2 s.
    assert_eq!(row[4], "90<small>3</small>");
    // One of 2 s at 60 Hz.
    assert_eq!(row.last().unwrap(), "1<small>0.833\u{a0}%</small>");
    assert!(page.contains("contacts between robots: 0, breaches of rules: 3"));
    results.scenes[0].simulation.as_mut().unwrap().frame_rate = 30.0;
    assert_eq!(
        first_row(&html(&results, Language::English), "overall-table").last().unwrap(),
        "1<small>1.67\u{a0}%</small>"
    );
    results.scenes[0].simulation = None;
    assert_eq!(first_row(&html(&results, Language::English), "overall-table").last().unwrap(), "1");
}

#[test]
fn the_line_of_compute_is_the_period_of_all_scenes() {
    let mut results = results(&["a"], &["one", "two"], 1);
    for scene in &mut results.scenes {
        scene.simulation.as_mut().unwrap().frame_rate = 30.0;
    }
    let page = html(&results, Language::English);
    assert!(page.contains("33.3\u{a0}ms at 30 Hz: what is right of it misses a frame"));
    assert!(!page.contains("reference only"));
    results.scenes[0].simulation.as_mut().unwrap().frame_rate = 60.0;
    let page = html(&results, Language::English);
    assert!(page.contains("The dashed line, 16\u{a0}ms, is a reference only"));
}

#[test]
fn a_run_that_fails_in_several_ways_is_in_several_columns() {
    let mut results = results(&["a"], &["one"], 1);
    let metrics = &mut results.runs[0].moving.as_mut().unwrap().metrics;
    (metrics.arrived, metrics.collisions) = (1, 2);
    results.runs[0].valid = false;
    let page = html(&results, Language::English);
    let table = page.split_once("id=\"missing-planners\"").unwrap().1.split_once("</table>").unwrap().0;
    assert!(table.contains(">not all arrived<") && table.contains(">robots touched<"), "{table}");
    assert!(!table.contains(">rule broken<"), "{table}");
    // Scenes with any, the two reasons, runs.
    assert_eq!(first_row(&page, "missing-planners"), ["1"; 4]);
}

#[test]
fn chinese_says_clean_and_has_its_spaces() {
    let page = html(&results(&["a", "b"], &["one"], 3), Language::Chinese);
    assert!(page.contains("涵盖 1 个场景") && page.contains("全部无失误") && !page.contains("全部有效"));
}
