//! The scenes that families name, and the scenes of the cases that follow from them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use mpm_document::DocumentError;
use mpm_scenes::scene::keys;
use mpm_scenes::{Scene, SceneError, SceneFault};
use toml::{Table, Value};

use super::Variant;
use super::family::Family;
use crate::CommandError;
use crate::study::configuration::fingerprint;

/// Scenes by the names that the configuration has for them.
#[derive(Clone, Debug, Default)]
pub struct SceneFiles {
    tables: BTreeMap<String, Table>,
    /// That of the configuration, from which the names and what scenes name count.
    directory: PathBuf,
}

/// The scene of a case, ready to run.
#[derive(Clone, Debug)]
pub struct CaseScene {
    /// The scene.
    pub own: PreparedScene,
    /// That which it is compared with.
    pub against: Option<PreparedScene>,
    /// The number on the horizontal axis.
    pub x: f64,
}

impl CaseScene {
    /// The fingerprint of the scene that it is compared with; empty where there is none.
    pub fn against(&self) -> &str {
        self.against.as_ref().map_or("", |other| &other.fingerprint)
    }
}

/// A scene with changes.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    /// All its keys.
    pub table: Table,
    /// The scene.
    pub scene: Scene,
    /// A fingerprint of all its keys and values.
    pub fingerprint: String,
}

impl SceneFiles {
    /// Reads the scenes of the families relative to the configuration's directory.
    ///
    /// # Errors
    /// A family whose scene cannot be read.
    pub fn read(families: &[Family], directory: &Path) -> Result<Self, CommandError> {
        let mut files = Self {
            directory: directory.to_owned(),
            ..Self::default()
        };
        for family in families {
            let other = family.read.against.as_ref().and_then(|other| other.scene.as_ref());
            for (field, name) in [("scene", family.scene.as_ref()), ("read.against.scene", other)] {
                if let Some(name) = name {
                    files.add(name).map_err(|message| family.refuse(field, message))?;
                }
            }
        }
        Ok(files)
    }

    /// Reads one scene, if it has not been; an error is in words.
    fn add(&mut self, name: &str) -> Result<(), String> {
        if self.tables.contains_key(name) {
            return Ok(());
        }
        let path = self.directory.join(name);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{}: {error}", path.display()))?;
        let table = mpm_document::parse::<Table>(&text, &path).map_err(|error| error.to_string())?;
        self.tables.insert(name.to_owned(), table);
        Ok(())
    }

    /// The family's scene with the changes of family and case, and the one that it is compared with.
    ///
    /// # Errors
    /// A change that has no place, what the reader of scenes refuses, or an x that is no number; with family and case.
    pub fn scene(&self, case: &Variant) -> Result<CaseScene, CommandError> {
        let name = case.family.scene.as_deref().unwrap_or_default();
        let family = case.family.set.iter();
        let own = case.combination.set.iter().map(|(key, value)| (key, value));
        let table = self.tables.get(name).cloned().unwrap_or_default();
        let table = changed(table, family.chain(own), &case.combination.drop);
        let own = prepared(
            table.map_err(|message| case.refuse(message))?,
            &self.directory.join(name),
            case,
        )?;
        let keys = &case.family.x;
        let x = keys.iter().find_map(|key| keys::number(&own.table, key));
        let x = x.filter(|x| x.is_finite()).ok_or_else(|| {
            case.family
                .refuse("x", format!("`{}` is no number of the scene", keys.join("`, `")))
        })?;
        if case.family.read.quantity.is_some() && own.scene.validation.is_none() {
            let message = "the scene has no `validation.reference`";
            return Err(case.family.refuse("read.quantity", message));
        }
        let shift = case.family.read.shift(&own.table);
        shift.map_err(|(field, message)| case.family.refuse(field, message))?;
        let against = match &case.family.read.against {
            None => None,
            Some(other) => {
                let table = match &other.scene {
                    Some(name) => self.tables.get(name).cloned().unwrap_or_default(),
                    None => own.table.clone(),
                };
                let table = changed(table, other.set.iter(), &other.drop);
                let table = table.map_err(|message| case.family.refuse("read.against", message))?;
                let path = self.directory.join(other.scene.as_deref().unwrap_or(name));
                Some(prepared(table, &path, case)?)
            }
        };
        Ok(CaseScene { own, against, x })
    }
}

/// A table with values put and keys removed; an error is in words.
fn changed<'a>(
    mut table: Table,
    set: impl Iterator<Item = (&'a String, &'a Value)>,
    drop: &[String],
) -> Result<Table, String> {
    for (key, value) in set {
        keys::put(&mut table, key, value.clone()).map_err(|message| format!("`{key}`: {message}"))?;
    }
    for key in drop {
        keys::remove(&mut table, key);
    }
    Ok(table)
}

fn prepared(table: Table, path: &Path, case: &Variant) -> Result<PreparedScene, CommandError> {
    let text = toml::to_string(&Value::Table(table.clone())).map_err(|error| case.refuse(error.to_string()))?;
    let scene = Scene::parse(&text, path).map_err(|error| case.refuse(refusal_text(error)))?;
    Ok(PreparedScene {
        scene,
        fingerprint: fingerprint(&text),
        table,
    })
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
