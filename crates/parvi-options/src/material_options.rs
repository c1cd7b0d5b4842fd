//! The material of the paper's algorithms, from the flags.

use clap::ValueEnum;
use mpm_materials::ParameterError;
use parvi::PaperMaterial;

use super::{Given, Material, MethodOptions, OptionError, Parameter, Switch};

impl MethodOptions {
    /// The law with its parameters.
    ///
    /// # Errors
    /// A parameter that the law does not have, or refuses.
    pub(super) fn paper_material(&self) -> Result<PaperMaterial, OptionError> {
        let material = self.material.unwrap_or(Material::NeoHookean);
        let given: Vec<(String, String)> = self.given().collect();
        let of = |material: &Material, flag: &str| material.parameters().iter().any(|known| known.flag == flag);
        let of_any = |flag: &str| Material::value_variants().iter().any(|material| of(material, flag));
        let misfit = given.iter().find(|(flag, _)| match flag.as_str() {
            "forgets-expansion" => material != Material::TaitFluid,
            flag => of_any(flag) && !of(&material, flag),
        });
        if let Some((name, value)) = misfit {
            let reason = format!("{value} does not fit the material `{material}`");
            return Err(OptionError::new(name, reason));
        }
        let value = |parameter: &Parameter| {
            let (_, text) = given.iter().find(|(flag, _)| *flag == parameter.flag)?;
            text.parse().ok()
        };
        let given = Given {
            parameter: &value,
            forgets_expansion: self.forgets_expansion == Some(Switch::On),
        };
        material.law(&given).map_err(refused)
    }
}

/// The flag of the parameter that a law refuses.
fn refused(error: ParameterError) -> OptionError {
    let name = match error.parameter() {
        ("friction_angle", value) => {
            let degrees = value.to_degrees();
            return OptionError::out_of_range("friction-angle", degrees, "strictly between 0 and 90 (degrees)");
        }
        ("young_modulus", _) => "youngs-modulus".to_owned(),
        ("poisson_ratio", _) => "poissons-ratio".to_owned(),
        (name, _) => name.replace('_', "-"),
    };
    OptionError::new(&name, error.to_string())
}
