//! A scene's file as a document whose values can be exchanged.

use std::path::{Path, PathBuf};

use mpm_document::DocumentError;
use toml::{Table, Value};

use super::keys;
use crate::scene::text_of;
use crate::{Scene, SceneError, SceneFault};

/// The document of a scene.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneDocument {
    table: Table,
    file: PathBuf,
}

impl SceneDocument {
    /// Reads a file.
    ///
    /// # Errors
    /// [`SceneFault::Unreadable`], or [`SceneFault::Syntax`] for what is no text or no TOML.
    pub fn read(file: &Path) -> Result<Self, SceneError> {
        Self::parse(&text_of(file)?, file)
    }

    /// As [`read`](Self::read), of a text; `file` is what errors call it.
    ///
    /// # Errors
    /// [`SceneFault::Syntax`] for what is no TOML.
    pub fn parse(text: &str, file: &Path) -> Result<Self, SceneError> {
        Ok(Self {
            table: mpm_document::parse(text, file).map_err(|error| refused(file, error))?,
            file: file.to_owned(),
        })
    }

    /// Puts a value where a key says; what was there is replaced, tables as a whole. Tables on the way that do not exist are made, elements of arrays
    /// have to be there.
    ///
    /// # Errors
    /// What is in the way, in words.
    pub fn put(&mut self, key: &str, value: Value) -> Result<(), String> {
        keys::put(&mut self.table, key, value)
    }

    /// Puts a value in the place of one that there is.
    ///
    /// # Errors
    /// What there is not, in words.
    pub fn exchange(&mut self, key: &str, value: Value) -> Result<(), String> {
        keys::exchange(&mut self.table, key, value)
    }

    /// Removes what is at a key; nothing where there is nothing.
    pub fn remove(&mut self, key: &str) {
        keys::remove(&mut self.table, key);
    }

    /// Puts values in the places of their keys and removes keys.
    ///
    /// # Errors
    /// As [`put`](Self::put), with the key.
    pub fn change<'a>(
        &mut self,
        set: impl IntoIterator<Item = (&'a String, &'a Value)>,
        drop: &[String],
    ) -> Result<(), String> {
        for (key, value) in set {
            let put = self.put(key, value.clone());
            put.map_err(|message| format!("`{key}`: {message}"))?;
        }
        drop.iter().for_each(|key| self.remove(key));
        Ok(())
    }

    /// The number at a key.
    pub fn number(&self, key: &str) -> Option<f64> {
        keys::number(&self.table, key)
    }

    /// The document as a text, whose lines are not those of the file.
    ///
    /// # Errors
    /// [`SceneFault::Syntax`] for values that TOML cannot hold.
    pub fn text(&self) -> Result<String, SceneError> {
        toml::to_string(&self.table).map_err(|error| {
            let fault = DocumentError {
                file: self.file.clone(),
                place: None,
                message: error.to_string(),
            };
            refused(&self.file, fault)
        })
    }

    /// The scene.
    ///
    /// # Errors
    /// As [`Scene::parse`]; places are those of [`text`](Self::text).
    pub fn scene(&self) -> Result<Scene, SceneError> {
        Scene::parse(&self.text()?, &self.file)
    }
}

fn refused(file: &Path, fault: impl Into<SceneFault>) -> SceneError {
    SceneError {
        file: file.to_owned(),
        fault: Box::new(fault.into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn changes_put_and_remove_and_name_what_has_no_place() {
        let mut document = SceneDocument::parse("a = 1\n", Path::new("s.toml")).unwrap();
        let set = |text: &str| text.parse::<Table>().unwrap();
        let refused = document.change(&set("\"a.b\" = 2"), &[]).unwrap_err();
        assert!(refused.starts_with("`a.b`: "), "{refused}");
        document.change(&set("\"b.c\" = 2.5"), &["a".to_owned()]).unwrap();
        assert_eq!((document.number("b.c"), document.number("a")), (Some(2.5), None));
    }

    #[test]
    fn an_error_of_changed_text_names_no_line() {
        let error = SceneDocument::parse("a =\n", Path::new("s.toml")).unwrap_err();
        assert!(error.to_string().contains("line 1"), "{error}");
        let text = error.without_line();
        assert!(text.starts_with("s.toml: ") && !text.contains("line"), "{text}");
    }
}
