//! The material of the paper's algorithms, from the flags.

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, LinearCauchy, LinearElastic,
    NeoHookean, ParameterError, SofteningHencky, TaitFluid,
};
use parvi::PaperMaterial;

use super::{Material, MethodOptions, OptionError, Switch};

/// Young's modulus where none is given; the unit of stress that the other defaults are in.
const YOUNGS_MODULUS: f64 = 1.0;
const POISSONS_RATIO: f64 = 0.3;
const PEAK_YIELD_STRESS: f64 = 0.1;
/// In degrees.
const FRICTION_ANGLE: f64 = 30.0;
const VISCOSITY: f64 = 0.1;

/// Materials with an elastic part.
const SOLIDS: &[Material] = &[
    Material::NeoHookean,
    Material::LinearCauchy,
    Material::LinearElastic,
    Material::FixedCorotated,
    Material::Hencky,
    Material::KelvinVoigt,
    Material::SofteningHencky,
    Material::DruckerPrager,
];
const METAL: &[Material] = &[Material::SofteningHencky];
const SAND: &[Material] = &[Material::DruckerPrager];
const FLUID: &[Material] = &[Material::TaitFluid];
const VISCOUS: &[Material] = &[Material::KelvinVoigt, Material::TaitFluid];
const GAS: &[Material] = &[Material::IsothermalGas];

impl MethodOptions {
    /// The law with its parameters.
    ///
    /// # Errors
    /// A parameter that the law does not have, or refuses.
    pub(super) fn paper_material(&self) -> Result<PaperMaterial, OptionError> {
        let material = self.material.unwrap_or(Material::NeoHookean);
        self.check_parameters(material)?;
        self.law(material).map_err(refused)
    }

    fn law(&self, material: Material) -> Result<PaperMaterial, ParameterError> {
        let moduli = || {
            ElasticModuli::new(
                self.youngs_modulus.unwrap_or(YOUNGS_MODULUS),
                self.poissons_ratio.unwrap_or(POISSONS_RATIO),
            )
        };
        Ok(match material {
            Material::NeoHookean => PaperMaterial::NeoHookean(NeoHookean::new(moduli()?)),
            Material::LinearCauchy => PaperMaterial::LinearCauchy(LinearCauchy::new(moduli()?)),
            Material::LinearElastic => PaperMaterial::LinearElastic(LinearElastic::new(moduli()?)),
            Material::FixedCorotated => PaperMaterial::FixedCorotated(FixedCorotated::new(moduli()?)),
            Material::Hencky => PaperMaterial::Hencky(Hencky::new(moduli()?)),
            Material::KelvinVoigt => {
                let viscosity = self.viscosity.unwrap_or(VISCOSITY);
                PaperMaterial::KelvinVoigt(KelvinVoigt::new(moduli()?, viscosity)?)
            }
            Material::SofteningHencky => {
                let peak = self.peak_yield_stress.unwrap_or(PEAK_YIELD_STRESS);
                let (residual, rate) = (self.residual_yield_stress.unwrap_or(peak), self.softening_rate);
                let law = SofteningHencky::new(moduli()?, peak, residual, rate.unwrap_or(0.0))?;
                PaperMaterial::SofteningHencky(law)
            }
            Material::DruckerPrager => {
                let angle = self.friction_angle.unwrap_or(FRICTION_ANGLE);
                let law = DruckerPrager::new(moduli()?, angle.to_radians())?;
                PaperMaterial::DruckerPrager(law.with_cohesion(self.cohesion.unwrap_or(0.0))?)
            }
            Material::TaitFluid => {
                let (density, speed) = (self.density.unwrap_or(1.0), self.sound_speed.unwrap_or(1.0));
                let law = TaitFluid::new(density, speed, self.viscosity.unwrap_or(0.0))?;
                PaperMaterial::TaitFluid(match self.forgets_expansion {
                    Some(Switch::On) => law.forgetting_expansion(),
                    _ => law,
                })
            }
            Material::IsothermalGas => {
                PaperMaterial::IsothermalGas(IsothermalGas::new(self.pressure_per_density.unwrap_or(1.0))?)
            }
        })
    }

    /// Refuses parameters of other laws.
    fn check_parameters(&self, material: Material) -> Result<(), OptionError> {
        let parameters = [
            ("youngs-modulus", self.youngs_modulus, SOLIDS),
            ("poissons-ratio", self.poissons_ratio, SOLIDS),
            ("peak-yield-stress", self.peak_yield_stress, METAL),
            ("residual-yield-stress", self.residual_yield_stress, METAL),
            ("softening-rate", self.softening_rate, METAL),
            ("friction-angle", self.friction_angle, SAND),
            ("cohesion", self.cohesion, SAND),
            ("density", self.density, FLUID),
            ("sound-speed", self.sound_speed, FLUID),
            ("viscosity", self.viscosity, VISCOUS),
            ("pressure-per-density", self.pressure_per_density, GAS),
        ];
        let forgets = (
            "forgets-expansion",
            self.forgets_expansion.map(|on| on.to_string()),
            FLUID,
        );
        let stated = parameters.map(|(name, value, owners)| (name, value.map(|value| value.to_string()), owners));
        for (name, value, owners) in stated.into_iter().chain([forgets]) {
            if let Some(value) = value
                && !owners.contains(&material)
            {
                return Err(OptionError {
                    name: name.to_owned(),
                    reason: format!("{value} does not fit the material `{material}`"),
                });
            }
        }
        Ok(())
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
    OptionError {
        name: name.to_owned(),
        reason: error.to_string(),
    }
}
