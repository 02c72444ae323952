//! Which runs of a campaign are to be made: a shard of them, less those that are done.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

/// Part I of N of a campaign. The unit is (scene, repeat), so that the runs that are compared stay together; units
/// are dealt out in turn, so that every part has its share of every scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shard {
    index: u32,
    count: u32,
}

impl Shard {
    /// All of a campaign.
    pub const WHOLE: Self = Self { index: 1, count: 1 };

    /// All N parts of a campaign.
    pub fn all(count: u32) -> impl Iterator<Item = Self> {
        (1..=count).map(move |index| Self { index, count })
    }

    /// Whether unit number `unit`, counted from 0, belongs to it.
    pub fn has(self, unit: usize) -> bool {
        unit % self.count as usize == self.index as usize - 1
    }

    /// Its units as (place of the scene, repeat), in the order in which they are made.
    pub fn units(self, scenes: usize, repeats: u32) -> impl Iterator<Item = (usize, u32)> {
        let all = (0..scenes).flat_map(move |scene| (0..repeats).map(move |repeat| (scene, repeat)));
        all.enumerate().filter(move |(unit, _)| self.has(*unit)).map(|(_, unit)| unit)
    }

    /// How many of a campaign's `units` units it has.
    pub fn size(self, units: usize) -> usize {
        let (index, count) = (self.index as usize, self.count as usize);
        units / count + usize::from(index <= units % count)
    }

    /// Number I, from 1.
    pub fn index(self) -> u32 {
        self.index
    }

    /// Number N.
    pub fn count(self) -> u32 {
        self.count
    }

    /// What a manifest calls it: nothing for all of the campaign.
    pub fn name(self) -> String {
        if self.is_whole() { String::new() } else { self.to_string() }
    }

    /// Whether it is all of the campaign.
    pub fn is_whole(self) -> bool {
        self.count == 1
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| Some((i.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, count)) if 1 <= index && index <= count => Ok(Self { index, count }),
            _ => Err(format!("{text:?}; expected I/N with 1 ≤ I ≤ N, such as 2/3")),
        }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

/// What to run, and how.
#[derive(Debug, Clone)]
pub struct Work {
    /// The part of the campaign.
    pub shard: Shard,
    /// Runs already made, as (place of the scene, place of the planner, repeat).
    pub done: BTreeSet<(usize, usize, u32)>,
    /// Threads, ≥ 1.
    pub jobs: usize,
    /// Whether every planner runs in a process of its own.
    pub isolate: bool,
}

impl Work {
    /// All runs, in the bench's own process where planners allow it.
    pub fn all(jobs: usize) -> Self {
        Self { shard: Shard::WHOLE, done: BTreeSet::new(), jobs, isolate: false }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_deal_out_every_unit_once() {
        let shards: Vec<Shard> = ["1/3", "2/3", "3/3"].iter().map(|s| s.parse().unwrap()).collect();
        for unit in 0..20 {
            assert_eq!(shards.iter().filter(|s| s.has(unit)).count(), 1);
        }
        for units in 0..20 {
            let size = |s: &Shard| s.size(units);
            assert!(shards.iter().all(|s| size(s) == s.units(1, units as u32).count()), "{units}");
        }
        assert_eq!(shards[1].to_string(), "2/3");
        assert_eq!(shards[1].units(2, 4).collect::<Vec<_>>(), [(0, 1), (1, 0), (1, 3)]);
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0", "-1/2", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
