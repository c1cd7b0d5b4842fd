//! A scene that follows from others, ready to run.

use super::SceneDocument;
use crate::{Scene, SceneError};

/// A scene with all its keys.
#[derive(Clone, Debug)]
pub struct PreparedScene {
    /// All its keys.
    pub document: SceneDocument,
    /// The scene.
    pub scene: Scene,
    /// A fingerprint of all its keys and values.
    pub fingerprint: String,
}

impl PreparedScene {
    /// The scene of a document.
    ///
    /// # Errors
    /// As for [`SceneDocument::scene`].
    pub fn new(document: SceneDocument) -> Result<Self, SceneError> {
        let fingerprint = mpm_document::fingerprint(document.text()?.as_bytes());
        Ok(Self {
            scene: document.scene()?,
            fingerprint: format!("{fingerprint:016x}"),
            document,
        })
    }
}
