//! What a body is made of, as the study's configuration states it.

use std::collections::BTreeMap;

use mpm_materials::ParameterError;
use parvi::PaperMaterial;
use serde::Deserialize;

use crate::options::{Given, Material, Parameter};

/// `{ law = "neo-hookean", youngs-modulus = 1.0, poissons-ratio = 0.3 }`: a law with all of its stated parameters.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Stated")]
pub struct MaterialTable {
    law: Material,
    /// Of the stated parameters in their order; those that the law does not have are 0.
    values: [f64; MOST],
}

/// Stated parameters of a law, at most.
const MOST: usize = 3;

/// What the configuration says, before it is checked.
#[derive(Deserialize)]
struct Stated {
    law: Material,
    #[serde(flatten)]
    values: BTreeMap<String, f64>,
}

impl TryFrom<Stated> for MaterialTable {
    type Error = String;

    fn try_from(stated: Stated) -> Result<Self, String> {
        let keys: Vec<&str> = keys(stated.law).map(|(_, key, _)| key).collect();
        if let Some(key) = stated.values.keys().find(|key| !keys.contains(&key.as_str())) {
            let expected = keys.join("`, `");
            return Err(format!(
                "unknown field `{key}` of the law `{}`, expected `{expected}`",
                stated.law
            ));
        }
        let mut values = [0.0; MOST];
        for (value, key) in values.iter_mut().zip(keys) {
            let found = stated.values.get(key);
            *value = *found.ok_or_else(|| format!("missing field `{key}` of the law `{}`", stated.law))?;
        }
        Ok(Self {
            law: stated.law,
            values,
        })
    }
}

/// The stated parameters of a law with key and symbol.
fn keys(law: Material) -> impl Iterator<Item = (&'static Parameter, &'static str, &'static str)> {
    law.parameters()
        .iter()
        .filter_map(|parameter| parameter.stated.map(|(key, symbol)| (parameter, key, symbol)))
}

impl MaterialTable {
    /// The value of a parameter, where the law states it.
    fn value(&self, flag: &str) -> Option<f64> {
        let place = keys(self.law).position(|(parameter, ..)| parameter.flag == flag)?;
        self.values.get(place).copied()
    }

    /// The material for the sampler.
    ///
    /// # Errors
    /// A parameter that is out of range.
    pub fn material(self) -> Result<PaperMaterial, ParameterError> {
        self.law.law(&Given {
            parameter: &|parameter| self.value(parameter.flag),
            forgets_expansion: false,
        })
    }

    /// The law with its parameters, in words.
    pub fn text(self) -> String {
        let mut text = self.law.to_string();
        for ((_, key, symbol), value) in keys(self.law).zip(self.values) {
            let unit = if key == "friction-angle" { "°" } else { "" };
            text.push_str(&format!(" {symbol}={value}{unit}"));
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(text: &str) -> Result<MaterialTable, String> {
        toml::from_str(text).map_err(|error| error.message().to_owned())
    }

    #[test]
    fn a_law_takes_exactly_its_parameters() {
        let sand = table("law = \"drucker-prager\"\nyoungs-modulus = 2\npoissons-ratio = 0.3\nfriction-angle = 30.0");
        let sand = sand.unwrap();
        assert_eq!(sand.text(), "drucker-prager E=2 ν=0.3 φ=30°");
        assert_eq!(sand.value("youngs-modulus"), Some(2.0));
        assert!(sand.material().is_ok());
        let gas = table("law = \"isothermal-gas\"\npressure-per-density = 1.5").unwrap();
        assert_eq!(
            (gas.text().as_str(), gas.value("youngs-modulus")),
            ("isothermal-gas κ=1.5", None)
        );
        for (text, part) in [
            (
                "law = \"hencky\"\nyoungs-modulus = 1.0",
                "missing field `poissons-ratio`",
            ),
            (
                "law = \"isothermal-gas\"\npressure-per-density = 1.0\nviscosity = 1.0",
                "unknown field `viscosity`",
            ),
            ("law = \"jelly\"", "jelly"),
            ("youngs-modulus = 1.0", "missing field `law`"),
        ] {
            let message = table(text).unwrap_err();
            assert!(message.contains(part), "{message}");
        }
    }

    #[test]
    fn no_law_states_more_than_there_is_room_for() {
        use clap::ValueEnum;
        assert!(Material::value_variants().iter().all(|law| keys(*law).count() <= MOST));
    }
}
