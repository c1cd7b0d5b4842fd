//! What a body is made of, as the study's configuration states it.

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, LinearCauchy, LinearElastic,
    NeoHookean, ParameterError, SofteningHencky, TaitFluid,
};
use parvi::PaperMaterial;
use serde::Deserialize;

/// `{ law = "neo-hookean", youngs-modulus = 1.0, poissons-ratio = 0.3 }`: a law of `mpm-materials` with its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MaterialTable {
    /// Compressible Neo-Hookean solid.
    NeoHookean(Solid),
    /// Linear elasticity of the Cauchy stress.
    LinearCauchy(Solid),
    /// Linear elasticity of the first Piola–Kirchhoff stress.
    LinearElastic(Solid),
    /// Fixed corotated solid.
    FixedCorotated(Solid),
    /// Hencky's solid.
    Hencky(Solid),
    /// Visco-elastic solid.
    KelvinVoigt(Viscous),
    /// J2 plasticity.
    SofteningHencky(Metal),
    /// Sand.
    DruckerPrager(Sand),
    /// Weakly compressible fluid.
    TaitFluid(Fluid),
    /// Isothermal gas.
    IsothermalGas(Gas),
}

/// E and ν.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Solid {
    youngs_modulus: f64,
    poissons_ratio: f64,
}

/// E, ν and the viscosity η.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Viscous {
    youngs_modulus: f64,
    poissons_ratio: f64,
    viscosity: f64,
}

/// E, ν and the stress ‖dev τ‖ at which the solid flows.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Metal {
    youngs_modulus: f64,
    poissons_ratio: f64,
    yield_stress: f64,
}

/// E, ν and the friction angle φ in degrees.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Sand {
    youngs_modulus: f64,
    poissons_ratio: f64,
    friction_angle: f64,
}

/// ρ₀, speed of sound and viscosity.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Fluid {
    reference_density: f64,
    sound_speed: f64,
    viscosity: f64,
}

/// κ.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Gas {
    pressure_per_density: f64,
}

impl MaterialTable {
    /// The material for the sampler.
    ///
    /// # Errors
    /// A parameter that is out of range.
    pub fn material(self) -> Result<PaperMaterial, ParameterError> {
        let moduli = |solid: Solid| ElasticModuli::new(solid.youngs_modulus, solid.poissons_ratio);
        let of = ElasticModuli::new;
        Ok(match self {
            Self::NeoHookean(solid) => PaperMaterial::NeoHookean(NeoHookean::new(moduli(solid)?)),
            Self::LinearCauchy(solid) => PaperMaterial::LinearCauchy(LinearCauchy::new(moduli(solid)?)),
            Self::LinearElastic(solid) => PaperMaterial::LinearElastic(LinearElastic::new(moduli(solid)?)),
            Self::FixedCorotated(solid) => PaperMaterial::FixedCorotated(FixedCorotated::new(moduli(solid)?)),
            Self::Hencky(solid) => PaperMaterial::Hencky(Hencky::new(moduli(solid)?)),
            Self::KelvinVoigt(table) => {
                let moduli = of(table.youngs_modulus, table.poissons_ratio)?;
                PaperMaterial::KelvinVoigt(KelvinVoigt::new(moduli, table.viscosity)?)
            }
            Self::SofteningHencky(table) => {
                let moduli = of(table.youngs_modulus, table.poissons_ratio)?;
                PaperMaterial::SofteningHencky(SofteningHencky::perfect(moduli, table.yield_stress)?)
            }
            Self::DruckerPrager(table) => {
                let moduli = of(table.youngs_modulus, table.poissons_ratio)?;
                PaperMaterial::DruckerPrager(DruckerPrager::new(moduli, table.friction_angle.to_radians())?)
            }
            Self::TaitFluid(table) => {
                let fluid = TaitFluid::new(table.reference_density, table.sound_speed, table.viscosity)?;
                PaperMaterial::TaitFluid(fluid)
            }
            Self::IsothermalGas(table) => PaperMaterial::IsothermalGas(IsothermalGas::new(table.pressure_per_density)?),
        })
    }

    /// E, of a solid.
    pub fn youngs_modulus(self) -> Option<f64> {
        match self {
            Self::NeoHookean(solid)
            | Self::LinearCauchy(solid)
            | Self::LinearElastic(solid)
            | Self::FixedCorotated(solid)
            | Self::Hencky(solid) => Some(solid.youngs_modulus),
            Self::KelvinVoigt(table) => Some(table.youngs_modulus),
            Self::SofteningHencky(table) => Some(table.youngs_modulus),
            Self::DruckerPrager(table) => Some(table.youngs_modulus),
            Self::TaitFluid(_) | Self::IsothermalGas(_) => None,
        }
    }

    /// The law with its parameters, in words.
    pub fn text(self) -> String {
        let elastic = |law: &str, young: f64, poisson: f64| format!("{law} E={young} ν={poisson}");
        let solid = |law: &str, solid: Solid| elastic(law, solid.youngs_modulus, solid.poissons_ratio);
        match self {
            Self::NeoHookean(table) => solid("neo-hookean", table),
            Self::LinearCauchy(table) => solid("linear-cauchy", table),
            Self::LinearElastic(table) => solid("linear-elastic", table),
            Self::FixedCorotated(table) => solid("fixed-corotated", table),
            Self::Hencky(table) => solid("hencky", table),
            Self::KelvinVoigt(table) => {
                let law = elastic("kelvin-voigt", table.youngs_modulus, table.poissons_ratio);
                format!("{law} η={}", table.viscosity)
            }
            Self::SofteningHencky(table) => {
                let law = elastic("softening-hencky", table.youngs_modulus, table.poissons_ratio);
                format!("{law} κ={}", table.yield_stress)
            }
            Self::DruckerPrager(table) => {
                let law = elastic("drucker-prager", table.youngs_modulus, table.poissons_ratio);
                format!("{law} φ={}°", table.friction_angle)
            }
            Self::TaitFluid(table) => format!(
                "tait-fluid ρ₀={} c={} μ={}",
                table.reference_density, table.sound_speed, table.viscosity
            ),
            Self::IsothermalGas(table) => format!("isothermal-gas κ={}", table.pressure_per_density),
        }
    }
}
