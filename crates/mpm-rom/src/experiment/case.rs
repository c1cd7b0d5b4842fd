//! What the values of the parameters make of the scene.

use super::{Experiment, ExperimentError, Key};
use crate::full_order::{Case, Value};

impl Experiment {
    /// The run with these values.
    ///
    /// # Errors
    /// [`ExperimentError::Field`] for a factor of a key that is no parameter.
    pub fn case(&self, values: &[f64]) -> Result<Case, ExperimentError> {
        let changes = self.keys.iter().enumerate().map(|(number, key)| {
            let value = self.value(key, values).ok_or_else(|| {
                let message = format!("{:?}: each must be a parameter, or `cos` or `sin` of one", key.product);
                self.field(format!("keys.{number}.product"), message)
            })?;
            Ok((key.key.clone(), Value::Float(value)))
        });
        Ok(Case {
            parameters: values.to_vec(),
            changes: changes.collect::<Result<_, ExperimentError>>()?,
        })
    }

    /// offset + factor Π product.
    fn value(&self, key: &Key, values: &[f64]) -> Option<f64> {
        let mut factors = key.product.iter().map(|factor| self.factor(factor, values));
        let product = factors.try_fold(1.0, |product, factor| Some(product * factor?))?;
        Some(key.offset + key.factor * product)
    }

    fn factor(&self, factor: &str, values: &[f64]) -> Option<f64> {
        let (function, name): (fn(f64) -> f64, &str) = match factor.split_once(' ') {
            Some(("cos", name)) => (f64::cos, name),
            Some(("sin", name)) => (f64::sin, name),
            _ => (|value| value, factor),
        };
        let place = self.parameters.iter().position(|parameter| parameter == name)?;
        values.get(place).map(|value| function(*value))
    }
}
