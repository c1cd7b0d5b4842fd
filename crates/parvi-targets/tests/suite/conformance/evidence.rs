//! Random targets and the problems of nested sampling.

use super::promises::{conforming_but_for_the_gradient, conforms};
use super::target;

#[test]
fn random() {
    conforming_but_for_the_gradient(&*target::<1>("random"));
    conforming_but_for_the_gradient(&*target::<2>("random"));
    conforming_but_for_the_gradient(&*target::<4>("random"));
    conforming_but_for_the_gradient(&*target::<8>("random"));
}

#[test]
fn eggbox() {
    conforming_but_for_the_gradient(&*target::<2>("eggbox"));
}

#[test]
fn shells() {
    crate::in_dimensions!(conforms("shells"), 2, 5, 8);
}

#[test]
fn spike_slab() {
    crate::in_dimensions!(conforms("spike-slab"), 1, 3, 8);
}

#[test]
fn log_gamma() {
    crate::in_dimensions!(conforms("log-gamma"), 2, 5, 8);
}
