//! A scene's file as a document whose values can be exchanged.

use std::path::{Path, PathBuf};

use mpm_scenes::variation;
use mpm_scenes::{Scene, SceneError, SceneFault};
pub use toml::Value;

use super::FullOrderError;

/// The document of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDocument {
    document: variation::SceneDocument,
    text: String,
    file: PathBuf,
}

impl SceneDocument {
    /// Reads a file.
    ///
    /// # Errors
    /// [`FullOrderError::Unreadable`], and as [`parse`](Self::parse); what is no text is no TOML.
    pub fn read(file: &Path) -> Result<Self, FullOrderError> {
        let bytes = std::fs::read(file).map_err(|source| FullOrderError::Unreadable {
            file: file.display().to_string(),
            source,
        })?;
        let text = mpm_document::text(bytes, file).map_err(|error| SceneError {
            file: file.to_owned(),
            fault: Box::new(error.into()),
        })?;
        Self::parse(&text, file)
    }

    /// As [`read`](Self::read), of a text; `file` is what errors call it.
    ///
    /// # Errors
    /// [`FullOrderError::Scene`] for what is no TOML.
    pub fn parse(text: &str, file: &Path) -> Result<Self, FullOrderError> {
        Ok(Self {
            document: variation::SceneDocument::parse(text, file)?,
            text: text.to_owned(),
            file: file.to_owned(),
        })
    }

    /// The text that was read.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The scene with these values at these dotted keys. A key names something that there is: `bodies.0.shape.upper.1` is the second entry of `upper` of the
    /// first body's shape.
    ///
    /// # Errors
    /// [`FullOrderError::Change`] for a key that there is not, or that has no place for such a value, and what [`Scene::parse`] says.
    pub fn scene(&self, changes: &[(String, Value)]) -> Result<Scene, FullOrderError> {
        match self.changed(changes) {
            Err(FullOrderError::Scene(error)) if is_syntax(&error) => Err(self.culprit(changes, error)),
            scene => scene,
        }
    }

    fn changed(&self, changes: &[(String, Value)]) -> Result<Scene, FullOrderError> {
        let mut document = self.document.clone();
        for (key, value) in changes {
            let exchanged = document.exchange(key, value.clone());
            exchanged.map_err(|reason| self.refused(key, reason))?;
        }
        Ok(document.scene()?)
    }

    /// What is to blame for a document that is no scene: the file, whose own lines the error then has, or the first change that makes it none.
    fn culprit(&self, changes: &[(String, Value)], error: SceneError) -> FullOrderError {
        match Scene::parse(&self.text, &self.file) {
            Err(own) if is_syntax(&own) => return own.into(),
            _ => {}
        }
        for (number, (key, _)) in changes.iter().enumerate() {
            if let Err(FullOrderError::Scene(error)) = self.changed(&changes[..=number])
                && let SceneFault::Syntax(fault) = *error.fault
            {
                return self.refused(key, fault.message);
            }
        }
        error.into()
    }

    fn refused(&self, key: &str, reason: String) -> FullOrderError {
        FullOrderError::Change {
            file: self.file.display().to_string(),
            key: key.to_owned(),
            reason,
        }
    }
}

fn is_syntax(error: &SceneError) -> bool {
    matches!(*error.fault, SceneFault::Syntax(_))
}
