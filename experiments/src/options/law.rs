//! The constitutive laws of the paper's algorithms and their parameters: one table, for the flags and for the study `paper`.
//!
//! A new law is a variant of [`Material`], its parameters in [`Material::parameters`] and an arm of [`Material::law`].

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, LinearCauchy, LinearElastic,
    NeoHookean, ParameterError, SofteningHencky, TaitFluid,
};
use parvi::PaperMaterial;

use super::Material;

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

impl Material {
    /// The parameters of the law, in the order in which tables state them.
    pub fn parameters(self) -> &'static [Parameter] {
        match self {
            Self::NeoHookean | Self::LinearCauchy | Self::LinearElastic | Self::FixedCorotated | Self::Hencky => {
                &[YOUNG, POISSON]
            }
            Self::KelvinVoigt => &[YOUNG, POISSON, DASHPOT],
            Self::SofteningHencky => &[YOUNG, POISSON, PEAK, RESIDUAL, SOFTENING],
            Self::DruckerPrager => &[YOUNG, POISSON, FRICTION, COHESION],
            Self::TaitFluid => &[DENSITY, SOUND, VISCOSITY],
            Self::IsothermalGas => &[PRESSURE],
        }
    }

    /// The law with the parameters that are given, the others at their defaults; a fluid may forget volumes above that of rest.
    ///
    /// # Errors
    /// The parameter that the law refuses.
    pub fn law(
        self,
        given: &dyn Fn(&Parameter) -> Option<f64>,
        forgets_expansion: bool,
    ) -> Result<PaperMaterial, ParameterError> {
        let or = |parameter: &Parameter, otherwise: f64| given(parameter).or(parameter.default).unwrap_or(otherwise);
        let value = |parameter: &Parameter| or(parameter, f64::NAN);
        let moduli = || ElasticModuli::new(value(&YOUNG), value(&POISSON));
        Ok(match self {
            Self::NeoHookean => PaperMaterial::NeoHookean(NeoHookean::new(moduli()?)),
            Self::LinearCauchy => PaperMaterial::LinearCauchy(LinearCauchy::new(moduli()?)),
            Self::LinearElastic => PaperMaterial::LinearElastic(LinearElastic::new(moduli()?)),
            Self::FixedCorotated => PaperMaterial::FixedCorotated(FixedCorotated::new(moduli()?)),
            Self::Hencky => PaperMaterial::Hencky(Hencky::new(moduli()?)),
            Self::KelvinVoigt => PaperMaterial::KelvinVoigt(KelvinVoigt::new(moduli()?, value(&DASHPOT))?),
            Self::SofteningHencky => {
                let peak = value(&PEAK);
                let law = SofteningHencky::new(moduli()?, peak, or(&RESIDUAL, peak), value(&SOFTENING))?;
                PaperMaterial::SofteningHencky(law)
            }
            Self::DruckerPrager => {
                let law = DruckerPrager::new(moduli()?, value(&FRICTION).to_radians())?;
                PaperMaterial::DruckerPrager(law.with_cohesion(value(&COHESION))?)
            }
            Self::TaitFluid => {
                let law = TaitFluid::new(value(&DENSITY), value(&SOUND), value(&VISCOSITY))?;
                PaperMaterial::TaitFluid(match forgets_expansion {
                    true => law.forgetting_expansion(),
                    false => law,
                })
            }
            Self::IsothermalGas => PaperMaterial::IsothermalGas(IsothermalGas::new(value(&PRESSURE))?),
        })
    }
}
