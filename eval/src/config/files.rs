//! Where the scenes of a comparison are read from.

use std::path::{Path, PathBuf};

/// The name of the embedded comparison.
pub const EMBEDDED_NAME: &str = "lu-sun-2012.toml (embedded)";

/// Reads files named relative to a comparison.
pub trait Files {
    /// The file's name for messages and its text.
    fn read(&self, relative: &str) -> Result<(String, String), String>;
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
    fn read(&self, relative: &str) -> Result<(String, String), String> {
        let path = self.folder.join(relative);
        let text = std::fs::read_to_string(&path).map_err(|e| format!("cannot read {}: {e}", path.display()))?;
        Ok((path.display().to_string(), text))
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
    fn read(&self, relative: &str) -> Result<(String, String), String> {
        match relative {
            "../scenes/lu-sun-2012.toml" => Ok(("lu-sun-2012.toml (embedded scene)".into(), Self::SCENE.into())),
            _ => Err(format!("no embedded file {relative}")),
        }
    }
}
