/// Options of adaptive importance sampling.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AisOptions {
    /// Evaluations of all kinds, at most; `None`: the default of [`PoolOptions`](parvi_pool::PoolOptions).
    pub evaluations: Option<u64>,
}
