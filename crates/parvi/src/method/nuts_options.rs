use super::with_defaults::with_defaults;
use crate::task::{Task, sampler};
use crate::{SampleError, Samples, defaults};

with_defaults! {
    /// Options of the No-U-Turn sampler (Hoffman & Gelman 2014), of the crate `nuts-rs`.
    ///
    /// The M draws of a run are shared out evenly over the chains and returned chain after chain. Needs the cargo feature `nuts`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct NutsOptions {
        /// Draws of every chain that adapt step size and mass matrix and are thrown away.
        pub warm_up: usize = defaults::NUTS_WARM_UP,
        /// Chains, ≥ 1; no more than there are draws.
        pub chains: usize = defaults::NUTS_CHAINS,
        /// Of so many draws after the warm-up the last one is kept, ≥ 1.
        pub thinning: usize = 1,
        /// Mean acceptance that the step size is adapted to, between 0 and 1.
        pub target_acceptance: f64 = defaults::NUTS_TARGET_ACCEPTANCE,
    }
}

sampler! {
    /// Draw from Markov chains that begin at the first points of the run's start law, in the target's own coordinates, with the diagonal mass
    /// matrix and the adaptation that are the defaults of `nuts-rs`.
    ///
    /// The score evaluations are all gradients, those of the warm-up included. A trajectory that diverges is counted, not an error. Same seed,
    /// same bits, on any number of threads; every chain keeps to one thread.
    ///
    /// Source: M. D. Hoffman, A. Gelman, *The No-U-Turn sampler*, JMLR 15, 2014.
    ///
    /// # Errors
    /// [`SampleError`]: without the cargo feature `nuts` always [`SampleError::NotBuilt`]; an option out of range; a score or a log density that is
    /// not finite where a chain begins; a chain that cannot begin; the observer's stop.
    NutsOptions => Self::run
}

impl NutsOptions {
    fn run<const D: usize>(&self, task: Task<'_, D>) -> Result<Samples<D>, SampleError> {
        #[cfg(feature = "nuts")]
        return crate::nuts::sample(self, task);
        #[cfg(not(feature = "nuts"))]
        {
            let _ = task;
            Err(SampleError::NotBuilt {
                method: "nuts",
                feature: "nuts",
            })
        }
    }
}
