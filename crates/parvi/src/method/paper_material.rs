//! What a body of the paper's algorithms is made of.

use mpm_materials::{
    DeformingGas, DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, Law, LinearCauchy,
    LinearElastic, Memory, NeoHookean, Numbered, ParameterError, Snow, SofteningHencky, TaitFluid,
};

/// The materials: variant, parameters, and the law with these.
macro_rules! materials {
    ($($(#[$meta:meta])* $variant:ident($name:ident: $type:ty) => $law:expr;)*) => {
        /// A material of `mpm-materials`, with its parameters; in any dimension.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum PaperMaterial {
            $($(#[$meta])* $variant($type),)*
        }

        impl PaperMaterial {
            /// Hands the law over.
            pub(crate) fn with_law<const D: usize, R>(&self, take: impl FnOnce(&dyn Law<D, State = Memory>) -> R) -> R {
                match *self {
                    $(Self::$variant($name) => take(&Numbered($law)),)*
                }
            }
        }
    };
}

materials! {
    /// Compressible Neo-Hookean solid (paper, Eq. 22).
    NeoHookean(law: NeoHookean) => law;
    /// Linear elasticity of the Cauchy stress (paper, Eq. 19).
    LinearCauchy(law: LinearCauchy) => law;
    /// Linear elasticity of the first Piola–Kirchhoff stress.
    LinearElastic(law: LinearElastic) => law;
    /// Fixed corotated solid.
    FixedCorotated(law: FixedCorotated) => law;
    /// Hencky's solid: linear elasticity in logarithmic strain.
    Hencky(law: Hencky) => law;
    /// Visco-elastic solid.
    KelvinVoigt(law: KelvinVoigt) => law;
    /// J2 (von Mises) plasticity, perfect or softening.
    SofteningHencky(law: SofteningHencky) => law;
    /// Drucker–Prager plasticity: sand.
    DruckerPrager(law: DruckerPrager) => law;
    /// Snow.
    Snow(law: Snow) => law;
    /// Weakly compressible, viscous fluid.
    TaitFluid(law: TaitFluid) => law;
    /// Isothermal gas, Ψ(F) = −κ (m/V⁰) ln det F: with the force weighted by mass, κ = 1 and α = 1 the body rests where its density is the target.
    IsothermalGas(gas: IsothermalGas) => DeformingGas { gas };
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
}
