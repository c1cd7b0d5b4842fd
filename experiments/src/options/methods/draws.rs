//! `ais`, `iid` and `sobol`: draws that no steps move.

use parvi::{AisOptions, Method};

use super::MethodKind;

/// Adaptive importance sampling.
pub const AIS: MethodKind = MethodKind::of_draws(
    "ais",
    "evaluations search-effort pool start start-law start-centre start-covariance start-mean start-sd start-draws",
    |options, _| {
        Ok(Method::Ais(AisOptions {
            evaluations: options.evaluations(),
            search_effort: options.search_effort.unwrap_or(AisOptions::default().search_effort),
        }))
    },
);

/// Independent exact draws.
pub const IID: MethodKind = MethodKind::of_draws("iid", "", |_, _| Ok(Method::Iid));

/// Scrambled Sobol points.
pub const SOBOL: MethodKind = MethodKind::of_draws("sobol", "", |_, _| Ok(Method::Sobol));
