//! What changed between two campaigns, beyond noise: a gate against regressions.
//!
//! Runs are paired by scene, planner and repeat where their seeds agree. Where every column that counts
//! something agrees in every pair, nothing changed, and no statistics are needed. Else the quality of the pairs
//! (the gap, or the length where a gap is missing; +∞ for a run without a valid path) is compared by
//! Wilcoxon's signed-rank test, corrected by Holm over everything that differs, with A₁₂ as effect size; and
//! where neither side varies over its repeats, directly. Times are compared by the ratio of medians with a
//! bootstrap interval: they changed when the interval leaves 1 out and the ratio is at least 10 %. Over all scenes
//! together a pair is a scene with its medians over the repeats, as in the report: more repeats are no more scenes.

mod side;

use std::collections::{BTreeMap, BTreeSet};

use serde::Serialize;

use crate::error::Error;
use crate::statistics::bootstrap::{Resamples, ratio_interval};
use crate::statistics::effect_size::a12;
use crate::statistics::holm::holm;
use crate::statistics::median;
use crate::statistics::wilcoxon::{Zeros, signed_rank};

pub use side::{Run, Side};

/// Chance of one false alarm about quality in the whole comparison.
const ALPHA: f64 = 0.05;
/// A time that changed by less is nobody's concern, and machines drift by as much.
const WORTH_SAYING: f64 = 1.10;
/// With fewer pairs, of runs in one scene or of scenes, neither the test nor the interval can tell anything: 2/2⁵ > 0.05.
const FEWEST: usize = 6;
/// Resamples of the bootstrap; a stated seed, so that the same files give the same answer.
const RESAMPLES: (usize, u64) = (2000, 1);

/// What became of the paths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Quality {
    /// Every column that counts something agrees in every pair.
    Same,
    /// Shorter, or valid more often.
    Better,
    /// Longer, or valid less often.
    Worse,
    /// Different, but not beyond chance.
    Unclear,
    /// Different, with too few pairs to tell more.
    TooFew,
}

/// What became of the time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Speed {
    /// No change beyond noise.
    Unchanged,
    /// Less time.
    Faster,
    /// More time.
    Slower,
    /// Too few pairs to tell.
    TooFew,
    /// A side has no times.
    Untimed,
}

/// One planner in one scene, or in all of them.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Change {
    /// The planner's label.
    pub planner: String,
    /// The scene; none for all of them together.
    pub scene: Option<String>,
    /// Pairs of runs.
    pub pairs: usize,
    /// Pairs in which some column that counts differs.
    pub differing: usize,
    /// Runs with a valid path, before and after.
    pub valid: [usize; 2],
    /// Median gap (or length), before and after, over all scenes of their medians; none where infinite.
    pub median: [Option<f64>; 2],
    /// The verdict on the paths.
    pub quality: Quality,
    /// Wilcoxon's p, corrected; none without a test.
    pub p: Option<f64>,
    /// How often a run of NEW is worse than one of OLD, ties half.
    pub a12: f64,
    /// Median time of NEW over that of OLD, over all scenes of their medians; none without times.
    pub time_ratio: Option<f64>,
    /// Its 95 % interval.
    pub time_interval: Option<[f64; 2]>,
    /// The verdict on the time.
    pub speed: Speed,
}

/// What changed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Changes {
    /// Every planner in every scene that both sides have, in byte order, then each planner in all its scenes
    /// where these are several.
    pub changes: Vec<Change>,
    /// Runs, by `scene, planner, repeat` or wholesale, that OLD has and NEW has not.
    pub missing: Vec<String>,
    /// Those that NEW has and OLD has not.
    pub added: Vec<String>,
    /// What a reader ought to know of the sides.
    pub notes: Vec<String>,
}

impl Changes {
    /// Whether anything but times differs, or runs are missing or new.
    pub fn changed(&self) -> bool {
        self.changes.iter().any(|c| c.differing > 0) || !self.missing.is_empty() || !self.added.is_empty()
    }

    /// Whether paths became worse, or runs are missing.
    pub fn worse(&self) -> bool {
        self.changes.iter().any(|c| c.quality == Quality::Worse) || !self.missing.is_empty()
    }

    /// Whether a planner became slower.
    pub fn slower(&self) -> bool {
        self.changes.iter().any(|c| c.speed == Speed::Slower)
    }
}

/// Compares two sides.
///
/// # Errors
/// Sides that do not compare: nothing in common, other seeds, other scenes under the same name.
pub fn compare(old: &Side, new: &Side) -> Result<Changes, Error> {
    let refuse = |message: String| Error::Usage(format!("{} and {} do not compare: {message}", old.name, new.name));
    let mut pairs: BTreeMap<(&str, &str), Vec<[&Run; 2]>> = BTreeMap::new();
    let mut reseeded = None;
    for (key, before) in &old.runs {
        let Some(after) = new.runs.get(key) else { continue };
        if let (Some(a), Some(b)) = (before.optimum, after.optimum)
            // An optimum is exact but for the scene's ε; a scene that differs shows at once.
            && (a - b).abs() > 1e-6 * a.abs()
        {
            return Err(refuse(format!("the optimum of scene {:?} is {a} in one and {b} in the other", key.0)));
        }
        if before.seed == after.seed {
            pairs.entry((&key.0, &key.1)).or_default().push([before, after]);
        } else {
            reseeded = Some((key, before.seed, after.seed));
        }
    }
    if let Some(((scene, planner, repeat), a, b)) = reseeded {
        return Err(refuse(format!("{planner} in {scene}, repeat {repeat}, has seed {a} in one and {b} in the other")));
    }
    if pairs.is_empty() {
        return Err(refuse(format!("no run in common; one has {}, the other {}", old.describe(), new.describe())));
    }
    let mut groups: Vec<Group<'_, '_>> =
        pairs.iter().map(|((scene, planner), runs)| (*planner, Some(*scene), vec![&runs[..]])).collect();
    groups.extend(over_scenes(&pairs));
    let mut changes: Vec<Change> =
        groups.iter().map(|(planner, scene, cells)| change(planner, *scene, cells)).collect();
    let tested: Vec<usize> = (0..changes.len()).filter(|i| changes[*i].p.is_some()).collect();
    let adjusted = holm(&tested.iter().filter_map(|i| changes[*i].p).collect::<Vec<f64>>());
    for (i, p) in tested.into_iter().zip(adjusted) {
        let change = &mut changes[i];
        change.p = Some(p);
        if p > ALPHA {
            change.quality = Quality::Unclear;
        }
    }
    Ok(Changes { changes, missing: absent(old, new), added: absent(new, old), notes: notes(old, new) })
}

/// A planner, a scene or none for all of them, and scene by scene the pairs of runs.
type Group<'a, 'p> = (&'a str, Option<&'a str>, Vec<&'p [[&'a Run; 2]]>);

/// Each planner over all its test scenes, where they are several.
fn over_scenes<'a, 'p>(pairs: &'p BTreeMap<(&'a str, &'a str), Vec<[&'a Run; 2]>>) -> Vec<Group<'a, 'p>> {
    let planners: BTreeSet<&str> = pairs.keys().map(|(_, planner)| *planner).collect();
    let whole = |planner: &'a str| {
        let counted = |runs: &[[&Run; 2]]| runs.iter().flatten().all(|run| !run.tuning());
        let of_planner = pairs.iter().filter(|((_, p), runs)| *p == planner && counted(runs));
        let scenes: Vec<_> = of_planner.map(|(_, runs)| &runs[..]).collect();
        (scenes.len() > 1).then_some((planner, None, scenes))
    };
    planners.into_iter().filter_map(whole).collect()
}

/// What changed in `cells`, the pairs of one scene or, for no scene, of every scene.
fn change(planner: &str, scene: Option<&str>, cells: &[&[[&Run; 2]]]) -> Change {
    let pairs: Vec<[&Run; 2]> = cells.concat();
    // Lengths and gaps must not meet in one column.
    let gaps = pairs.iter().flatten().all(|run| !run.valid || run.gap.is_some());
    let qualities = |side: usize| column(cells, scene, |pair| pair[side].quality(gaps));
    let (old, new) = (qualities(0), qualities(1));
    let differing = pairs.iter().filter(|[a, b]| a.differs(b)).count();
    let (quality, p) = if differing == 0 { (Quality::Same, None) } else { verdict(&old, &new, scene.is_some()) };
    let timed = pairs.iter().flatten().all(|run| run.time_us.is_some());
    let spent = |side: usize| timed.then(|| column(cells, scene, |pair| pair[side].time_us.unwrap_or(f64::NAN)));
    let (time_ratio, time_interval, speed) = spent(0).zip(spent(1)).map_or((None, None, Speed::Untimed), times);
    Change {
        planner: planner.to_owned(),
        scene: scene.map(str::to_owned),
        pairs: pairs.len(),
        differing,
        valid: [0, 1].map(|side| pairs.iter().filter(|pair| pair[side].valid).count()),
        median: [&old, &new].map(|values| median(values).filter(|m| m.is_finite())),
        quality,
        p,
        a12: a12(&new, &old).unwrap_or(0.5),
        time_ratio,
        time_interval,
        speed,
    }
}

/// What is compared: a value of each run in one scene, or of each scene the median over its runs.
fn column(cells: &[&[[&Run; 2]]], scene: Option<&str>, value: impl Fn(&[&Run; 2]) -> f64) -> Vec<f64> {
    let values = cells.iter().map(|pairs| pairs.iter().map(&value).collect::<Vec<f64>>());
    if scene.is_some() { values.flatten().collect() } else { values.filter_map(|values| median(&values)).collect() }
}

/// What became of paths of these qualities, and the test's p if it took a test.
fn verdict(old: &[f64], new: &[f64], one_scene: bool) -> (Quality, Option<f64>) {
    let constant = |values: &[f64]| values.iter().all(|v| *v == values[0]);
    if one_scene && old.len() > 1 && constant(old) && constant(new) {
        // A planner that does not vary over its seeds: the difference is no chance.
        let quality = match new[0].total_cmp(&old[0]) {
            std::cmp::Ordering::Less => Quality::Better,
            std::cmp::Ordering::Equal => Quality::Unclear,
            std::cmp::Ordering::Greater => Quality::Worse,
        };
        return (quality, None);
    }
    if old.len() < FEWEST {
        return (Quality::TooFew, None);
    }
    // Of two failures neither is worse.
    let difference = |(a, b): (&f64, &f64)| if a == b { 0.0 } else { b - a };
    let differences: Vec<f64> = old.iter().zip(new).map(difference).collect();
    let Some(test) = signed_rank(&differences, Zeros::Pratt) else { return (Quality::TooFew, None) };
    (if test.positive > test.negative { Quality::Worse } else { Quality::Better }, Some(test.p))
}

/// The ratio of the medians of paired times, its interval and what to make of it.
fn times((old, new): (Vec<f64>, Vec<f64>)) -> (Option<f64>, Option<[f64; 2]>, Speed) {
    let ratio = median(&new).zip(median(&old)).map(|(new, old)| new / old).filter(|ratio| ratio.is_finite());
    if old.len() < FEWEST {
        return (ratio, None, Speed::TooFew);
    }
    let resamples = Resamples::new(old.len(), RESAMPLES.0, RESAMPLES.1);
    let interval = ratio_interval(&resamples.medians(&new), &resamples.medians(&old));
    let speed = match (ratio, interval) {
        (Some(ratio), Some([low, _])) if ratio >= WORTH_SAYING && low > 1.0 => Speed::Slower,
        (Some(ratio), Some([_, high])) if ratio <= 1.0 / WORTH_SAYING && high < 1.0 => Speed::Faster,
        _ => Speed::Unchanged,
    };
    (ratio, interval.filter(|[_, high]| high.is_finite()), speed)
}

/// What `from` has and `of` has not, whole planners and scenes as such.
fn absent(from: &Side, of: &Side) -> Vec<String> {
    let (planners, scenes) = (of.planners(), of.scenes());
    let mut found = BTreeSet::new();
    for (scene, planner, repeat) in from.runs.keys().filter(|key| !of.runs.contains_key(*key)) {
        found.insert(if !planners.contains(&planner[..]) {
            format!("planner {planner}")
        } else if !scenes.contains(&scene[..]) {
            format!("scene {scene}")
        } else {
            format!("run {repeat} of {planner} in {scene}")
        });
    }
    found.into_iter().collect()
}

fn notes(old: &Side, new: &Side) -> Vec<String> {
    match (&old.machine, &new.machine) {
        (Some(a), Some(b)) if a != b => vec![format!("times are of different conditions: {a}; {b}")],
        _ => Vec::new(),
    }
}

#[cfg(test)]
mod tests;
