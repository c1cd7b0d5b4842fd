//! Bodies of the dimensions whose features `d1`…`d8` are on, which are compiled in this crate, once for all crates that call it.

use mpm_materials::{AnyLaw, IsothermalGas, Memory};

#[cfg(feature = "mesh")]
use crate::on_mesh::{MovingOnMesh, PartsOnMesh};
use crate::parts::{Parts, Ready};

impl<'a, const D: usize> Parts<'a, D> {
    /// The gas of the calibrated sampler.
    ///
    /// # Errors
    /// A spacing that is not positive and finite.
    pub fn of_gas(self, gas: IsothermalGas) -> Ready<'a, D> {
        (Compiled::of().gas)(self, gas)
    }
}

impl<'a, const D: usize> Parts<'a, D, Memory> {
    /// The body of the paper's algorithms, of any material.
    ///
    /// # Errors
    /// A spacing that is not positive and finite.
    pub fn of_law(self, law: AnyLaw<'a, D>) -> Ready<'a, D> {
        #[cfg(feature = "paper")]
        return (Compiled::of().law)(self, law);
        #[cfg(not(feature = "paper"))]
        self.law_here(law)
    }
}

#[cfg(feature = "mesh")]
impl<'a, const D: usize> PartsOnMesh<'a, D> {
    /// The gas within a mesh; none where D is above 3.
    pub fn of_gas(self, gas: IsothermalGas) -> Option<Box<dyn MovingOnMesh<'a, D> + 'a>> {
        (Compiled::of().on_mesh)(self, gas)
    }
}

#[cfg(feature = "paper")]
type OfLaw<const D: usize> = for<'a> fn(Parts<'a, D, Memory>, AnyLaw<'a, D>) -> Ready<'a, D>;

#[cfg(feature = "mesh")]
type OnMesh<const D: usize> =
    for<'a> fn(PartsOnMesh<'a, D>, IsothermalGas) -> Option<Box<dyn MovingOnMesh<'a, D> + 'a>>;

struct Compiled<const D: usize> {
    gas: for<'a> fn(Parts<'a, D>, IsothermalGas) -> Ready<'a, D>,
    #[cfg(feature = "paper")]
    law: OfLaw<D>,
    #[cfg(feature = "mesh")]
    on_mesh: OnMesh<D>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        gas: |parts, gas| parts.gas_here(gas),
        #[cfg(feature = "paper")]
        law: |parts, law| parts.law_here(law),
        #[cfg(feature = "mesh")]
        on_mesh: |parts, gas| parts.gas_here(gas),
    };
}

mpm_parallel::compiled_ahead!(Compiled);
