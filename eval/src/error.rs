//! What can go wrong in the bench itself.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use env_model::FileError;
use rusqlite::ErrorCode;

/// Why a command could not do its work. Planners that fail are results, not errors.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A scene or comparison is wrong; says where.
    #[error(transparent)]
    File(#[from] FileError),
    /// A file or folder could not be read or written.
    #[error("cannot {action} {}: {source}", path.display())]
    Io {
        /// "read", "write", "create", ….
        action: &'static str,
        /// What.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// The stored runs could not be read or written.
    #[error("{}: {source}", path.display())]
    Store {
        /// The database.
        path: PathBuf,
        /// Why.
        source: rusqlite::Error,
    },
    /// The stored runs are not what this version understands.
    #[error("{}: {message}", path.display())]
    Foreign {
        /// The database or folder.
        path: PathBuf,
        /// What is the matter and what was expected.
        message: String,
    },
    /// A process or thread could not be started for want of what the bench itself needs.
    #[error("cannot start {what}: {source}")]
    Start {
        /// Its command, in words.
        what: String,
        /// Why.
        source: std::io::Error,
    },
    /// A campaign that cannot go on now.
    #[error("{source}\n{kept}; {}, then {what} with: {command}", remedy(source))]
    Interrupted {
        /// Why.
        source: Box<Self>,
        /// What is safe: "12 of 40 runs are kept in out".
        kept: String,
        /// "go on" or "make the exports".
        what: &'static str,
        /// What does it.
        command: String,
    },
    /// A command line that makes no sense.
    #[error("{0}")]
    Usage(String),
}

/// What to do first about an interruption.
fn remedy(error: &Error) -> &'static str {
    if let Error::Start { .. } = error {
        return "allow more open files and processes, or use fewer --jobs";
    }
    let full = match error {
        Error::Io { source, .. } => {
            matches!(source.kind(), ErrorKind::StorageFull | ErrorKind::QuotaExceeded | ErrorKind::FileTooLarge)
        }
        Error::Store { source, .. } => source.sqlite_error_code() == Some(ErrorCode::DiskFull),
        _ => false,
    };
    if full { "free some space" } else { "mend that" }
}

impl Error {
    /// Says what was being done to `path` when `source` happened.
    pub fn io(action: &'static str, path: impl AsRef<Path>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.as_ref().to_owned();
        move |source| Self::Io { action, path, source }
    }
}
