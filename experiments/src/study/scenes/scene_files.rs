//! The scenes that families name, and the scenes of the cases that follow from them.

use std::collections::BTreeMap;
use std::path::Path;

use mpm_scenes::variation::{PreparedScene, SceneDocument};

use super::Variant;
use super::family::Family;
use crate::CommandError;

/// Scenes by the names that the configuration has for them.
#[derive(Clone, Debug, Default)]
pub struct SceneFiles {
    documents: BTreeMap<String, SceneDocument>,
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

impl SceneFiles {
    /// Reads the scenes of the families relative to the configuration's directory.
    ///
    /// # Errors
    /// A family whose scene cannot be read.
    pub fn read(families: &[Family], directory: &Path) -> Result<Self, CommandError> {
        let mut files = Self::default();
        for family in families {
            let other = family.read.against.as_ref().and_then(|other| other.scene.as_ref());
            for (field, name) in [("scene", family.scene.as_ref()), ("read.against.scene", other)] {
                if let Some(name) = name {
                    let document = SceneDocument::read(&directory.join(name));
                    let document = document.map_err(|error| family.refuse(field, error.to_string()))?;
                    files.documents.insert(name.clone(), document);
                }
            }
        }
        Ok(files)
    }

    /// The family's scene with the changes of family and case, and the one that it is compared with.
    ///
    /// # Errors
    /// A change that has no place, what the reader of scenes refuses, or an x that is no number; with family and case.
    pub fn scene(&self, case: &Variant) -> Result<CaseScene, CommandError> {
        let of_name = |name: &Option<String>| name.as_ref().and_then(|name| self.documents.get(name)).cloned();
        let family = case.family.set.iter();
        let own = case.combination.set.iter().map(|(key, value)| (key, value));
        let mut document = of_name(&case.family.scene).unwrap_or_default();
        let changed = document.change(family.chain(own), &case.combination.drop);
        changed.map_err(|message| case.refuse(message))?;
        let own = prepared(document, case)?;
        let keys = &case.family.x;
        let x = keys.iter().find_map(|key| own.document.number(key));
        let otherwise = || format!("`{}` is no number of the scene", keys.join("`, `"));
        let x = x
            .filter(|x| x.is_finite())
            .ok_or_else(|| case.family.refuse("x", otherwise()))?;
        if case.family.read.quantity.is_some() && own.scene.validation.is_none() {
            let message = "the scene has no `validation.reference`";
            return Err(case.family.refuse("read.quantity", message));
        }
        let shift = case.family.read.shift(&own.document);
        shift.map_err(|error| case.family.misread(error))?;
        let mut against = None;
        if let Some(other) = &case.family.read.against {
            let mut document = of_name(&other.scene).unwrap_or_else(|| own.document.clone());
            let changed = document.change(&other.set, &other.drop);
            changed.map_err(|message| case.family.refuse("read.against", message))?;
            against = Some(prepared(document, case)?);
        }
        Ok(CaseScene { own, against, x })
    }
}

fn prepared(document: SceneDocument, case: &Variant) -> Result<PreparedScene, CommandError> {
    PreparedScene::new(document).map_err(|error| case.refuse(error.without_line()))
}
