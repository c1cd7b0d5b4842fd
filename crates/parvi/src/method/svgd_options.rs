/// Options of Stein variational gradient descent (Liu & Wang 2016).
#[derive(Clone, Debug, PartialEq)]
pub struct SvgdOptions {
    /// Steps (default: 500).
    pub steps: Option<usize>,
    /// Adam step size in frame units.
    pub step_size: f64,
    /// Kernel bandwidth; `None`: median heuristic in every step.
    pub bandwidth: Option<f64>,
    /// Measure energy every so many steps (0: never).
    pub trace_every: usize,
}

impl Default for SvgdOptions {
    fn default() -> Self {
        Self {
            steps: None,
            step_size: 0.1,
            bandwidth: None,
            trace_every: 0,
        }
    }
}
