//! The step of mpm-core on meshes.

#![allow(clippy::print_stdout, reason = "errors and drifts are reported")]

mod bar;
mod conservation;
mod graded;
mod oracle;
mod two_halves;

use mpm_core::{Continuum, DeformsLast, StepControl};
use mpm_materials::Material;

/// Any elastic law; behind a reference, so that the step is compiled once for all laws, and in one order of a step.
pub type Solid<const D: usize> = DeformsLast<Continuum<&'static dyn Material<D>>>;

/// A solid of the given law.
pub fn solid<const D: usize>(law: impl Material<D> + 'static) -> Solid<D> {
    DeformsLast(Continuum {
        law: Box::leak(Box::new(law)),
    })
}

/// A step of the given length with no other limit.
pub fn control(time_step: f64) -> StepControl {
    StepControl {
        time_step,
        courant: f64::INFINITY,
        displacement: f64::INFINITY,
        friction: 0.0,
    }
}
