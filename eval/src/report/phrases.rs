//! Quotable sentences in the report's language.

use super::evidence::Evidence;
use super::language::Strings;
use crate::analysis::pairs::Ratio;
use crate::analysis::sentences::Sentence;
use crate::analysis::{Measure, Over};
use crate::format;

/// The sentence with the planners' names.
pub fn phrase(sentence: &Sentence, evidence: &Evidence<'_>, t: &Strings) -> String {
    let name = |planner: &usize| evidence.label(*planner);
    match sentence {
        Sentence::Valid { planner, valid, runs, interval: (low, high) } => t.fill(
            "phrase_valid",
            &[
                ("planner", name(planner)),
                ("valid", &format::count(*valid as f64)),
                ("runs", &format::count(*runs as f64)),
                ("interval", &format::share_interval(*low, *high)),
            ],
        ),
        Sentence::Better { measure, better, worse, ratio, medians, p, pairs, over, failures } => {
            let (p, evidence) = (p_value(*p), weight(*pairs, *over, *failures, t));
            let common = [("a", name(better)), ("b", name(worse)), ("p", p.as_str()), ("evidence", evidence.as_str())];
            match ratio {
                Some(ratio) => {
                    let times = times(*ratio);
                    t.fill(&key("phrase_times", *measure), &[common.as_slice(), &[("times", &times)]].concat())
                }
                None => {
                    let [x, y] = medians.map(|v| value(*measure, v));
                    let figures = [("x", x.as_str()), ("y", y.as_str())];
                    t.fill(&key("phrase_better", *measure), &[common.as_slice(), &figures].concat())
                }
            }
        }
        Sentence::Alike { measure, best, other, p, pairs, over, failures } => t.fill(
            &key("phrase_alike", *measure),
            &[
                ("a", name(best)),
                ("b", name(other)),
                ("p", &p_value(*p)),
                ("evidence", &weight(*pairs, *over, *failures, t)),
            ],
        ),
        Sentence::TooFew { measure, best, other, medians, a12, pairs, over, failures } => {
            let few = match over {
                Over::Repeats => "phrase_few_pairs",
                Over::Scenes => "phrase_few_scenes",
            };
            let few = t.fill(few, &[("n", &format::count(*pairs as f64))]);
            let [x, y] = medians.map(|v| value(*measure, v));
            let a12 = a12.map_or(format::NONE.to_owned(), |share| format::significant(share, 2));
            let common = [("a", name(best)), ("b", name(other)), ("few", few.as_str()), ("a12", a12.as_str())];
            t.fill(&key("phrase_few", *measure), &[common.as_slice(), &[("x", &x), ("y", &y)]].concat())
                + counted(*failures, t)
        }
        Sentence::Settled { measure, best, other, medians: [x, y] } => {
            let what = if x == y { "phrase_equal" } else { "phrase_settled" };
            let (x, y) = (value(*measure, *x), value(*measure, *y));
            t.fill(&key(what, *measure), &[("a", name(best)), ("b", name(other)), ("x", &x), ("y", &y)])
        }
    }
}

fn key(what: &str, measure: Measure) -> String {
    let measure = match measure {
        Measure::Gap => "gap",
        Measure::Length => "length",
        Measure::Time => "time",
    };
    format!("{what}_{measure}")
}

/// A figure of that measure.
pub fn value(measure: Measure, value: f64) -> String {
    match measure {
        Measure::Gap => format::percent(value),
        Measure::Length => format::significant(value, 6),
        Measure::Time => format::time(value),
    }
}

/// A ratio with its interval.
pub fn times(ratio: Ratio) -> String {
    // A ratio of lengths near one lives in its later digits.
    let digits = if ratio.value < 1.1 { 4 } else { 2 };
    let shown = |v: f64| if v >= 100.0 { format::significant(v, 3) } else { format::significant(v, digits) };
    let interval = ratio.interval.map(|[low, high]| format!(" [{}, {}]", shown(low), shown(high)));
    shown(ratio.value) + &interval.unwrap_or_default()
}

/// A p-value: below 0.001 only that it is.
pub fn p_value(p: f64) -> String {
    if p < 0.001 { "p < 0.001".to_owned() } else { format!("p = {}", format::significant(p, 2)) }
}

fn weight(pairs: usize, over: Over, failures: bool, t: &Strings) -> String {
    let key = match over {
        Over::Repeats => "phrase_pairs",
        Over::Scenes => "phrase_scenes",
    };
    t.fill(key, &[("n", &format::count(pairs as f64))]) + counted(failures, t)
}

fn counted(failures: bool, t: &Strings) -> &str {
    if failures { t.get("phrase_failures") } else { "" }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::analysis::pairs::Pairs;
    use crate::analysis::sentences::{against_best, validity};
    use crate::report::Language;
    use crate::report::tests::results;

    #[test]
    fn english_is_what_the_analysis_says() {
        // Gaps that differ, are equal, and fail; several scenes and one.
        let seven = ["one", "two", "three", "four", "five", "six", "seven"];
        for (scenes, repeats) in [(&seven[..1], 12), (&seven[..1], 4), (&seven[..4], 3), (&seven[..], 3)] {
            let mut results = results(&["a", "b", "c"], scenes, repeats);
            for (k, r) in results.runs.iter_mut().enumerate() {
                r.time_us += k as f64;
                r.valid &= k != 1;
            }
            let evidence = Evidence::new(&results);
            let names = ["a", "b", "c"];
            let t = Strings::new(Language::English);
            let measures = [Measure::Gap, Measure::Length, Measure::Time].map(|m| Pairs::new(&evidence.grid, m));
            let compared = measures.iter().flat_map(|pairs| against_best(&evidence.grid, pairs));
            let sentences: Vec<Sentence> = validity(&evidence.grid).into_iter().chain(compared).collect();
            assert!(sentences.len() >= 6);
            for sentence in sentences {
                assert_eq!(phrase(&sentence, &evidence, &t), sentence.english(&names));
            }
        }
    }
}
