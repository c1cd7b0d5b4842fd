//! What a body is made of, as the study's configuration states it.

use std::collections::BTreeMap;

use mpm_materials::ParameterError;
use parvi::PaperMaterial;
use serde::Deserialize;

use crate::options::{Given, Material};

/// `{ law = "neo-hookean", youngs-modulus = 1.0, poissons-ratio = 0.3 }`: a law with all of its stated parameters.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(try_from = "Stated")]
pub struct MaterialTable(Stated);

/// What the configuration says, before it is checked.
#[derive(Clone, Debug, PartialEq, Deserialize)]
struct Stated {
    law: Material,
    #[serde(flatten)]
    values: BTreeMap<String, f64>,
}

impl TryFrom<Stated> for MaterialTable {
    type Error = String;

    fn try_from(stated: Stated) -> Result<Self, String> {
        let law = stated.law;
        let keys: Vec<&str> = keys(law).map(|(key, _)| key).collect();
        if let Some(key) = stated.values.keys().find(|key| !keys.contains(&key.as_str())) {
            let expected = keys.join("`, `");
            return Err(format!(
                "unknown field `{key}` of the law `{law}`, expected `{expected}`"
            ));
        }
        match keys.into_iter().find(|key| !stated.values.contains_key(*key)) {
            Some(key) => Err(format!("missing field `{key}` of the law `{law}`")),
            None => Ok(Self(stated)),
        }
    }
}

/// The keys of the stated parameters of a law, with their symbols.
fn keys(law: Material) -> impl Iterator<Item = (&'static str, &'static str)> {
    law.parameters().iter().filter_map(|parameter| parameter.stated)
}

impl MaterialTable {
    /// The material for the sampler.
    ///
    /// # Errors
    /// A parameter that is out of range.
    pub fn material(&self) -> Result<PaperMaterial, ParameterError> {
        let Self(Stated { law, values }) = self;
        law.law(&Given {
            parameter: &|parameter| values.get(parameter.stated?.0).copied(),
            forgets_expansion: false,
        })
    }

    /// The law with its parameters, in words.
    pub fn text(&self) -> String {
        let Self(Stated { law, values }) = self;
        let mut text = law.to_string();
        for (key, symbol) in keys(*law) {
            let unit = if key == "friction-angle" { "°" } else { "" };
            let value = values.get(key).copied().unwrap_or_default();
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
