//! Densities. One theme per file.

use mpm_tensor::in_dimensions;

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
#[cfg(unix)]
mod program;
mod random_targets;
mod sbibm;
mod student_t;
mod support;
