//! The scenes that families name, and the scenes of the cases that follow from them.

use std::collections::BTreeMap;
use std::path::Path;

use mpm_document::DocumentError;
use mpm_scenes::{Scene, SceneError, SceneFault};
use toml::{Table, Value};

use super::case::Case;
use super::configuration::Family;
use super::overrides;
use crate::CommandError;
use crate::study::configuration::fingerprint;

/// Scenes by the names that the configuration has for them.
#[derive(Clone, Debug, Default)]
pub struct SceneFiles {
    tables: BTreeMap<String, Table>,
}

/// The scene of a case, ready to run.
#[derive(Clone, Debug)]
pub struct CaseScene {
    /// All its keys.
    pub table: Table,
    /// The scene.
    pub scene: Scene,
    /// A fingerprint of all its keys and values.
    pub fingerprint: String,
    /// The number on the horizontal axis.
    pub x: f64,
}

impl SceneFiles {
    /// Reads the scenes of the families relative to the configuration's directory.
    ///
    /// # Errors
    /// A family whose scene cannot be read.
    pub fn read(families: &[Family], directory: &Path) -> Result<Self, CommandError> {
        let mut files = Self::default();
        for family in families {
            let name = family.scene.clone().unwrap_or_default();
            if files.tables.contains_key(&name) {
                continue;
            }
            let path = directory.join(&name);
            let refuse = |message: String| family.refuse("scene", format!("{}: {message}", path.display()));
            let text = std::fs::read_to_string(&path).map_err(|error| refuse(error.to_string()))?;
            let table = mpm_document::parse::<Table>(&text, &path);
            let table = table.map_err(|error| family.refuse("scene", error.to_string()))?;
            files.tables.insert(name, table);
        }
        Ok(files)
    }

    /// The family's scene with the changes of family and case.
    ///
    /// # Errors
    /// A change that has no place, what the reader of scenes refuses, or an x that is no number; with family and case.
    pub fn scene(&self, case: &Case) -> Result<CaseScene, CommandError> {
        let name = case.family.scene.as_deref().unwrap_or_default();
        let mut table = self.tables.get(name).cloned().unwrap_or_default();
        let family = case.family.set.iter();
        let own = case.combination.set.iter().map(|(key, value)| (key, value));
        for (key, value) in family.chain(own) {
            let put = overrides::put(&mut table, key, value.clone());
            put.map_err(|message| case.refuse(format!("`{key}`: {message}")))?;
        }
        let x = overrides::number(&table, case.family.x_key()).filter(|x| x.is_finite());
        let x = x.ok_or_else(|| {
            case.family
                .refuse("x", format!("`{}` is no number of the scene", case.family.x_key()))
        })?;
        let text = toml::to_string(&Value::Table(table.clone())).map_err(|error| case.refuse(error.to_string()))?;
        let scene = Scene::parse(&text, Path::new(name)).map_err(|error| case.refuse(refusal_text(error)))?;
        if case.family.read.quantity.is_some() && scene.validation.is_none() {
            return Err(case
                .family
                .refuse("read.quantity", "the scene has no `validation.reference`"));
        }
        let shift = case.family.read.shift(&table);
        shift.map_err(|(field, message)| case.family.refuse(field, message))?;
        Ok(CaseScene {
            scene,
            fingerprint: fingerprint(&text),
            table,
            x,
        })
    }
}

/// What the reader of scenes says, without the line, which is one of the changed text.
pub fn refusal_text(error: SceneError) -> String {
    let file = error.file.display();
    match *error.fault {
        SceneFault::Syntax(DocumentError { place, message, .. }) => match place.map(|place| place.field()) {
            Some(field) => format!("{file}: {field}: {message}"),
            None => format!("{file}: {message}"),
        },
        fault => format!("{file}: {fault}"),
    }
}
