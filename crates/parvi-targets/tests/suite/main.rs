//! Densities. One theme per file.

/// A check that is generic over the dimension, in each of some: `in_dimensions!(check("ring"), 1, 2)` is `check::<1>("ring"); check::<2>("ring")`.
macro_rules! in_dimensions {
    ($check:ident $arguments:tt, $($dimension:literal),+) => {
        $($check::<$dimension> $arguments;)+
    };
}

mod catalogue;
mod conformance;
mod constrained_densities;
mod constraints;
mod data_errors;
mod far_away;
mod finite_difference;
mod frames;
mod generalised_linear;
mod logistic;
mod minibatch;
mod nested_problems;
mod posteriordb;
mod random_targets;
mod sbibm;
mod student_t;
mod support;
