//! What the values of the parameters make of the scene.

use std::path::Path;

use mpm_scenes::Scene;

use super::config::repeated;
use super::{Experiment, ExperimentError, Key};
use crate::full_order::{Case, FullOrderError, SceneDocument, Value};

impl Experiment {
    /// The run with these values.
    ///
    /// # Errors
    /// [`ExperimentError::Field`] for a factor of a key that is no parameter.
    pub fn case(&self, values: &[f64]) -> Result<Case, ExperimentError> {
        let changes = self.keys.iter().enumerate().map(|(number, key)| {
            let value = self.value(key, values).ok_or_else(|| {
                let message = format!("{:?}: each must be a parameter, or `cos` or `sin` of one", key.product);
                self.field(&format!("keys.{number}.product"), message)
            })?;
            Ok((key.key.clone(), Value::Float(value)))
        });
        Ok(Case {
            parameters: values.to_vec(),
            changes: changes.collect::<Result<_, ExperimentError>>()?,
        })
    }

    /// Refuses what changes nothing: a key that another one after it changes again, a parameter that no key takes.
    pub(super) fn check_keys(&self) -> Result<(), ExperimentError> {
        let keys: Vec<&str> = self.keys.iter().map(|key| key.key.as_str()).collect();
        if let Some(place) = repeated(&keys) {
            let message = format!("`{}` stands in the list before", keys[place]);
            return Err(self.field(&format!("keys.{place}.key"), message));
        }
        for (number, name) in self.parameters.iter().enumerate() {
            let is_taken = self.keys.iter().any(|key| key.takes(name));
            let message = format!("{name:?}: no key takes it");
            self.require(is_taken, &format!("parameters.{number}"), &message)?;
        }
        Ok(())
    }

    /// The scene of the run with these values.
    ///
    /// # Errors
    /// As [`case`](Self::case), for a key that the scene does not have too, and what the scene's own reader says.
    pub fn scene_of(&self, document: &SceneDocument, values: &[f64]) -> Result<Scene, ExperimentError> {
        let case = self.case(values)?;
        document.scene(&case.changes).map_err(|error| self.blamed(error))
    }

    /// The scene that is trained on.
    pub(super) fn read_scene(&self) -> Result<SceneDocument, ExperimentError> {
        self.read_named("scene", &self.scene_file())
    }

    /// The scene that reduced runs are runs of.
    pub(super) fn read_run_scene(&self) -> Result<SceneDocument, ExperimentError> {
        let key = if self.run.scene.is_some() { "run.scene" } else { "scene" };
        self.read_named(key, &self.run_scene_file())
    }

    /// A file that a key names; the key is at fault where there is none.
    pub(super) fn read_named(&self, key: &str, file: &Path) -> Result<SceneDocument, ExperimentError> {
        SceneDocument::read(file).map_err(|error| match error {
            FullOrderError::Unreadable { .. } => self.field(key, error),
            other => other.into(),
        })
    }

    /// A change that does not fit the scene is a fault of the key that asks for it, not of the scene.
    pub(super) fn blamed(&self, error: FullOrderError) -> ExperimentError {
        match error {
            FullOrderError::Change { file, key, reason } => {
                let number = self.keys.iter().position(|own| own.key == key).unwrap_or_default();
                let message = format!("`{key}` does not fit the scene {file}: {reason}");
                self.field(&format!("keys.{number}.key"), message)
            }
            other => other.into(),
        }
    }

    /// offset + factor Π product.
    fn value(&self, key: &Key, values: &[f64]) -> Option<f64> {
        let mut factors = key.product.iter().map(|factor| self.factor(factor, values));
        let product = factors.try_fold(1.0, |product, factor| Some(product * factor?))?;
        Some(key.offset + key.factor * product)
    }

    fn factor(&self, factor: &str, values: &[f64]) -> Option<f64> {
        let (function, name) = parts(factor);
        let place = self.parameters.iter().position(|parameter| parameter == name)?;
        values.get(place).map(|value| function(*value))
    }
}

impl Key {
    /// Whether this parameter has a part in it.
    fn takes(&self, parameter: &str) -> bool {
        self.product.iter().any(|factor| parts(factor).1 == parameter)
    }
}

/// The function and the parameter of a factor.
fn parts(factor: &str) -> (fn(f64) -> f64, &str) {
    match factor.split_once(' ') {
        Some(("cos", name)) => (f64::cos, name),
        Some(("sin", name)) => (f64::sin, name),
        _ => (|value| value, factor),
    }
}
