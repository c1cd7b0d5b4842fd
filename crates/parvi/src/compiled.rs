//! The samplers, compiled in this crate for the dimensions whose features `d1`…`d8` are on, once for all crates that call them: a program that samples a density of its own is then built in a second
//! or two.

use mpm_materials::{IsothermalGas, Law, Memory};
use parvi_targets::{CatalogueTarget, Frame, Target};

use crate::basis_choice::{Parts, Ready};
use crate::{Method, MpmOptions, Observer, PaperBody, PaperOptions, Run, SampleError, Samples};

/// [`sample`](crate::sample).
type Sample<const D: usize> =
    fn(&dyn CatalogueTarget<D>, &Method, &Run, &mut dyn Observer) -> Result<Samples<D>, SampleError>;

/// [`MpmOptions::sample`].
type SampleByMpm<const D: usize> =
    fn(&MpmOptions, &dyn Target<D>, &Frame<D>, &Run, &mut dyn Observer) -> Result<Samples<D>, SampleError>;

/// [`PaperOptions::sample_body`].
type SampleByPaper<const D: usize> = fn(
    &PaperOptions,
    &PaperBody<D>,
    &dyn Target<D>,
    &Frame<D>,
    &Run,
    &mut dyn Observer,
) -> Result<Samples<D>, SampleError>;

/// A body of a law with whatever memory.
type BodyOfLaw<const D: usize> = for<'a> fn(Parts<'a, D, Memory>, &'a dyn Law<D, State = Memory>) -> Ready<'a, D>;

/// What is compiled for a dimension.
pub(crate) struct Compiled<const D: usize> {
    /// A body of gas, for the calibrated sampler.
    pub gas: for<'a> fn(Parts<'a, D>, IsothermalGas) -> Ready<'a, D>,
    /// A body of any material, for the paper's algorithms.
    pub law: BodyOfLaw<D>,
    /// The calibrated sampler.
    pub mpm: SampleByMpm<D>,
    /// The paper's algorithms.
    pub paper: SampleByPaper<D>,
    /// Any method.
    pub sample: Sample<D>,
}

impl<const D: usize> Compiled<D> {
    /// Generated where it is named.
    const HERE: Self = Self {
        gas: |parts, gas| parts.of_gas(gas),
        law: |parts, law| parts.of_law(law),
        mpm: crate::mpm::sample,
        paper: crate::paper::sample,
        sample: |target, method, run, observer| method.sample(target, &target.frame(), run, observer),
    };
}

mpm_parallel::compiled_ahead!(Compiled);
