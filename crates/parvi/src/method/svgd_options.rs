use super::with_defaults::with_defaults;

with_defaults! {
    /// Options of Stein variational gradient descent (Liu & Wang 2016).
    #[derive(Clone, Debug, PartialEq)]
    pub struct SvgdOptions {
        /// Steps (default: 500).
        pub steps: Option<usize> = None,
        /// Adam step size in frame units.
        pub step_size: f64 = 0.1,
        /// Kernel bandwidth; `None`: median heuristic in every step.
        pub bandwidth: Option<f64> = None,
        /// Measure energy every so many steps (0: never).
        pub trace_every: usize = 0,
    }
}
