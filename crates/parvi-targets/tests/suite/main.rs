//! Densities. One theme per file.

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
mod random_targets;
mod student_t;
