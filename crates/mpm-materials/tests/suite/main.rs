//! Constitutive laws. One theme per file.

mod common;
mod conformance;
mod fluid;
mod hostile_input;
mod inelastic;
mod visco_elastic;
