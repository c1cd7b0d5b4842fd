//! The material of the paper's algorithms, from the flags.

use mpm_materials::ParameterError;
use parvi::PaperMaterial;

use super::{Material, MethodOptions, OptionError, Switch};

impl MethodOptions {
    /// The law with its parameters.
    ///
    /// # Errors
    /// A parameter that the law does not have, or refuses.
    pub(super) fn paper_material(&self) -> Result<PaperMaterial, OptionError> {
        let material = self.material.unwrap_or(Material::NeoHookean);
        let given = self.law_parameters();
        let has = |flag: &str| material.parameters().iter().any(|parameter| parameter.flag == flag);
        let other = given.iter().find(|(flag, value)| value.is_some() && !has(flag));
        let other = other.and_then(|(flag, value)| Some((*flag, value.as_ref()?.to_string())));
        let forgets = self.forgets_expansion.filter(|_| material != Material::TaitFluid);
        let forgets = forgets.map(|on| ("forgets-expansion", on.to_string()));
        if let Some((name, value)) = other.or(forgets) {
            return Err(OptionError::new(
                name,
                format!("{value} does not fit the material `{material}`"),
            ));
        }
        let value = |flag: &str| given.iter().find(|(name, _)| *name == flag)?.1;
        let forgets = self.forgets_expansion == Some(Switch::On);
        material
            .law(&|parameter| value(parameter.flag), forgets)
            .map_err(refused)
    }

    /// The parameters of all laws by their flags.
    fn law_parameters(&self) -> [(&'static str, Option<f64>); 11] {
        [
            ("youngs-modulus", self.youngs_modulus),
            ("poissons-ratio", self.poissons_ratio),
            ("peak-yield-stress", self.peak_yield_stress),
            ("residual-yield-stress", self.residual_yield_stress),
            ("softening-rate", self.softening_rate),
            ("friction-angle", self.friction_angle),
            ("cohesion", self.cohesion),
            ("density", self.density),
            ("sound-speed", self.sound_speed),
            ("viscosity", self.viscosity),
            ("pressure-per-density", self.pressure_per_density),
        ]
    }
}

/// The flag of the parameter that a law refuses.
fn refused(error: ParameterError) -> OptionError {
    let name = match error {
        ParameterError::YoungModulus { .. } | ParameterError::ShearModulus { .. } => "youngs-modulus",
        ParameterError::PoissonRatio { .. } | ParameterError::FirstLameParameter { .. } => "poissons-ratio",
        ParameterError::PressurePerDensity { .. } => "pressure-per-density",
        ParameterError::ReferenceDensity { .. } => "density",
        ParameterError::PeakYieldStress { .. } => "peak-yield-stress",
        ParameterError::ResidualYieldStress { .. } => "residual-yield-stress",
        ParameterError::SofteningRate { .. } => "softening-rate",
        ParameterError::FrictionAngle { value } => {
            let degrees = value.to_degrees();
            return OptionError::out_of_range("friction-angle", degrees, "strictly between 0 and 90 (degrees)");
        }
        ParameterError::Cohesion { .. } => "cohesion",
        ParameterError::SoundSpeed { .. } => "sound-speed",
        ParameterError::Viscosity { .. } => "viscosity",
    };
    OptionError::new(name, error.to_string())
}
