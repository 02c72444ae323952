//! One process at a time writes into a campaign's folder.
//!
//! An exclusive lock of the operating system on `runs.lock`, which a process that dies gives back, whatever killed it.
//! The file itself goes when the lock is given back, and may stay after a kill: it means nothing then.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

use crate::error::Error;

/// The file's name in a campaign's folder.
pub const FILE: &str = "runs.lock";
/// How often a lock is asked for: who only looks holds it for a moment too.
const ATTEMPTS: u32 = 10;
/// How far these attempts are apart.
const PAUSE: Duration = Duration::from_millis(20);

/// The right to write into a folder, until dropped.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
}

impl Lock {
    /// Takes the lock of a folder that is there; `None` when another process has it.
    pub fn take(folder: &Path) -> Result<Option<Self>, Error> {
        let path = folder.join(FILE);
        for attempt in 0..ATTEMPTS {
            if attempt > 0 {
                std::thread::sleep(PAUSE);
            }
            let mut options = OpenOptions::new();
            let file = options.write(true).create(true).truncate(false).open(&path);
            let file = file.map_err(Error::io("write into", folder))?;
            match file.try_lock() {
                // A file that its last owner removed meanwhile guards nothing.
                Ok(()) if same(&file, &path) => return Ok(Some(Self { path, file })),
                Ok(()) | Err(TryLockError::WouldBlock) => {}
                Err(TryLockError::Error(e)) => return Err(Error::io("lock", &path)(e)),
            }
        }
        Ok(None)
    }

    /// Whether a process is writing into `folder`.
    pub fn is_taken(folder: &Path) -> bool {
        let probe = File::open(folder.join(FILE));
        probe.is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Before it is unlocked, so that nobody locks a file that is about to go.
        let _ = fs::remove_file(&self.path);
        let _ = self.file.unlock();
    }
}

#[cfg(unix)]
fn same(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let place = |data: io::Result<fs::Metadata>| data.ok().map(|data| (data.dev(), data.ino()));
    place(file.metadata()) == place(fs::metadata(path))
}

#[cfg(not(unix))]
fn same(_: &File, path: &Path) -> bool {
    path.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_no_trace() {
        let folder = std::env::temp_dir().join(format!("touchline-lock-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        assert!(!Lock::is_taken(&folder), "no file");
        let lock = Lock::take(&folder).unwrap().expect("free");
        assert!(Lock::is_taken(&folder) && Lock::take(&folder).unwrap().is_none());
        drop(lock);
        assert!(!folder.join(FILE).exists());
        // What a kill leaves behind.
        fs::write(folder.join(FILE), "").unwrap();
        assert!(!Lock::is_taken(&folder) && Lock::take(&folder).unwrap().is_some());
        fs::remove_dir_all(&folder).unwrap();
        assert!(Lock::take(&folder).is_err(), "no folder");
    }
}
