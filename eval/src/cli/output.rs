//! Where a campaign may leave its results.

use std::ffi::OsStr;
use std::fs::{self, OpenOptions};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::lock::{self, Lock};
use crate::store::{self, Store};
use crate::work::Shard;

/// The folder that a campaign called `name` would get: `out` if it is new or empty, else
/// `results/<name>`, numbered when taken. Creates nothing, and so promises nothing.
pub(super) fn choose(out: Option<&Path>, name: &str) -> Result<PathBuf, Error> {
    match out {
        Some(out) if is_free(out)? => Ok(out.to_owned()),
        Some(out) => Err(refusal(out)),
        None => numbered(name).find(|folder| folder.symlink_metadata().is_err()).ok_or_else(|| none_free(name)),
    }
}

/// `results/<name>`, `results/<name>-2`, ….
fn numbered(name: &str) -> impl Iterator<Item = PathBuf> + '_ {
    let numbers = (2u32..).map(move |number| format!("{name}-{number}"));
    std::iter::once(name.to_owned()).chain(numbers).map(|name| Path::new("results").join(name))
}

fn none_free(name: &str) -> Error {
    Error::Usage(format!("no free folder results/{name}-…; name one with --out"))
}

/// `results/<name>`, where a campaign is looked for that is to go on.
pub(super) fn usual(name: &str) -> PathBuf {
    Path::new("results").join(name)
}

/// The name of a folder for a part of a campaign.
pub(super) fn part_name(name: &str, shard: Shard) -> String {
    if shard.is_whole() { name.to_owned() } else { format!("{name}-shard-{}-of-{}", shard.index(), shard.count()) }
}

/// Whether `folder` holds nothing but what a campaign leaves that never began.
fn is_free(folder: &Path) -> Result<bool, Error> {
    let ours = |entry: &fs::DirEntry| entry.file_name() == lock::FILE;
    match fs::read_dir(folder) {
        Ok(mut entries) => Ok(entries.all(|entry| entry.is_ok_and(|entry| ours(&entry)))),
        Err(e) if e.kind() == ErrorKind::NotFound => Ok(true),
        Err(e) => Err(Error::io("use the folder", folder)(e)),
    }
}

fn refusal(folder: &Path) -> Error {
    let database = folder.join(store::FILE);
    let begun = database.metadata().is_ok_and(|file| file.len() > 0);
    if database.exists() && !begun {
        // Not to be opened: it may become another campaign's at this moment.
        let message = "holds a campaign that is just beginning, or never began; expected a new or empty folder, \
            or --resume and the comparison's file";
        return Error::Foreign { path: folder.to_owned(), message: message.to_owned() };
    }
    let message = match Store::open(folder).and_then(|store| store.head()) {
        Ok(stored) => {
            let manifest = &stored.results.manifest;
            let (state, hint) = match manifest.finished.is_empty() {
                true => ("an unfinished campaign", ", or --resume to go on with it"),
                false => ("a finished campaign", ""),
            };
            format!(
                "holds {state}, {:?} of {} (identity {}); expected a new or empty folder{hint}",
                stored.results.name, manifest.started, manifest.identity
            )
        }
        Err(e) if begun => {
            format!("holds a {} that cannot be read as a campaign's ({e}); expected a new or empty folder", store::FILE)
        }
        Err(_) => "holds other files; expected a new or empty folder".to_owned(),
    };
    Error::Foreign { path: folder.to_owned(), message }
}

/// What there is in a folder in which a campaign is to go on.
pub(super) enum Found {
    /// None yet: it may begin.
    Nothing(Claim),
    /// One that was begun, and nobody else is working on it. Without a lock it is complete, in a place that cannot be
    /// written to.
    Campaign(Option<Lock>),
}

/// Looks for a campaign in `folder`, which is created where it is missing.
pub(super) fn find(folder: &Path) -> Result<Found, Error> {
    let mut claim = Claim::default();
    claim.make(folder)?;
    let lock = match Lock::take(folder) {
        Err(_) if is_finished(folder) => return Ok(Found::Campaign(None)),
        lock => lock?,
    };
    let Some(lock) = lock else {
        let message = "another process is working on this campaign; expected it to end first".to_owned();
        return Err(Error::Foreign { path: folder.to_owned(), message });
    };
    if !Store::is_blank(folder)? {
        claim.keep = true;
        return Ok(Found::Campaign(Some(lock)));
    }
    let ours = |name: &OsStr| name == lock::FILE || name.to_str().is_some_and(|n| FILES.contains(&n));
    let entries = fs::read_dir(folder).map_err(Error::io("use the folder", folder))?;
    for entry in entries {
        if !ours(&entry.map_err(Error::io("use the folder", folder))?.file_name()) {
            return Err(refusal(folder));
        }
    }
    (claim.folder, claim.taken, claim.lock) = (folder.to_owned(), true, Some(lock));
    Ok(Found::Nothing(claim))
}

fn is_finished(folder: &Path) -> bool {
    let head = Store::open(folder).and_then(|store| store.head());
    head.is_ok_and(|stored| !stored.results.manifest.finished.is_empty())
}

/// The database, and what `SQLite` puts beside it.
const FILES: [&str; 4] = ["runs.db-wal", "runs.db-shm", "runs.db-journal", store::FILE];

/// A folder that is this campaign's alone, until kept: whatever the claim created is removed again unless kept,
/// and nothing else ever is.
#[derive(Default)]
pub(super) struct Claim {
    folder: PathBuf,
    /// Folders that did not exist before, the deepest last.
    created: Vec<PathBuf>,
    /// Whether the folder's `runs.db` is ours.
    taken: bool,
    lock: Option<Lock>,
    keep: bool,
}

impl Claim {
    /// Claims the folder that [`choose`] describes. Of several processes that want the same one, one gets it:
    /// who creates the empty `runs.db`.
    pub(super) fn new(out: Option<&Path>, name: &str) -> Result<Self, Error> {
        let mut claim = Self::default();
        if let Some(out) = out {
            claim.make(out)?;
            return if is_free(out)? && claim.take(out)? { Ok(claim) } else { Err(refusal(out)) };
        }
        for folder in numbered(name) {
            if claim.make(&folder)? && claim.take(&folder)? {
                return Ok(claim);
            }
        }
        Err(none_free(name))
    }

    /// Creates `folder` and its parents; `false` when it was there.
    fn make(&mut self, folder: &Path) -> Result<bool, Error> {
        let mut attempts = 8;
        loop {
            match (fs::create_dir(folder), folder.parent()) {
                (Ok(()), _) => {
                    self.created.push(folder.to_owned());
                    return Ok(true);
                }
                (Err(e), _) if e.kind() == ErrorKind::AlreadyExists => return Ok(false),
                // More than once, since another process may remove the parent that it created.
                (Err(e), Some(parent))
                    if e.kind() == ErrorKind::NotFound && attempts > 0 && !parent.as_os_str().is_empty() =>
                {
                    attempts -= 1;
                    self.make(parent)?;
                }
                (Err(e), _) => return Err(Error::io("create", folder)(e)),
            }
        }
    }

    /// Locks the folder and creates `runs.db`, empty, which also shows that files can be written; `false` when
    /// somebody else was first.
    fn take(&mut self, folder: &Path) -> Result<bool, Error> {
        let Some(lock) = Lock::take(folder)? else { return Ok(false) };
        self.lock = Some(lock);
        match OpenOptions::new().write(true).create_new(true).open(folder.join(store::FILE)) {
            Ok(_) => {
                (self.folder, self.taken) = (folder.to_owned(), true);
                Ok(true)
            }
            Err(e) if e.kind() == ErrorKind::AlreadyExists => {
                self.lock = None;
                Ok(false)
            }
            Err(e) => Err(Error::io("write into", folder)(e)),
        }
    }

    /// The folder stays, locked.
    pub(super) fn keep(mut self) -> Option<Lock> {
        self.keep = true;
        self.lock.take()
    }

    /// The folder claimed.
    pub(super) fn folder(&self) -> &Path {
        &self.folder
    }
}

impl Drop for Claim {
    fn drop(&mut self) {
        if self.keep {
            return;
        }
        if self.taken {
            // `runs.db` last: without it the folder is anybody's.
            for file in FILES {
                let _ = fs::remove_file(self.folder.join(file));
            }
        }
        self.lock = None;
        for folder in self.created.iter().rev() {
            // Fails, as it should, where anybody else has put something.
            let _ = fs::remove_dir(folder);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_kept_leaves_no_trace() {
        let root = std::env::temp_dir().join(format!("touchline-output-{}", std::process::id()));
        let claim = |folder: &Path| Claim::new(Some(folder), "x");
        let deep = root.join("a/b");
        drop(claim(&deep).unwrap());
        assert!(!root.exists());
        fs::create_dir_all(&deep).unwrap();
        drop(claim(&deep).unwrap());
        assert_eq!(choose(Some(&deep), "x").unwrap(), deep, "empty again, and still there");
        let lock = claim(&deep).unwrap().keep();
        assert!(claim(&deep).is_err(), "claimed");
        assert!(deep.join(store::FILE).exists(), "a refused claim removes nothing");
        assert!(find(&deep).is_err_and(|e| e.to_string().contains("another process is working on")), "locked");
        drop(lock);
        assert!(matches!(find(&deep).unwrap(), Found::Nothing(_)), "an empty database is no campaign");
        fs::write(root.join("a/notes"), "mine").unwrap();
        drop(claim(&root.join("a/c")).unwrap());
        assert!(root.join("a/notes").exists() && !root.join("a/c").exists());
        assert!(choose(Some(&root.join("a")), "x").is_err(), "other files");
        fs::remove_dir_all(&root).unwrap();
    }
}
