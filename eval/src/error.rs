//! What can go wrong in the bench itself.

use std::path::{Path, PathBuf};

use env_model::FileError;

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
    /// A command line that makes no sense.
    #[error("{0}")]
    Usage(String),
    /// Something that the design promises and this version lacks.
    #[error("not yet: {0}")]
    NotYet(String),
}

impl Error {
    /// Says what was being done to `path` when `source` happened.
    pub fn io(action: &'static str, path: impl AsRef<Path>) -> impl FnOnce(std::io::Error) -> Self {
        let path = path.as_ref().to_owned();
        move |source| Self::Io { action, path, source }
    }
}
