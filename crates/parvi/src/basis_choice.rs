//! From basis and transfer, chosen at run time, to their types: all code of the mechanics is generated here, once per dimension.

use mpm_core::{
    Continuum, DeformsLast, Medium, Mpm, MpmError, Particles, Pic, ProductGrid, SimplexLattice, SplineDegree,
    SplineGrid, Transfer, UniformBasis,
};
use mpm_kernels::{Cubic, Linear, Quadratic};
use mpm_materials::{AnyLaw, IsothermalGas, Law, Memory};

use crate::framed_score::ScoreForce;
use crate::in_cell::InCell;
use crate::moving::{Moving, OnBasis};
use crate::remembering_gas::RememberingGas;
use crate::{BasisChoice, SampleError, TransferChoice};

/// The largest dimension with splines that are compiled for their width. Beyond, a stencil has 32 to 65,536 nodes, and code for each of the
/// three widths would take most of the time that this crate takes to compile.
const LARGEST_UNROLLED: usize = 4;

/// A body that is ready to move.
pub(crate) type Ready<'a, const D: usize> = Result<Box<dyn Moving<'a, D> + 'a>, SampleError>;

/// A body before its basis is known; `S` are the internal variables of its medium.
pub(crate) struct Parts<'a, const D: usize, S = ()> {
    pub particles: Particles<D, S>,
    pub force: ScoreForce<'a, D>,
    pub transfer: TransferChoice,
    pub basis: BasisChoice,
    /// h.
    pub spacing: f64,
}

impl<'a, const D: usize> Parts<'a, D> {
    /// The gas of the calibrated sampler.
    pub fn of_gas(self, gas: IsothermalGas) -> Ready<'a, D> {
        let parts = Parts {
            particles: self.particles.remembering(),
            force: self.force,
            transfer: self.transfer,
            basis: self.basis,
            spacing: self.spacing,
        };
        parts.of(RememberingGas(gas))
    }
}

impl<'a, const D: usize> Parts<'a, D, Memory> {
    /// The body of the paper's algorithms, of any material.
    pub fn of_law(self, law: &'a dyn Law<D, State = Memory>) -> Ready<'a, D> {
        self.of(DeformsLast(Continuum { law: AnyLaw(law) }))
    }

    fn of<M: Medium<D, State = Memory> + 'a>(self, medium: M) -> Ready<'a, D> {
        let (origin, h) = ([0.0; D], self.spacing);
        let degree = match self.basis {
            BasisChoice::Lattice => return self.on(medium, || SimplexLattice::<D>::permutohedral(origin, h)),
            BasisChoice::Linear => SplineDegree::Linear,
            BasisChoice::Quadratic => SplineDegree::Quadratic,
            BasisChoice::Cubic => SplineDegree::Cubic,
        };
        if const { D > LARGEST_UNROLLED } {
            return self.on(medium, || ProductGrid::<D>::new(degree, origin, h));
        }
        match degree {
            SplineDegree::Linear => self.on(medium, || SplineGrid::<Linear, 2, D>::new(origin, h)),
            SplineDegree::Quadratic => self.on(medium, || SplineGrid::<Quadratic, 3, D>::new(origin, h)),
            SplineDegree::Cubic => self.on(medium, || SplineGrid::<Cubic, 4, D>::new(origin, h)),
        }
    }

    /// `make` gives any number of bases, all alike.
    fn on<B, M>(self, medium: M, make: impl Fn() -> Result<B, MpmError>) -> Ready<'a, D>
    where
        B: UniformBasis<D> + 'a,
        M: Medium<D, State = Memory> + 'a,
    {
        let failed = |error| SampleError::in_step(0, error);
        let (basis, certificate) = (make().map_err(failed)?, make().map_err(failed)?);
        Ok(if !M::DEFORMS && self.transfer == TransferChoice::Pic {
            self.with(medium, Pic, basis, certificate)
        } else {
            let transfer = InCell::new(self.transfer);
            self.with(medium, transfer, basis, certificate)
        })
    }

    fn with<B, T, M>(self, medium: M, transfer: T, basis: B, certificate: B) -> Box<dyn Moving<'a, D> + 'a>
    where
        B: UniformBasis<D> + 'a,
        T: Transfer<D> + 'a,
        M: Medium<D, State = Memory> + 'a,
    {
        let body = Mpm::new(self.particles, basis, transfer, medium, self.force);
        Box::new(OnBasis { body, certificate })
    }
}
