use super::*;

/// A table of one planner's runs in one scene: length 10 + gap, or a failure; times from `time`.
fn side(planner: &str, gaps: &[f64], time: impl Fn(usize) -> f64) -> Side {
    let mut text = "scene,planner,repeat,seed,valid,length,optimum,gap,evaluations,time_us\n".to_owned();
    for (repeat, gap) in gaps.iter().enumerate() {
        let cells = if gap.is_finite() { format!("true,{},10,{gap}", 10.0 * (1.0 + gap)) } else { "false,,10,".into() };
        text += &format!("s,{planner},{repeat},{},{cells},5,{}\n", 100 + repeat, time(repeat));
    }
    Side::from_csv("x", &text).unwrap()
}

fn ramp(n: usize, shift: f64) -> Vec<f64> {
    (0..n).map(|i| 0.1 + 0.01 * i as f64 + shift * (1.0 + 0.1 * i as f64)).collect()
}

fn one(old: &Side, new: &Side) -> Change {
    compare(old, new).unwrap().changes.remove(0)
}

#[test]
fn equal_counts_are_the_same_whatever_the_times() {
    let (old, new) = (side("p", &ramp(30, 0.0), |_| 1.0), side("p", &ramp(30, 0.0), |_| 2.0));
    let changes = compare(&old, &new).unwrap();
    assert!(!changes.changed() && !changes.worse() && changes.slower());
    assert_eq!((changes.changes[0].quality, changes.changes[0].time_ratio), (Quality::Same, Some(2.0)));
}

#[test]
fn longer_paths_are_worse_and_shorter_ones_better() {
    let (old, new) = (side("p", &ramp(8, 0.0), |_| 1.0), side("p", &ramp(8, 0.02), |_| 1.0));
    let worse = one(&old, &new);
    // All eight differences on one side: 2/2⁸.
    assert_eq!((worse.quality, worse.p, worse.differing), (Quality::Worse, Some(2.0 / 256.0), 8));
    assert_eq!(one(&new, &old).quality, Quality::Better);
    let few = compare(&side("p", &ramp(5, 0.0), |_| 1.0), &side("p", &ramp(5, 0.02), |_| 1.0)).unwrap();
    assert_eq!((few.changes[0].quality, few.changes[0].p), (Quality::TooFew, None));
    assert!(few.changed() && !few.worse());
}

#[test]
fn noise_is_not_a_change_for_the_worse() {
    let gaps = ramp(12, 0.0);
    let shaken: Vec<f64> = gaps.iter().enumerate().map(|(i, g)| g + if i % 2 == 0 { 1e-3 } else { -1.1e-3 }).collect();
    let changes = compare(&side("p", &gaps, |_| 1.0), &side("p", &shaken, |_| 1.0)).unwrap();
    assert_eq!(changes.changes[0].quality, Quality::Unclear);
    assert!(changes.changed() && !changes.worse());
}

#[test]
fn failures_are_the_worst_and_of_two_neither_is_worse() {
    let mut gaps = ramp(12, 0.0);
    let old = side("p", &gaps, |_| 1.0);
    gaps[3..].fill(f64::INFINITY);
    let new = side("p", &gaps, |_| 1.0);
    let change = one(&old, &new);
    assert_eq!((change.quality, change.valid, change.median[1]), (Quality::Worse, [12, 3], None));
    let all = side("p", &[f64::INFINITY; 12], |_| 1.0);
    assert_eq!(one(&all, &all).quality, Quality::Same);
    assert_eq!(one(&all, &new).quality, Quality::Unclear, "three of twelve mended: p = 2/8");
}

#[test]
fn planners_that_do_not_vary_need_no_test() {
    let at = |gap: f64| side("p", &[gap; 3], |_| 1.0);
    assert_eq!((one(&at(0.1), &at(0.2)).quality, one(&at(0.2), &at(0.1)).quality), (Quality::Worse, Quality::Better));
    assert_eq!(one(&at(0.1), &at(f64::INFINITY)).quality, Quality::Worse);
}

#[test]
fn over_all_scenes_a_scene_is_one_observation() {
    // A planner that does not vary: in each scene the same gap and time ten times.
    let side = |gaps: &[f64], time: f64| {
        let mut whole = side("p", &[], |_| time);
        for (k, gap) in gaps.iter().enumerate() {
            let runs = side("p", &[*gap; 10], |_| time * (k + 1) as f64).runs;
            whole.runs.extend(runs.into_iter().map(|((_, p, r), run)| ((format!("s{k}"), p, r), run)));
        }
        whole
    };
    let all = |old: &[f64], new: &[f64]| {
        compare(&side(old, 1.0), &side(new, 2.0)).unwrap().changes.into_iter().find(|c| c.scene.is_none()).unwrap()
    };
    // 40 pairs of runs, 30 of them better; of four scenes nothing can be told.
    let four = all(&[0.1, 0.2, 0.3, 0.9], &[0.05, 0.15, 0.2, 0.9]);
    assert_eq!((four.pairs, four.differing, four.quality, four.p), (40, 30, Quality::TooFew, None));
    assert_eq!((four.median, four.speed), ([Some(0.25), Some(0.175)], Speed::TooFew));
    // Seven scenes, all better: 2/2⁷.
    let ramp: Vec<f64> = (1..8).map(|k| 0.1 * f64::from(k)).collect();
    let half: Vec<f64> = ramp.iter().map(|gap| 0.5 * gap).collect();
    let seven = all(&ramp, &half);
    // The seven scenes need no test, so that Holm's correction is of this one alone.
    assert_eq!((seven.quality, seven.p), (Quality::Better, Some(2.0 / 128.0)));
    assert_eq!((seven.time_ratio, seven.speed), (Some(2.0), Speed::Slower));
}

#[test]
fn times_change_beyond_noise_only() {
    let gaps = ramp(20, 0.0);
    let at = |factor: f64| side("p", &gaps, move |i| factor * (100.0 + (i * 7 % 20) as f64));
    let speed = |factor: f64| one(&at(1.0), &at(factor)).speed;
    assert_eq!(
        (speed(1.0), speed(1.05), speed(1.5), speed(0.5)),
        (Speed::Unchanged, Speed::Unchanged, Speed::Slower, Speed::Faster)
    );
    // A ratio of 1.2 in the medians of times that spread over three decades says nothing.
    let wild = |factor: f64, step: usize| side("p", &gaps, move |i| factor * 10_f64.powf((i * step % 20) as f64 / 6.0));
    assert_eq!(one(&wild(1.0, 7), &wild(1.2, 11)).speed, Speed::Unchanged);
    let untimed =
        Side { runs: at(1.0).runs.into_iter().map(|(k, r)| (k, Run { time_us: None, ..r })).collect(), ..at(1.0) };
    assert_eq!(one(&untimed, &at(9.0)).speed, Speed::Untimed);
    assert_eq!(one(&side("p", &[0.1; 3], |_| 1.0), &side("p", &[0.1; 3], |_| 9.0)).speed, Speed::TooFew);
}

#[test]
fn what_does_not_compare_is_named() {
    let refusal = |old: &Side, new: &Side| compare(old, new).unwrap_err().to_string();
    let (p, q) = (side("p", &[0.1, 0.2], |_| 1.0), side("q", &[0.1], |_| 1.0));
    assert!(refusal(&p, &q).contains("no run in common; one has p in s, the other q in s"), "{}", refusal(&p, &q));
    let mut other = p.clone();
    other.runs.values_mut().for_each(|r| r.optimum = Some(11.0));
    assert!(refusal(&p, &other).contains("the optimum of scene \"s\" is 10 in one and 11 in the other"));
    let mut other = p.clone();
    other.runs.values_mut().for_each(|r| r.seed += 1);
    assert!(refusal(&p, &other).contains("p in s, repeat 1, has seed 101 in one and 102 in the other"));
}

#[test]
fn missing_runs_fail_the_gate() {
    let mut both = side("p", &[0.1, 0.2], |_| 1.0);
    both.runs.extend(side("q", &[0.3], |_| 1.0).runs);
    let mut less = side("p", &[0.1, 0.2], |_| 1.0);
    let changes = compare(&both, &less).unwrap();
    assert_eq!((changes.missing.clone(), changes.added.len()), (vec!["planner q".to_owned()], 0));
    assert!(changes.worse() && changes.changed());
    let back = compare(&less, &both).unwrap();
    assert!(!back.worse() && back.changed() && back.added == ["planner q"]);
    less.runs.pop_last();
    assert_eq!(compare(&both, &less).unwrap().missing, ["planner q", "run 1 of p in s"]);
}

#[test]
fn tables_that_are_none_are_named_with_their_line() {
    let error = |text: &str| Side::from_csv("old.csv", text).unwrap_err().to_string();
    assert!(error("a,b\n1,2\n").contains("old.csv: no column scene; expected a runs.csv"));
    let head = "scene,planner,repeat,seed,valid,length\n";
    let row = "s,p,0,7,true,1.5\n";
    assert!(
        error(&(head.to_owned() + row + "s,p,1,7,yes,1.5\n"))
            .contains("old.csv: line 3: valid is \"yes\"; expected true")
    );
    for number in ["NaN", "inf", "-inf", "1e999"] {
        let text = format!("{head}{row}s,p,1,7,true,{number}\n");
        let expected = format!("old.csv: line 3: length is {number:?}; expected a finite number");
        assert!(error(&text).contains(&expected), "{}", error(&text));
    }
    assert!(error(&(head.to_owned() + row + row)).contains("line 3: a second run 0 of p in s"));
    assert!(error(&(head.to_owned() + "s,p\n")).contains("old.csv: CSV error"));
}
