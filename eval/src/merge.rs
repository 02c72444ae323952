//! Joins the parts of a campaign that were made apart, on one machine or several.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use crate::differences::{Signature, differences};
use crate::error::Error;
use crate::results::{Manifest, Results, RunRecord};
use crate::store::Stored;
use crate::work::Shard;

/// A part, and where it is.
pub struct Part {
    /// The part's folder.
    pub folder: PathBuf,
    /// What the folder holds.
    pub stored: Stored,
}

/// A campaign of parts.
pub struct Merged {
    /// The campaign, without snapshots: which run is typical is only known with all of them.
    pub stored: Stored,
    /// What is missing, a line for every part that lacks runs; empty when the campaign is complete.
    pub missing: Vec<String>,
}

type Key = (String, String, u32);

fn key(run: &RunRecord) -> Key {
    (run.scene.clone(), run.planner.clone(), run.repeat)
}

/// Joins `parts`, in any order; refuses foreign and overlapping ones.
pub fn merge(mut parts: Vec<Part>) -> Result<Merged, Error> {
    parts.iter().skip(1).try_for_each(|part| same_campaign(&parts[0], part))?;
    disjoint(&parts)?;
    // So that the result does not depend on the order in which the folders were named.
    parts.sort_by_key(|part| {
        let manifest = &part.stored.results.manifest;
        (manifest.part().index(), manifest.started.clone())
    });
    let manifests: Vec<Manifest> = parts.iter().flat_map(|part| leaves(&part.stored.results.manifest)).collect();
    let first = &parts[0].stored;
    let mut results = Results { runs: Vec::new(), snapshots: Vec::new(), traces: Vec::new(), ..first.results.clone() };
    results.manifest = joined(manifests);
    results.runs = parts.iter().flat_map(|part| part.stored.results.runs.iter().cloned()).collect();
    results.runs.sort_by_key(key);
    let missing = missing(&results, &parts);
    if !missing.is_empty() {
        results.manifest.finished = String::new();
    }
    Ok(Merged { stored: Stored { results, ..first.clone() }, missing })
}

/// The manifests of the parts that `manifest`'s campaign was merged from, or its own.
fn leaves(manifest: &Manifest) -> Vec<Manifest> {
    if manifest.shards.is_empty() { vec![manifest.clone()] } else { manifest.shards.clone() }
}

fn joined(parts: Vec<Manifest>) -> Manifest {
    let unique = |of: fn(&Manifest) -> &String| {
        let mut all: Vec<&str> = Vec::new();
        for part in &parts {
            if !all.contains(&of(part).as_str()) {
                all.push(of(part));
            }
        }
        all.join(" + ")
    };
    let mut notes: Vec<String> = Vec::new();
    for note in parts.iter().flat_map(|part| &part.notes) {
        if !notes.contains(note) {
            notes.push(note.clone());
        }
    }
    let all_finished = parts.iter().all(|part| !part.finished.is_empty());
    Manifest {
        // One debug build among them spoils the times of all.
        profile: if parts.iter().any(|p| p.profile == "debug") { "debug".into() } else { parts[0].profile.clone() },
        platform: unique(|part| &part.platform),
        cpu: unique(|part| &part.cpu),
        jobs: parts.iter().map(|part| part.jobs).max().unwrap_or(1),
        started: parts.iter().map(|part| part.started.clone()).min().unwrap_or_default(),
        finished: parts.iter().map(|part| part.finished.clone()).max().filter(|_| all_finished).unwrap_or_default(),
        notes,
        isolated: parts.iter().all(|part| part.isolated),
        resumed: parts.iter().map(|part| part.resumed).sum(),
        shard: String::new(),
        sessions: Vec::new(),
        version: parts[0].version.clone(),
        cores: parts[0].cores,
        identity: parts[0].identity.clone(),
        shards: parts,
    }
}

fn same_campaign(first: &Part, other: &Part) -> Result<(), Error> {
    let [a, b] = [first, other].map(|part| &part.stored.results);
    let foreign = |message| Err(Error::Foreign { path: other.folder.clone(), message });
    if a.manifest.identity != b.manifest.identity {
        let [a, b] = [first, other].map(|part| Signature::of_stored(&part.stored));
        return foreign(format!("not of the campaign of {}: {}", first.folder.display(), differences(&b, &a)));
    }
    let differ = a.scenes.iter().zip(&b.scenes).find(|(x, y)| x.optimum != y.optimum);
    if let Some((x, y)) = differ {
        let told = |length: Option<f64>| length.map_or_else(|| "none".to_owned(), |length| length.to_string());
        return foreign(format!(
            "another optimum of scene {:?} than {}: {} instead of {}; expected the same on every machine",
            x.scene.name,
            first.folder.display(),
            told(y.optimum.length),
            told(x.optimum.length)
        ));
    }
    Ok(())
}

fn disjoint(parts: &[Part]) -> Result<(), Error> {
    let mut owner: BTreeMap<(&str, &str, u32), usize> = BTreeMap::new();
    for (index, part) in parts.iter().enumerate() {
        for run in &part.stored.results.runs {
            if let Some(other) = owner.insert((&run.scene, &run.planner, run.repeat), index) {
                let [here, there] = [part, &parts[other]];
                let told = |part: &Part| format!("part {}", part.stored.results.manifest.part());
                return Err(Error::Usage(format!(
                    "{} ({}) and {} ({}) overlap: both hold the run of planner {:?} in scene {:?}, repeat {}; \
                     expected every run once",
                    there.folder.display(),
                    told(there),
                    here.folder.display(),
                    told(here),
                    run.planner,
                    run.scene,
                    run.repeat
                )));
            }
        }
    }
    Ok(())
}

/// What `results` lacks, by the parts that should have it.
fn missing(results: &Results, parts: &[Part]) -> Vec<String> {
    let there: BTreeSet<Key> = results.runs.iter().map(key).collect();
    let lacks = |shard: Shard| {
        let units = shard.units(results.scenes.len(), results.repeats);
        let runs = units.flat_map(|(scene, repeat)| results.planners.iter().map(move |p| (scene, p, repeat)));
        runs.filter(|(scene, planner, repeat)| {
            !there.contains(&(results.scenes[*scene].scene.name.clone(), planner.label.clone(), *repeat))
        })
        .count()
    };
    let shards: Vec<Shard> = parts.iter().map(|part| part.stored.results.manifest.part()).collect();
    let count = shards[0].count();
    let total = lacks(Shard::WHOLE);
    if total == 0 {
        return Vec::new();
    }
    if count == 1 || shards.iter().any(|shard| shard.count() != count) {
        return vec![format!("{total} of {} runs", results.planned())];
    }
    let mut lines = Vec::new();
    for shard in Shard::all(count) {
        let lacking = lacks(shard);
        if lacking > 0 {
            let given = parts.iter().zip(&shards).find(|(_, s)| **s == shard);
            let whose = given.map_or_else(
                || "which was not given".to_owned(),
                |(part, _)| format!("which is unfinished in {}", part.folder.display()),
            );
            lines.push(format!("{lacking} runs of part {shard}, {whose}"));
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::Campaign;
    use crate::runner;
    use crate::testing::{campaign, detour, entry, straight};
    use crate::work::Work;

    fn whole() -> Campaign {
        campaign(vec![entry("straight", straight), entry("detour", detour)])
    }

    fn part(campaign: &Campaign, shard: &str) -> Part {
        let shard: Shard = shard.parse().unwrap();
        let mut results = campaign.empty_results(1);
        let optima: Vec<_> = results.scenes.iter().map(|s| s.optimum.length).collect();
        runner::run(campaign, &optima, &Work { shard, ..Work::all(1) }, |run| {
            results.runs.push(run);
            Ok(())
        })
        .unwrap();
        results.runs.sort_by_key(key);
        results.manifest.shard = shard.name();
        results.manifest.started = format!("2026-01-0{}T00:00:00Z", 4 - shard.index());
        results.manifest.finished = format!("2026-02-0{}T00:00:00Z", shard.index());
        results.manifest.jobs = shard.index() as usize;
        let stored = Stored { results: results.clone(), ..campaign.stored(&results) };
        Part { folder: format!("part-{}", shard.index()).into(), stored }
    }

    fn refusal(parts: Vec<Part>) -> String {
        merge(parts).err().unwrap().to_string()
    }

    #[test]
    fn parts_become_one_campaign_in_whatever_order() {
        let campaign = whole();
        let merged = merge(["2/3", "3/3", "1/3"].map(|shard| part(&campaign, shard)).into()).unwrap();
        assert!(merged.missing.is_empty(), "{:?}", merged.missing);
        let keys = |runs: &[RunRecord]| runs.iter().map(|r| (key(r), r.seed, r.path.clone())).collect::<Vec<_>>();
        let Stored { results, .. } = merged.stored;
        assert_eq!(keys(&results.runs), keys(&part(&campaign, "1/1").stored.results.runs));
        let Manifest { started, finished, jobs, shard, shards, .. } = results.manifest;
        assert_eq!((started.as_str(), finished.as_str()), ("2026-01-01T00:00:00Z", "2026-02-03T00:00:00Z"));
        assert_eq!((jobs, shard.as_str()), (3, ""));
        assert_eq!(shards.iter().map(|s| s.shard.as_str()).collect::<Vec<_>>(), ["1/3", "2/3", "3/3"]);
    }

    #[test]
    fn what_is_missing_is_told_by_part() {
        let campaign = whole();
        let mut second = part(&campaign, "2/3");
        second.stored.results.runs.pop().unwrap();
        second.stored.results.manifest.finished.clear();
        let merged = merge(vec![part(&campaign, "1/3"), second]).unwrap();
        // 2 scenes × 5 repeats are ten units: 4 + 3 + 3, of two runs each.
        let expected = ["1 runs of part 2/3, which is unfinished in part-2", "6 runs of part 3/3, which was not given"];
        assert_eq!(merged.missing, expected);
        assert_eq!(merged.stored.results.manifest.finished, "");
        // What was merged can be merged again.
        let mut rest = part(&campaign, "3/3");
        rest.stored.results.runs.extend(part(&campaign, "2/3").stored.results.runs.pop());
        let again = merge(vec![Part { folder: "both".into(), stored: merged.stored }, rest]).unwrap();
        assert!(again.missing.is_empty());
        assert_eq!(again.stored.results.manifest.shards.len(), 3, "the parts themselves");
    }

    #[test]
    fn overlapping_and_foreign_parts_are_named() {
        let campaign = whole();
        let overlap = refusal(vec![part(&campaign, "1/3"), part(&campaign, "1/2")]);
        assert!(overlap.contains("part-1 (part 1/3) and part-1 (part 1/2) overlap: both hold the run of"), "{overlap}");
        assert!(overlap.contains("scene \"a-scene\", repeat 1"), "{overlap}");
        let mut other = whole();
        other.comparison.seed = 9;
        let foreign = refusal(vec![part(&campaign, "1/2"), part(&other, "2/2")]);
        assert!(foreign.contains("part-2: not of the campaign of part-1: seed 9 instead of 3"), "{foreign}");
        let mut odd = part(&campaign, "2/2");
        odd.stored.results.scenes[1].optimum.length = Some(9.5);
        let odd = refusal(vec![part(&campaign, "1/2"), odd]);
        assert!(odd.contains("another optimum of scene \"a-scene\" than part-1: 9.5 instead of 10."), "{odd}");
    }
}
