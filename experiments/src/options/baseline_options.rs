//! The options of the samplers that draw, choose or place points, from the flags.

use parvi::{NutsOptions, Pool, SteinThinningOptions, SupportPointsOptions};

use super::{MethodOptions, OptionError, ParticleCount, PoolChoice, StepCount, WarmUp};

impl MethodOptions {
    /// The No-U-Turn sampler.
    pub(super) fn nuts(&self) -> NutsOptions {
        let default = NutsOptions::default();
        NutsOptions {
            warm_up: self.warm_up.map_or(default.warm_up, WarmUp::get),
            chains: self.chains.map_or(default.chains, StepCount::get),
            thinning: self.thinning.map_or(default.thinning, StepCount::get),
            target_acceptance: self.target_acceptance.unwrap_or(default.target_acceptance),
        }
    }

    /// Stein thinning.
    pub(super) fn stein_thinning(&self) -> Result<SteinThinningOptions, OptionError> {
        Ok(SteinThinningOptions {
            pool: match self.pool_choice()? {
                None => Pool::default(),
                Some(PoolChoice::Exact) => Pool::Exact,
                Some(PoolChoice::Nuts) => Pool::Nuts(self.nuts()),
            },
            pool_size: self.pool_size.map(ParticleCount::get),
        })
    }

    /// Support points.
    pub(super) fn support_points(&self) -> SupportPointsOptions {
        let default = SupportPointsOptions::default();
        SupportPointsOptions {
            pool_size: self.pool_size.map(ParticleCount::get),
            steps: self.steps.map(StepCount::get),
            tolerance: self.tolerance.unwrap_or(default.tolerance),
        }
    }
}
