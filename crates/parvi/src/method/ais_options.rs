use super::with_defaults::with_defaults;

/// What particles are made of a weighted pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Condensation {
    /// M of equal mass.
    #[default]
    On,
    /// The points that weigh anything, as many as they are, with their weights: what M points of equal mass cannot hold is kept, and nothing is spent on them.
    Off,
    /// These and free draws of the last proposals, which take most of the weights' noise away ([`Pool::controlled`](parvi_pool::Pool::controlled)): several times nearer to the target where proposals are near to it.
    Controlled,
}

with_defaults! {
    /// Options of adaptive importance sampling.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct AisOptions {
        /// Evaluations of all kinds that the pool is planned with, ≥ 1; [`PoolOptions`](parvi_pool::PoolOptions) says what is evaluated in any case, and has the default for `None`. To these come one per
        /// particle and up to 100 by which scores, tails and values are checked.
        pub evaluations: Option<u64> = None,
        /// How many times as much is drawn in search of pieces that no proposal has met; ≥ 1.
        pub search_effort: f64 = 1.0,
        /// What particles are made of the pool.
        pub condense: Condensation = Condensation::On,
    }
}
