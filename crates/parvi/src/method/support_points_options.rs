use super::with_defaults::with_defaults;
use crate::defaults;

with_defaults! {
    /// Options of support points ([`crate::support_points`]) as a sampler: M points that represent a bigger sample of independent exact
    /// draws, where the target has them.
    #[derive(Clone, Debug, PartialEq)]
    pub struct SupportPointsOptions {
        /// Size of the sample, at least M (default: [`crate::defaults::pool_size`]).
        pub pool_size: Option<usize> = None,
        /// Iterations at most (default: [`crate::defaults::SUPPORT_POINTS_STEPS`]).
        pub steps: Option<usize> = None,
        /// Ends once no point moves farther than this, in units of the sample's spread.
        pub tolerance: f64 = defaults::SUPPORT_POINTS_TOLERANCE,
    }
}
