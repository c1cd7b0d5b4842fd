use mpm_materials::{
    DruckerPrager, FixedCorotated, Hencky, LinearElastic, NeoHookean, SofteningHencky, TaitFluid, TrackedGas,
};

/// One law of the scene, chosen at run time.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyLaw {
    /// Small strains.
    LinearElastic(LinearElastic),
    /// The compressible Neo-Hookean solid.
    NeoHookean(NeoHookean),
    /// The fixed corotated solid.
    FixedCorotated(FixedCorotated),
    /// Hencky's solid.
    Hencky(Hencky),
    /// Metal plasticity with softening.
    SofteningHencky(SofteningHencky),
    /// Granular friction.
    DruckerPrager(DruckerPrager),
    /// The weakly compressible fluid.
    TaitFluid(TaitFluid),
    /// The isothermal gas.
    IsothermalGas(TrackedGas),
}

/// Evaluates an expression with the law, whichever it is.
macro_rules! with_law {
    ($any:expr, $law:ident => $call:expr) => {
        match $any {
            AnyLaw::LinearElastic($law) => $call,
            AnyLaw::NeoHookean($law) => $call,
            AnyLaw::FixedCorotated($law) => $call,
            AnyLaw::Hencky($law) => $call,
            AnyLaw::SofteningHencky($law) => $call,
            AnyLaw::DruckerPrager($law) => $call,
            AnyLaw::TaitFluid($law) => $call,
            AnyLaw::IsothermalGas($law) => $call,
        }
    };
}

pub(super) use with_law;
