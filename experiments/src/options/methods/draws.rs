//! `ais`, `iid` and `sobol`: draws that no steps move.

use parvi::{AisOptions, Method};

use super::MethodKind;

/// Adaptive importance sampling.
pub const AIS: MethodKind = MethodKind {
    name: "ais",
    options: "evaluations search-effort pool start-mean start-sd start-draws",
    iterates: false,
    build: |options, _| {
        Ok(Method::Ais(AisOptions {
            evaluations: options.evaluations(),
            search_effort: options.search_effort.unwrap_or(AisOptions::default().search_effort),
        }))
    },
};

/// Independent exact draws.
pub const IID: MethodKind = MethodKind {
    name: "iid",
    options: "",
    iterates: false,
    build: |_, _| Ok(Method::Iid),
};

/// Scrambled Sobol points.
pub const SOBOL: MethodKind = MethodKind {
    name: "sobol",
    build: |_, _| Ok(Method::Sobol),
    ..IID
};
