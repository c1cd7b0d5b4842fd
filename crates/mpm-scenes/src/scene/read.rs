//! From the file to the document.

use std::path::{Path, PathBuf};

use super::Scene;
use crate::{SceneError, SceneFault};

impl Scene {
    /// Reads and checks a scene.
    ///
    /// # Errors
    /// [`SceneError`] with the file, the field and the value that is wrong. What only the filled bodies can tell (empty or overlapping
    /// shapes, the longest time step) is left to [`simulate`](crate::simulate).
    pub fn read(path: impl Into<PathBuf>) -> Result<Self, SceneError> {
        let file = path.into();
        let text = text_of(&file)?;
        Self::parse(&text, &file)
    }

    /// As [`read`](Self::read), of a text that is in no file yet; `file` is what errors call it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        let scene = mpm_document::parse(text, file).map_err(SceneFault::from);
        let checked = scene.and_then(|mut scene: Self| {
            scene.file = file.to_owned();
            scene.text = text.to_owned();
            scene.check()?;
            Ok(scene)
        });
        checked.map_err(|fault| refused(file, fault))
    }

    /// A fault of this scene as an error that names its file.
    pub fn error(&self, fault: SceneFault) -> SceneError {
        refused(&self.file, fault)
    }
}

/// The text of a file.
///
/// # Errors
/// [`SceneFault::Unreadable`], [`SceneFault::Syntax`] for what is no text.
pub(crate) fn text_of(file: &Path) -> Result<String, SceneError> {
    let bytes = std::fs::read(file).map_err(|error| refused(file, error.into()))?;
    mpm_document::text(bytes, file).map_err(|error| refused(file, error.into()))
}

fn refused(file: &Path, fault: SceneFault) -> SceneError {
    SceneError {
        file: file.to_owned(),
        fault: Box::new(fault),
    }
}
