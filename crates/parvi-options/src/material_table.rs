//! What a body of the paper's algorithms is made of, as a configuration states it.

use std::collections::BTreeMap;

use mpm_materials::ParameterError;
use parvi::PaperMaterial;
use serde::Deserialize;

use super::{Given, Material, checked_when_read};

/// `{ law = "neo-hookean", youngs-modulus = 1.0, poissons-ratio = 0.3 }`: a law with all of its stated parameters.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(remote = "Self")]
pub struct MaterialTable {
    law: Material,
    #[serde(flatten)]
    values: BTreeMap<String, f64>,
}

checked_when_read!(MaterialTable);

/// The keys of the stated parameters of a law, with their symbols.
fn keys(law: Material) -> impl Iterator<Item = (&'static str, &'static str)> {
    law.parameters().iter().filter_map(|parameter| parameter.stated)
}

impl MaterialTable {
    /// Refuses keys that the law does not have, and asks for those that it has.
    fn check(&self) -> Result<(), String> {
        let (law, keys) = (self.law, keys(self.law).map(|(key, _)| key).collect::<Vec<_>>());
        if let Some(key) = self.values.keys().find(|key| !keys.contains(&key.as_str())) {
            let expected = keys.join("`, `");
            return Err(format!(
                "unknown field `{key}` of the law `{law}`, expected `{expected}`"
            ));
        }
        let missing = keys.into_iter().find(|key| !self.values.contains_key(*key));
        missing.map_or(Ok(()), |key| Err(format!("missing field `{key}` of the law `{law}`")))
    }

    /// The material for the sampler.
    ///
    /// # Errors
    /// A parameter that is out of range.
    pub fn material(&self) -> Result<PaperMaterial, ParameterError> {
        self.law.law(&Given {
            parameter: &|parameter| self.values.get(parameter.stated?.0).copied(),
            forgets_expansion: false,
        })
    }

    /// The law with its parameters, in words.
    pub fn text(&self) -> String {
        let told = |(key, symbol): (&str, &str)| {
            let unit = if key == "friction-angle" { "°" } else { "" };
            let value = self.values.get(key).copied().unwrap_or_default();
            format!(" {symbol}={value}{unit}")
        };
        self.law.to_string() + &keys(self.law).map(told).collect::<String>()
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
        assert!(sand.material().is_ok());
        let gas = table("law = \"isothermal-gas\"\npressure-per-density = 1.5").unwrap();
        assert_eq!(gas.text(), "isothermal-gas κ=1.5");
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
}
