//! What a body of the paper's algorithms is made of.

use mpm_materials::{
    DeformingGas, DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, Law, LinearCauchy,
    LinearElastic, Memory, NeoHookean, Numbered, ParameterError, SofteningHencky, TaitFluid,
};

/// A material of `mpm-materials`, with its parameters; in any dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PaperMaterial {
    /// Compressible Neo-Hookean solid (paper, Eq. 22).
    NeoHookean(NeoHookean),
    /// Linear elasticity of the Cauchy stress (paper, Eq. 19).
    LinearCauchy(LinearCauchy),
    /// Linear elasticity of the first Piola–Kirchhoff stress.
    LinearElastic(LinearElastic),
    /// Fixed corotated solid.
    FixedCorotated(FixedCorotated),
    /// Hencky's solid: linear elasticity in logarithmic strain.
    Hencky(Hencky),
    /// Visco-elastic solid.
    KelvinVoigt(KelvinVoigt),
    /// J2 (von Mises) plasticity, perfect or softening.
    SofteningHencky(SofteningHencky),
    /// Drucker–Prager plasticity: sand.
    DruckerPrager(DruckerPrager),
    /// Weakly compressible, viscous fluid.
    TaitFluid(TaitFluid),
    /// Isothermal gas, Ψ(F) = −κ (m/V⁰) ln det F: with the force weighted by mass, κ = 1 and α = 1 the body rests where its density is the target.
    IsothermalGas(IsothermalGas),
}

impl Default for PaperMaterial {
    /// The Neo-Hookean solid of E = 1, ν = 0.3.
    fn default() -> Self {
        let moduli = ElasticModuli::new(1.0, 0.3).expect("both are in their ranges");
        Self::NeoHookean(NeoHookean::new(moduli))
    }
}

impl PaperMaterial {
    /// The Neo-Hookean solid of Young's modulus E > 0 and Poisson's ratio ν ∈ (−1, ½).
    ///
    /// # Errors
    /// [`ParameterError`] with the parameter that is out of range.
    pub fn neo_hookean(youngs_modulus: f64, poissons_ratio: f64) -> Result<Self, ParameterError> {
        let moduli = ElasticModuli::new(youngs_modulus, poissons_ratio)?;
        Ok(Self::NeoHookean(NeoHookean::new(moduli)))
    }

    /// Hands the law over.
    pub(crate) fn with_law<const D: usize, R>(&self, take: impl FnOnce(&dyn Law<D, State = Memory>) -> R) -> R {
        match *self {
            Self::NeoHookean(law) => take(&Numbered(law)),
            Self::LinearCauchy(law) => take(&Numbered(law)),
            Self::LinearElastic(law) => take(&Numbered(law)),
            Self::FixedCorotated(law) => take(&Numbered(law)),
            Self::Hencky(law) => take(&Numbered(law)),
            Self::KelvinVoigt(law) => take(&Numbered(law)),
            Self::SofteningHencky(law) => take(&Numbered(law)),
            Self::DruckerPrager(law) => take(&Numbered(law)),
            Self::TaitFluid(law) => take(&Numbered(law)),
            Self::IsothermalGas(gas) => take(&Numbered(DeformingGas { gas })),
        }
    }
}
