//! From the choice of a basis, made at run time, to its type.

use mpm_core::{MpmError, SimplexLattice, SplineGrid, UniformBasis};
use mpm_kernels::{Cubic, Linear, Quadratic};

use crate::{BasisChoice, SampleError};

/// Work that wants a basis of whatever type.
pub(crate) trait OnBasis<const D: usize> {
    type Output;

    /// `make` gives any number of bases, all alike.
    fn on<B: UniformBasis<D>>(self, make: impl Fn() -> Result<B, MpmError>) -> Result<Self::Output, SampleError>;
}

impl BasisChoice {
    /// Do `work` on this basis, with spacing h.
    pub(crate) fn with<W: OnBasis<D>, const D: usize>(self, h: f64, work: W) -> Result<W::Output, SampleError> {
        let origin = [0.0; D];
        match self {
            Self::Lattice => work.on(|| SimplexLattice::<D>::permutohedral(origin, h)),
            Self::Linear => work.on(|| SplineGrid::<Linear, 2, D>::new(origin, h)),
            Self::Quadratic => work.on(|| SplineGrid::<Quadratic, 3, D>::new(origin, h)),
            Self::Cubic => work.on(|| SplineGrid::<Cubic, 4, D>::new(origin, h)),
        }
    }
}
