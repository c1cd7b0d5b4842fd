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
        match std::fs::read_to_string(&file) {
            Ok(text) => Self::parse(&text, &file),
            Err(error) => Err(SceneError {
                file,
                fault: Box::new(error.into()),
            }),
        }
    }

    /// As [`read`](Self::read), of a text that is in no file yet; `file` is what errors call it.
    ///
    /// # Errors
    /// As [`read`](Self::read).
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        let scene = toml::from_str(text).map_err(|error| syntax(text, &error));
        let checked = scene.and_then(|mut scene: Self| {
            scene.file = file.to_owned();
            scene.text = text.to_owned();
            scene.check()?;
            Ok(scene)
        });
        checked.map_err(|fault| SceneError {
            file: file.to_owned(),
            fault: Box::new(fault),
        })
    }

    /// A fault of this scene as an error that names its file.
    pub fn error(&self, fault: SceneFault) -> SceneError {
        SceneError {
            file: self.file.clone(),
            fault: Box::new(fault),
        }
    }
}

/// The parser's error with the line and the field that it stands at.
fn syntax(text: &str, error: &toml::de::Error) -> SceneFault {
    let before = error.span().and_then(|span| text.get(..span.start)).unwrap_or("");
    let line = before.lines().count().max(1) + usize::from(before.ends_with('\n'));
    SceneFault::Syntax {
        line,
        field: field_at(text, line),
        message: error.message().to_owned(),
    }
}

/// The key in a line with the table it stands in.
fn field_at(text: &str, line: usize) -> String {
    let header = |line: &str| {
        let name = line.trim().strip_prefix('[')?;
        let name = name.trim_start_matches('[').split(']').next()?;
        Some(name.trim().to_owned())
    };
    let table = text.lines().take(line).filter_map(header).last().unwrap_or_default();
    let own = text.lines().nth(line - 1).filter(|line| header(line).is_none());
    let key = own.and_then(|line| Some(line.split_once('=')?.0.trim())).unwrap_or("");
    match (table.is_empty(), key.is_empty()) {
        (true, _) => key.to_owned(),
        (false, true) => table,
        (false, false) => format!("{table}.{key}"),
    }
}
