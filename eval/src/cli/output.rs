//! Where a campaign may leave its results.

use std::fs;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::store::{self, Store};

/// The folder for a campaign called `name`: `out` if it is new or empty, else
/// `results/<name>`, numbered when taken. Creates nothing.
pub(super) fn choose(out: Option<&Path>, name: &str) -> Result<PathBuf, Error> {
    if let Some(out) = out {
        return if is_free(out)? { Ok(out.to_owned()) } else { Err(refusal(out)) };
    }
    let results = Path::new("results");
    for number in 1u32.. {
        let folder = results.join(if number == 1 { name.to_owned() } else { format!("{name}-{number}") });
        // A file of that name counts as taken; other trouble shows when the folder is made.
        if is_free(&folder).unwrap_or(!folder.exists()) {
            return Ok(folder);
        }
    }
    Err(Error::Usage(format!("no free folder results/{name}-…; name one with --out")))
}

fn is_free(folder: &Path) -> Result<bool, Error> {
    match fs::read_dir(folder) {
        Ok(mut entries) => Ok(entries.next().is_none()),
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => Ok(true),
        Err(e) => Err(Error::io("use the folder", folder)(e)),
    }
}

fn refusal(folder: &Path) -> Error {
    let message = match Store::open(folder).and_then(|store| store.read()) {
        Ok(stored) => {
            let manifest = &stored.results.manifest;
            let state = if manifest.finished.is_empty() { "an unfinished campaign" } else { "a finished campaign" };
            format!(
                "holds {state}, {:?} of {} (identity {}); expected a new or empty folder",
                stored.results.name, manifest.started, manifest.identity
            )
        }
        Err(e) if folder.join(store::FILE).exists() => format!("holds a {} that is no campaign's: {e}", store::FILE),
        Err(_) => "holds other files; expected a new or empty folder".to_owned(),
    };
    Error::Foreign { path: folder.to_owned(), message }
}

/// A folder under construction, which was new or empty: what was made in it is removed again unless kept.
pub(super) struct Folder {
    folder: PathBuf,
    /// Folders that did not exist before, the deepest first.
    created: Vec<PathBuf>,
    keep: bool,
}

impl Folder {
    /// Creates `folder` and its parents and makes sure that files can be written in it.
    pub(super) fn create(folder: &Path) -> Result<Self, Error> {
        let missing = folder.ancestors().take_while(|p| !p.as_os_str().is_empty() && !p.exists());
        let created = missing.map(Path::to_owned).collect();
        let this = Self { folder: folder.to_owned(), created, keep: false };
        fs::create_dir_all(folder).map_err(Error::io("create", folder))?;
        let probe = folder.join(".touchline-probe");
        fs::write(&probe, "").map_err(Error::io("write into", folder))?;
        let _ = fs::remove_file(&probe);
        Ok(this)
    }

    /// The folder stays.
    pub(super) fn keep(mut self) {
        self.keep = true;
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        if self.keep {
            return;
        }
        for suffix in ["", "-wal", "-shm", "-journal"] {
            let _ = fs::remove_file(self.folder.join(format!("{}{suffix}", store::FILE)));
        }
        for folder in &self.created {
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
        let deep = root.join("a/b");
        drop(Folder::create(&deep).unwrap());
        assert!(!root.exists());
        Folder::create(&deep).unwrap().keep();
        assert!(deep.is_dir());
        fs::write(root.join("a/notes"), "mine").unwrap();
        drop(Folder::create(&root.join("a/c")).unwrap());
        assert!(root.join("a/notes").exists() && !root.join("a/c").exists());
        assert!(choose(Some(&root.join("a")), "x").is_err(), "other files");
        assert_eq!(choose(Some(&deep), "x").unwrap(), deep, "empty");
        fs::remove_dir_all(&root).unwrap();
    }
}
