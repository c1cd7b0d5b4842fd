//! Prior densities of single parameters.

/// The density of a parameter before the data, up to a constant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Prior {
    /// log p = 0 wherever the parameter may be.
    Flat,
    /// log p = −½ (x − m)²/s²; on a half-line the half-normal distribution.
    Normal {
        /// m.
        mean: f64,
        /// s.
        standard_deviation: f64,
    },
    /// log p = −log(1 + x²/s²) for x > 0.
    HalfCauchy {
        /// s.
        scale: f64,
    },
    /// log p = (a − 1) log x − b x for x > 0.
    Gamma {
        /// a.
        shape: f64,
        /// b.
        rate: f64,
    },
    /// log p = −½ (log x − m)²/s² − log x for x > 0.
    LogNormal {
        /// m, the mean of log x.
        mean: f64,
        /// s, the standard deviation of log x.
        standard_deviation: f64,
    },
    /// log p = (a − 1) (log x + log(1 − x)) for 0 < x < 1.
    SymmetricBeta {
        /// a.
        shape: f64,
    },
}

impl Prior {
    /// log p(x).
    pub fn log_density(&self, x: f64) -> f64 {
        match *self {
            Self::Flat => 0.0,
            Self::Normal {
                mean,
                standard_deviation,
            } => -0.5 * ((x - mean) / standard_deviation).powi(2),
            Self::HalfCauchy { scale } => -(x / scale).powi(2).ln_1p(),
            Self::Gamma { shape, rate } => (shape - 1.0) * x.ln() - rate * x,
            Self::LogNormal {
                mean,
                standard_deviation,
            } => -0.5 * ((x.ln() - mean) / standard_deviation).powi(2) - x.ln(),
            Self::SymmetricBeta { shape } => (shape - 1.0) * (x.ln() + (-x).ln_1p()),
        }
    }

    /// d log p/dx.
    pub fn score(&self, x: f64) -> f64 {
        match *self {
            Self::Flat => 0.0,
            Self::Normal {
                mean,
                standard_deviation,
            } => (mean - x) / standard_deviation.powi(2),
            Self::HalfCauchy { scale } => -2.0 * x / (scale * scale + x * x),
            Self::Gamma { shape, rate } => (shape - 1.0) / x - rate,
            Self::LogNormal {
                mean,
                standard_deviation,
            } => ((mean - x.ln()) / standard_deviation.powi(2) - 1.0) / x,
            Self::SymmetricBeta { shape } => (shape - 1.0) * (x.recip() - (1.0 - x).recip()),
        }
    }
}

/// N(0, s²).
pub(super) const fn centred_normal(standard_deviation: f64) -> Prior {
    Prior::Normal {
        mean: 0.0,
        standard_deviation,
    }
}
