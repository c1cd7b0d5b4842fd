use super::NutsOptions;

/// Options of Stein thinning ([`crate::stein_thinning`]) as a sampler: M points out of a bigger sample.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SteinThinningOptions {
    /// Where the sample comes from.
    pub pool: SampleSource,
    /// Its size, at least M (default: [`crate::defaults::pool_size`]).
    pub pool_size: Option<usize>,
}

/// A sample to choose from.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum SampleSource {
    /// Independent exact draws, where the target has them.
    #[default]
    Exact,
    /// Draws of the No-U-Turn sampler.
    Nuts(NutsOptions),
}
