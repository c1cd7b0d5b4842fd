//! `ais`, `iid` and `sobol`: draws that no steps move.

use parvi::{AisOptions, Method};

use super::MethodKind;

/// Adaptive importance sampling.
pub const AIS: MethodKind = MethodKind::of_draws(
    "ais",
    "evaluations search-effort condense pool start start-law start-centre start-covariance start-mean start-sd start-draws",
    |options, _| {
        let default = AisOptions::default();
        Ok(Method::Ais(AisOptions {
            evaluations: options.evaluations(),
            search_effort: options.search_effort.unwrap_or(default.search_effort),
            condense: options.condense.map_or(default.condense, Into::into),
        }))
    },
);

/// Independent exact draws.
pub const IID: MethodKind = MethodKind::of_draws("iid", "", |_, _| Ok(Method::Iid));

/// Scrambled Sobol points.
pub const SOBOL: MethodKind = MethodKind::of_draws("sobol", "", |_, _| Ok(Method::Sobol));
