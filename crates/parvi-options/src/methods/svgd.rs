//! `svgd`: Stein variational gradient descent.

use parvi::{Method, SvgdOptions};

use super::MethodKind;

/// The method.
pub const KIND: MethodKind = MethodKind {
    name: "svgd",
    options: "steps step-size bandwidth start start-law start-centre start-covariance start-mean start-sd start-draws",
    iterates: true,
    build: |options, steps| {
        let default = SvgdOptions::default();
        Ok(Method::Svgd(SvgdOptions {
            steps: steps.or(default.steps),
            step_size: options.step_size.unwrap_or(default.step_size),
            bandwidth: options.bandwidth,
            trace_every: options.trace_every,
        }))
    },
};
