//! A scene's file as a document whose values can be exchanged.

use std::path::{Path, PathBuf};

use mpm_scenes::Scene;
use toml::Table;
pub use toml::Value;

use super::FullOrderError;

/// The document of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneDocument {
    table: Table,
    file: PathBuf,
}

impl SceneDocument {
    /// Reads a file.
    ///
    /// # Errors
    /// [`FullOrderError::Unreadable`], [`FullOrderError::Syntax`].
    pub fn read(file: &Path) -> Result<Self, FullOrderError> {
        let text = std::fs::read_to_string(file).map_err(|source| FullOrderError::Unreadable {
            file: file.display().to_string(),
            source,
        })?;
        Self::parse(&text, file)
    }

    /// As [`read`](Self::read), of a text; `file` is what errors call it.
    ///
    /// # Errors
    /// [`FullOrderError::Syntax`].
    pub fn parse(text: &str, file: &Path) -> Result<Self, FullOrderError> {
        let table = text.parse::<Table>().map_err(|error| FullOrderError::Syntax {
            file: file.display().to_string(),
            message: error.to_string(),
        })?;
        Ok(Self {
            table,
            file: file.to_owned(),
        })
    }

    /// The scene with these values at these dotted keys. A key names something that there is: `bodies.0.shape.upper.1` is the second entry of `upper` of the
    /// first body's shape.
    ///
    /// # Errors
    /// [`FullOrderError::Change`] for a key that there is not, and what [`Scene::parse`] says.
    pub fn scene(&self, changes: &[(String, Value)]) -> Result<Scene, FullOrderError> {
        let mut whole = Value::Table(self.table.clone());
        for (key, value) in changes {
            let refused = |reason: String| FullOrderError::Change {
                file: self.file.display().to_string(),
                key: key.clone(),
                reason,
            };
            *find(&mut whole, key).map_err(refused)? = value.clone();
        }
        let text = toml::to_string(&whole).map_err(|error| FullOrderError::Syntax {
            file: self.file.display().to_string(),
            message: error.to_string(),
        })?;
        Ok(Scene::parse(&text, &self.file)?)
    }
}

/// The value at a dotted key.
fn find<'a>(whole: &'a mut Value, key: &str) -> Result<&'a mut Value, String> {
    key.split('.').try_fold(whole, |place, name| {
        let found = match place {
            Value::Table(table) => table.get_mut(name),
            Value::Array(elements) => name.parse::<usize>().ok().and_then(|index| elements.get_mut(index)),
            _ => None,
        };
        found.ok_or_else(|| format!("there is no `{name}`"))
    })
}
