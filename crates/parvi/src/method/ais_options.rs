use super::with_defaults::with_defaults;

with_defaults! {
    /// Options of adaptive importance sampling.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct AisOptions {
        /// Evaluations of all kinds, at most; `None`: the default of [`PoolOptions`](parvi_pool::PoolOptions).
        pub evaluations: Option<u64> = None,
        /// How many times as much is drawn in search of pieces that no proposal has met; ≥ 1.
        pub search_effort: f64 = 1.0,
    }
}
