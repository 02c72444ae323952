//! How long a campaign lasts at most.

use std::fmt::Write as _;

use crate::campaign::{Arena, Campaign};
use crate::config::{Maker, PlannerEntry};
use crate::machine;
use crate::results::Subject;
use crate::work::Work;

/// The worst case of the runs that are to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct Estimate {
    /// Runs to be made, warm-ups aside.
    pub runs: usize,
    /// Wall time at most, s, when every run takes as long as it may; `None` where nothing bounds one of them.
    ///
    /// A run in a process of its own counts as two hard limits, since a new process, one in a new scene, and one after
    /// a failed run are warmed up first; an external planner has a minute more for its start.
    ///
    /// With R the time of all runs, W that of all warm-ups, U that of the longest unit and n jobs, no order of units
    /// takes longer than (R + W)/n + (1 − 1/n)·U (Graham 1966, *Bounds for certain multiprocessing anomalies*).
    pub seconds: Option<f64>,
    /// Planners without any limit, in the comparison's order.
    pub unbounded: Vec<String>,
    /// Seconds that are simulated at most, all runs together.
    pub simulated: f64,
    /// Whether what moves is compared, which has no process of its own.
    moves: bool,
}

impl Estimate {
    /// Of the runs of `work`.
    pub fn new(campaign: &Campaign, work: &Work) -> Self {
        let planners = &campaign.comparison.planners;
        let of = |scene: usize| -> Vec<Option<f64>> {
            planners.iter().map(|entry| limit(entry, &campaign.arenas[scene], work.isolate)).collect()
        };
        let limits: Vec<Vec<Option<f64>>> = (0..campaign.arenas.len()).map(of).collect();
        let (mut runs, mut total, mut longest, mut simulated) = (0_usize, 0.0_f64, 0.0_f64, 0.0_f64);
        let mut used = vec![vec![0_usize; planners.len()]; campaign.arenas.len()];
        let repeats = campaign.comparison.repeats as usize;
        for (scene, used) in used.iter_mut().enumerate() {
            let units = work.shard.size((scene + 1) * repeats) - work.shard.size(scene * repeats);
            used.fill(units);
            work.done
                .range((scene, 0, 0)..(scene + 1, 0, 0))
                .for_each(|(_, planner, _)| used[*planner] = used[*planner].saturating_sub(1));
            let times = used.iter().zip(&limits[scene]).map(|(n, limit)| (*n, limit.unwrap_or(0.0)));
            let lasts = campaign.arenas[scene].simulation.as_ref().map_or(0.0, |s| s.duration_s);
            simulated += used.iter().sum::<usize>() as f64 * lasts;
            runs += used.iter().sum::<usize>();
            total += times.clone().map(|(n, limit)| n as f64 * limit).sum::<f64>();
            // No unit has more than every planner of which any run is missing.
            longest = longest.max(times.map(|(n, limit)| if n > 0 { limit } else { 0.0 }).sum());
        }
        // Every job warms a planner up that it runs in a scene.
        let moves = campaign.comparison.subject != Subject::Paths;
        let warm = |planner: usize, limits: &[Option<f64>], n: usize| {
            let cold = moves || work.isolate || planners[planner].isolated();
            if cold { 0.0 } else { limits[planner].unwrap_or(0.0) * n.min(work.jobs) as f64 }
        };
        let rows = used.iter().zip(&limits);
        let warm: f64 = rows.flat_map(|(row, l)| row.iter().enumerate().map(|(planner, n)| warm(planner, l, *n))).sum();
        let needed = |planner: usize| used.iter().any(|row| row[planner] > 0);
        let unbounded: Vec<String> = (0..planners.len())
            .filter(|planner| limits.iter().any(|l| l[*planner].is_none()) && needed(*planner))
            .map(|planner| planners[planner].label.clone())
            .collect();
        let jobs = work.jobs as f64;
        let seconds = (total + warm) / jobs + (1.0 - 1.0 / jobs) * longest;
        Self { runs, seconds: unbounded.is_empty().then_some(seconds), unbounded, simulated, moves }
    }

    /// What is said before the campaign.
    pub fn words(&self) -> String {
        /// More labels would hide the sentence.
        const MOST: usize = 4;
        let simulated = match self.simulated {
            0.0 => String::new(),
            s => format!("at most {} are simulated; ", duration(s)),
        };
        if let Some(seconds) = self.seconds {
            let end = machine::after(seconds.ceil() as u64);
            return format!("{simulated}at most about {} of planning, until {end}", duration(seconds));
        }
        let mut labels = self.unbounded.iter().take(MOST).cloned().collect::<Vec<_>>().join(", ");
        if let Some(more @ 1..) = self.unbounded.len().checked_sub(MOST) {
            let _ = write!(labels, " and {more} more");
        }
        let how = if self.moves { "a time budget" } else { "a time budget or --isolate" };
        format!("{simulated}no limit is known for {labels}: their time has no bound without {how}")
    }
}

/// What the first answer of a newly started external planner may take beyond its hard limit, s.
const START: f64 = 60.0;

/// The longest that one run may take, s.
fn limit(entry: &PlannerEntry, arena: &Arena, isolate: bool) -> Option<f64> {
    if isolate || entry.isolated() {
        let start = if matches!(entry.maker, Maker::External(_)) { START } else { 0.0 };
        return Some(2.0 * entry.hard_limit().as_secs_f64() + start);
    }
    match (&entry.maker, &arena.simulation) {
        (Maker::Parameters(_) | Maker::Tuning(_), _) => None,
        // The budget is a call's: one for each robot and frame.
        (_, Some(s)) => {
            entry.budget.time_ms.map(|ms| ms / 1000.0 * (s.duration_s * s.frame_rate).ceil() * s.robots as f64)
        }
        (_, None) => entry.budget.time_ms.map(|ms| ms / 1000.0),
    }
}

/// `12 s`, `3 min 20 s`, `5 h 12 min`, `2 d 3 h`.
pub fn duration(seconds: f64) -> String {
    if seconds < 9.95 {
        return format!("{seconds:.1} s");
    }
    let s = seconds.round() as u64;
    match s {
        0..60 => format!("{s} s"),
        60..3600 => format!("{} min {} s", s / 60, s % 60),
        3600..86_400 => format!("{} h {} min", s / 3600, s / 60 % 60),
        _ => format!("{} d {} h", s / 86_400, s / 3600 % 24),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{BudgetSpec, External};
    use crate::testing::{campaign, entry, straight};

    fn budget(time_ms: Option<f64>) -> BudgetSpec {
        BudgetSpec { time_ms, ..BudgetSpec::default() }
    }

    #[test]
    fn the_worst_case_is_worked_by_hand() {
        let mut campaign = campaign(vec![entry("a", straight), entry("b", straight)]);
        let free = Estimate::new(&campaign, &Work::all(1));
        assert_eq!((free.runs, free.seconds), (20, None));
        let said = "no limit is known for a, b: their time has no bound without a time budget or --isolate";
        assert_eq!(free.words(), said);
        // Without a budget a process may take a minute, and as long again when the run before has failed.
        let isolated = Estimate::new(&campaign, &Work { isolate: true, ..Work::all(1) });
        assert_eq!(isolated.seconds, Some(20.0 * 2.0 * 60.0));

        campaign.comparison.planners[0].budget = budget(Some(1000.0));
        assert_eq!(Estimate::new(&campaign, &Work::all(1)).unbounded, ["b"]);
        campaign.comparison.planners[1].budget = budget(Some(3000.0));
        // 10 units of 4 s, and a warm-up of each planner in both scenes; numbers that binary fractions hold.
        assert_eq!(Estimate::new(&campaign, &Work::all(1)).seconds, Some(48.0));
        // Twice the warm-ups, half the time, and half of the last unit in which one job may be alone.
        assert_eq!(Estimate::new(&campaign, &Work::all(2)).seconds, Some((40.0 + 16.0) / 2.0 + 2.0));
        // All of b in the second scene is done: 5 units of 4 s and 5 of 1 s, three warm-ups.
        let done = (0..5).map(|repeat| (1, 1, repeat)).collect();
        let rest = Estimate::new(&campaign, &Work { done, ..Work::all(1) });
        assert_eq!((rest.runs, rest.seconds), (15, Some(25.0 + 5.0)));
        // Units 1, 4, 7 of 0..10: one repeat of the first scene twice, and of the second once.
        let shard = Estimate::new(&campaign, &Work { shard: "2/3".parse().unwrap(), ..Work::all(1) });
        assert_eq!((shard.runs, shard.seconds), (6, Some(12.0 + 8.0)));

        // Far more units than can be looked at one by one.
        campaign.comparison.repeats = u32::MAX;
        let many = Estimate::new(&campaign, &Work::all(1));
        assert_eq!(many.runs, 4 * u32::MAX as usize);
        assert_eq!(many.seconds, Some(f64::from(u32::MAX) * 8.0 + 8.0));
        campaign.comparison.repeats = 5;
        let command = vec!["p".to_owned()];
        campaign.comparison.planners[0].maker = Maker::External(External { command, folder: ".".into() });
        campaign.comparison.planners.truncate(1);
        // Ten runs with a hard limit of 3 s, each of which may be a process's first.
        assert_eq!(Estimate::new(&campaign, &Work::all(1)).seconds, Some(10.0 * (3.0 + 3.0 + 60.0)));
    }

    #[test]
    fn durations_are_in_two_units() {
        let told =
            [(0.25, "0.2 s"), (9.99, "10 s"), (200.0, "3 min 20 s"), (18_720.0, "5 h 12 min"), (183_600.0, "2 d 3 h")];
        for (seconds, text) in told {
            assert_eq!(duration(seconds), text);
        }
    }
}
