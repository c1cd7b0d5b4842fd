//! `nuts`: the No-U-Turn sampler.

use parvi::{Method, NutsOptions};

use super::MethodKind;
use crate::{MethodOptions, StepCount, WarmUp};

/// The method.
pub const KIND: MethodKind = MethodKind::of_draws(
    "nuts",
    "warm-up chains thinning target-acceptance start-mean start-sd start-draws",
    |options, _| Ok(Method::Nuts(options.nuts())),
);

impl MethodOptions {
    /// The chains.
    pub(super) fn nuts(&self) -> NutsOptions {
        let default = NutsOptions::default();
        NutsOptions {
            warm_up: self.warm_up.map_or(default.warm_up, WarmUp::get),
            chains: self.chains.map_or(default.chains, StepCount::get),
            thinning: self.thinning.map_or(default.thinning, StepCount::get),
            target_acceptance: self.target_acceptance.unwrap_or(default.target_acceptance),
        }
    }
}
