//! `stein-thinning` and `support-points`: particles from a bigger sample.

use parvi::{Method, SampleSource, SteinThinningOptions, SupportPointsOptions};

use super::MethodKind;
use crate::{ParticleCount, PoolChoice};

/// The draws of a bigger sample with the least kernel Stein discrepancy.
pub const STEIN_THINNING: MethodKind = MethodKind::of_draws(
    "stein-thinning",
    "warm-up chains thinning target-acceptance pool pool-size start-mean start-sd start-draws",
    |options, _| {
        Ok(Method::SteinThinning(SteinThinningOptions {
            pool: match options.pool_choice()? {
                None => SampleSource::default(),
                Some(PoolChoice::Exact) => SampleSource::Exact,
                Some(PoolChoice::Nuts) => SampleSource::Nuts(options.nuts()),
            },
            pool_size: options.pool_size.map(ParticleCount::get),
        }))
    },
);

/// The points with the least energy distance to a bigger sample.
pub const SUPPORT_POINTS: MethodKind =
    MethodKind::of_draws("support-points", "steps pool-size tolerance", |options, steps| {
        let default = SupportPointsOptions::default();
        Ok(Method::SupportPoints(SupportPointsOptions {
            pool_size: options.pool_size.map(ParticleCount::get),
            steps,
            tolerance: options.tolerance.unwrap_or(default.tolerance),
        }))
    });
