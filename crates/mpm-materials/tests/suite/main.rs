//! Constitutive laws. One theme per file.
// F, J, R, P and the like are the symbols of the field.
#![allow(non_snake_case)]

/// A check for D = 1…4, in a function that hands its failures on.
macro_rules! in_every_dimension {
    ($check:ident($($argument:expr),*)) => {{
        $check::<1>($($argument),*)?;
        $check::<2>($($argument),*)?;
        $check::<3>($($argument),*)?;
        $check::<4>($($argument),*)?;
    }};
}

/// Properties of random states, D = 1…4: a test of each check.
macro_rules! properties {
    ($($name:ident: $check:ident;)+) => {
        proptest! {
            $(#[test]
            fn $name(sample in crate::common::sample()) {
                in_every_dimension!($check(&sample));
            })+
        }
    };
}

mod common;
mod conformance;
mod fluid;
mod hand_calculations;
mod hostile_input;
mod inelastic;
mod visco_elastic;
