//! `[materials.NAME]`.

use serde::Deserialize;

/// `[materials.NAME]`: a constitutive law with its parameters and the mass per reference volume.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(tag = "law", rename_all = "kebab-case")]
pub enum MaterialTable {
    /// Small strains.
    LinearElastic(SolidTable),
    /// The compressible Neo-Hookean solid.
    NeoHookean(SolidTable),
    /// The fixed corotated solid.
    FixedCorotated(SolidTable),
    /// Hencky's solid: quadratic in the logarithmic strain.
    Hencky(SolidTable),
    /// Hencky's solid with von Mises plasticity that softens.
    SofteningHencky(MetalTable),
    /// Hencky's solid with Drucker–Prager friction, for sand.
    DruckerPrager(SandTable),
    /// The weakly compressible fluid.
    TaitFluid(FluidTable),
    /// The isothermal gas P = κ ρ.
    IsothermalGas(GasTable),
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

impl MaterialTable {
    /// Mass per reference volume ρ₀.
    pub fn density(&self) -> f64 {
        match self {
            Self::LinearElastic(table)
            | Self::NeoHookean(table)
            | Self::FixedCorotated(table)
            | Self::Hencky(table) => table.density,
            Self::SofteningHencky(table) => table.density,
            Self::DruckerPrager(table) => table.density,
            Self::TaitFluid(table) => table.density,
            Self::IsothermalGas(table) => table.density,
        }
    }
}
