//! The configuration of the study `scenes`.

use super::family::Family;
use super::scene_files::SceneFiles;
use crate::study::prelude::*;

/// Families of runs of scenes.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Scenes {
    /// Heads the report.
    pub title: String,
    /// The families.
    pub families: Vec<Family>,
    /// The scenes that the families name, once they are read.
    #[serde(skip)]
    pub files: SceneFiles,
}

impl Scenes {
    /// The families with what they take over from others.
    ///
    /// # Errors
    /// The field that is wrong, with the family.
    pub fn resolved(&self) -> Result<Vec<Family>, CommandError> {
        not_empty("families", &self.families)?;
        let mut known: Vec<Family> = Vec::with_capacity(self.families.len());
        for family in &self.families {
            if known.iter().any(|other| other.name == family.name) {
                return Err(family.refuse("name", "is that of another family"));
            }
            let model = family.like.as_ref().map(|name| {
                let named = known.iter().find(|other| other.name == *name);
                named.ok_or_else(|| family.refuse("like", format!("no family before it is `{name}`")))
            });
            let family = family.over(model.transpose()?);
            family.check()?;
            known.push(family);
        }
        Ok(known)
    }
}
