//! The constitutive laws of the paper's algorithms and their parameters: one table, for the flags and for the study `paper`.
//!
//! A new law is a line of `materials!` below.

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, LinearCauchy, LinearElastic,
    NeoHookean, ParameterError, Snow, SofteningHencky, TaitFluid,
};
use parvi::PaperMaterial;

use crate::words;

/// A parameter of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameter {
    /// The flag, without dashes in front.
    pub flag: &'static str,
    /// The key and the symbol in the study's tables, which state all that have one.
    pub stated: Option<(&'static str, &'static str)>,
    /// The value where none is given; `None`: the law says.
    pub default: Option<f64>,
}

impl Parameter {
    const fn of(flag: &'static str, stated: Option<(&'static str, &'static str)>, default: Option<f64>) -> Self {
        Self { flag, stated, default }
    }
}

/// The unit of stress that the other defaults are in.
const YOUNG: Parameter = Parameter::of("youngs-modulus", Some(("youngs-modulus", "E")), Some(1.0));
const POISSON: Parameter = Parameter::of("poissons-ratio", Some(("poissons-ratio", "ν")), Some(0.3));
const DASHPOT: Parameter = Parameter::of("viscosity", Some(("viscosity", "η")), Some(0.1));
const PEAK: Parameter = Parameter::of("peak-yield-stress", Some(("yield-stress", "κ")), Some(0.1));
const RESIDUAL: Parameter = Parameter::of("residual-yield-stress", None, None);
const SOFTENING: Parameter = Parameter::of("softening-rate", None, Some(0.0));
/// In degrees.
const FRICTION: Parameter = Parameter::of("friction-angle", Some(("friction-angle", "φ")), Some(30.0));
const COHESION: Parameter = Parameter::of("cohesion", None, Some(0.0));
const DENSITY: Parameter = Parameter::of("density", Some(("reference-density", "ρ₀")), Some(1.0));
const SOUND: Parameter = Parameter::of("sound-speed", Some(("sound-speed", "c")), Some(1.0));
const VISCOSITY: Parameter = Parameter::of("viscosity", Some(("viscosity", "μ")), Some(0.0));
const PRESSURE: Parameter = Parameter::of("pressure-per-density", Some(("pressure-per-density", "κ")), Some(1.0));

/// The laws by the names of the scenes: variant, what `--help` says, the parameters in the order in which tables state them, and the law.
macro_rules! materials {
    (($given:ident); $($(#[$meta:meta])* $variant:ident [$($parameter:ident),*] => $law:expr;)*) => {
        words! {
            /// Constitutive law of the paper's algorithms, by the names of the scenes.
            Material { $($(#[$meta])* $variant,)* }
        }

        impl Material {
            /// The parameters of the law, in the order in which tables state them.
            pub(crate) fn parameters(self) -> &'static [Parameter] {
                match self {
                    $(Self::$variant => &[$($parameter),*],)*
                }
            }

            /// The law with the parameters that are given, the others at their defaults.
            ///
            /// # Errors
            /// The parameter that the law refuses.
            pub(crate) fn law(self, $given: &Given<'_>) -> Result<PaperMaterial, ParameterError> {
                Ok(match self {
                    $(Self::$variant => PaperMaterial::$variant($law),)*
                })
            }
        }
    };
}

materials! {
    (given);
    /// Compressible Neo-Hookean solid
    NeoHookean [YOUNG, POISSON] => NeoHookean::new(given.moduli()?);
    /// Linear elasticity of the Cauchy stress, as the paper has it
    LinearCauchy [YOUNG, POISSON] => LinearCauchy::new(given.moduli()?);
    /// Linear elasticity of the first Piola-Kirchhoff stress
    LinearElastic [YOUNG, POISSON] => LinearElastic::new(given.moduli()?);
    /// Fixed corotated solid
    FixedCorotated [YOUNG, POISSON] => FixedCorotated::new(given.moduli()?);
    /// Linear elasticity in logarithmic strain
    Hencky [YOUNG, POISSON] => Hencky::new(given.moduli()?);
    /// Visco-elasticity: a Neo-Hookean spring beside a dashpot
    KelvinVoigt [YOUNG, POISSON, DASHPOT] => KelvinVoigt::new(given.moduli()?, given.value(&DASHPOT))?;
    /// J2 (von Mises) plasticity, perfect or softening
    SofteningHencky [YOUNG, POISSON, PEAK, RESIDUAL, SOFTENING] => {
        let peak = given.value(&PEAK);
        SofteningHencky::new(given.moduli()?, peak, given.or(&RESIDUAL, peak), given.value(&SOFTENING))?
    };
    /// Drucker-Prager plasticity: sand
    DruckerPrager [YOUNG, POISSON, FRICTION, COHESION] => {
        let law = DruckerPrager::new(given.moduli()?, given.value(&FRICTION).to_radians())?;
        law.with_cohesion(given.value(&COHESION))?
    };
    /// Elasto-plastic snow that hardens as it is packed
    Snow [YOUNG, POISSON] => Snow::fresh(given.moduli()?);
    /// Weakly compressible, viscous fluid
    TaitFluid [DENSITY, SOUND, VISCOSITY] => {
        let law = TaitFluid::new(given.value(&DENSITY), given.value(&SOUND), given.value(&VISCOSITY))?;
        if given.forgets_expansion { law.forgetting_expansion() } else { law }
    };
    /// Isothermal gas as a law of F, whose rest state is the target
    IsothermalGas [PRESSURE] => IsothermalGas::new(given.value(&PRESSURE))?;
}

/// What is given of a law's parameters.
pub struct Given<'a> {
    /// A parameter's value, where it is given.
    pub parameter: &'a dyn Fn(&Parameter) -> Option<f64>,
    /// Whether a fluid forgets volumes above that of rest.
    pub forgets_expansion: bool,
}

impl Given<'_> {
    /// The value as given, the default, or this one.
    fn or(&self, parameter: &Parameter, otherwise: f64) -> f64 {
        (self.parameter)(parameter).or(parameter.default).unwrap_or(otherwise)
    }

    /// The value of a parameter that has a default.
    fn value(&self, parameter: &Parameter) -> f64 {
        self.or(parameter, f64::NAN)
    }

    fn moduli(&self) -> Result<ElasticModuli, ParameterError> {
        ElasticModuli::new(self.value(&YOUNG), self.value(&POISSON))
    }
}
