//! Bodies of the dimensions whose features `d1`…`d8` are on, which are compiled in this crate, once for all crates that call it.

use mpm_materials::{IsothermalGas, Law, Memory};

use crate::basis_choice::{Parts, Ready};

/// A body of gas, for the calibrated sampler.
pub(crate) fn body_of_gas<const D: usize>(parts: Parts<'_, D>, gas: IsothermalGas) -> Ready<'_, D> {
    (Compiled::of().gas)(parts, gas)
}

/// A body of any material, for the paper's algorithms.
pub(crate) fn body_of_law<'a, const D: usize>(
    parts: Parts<'a, D, Memory>,
    law: &'a dyn Law<D, State = Memory>,
) -> Ready<'a, D> {
    (Compiled::of().law)(parts, law)
}

type OfLaw<const D: usize> = for<'a> fn(Parts<'a, D, Memory>, &'a dyn Law<D, State = Memory>) -> Ready<'a, D>;

struct Compiled<const D: usize> {
    gas: for<'a> fn(Parts<'a, D>, IsothermalGas) -> Ready<'a, D>,
    law: OfLaw<D>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        gas: |parts, gas| parts.of_gas(gas),
        law: |parts, law| parts.of_law(law),
    };
}

mpm_parallel::compiled_ahead!(Compiled);
