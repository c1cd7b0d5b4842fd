//! `smc`: tempered sequential Monte Carlo.

use parvi::{Method, SmcOptions};

use super::MethodKind;
use crate::ParticleCount;

/// The method.
pub const KIND: MethodKind = MethodKind::of_draws("smc", "pool-size start-mean start-sd start-draws", |options, _| {
    Ok(Method::Smc(SmcOptions {
        pool_size: options.pool_size.map(ParticleCount::get),
        ..SmcOptions::default()
    }))
});
