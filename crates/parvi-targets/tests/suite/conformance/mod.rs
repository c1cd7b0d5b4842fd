//! What every target of the catalogue promises, checked for each of them in several dimensions.

mod closed_form;
mod evidence;
mod mixtures;
mod normalisation;
mod posteriors;
pub mod promises;
mod references;

use parvi_targets::{BoxedTarget, Parameters, build};

fn target<const D: usize>(name: &str) -> BoxedTarget<D> {
    build(name, &Parameters::default()).unwrap()
}
