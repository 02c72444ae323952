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

    /// Whether unit number `unit`, counted from 0, belongs to it.
    pub fn has(self, unit: usize) -> bool {
        unit % self.count as usize == self.index as usize - 1
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
        assert_eq!(shards[1].to_string(), "2/3");
        for wrong in ["0/3", "4/3", "1", "a/b", "1/0", "-1/2", ""] {
            assert!(wrong.parse::<Shard>().is_err(), "{wrong}");
        }
    }
}
