//! Constitutive laws. One theme per file.
// F, J, R, P and the like are the symbols of the field.
#![allow(non_snake_case)]

/// Properties of random states, D = 1…4: a test of each check.
macro_rules! properties {
    ($($name:ident: $check:ident;)+) => {
        proptest! {
            $(#[test]
            fn $name(sample in crate::common::sample()) {
                mpm_tensor::in_dimensions!($check(&sample)?, 1, 2, 3, 4);
            })+
        }
    };
}

mod across;
mod common;
mod conformance;
mod fluid;
mod hand_calculations;
mod hostile_input;
mod inelastic;
mod visco_elastic;
