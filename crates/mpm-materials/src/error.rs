//! What can be wrong with a parameter or with a deformation.

/// A material parameter outside its range. Each variant carries the value as given.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum ParameterError {
    /// Young's modulus E must be positive and finite.
    #[error("Young's modulus must be positive and finite, not {value}")]
    YoungModulus {
        /// E as given.
        value: f64,
    },
    /// Poisson's ratio ν must be strictly between −1 and 1/2.
    #[error("Poisson's ratio must be strictly between -1 and 1/2, not {value}")]
    PoissonRatio {
        /// ν as given.
        value: f64,
    },
    /// The shear modulus μ must be positive and finite.
    #[error("the shear modulus must be positive and finite, not {value}")]
    ShearModulus {
        /// μ as given, or as computed from E and ν.
        value: f64,
    },
    /// Lamé's first parameter λ must be finite and above −2μ/3.
    #[error("Lame's first parameter must be finite and above -2/3 of the shear modulus, not {value}")]
    FirstLameParameter {
        /// λ as given, or as computed from E and ν.
        value: f64,
    },
    /// The ratio κ of pressure to density must be positive and finite.
    #[error("the pressure per density must be positive and finite, not {value}")]
    PressurePerDensity {
        /// κ as given.
        value: f64,
    },
    /// The reference density ρ₀ must be positive and finite.
    #[error("the reference density must be positive and finite, not {value}")]
    ReferenceDensity {
        /// ρ₀ as given.
        value: f64,
    },
    /// The peak yield stress κ_p must be positive and finite.
    #[error("the peak yield stress must be positive and finite, not {value}")]
    PeakYieldStress {
        /// κ_p as given.
        value: f64,
    },
    /// The residual yield stress κ_r must be between zero and the peak.
    #[error("the residual yield stress must be between 0 and the peak {peak}, not {value}")]
    ResidualYieldStress {
        /// κ_r as given.
        value: f64,
        /// κ_p.
        peak: f64,
    },
    /// The rate of softening η must be finite and not negative.
    #[error("the rate of softening must be finite and at least 0, not {value}")]
    SofteningRate {
        /// η as given.
        value: f64,
    },
    /// The friction angle φ must be strictly between 0 and π/2.
    #[error("the friction angle must be strictly between 0 and pi/2 (radians), not {value}")]
    FrictionAngle {
        /// φ as given, in radians.
        value: f64,
    },
    /// The cohesion c must be finite and not negative.
    #[error("the cohesion must be finite and at least 0, not {value}")]
    Cohesion {
        /// c as given.
        value: f64,
    },
    /// The speed of sound c at rest must be positive and finite, and so must ρ₀ c².
    #[error("the speed of sound must be positive and finite, also its square times the density, not {value}")]
    SoundSpeed {
        /// c as given.
        value: f64,
    },
    /// A parameter of one law alone.
    #[error("{parameter} must be {expected}, not {value}")]
    OutOfRange {
        /// Its name, as documents call it.
        parameter: &'static str,
        /// The value as given.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// The viscosity μ_v must be finite and not negative.
    #[error("the viscosity must be finite and at least 0, not {value}")]
    Viscosity {
        /// μ_v as given.
        value: f64,
    },
}

impl ParameterError {
    /// The parameter as documents call it, and its value as given. The shear modulus and Lamé's first parameter come from Young's modulus and Poisson's ratio.
    pub fn parameter(&self) -> (&'static str, f64) {
        match *self {
            Self::YoungModulus { value } | Self::ShearModulus { value } => ("young_modulus", value),
            Self::PoissonRatio { value } | Self::FirstLameParameter { value } => ("poisson_ratio", value),
            Self::PressurePerDensity { value } => ("pressure_per_density", value),
            Self::ReferenceDensity { value } => ("density", value),
            Self::PeakYieldStress { value } => ("peak_yield_stress", value),
            Self::ResidualYieldStress { value, .. } => ("residual_yield_stress", value),
            Self::SofteningRate { value } => ("softening_rate", value),
            Self::FrictionAngle { value } => ("friction_angle", value),
            Self::Cohesion { value } => ("cohesion", value),
            Self::SoundSpeed { value } => ("sound_speed", value),
            Self::Viscosity { value } => ("viscosity", value),
            Self::OutOfRange { parameter, value, .. } => (parameter, value),
        }
    }
}

/// A deformation gradient for which a material has no stress.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum DeformationError {
    /// An entry of F is NaN or infinite.
    #[error("the deformation gradient is not finite: entry ({row}, {column}) is {value}")]
    NotFinite {
        /// Zero-based row of the first such entry.
        row: usize,
        /// Zero-based column of the first such entry.
        column: usize,
        /// The entry.
        value: f64,
    },
    /// The material is crushed or turned inside out: J = det F is not a positive finite number.
    #[error("the volume ratio det F must be positive and finite, not {volume_ratio}")]
    VolumeRatio {
        /// J = det F.
        volume_ratio: f64,
    },
}

/// `Ok` for a finite value that is not negative, the error made of it otherwise.
pub(crate) fn not_negative(value: f64, error: impl FnOnce(f64) -> ParameterError) -> Result<f64, ParameterError> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(error(value))
    }
}

/// `Ok` for a positive finite value, the error made of it otherwise.
pub(crate) fn positive(value: f64, error: impl FnOnce(f64) -> ParameterError) -> Result<f64, ParameterError> {
    if value > 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(error(value))
    }
}
