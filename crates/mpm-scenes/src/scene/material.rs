//! `[materials.NAME]`.

use std::sync::Arc;

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, FlowingGas, Hencky, IsothermalGas, KelvinVoigt, Law, LinearElastic,
    Memory, NeoHookean, Numbered, ParameterError, Snow, SofteningHencky, TaitFluid,
};
use serde::Deserialize;

/// The laws of scenes: the name, which is the variant's in kebab case, its parameters, and the law with these.
macro_rules! materials {
    ($($(#[$meta:meta])* $variant:ident($table:ident: $type:ty) => $law:expr;)*) => {
        /// `[materials.NAME]`: a constitutive law with its parameters and the mass per reference volume.
        #[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
        #[serde(tag = "law", rename_all = "kebab-case")]
        pub enum MaterialTable {
            $($(#[$meta])* $variant($type),)*
        }

        impl MaterialTable {
            /// Mass per reference volume ρ₀.
            pub fn density(&self) -> f64 {
                match self {
                    $(Self::$variant(table) => table.density,)*
                }
            }

            /// The law.
            pub(crate) fn law<const D: usize>(
                &self,
            ) -> Result<Arc<dyn Law<D, State = Memory> + Send + Sync>, ParameterError> {
                Ok(match self {
                    $(Self::$variant($table) => Arc::new(Numbered($law)),)*
                })
            }
        }
    };
}

materials! {
    /// Small strains.
    LinearElastic(solid: SolidTable) => LinearElastic::new(solid.moduli()?);
    /// The compressible Neo-Hookean solid.
    NeoHookean(solid: SolidTable) => NeoHookean::new(solid.moduli()?);
    /// The fixed corotated solid.
    FixedCorotated(solid: SolidTable) => FixedCorotated::new(solid.moduli()?);
    /// Hencky's solid: quadratic in the logarithmic strain.
    Hencky(solid: SolidTable) => Hencky::new(solid.moduli()?);
    /// The Neo-Hookean solid with a viscosity.
    KelvinVoigt(solid: ViscousSolidTable) => solid.law()?;
    /// Hencky's solid with von Mises plasticity that softens.
    SofteningHencky(metal: MetalTable) => metal.law()?;
    /// Hencky's solid with Drucker–Prager friction, for sand.
    DruckerPrager(sand: SandTable) => sand.law()?;
    /// Snow that hardens as it is packed.
    Snow(snow: SnowTable) => snow.law()?;
    /// The weakly compressible fluid.
    TaitFluid(fluid: FluidTable) => fluid.law()?;
    /// The isothermal gas P = κ ρ.
    IsothermalGas(gas: GasTable) => {
        FlowingGas(IsothermalGas::new(gas.pressure_per_density)?.with_reference_density(gas.density)?)
    };
}

/// Parameters of an elastic solid.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SolidTable {
    /// ρ₀.
    pub density: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
}

/// Parameters of `kelvin-voigt`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ViscousSolidTable {
    /// ρ₀.
    pub density: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// η in σ = σ_e + 2 η d.
    pub viscosity: f64,
}

fn one() -> f64 {
    1.0
}

/// Parameters of `softening-hencky`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MetalTable {
    /// ρ₀.
    pub density: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// a in ‖dev τ‖ = a κ where the material yields. Default 1; √(2/3) where κ is the uniaxial yield stress.
    #[serde(default = "one")]
    pub norm_per_strength: f64,
    /// κ_p.
    pub peak_yield_stress: f64,
    /// κ_r. Default κ_p: perfect plasticity.
    pub residual_yield_stress: Option<f64>,
    /// η, per plastic strain. Default 0.
    #[serde(default)]
    pub softening_rate: f64,
    /// R, a length: increments of plastic strain are averaged over what is as near in the body. Without, they are local.
    pub nonlocal_radius: Option<f64>,
}

/// Parameters of `drucker-prager`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SandTable {
    /// ρ₀.
    pub density: f64,
    /// E.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// φ in degrees.
    pub friction_angle: f64,
    /// c, a stress. Default 0.
    #[serde(default)]
    pub cohesion: f64,
}

/// Parameters of `tait-fluid`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FluidTable {
    /// ρ₀.
    pub density: f64,
    /// c at rest.
    pub sound_speed: f64,
    /// Dynamic viscosity μ_v. Default 0.
    #[serde(default)]
    pub viscosity: f64,
    /// Whether J is set to 1 where it is above. Default false.
    #[serde(default)]
    pub forgets_expansion: bool,
}

/// Parameters of `isothermal-gas`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GasTable {
    /// ρ₀.
    pub density: f64,
    /// κ.
    pub pressure_per_density: f64,
}

/// Parameters of `snow`.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SnowTable {
    /// ρ₀.
    pub density: f64,
    /// E at first.
    pub young_modulus: f64,
    /// ν.
    pub poisson_ratio: f64,
    /// θ_c. Default 0.025.
    pub critical_compression: Option<f64>,
    /// θ_s. Default 0.0075.
    pub critical_stretch: Option<f64>,
    /// ξ. Default 10.
    pub hardening: Option<f64>,
}

impl SnowTable {
    fn law(&self) -> Result<Snow, ParameterError> {
        let [compression, stretch, hardening] = Snow::FRESH;
        Snow::new(
            ElasticModuli::new(self.young_modulus, self.poisson_ratio)?,
            self.critical_compression.unwrap_or(compression),
            self.critical_stretch.unwrap_or(stretch),
            self.hardening.unwrap_or(hardening),
        )
    }
}

impl SolidTable {
    fn moduli(&self) -> Result<ElasticModuli, ParameterError> {
        ElasticModuli::new(self.young_modulus, self.poisson_ratio)
    }
}

impl ViscousSolidTable {
    fn law(&self) -> Result<KelvinVoigt, ParameterError> {
        let moduli = ElasticModuli::new(self.young_modulus, self.poisson_ratio)?;
        KelvinVoigt::new(moduli, self.viscosity)?.with_reference_density(self.density)
    }
}

impl MetalTable {
    fn law(&self) -> Result<SofteningHencky, ParameterError> {
        SofteningHencky::new(
            ElasticModuli::new(self.young_modulus, self.poisson_ratio)?,
            self.norm_per_strength * self.peak_yield_stress,
            self.norm_per_strength * self.residual_yield_stress.unwrap_or(self.peak_yield_stress),
            self.softening_rate,
        )
    }
}

impl SandTable {
    fn law(&self) -> Result<DruckerPrager, ParameterError> {
        let moduli = ElasticModuli::new(self.young_modulus, self.poisson_ratio)?;
        DruckerPrager::new(moduli, self.friction_angle.to_radians())?.with_cohesion(self.cohesion)
    }
}

impl FluidTable {
    fn law(&self) -> Result<TaitFluid, ParameterError> {
        let law = TaitFluid::new(self.density, self.sound_speed, self.viscosity)?;
        Ok(if self.forgets_expansion {
            law.forgetting_expansion()
        } else {
            law
        })
    }
}
