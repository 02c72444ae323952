//! Where the scenes of a comparison are read from.

use std::collections::BTreeMap;
use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};

use crate::store::Stored;

/// The name of the embedded comparison.
pub const EMBEDDED_NAME: &str = "lu-sun-2012.toml (embedded)";

/// A file's name for messages, and its bytes.
pub type Opened = (String, Box<dyn Read>);

/// Reads files named relative to a comparison.
pub trait Files {
    /// Opens a file.
    fn open(&self, relative: &str) -> Result<Opened, String>;

    /// Where external planners run whose tables name no folder.
    fn folder(&self) -> &Path;

    /// The file's name for messages and its text.
    fn read(&self, relative: &str) -> Result<(String, String), String> {
        let (name, mut reader) = self.open(relative)?;
        let mut text = String::new();
        reader.read_to_string(&mut text).map_err(|e| format!("cannot read {name}: {e}"))?;
        Ok((name, text))
    }
}

/// Files in and under the folder of a comparison on disk.
pub struct Disk {
    folder: PathBuf,
}

impl Disk {
    /// Files relative to the folder of the file `comparison`.
    pub fn beside(comparison: &Path) -> Self {
        Self { folder: comparison.parent().map(Path::to_owned).unwrap_or_default() }
    }
}

impl Files for Disk {
    fn folder(&self) -> &Path {
        // The empty path of a bare file name is no folder to change to.
        if self.folder.as_os_str().is_empty() { Path::new(".") } else { &self.folder }
    }

    fn open(&self, relative: &str) -> Result<Opened, String> {
        if relative.is_empty() {
            return Err("an empty path".to_owned());
        }
        let path = self.folder.join(relative);
        // Opening it may succeed, and reading then fails without its name.
        if path.is_dir() {
            return Err(format!("cannot read {}: it is a folder", path.display()));
        }
        let file = std::fs::File::open(&path).map_err(|e| format!("cannot read {}: {e}", path.display()))?;
        Ok((path.display().to_string(), Box::new(file)))
    }
}

/// The comparison and the scene that the program carries.
pub struct Embedded;

impl Embedded {
    /// The comparison of Lu & Sun (2012): what `touchline` runs without arguments.
    pub const COMPARISON: &'static str = include_str!("../../../configs/comparisons/lu-sun-2012.toml");
    const SCENE: &'static str = include_str!("../../../configs/scenes/lu-sun-2012.toml");
}

impl Files for Embedded {
    fn folder(&self) -> &Path {
        Path::new(".")
    }

    fn open(&self, relative: &str) -> Result<Opened, String> {
        match relative {
            "../scenes/lu-sun-2012.toml" => {
                Ok(("lu-sun-2012.toml (embedded scene)".into(), Box::new(Cursor::new(Self::SCENE))))
            }
            _ => Err(format!("no embedded file {relative}")),
        }
    }
}

/// The scenes of a campaign that is kept, under the names that its resolved comparison gives them.
pub struct Kept {
    texts: BTreeMap<String, String>,
}

impl Kept {
    /// The files of `stored`.
    pub fn new(stored: &Stored) -> Self {
        let texts = stored.still_scenes().map(|(file, scene)| (file.to_owned(), scene.to_toml())).collect();
        Self { texts }
    }
}

impl Files for Kept {
    fn folder(&self) -> &Path {
        // Every external planner of a resolved comparison says its own.
        Path::new(".")
    }

    fn open(&self, relative: &str) -> Result<Opened, String> {
        let text = self.texts.get(relative).ok_or_else(|| format!("no stored scene {relative}"))?;
        Ok((format!("{relative} (stored)"), Box::new(Cursor::new(text.clone()))))
    }
}
