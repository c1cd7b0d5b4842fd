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
    conforms::<2>("shells");
    conforms::<5>("shells");
    conforms::<8>("shells");
}

#[test]
fn spike_slab() {
    conforms::<1>("spike-slab");
    conforms::<3>("spike-slab");
    conforms::<8>("spike-slab");
}

#[test]
fn log_gamma() {
    conforms::<2>("log-gamma");
    conforms::<5>("log-gamma");
    conforms::<8>("log-gamma");
}
