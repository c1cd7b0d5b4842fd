use super::{BasisChoice, SpacingSchedule, Settling, TransferChoice};

/// Where the score is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScoreLocation {
    /// At the particles (paper, Eq. 5); exact moments.
    #[default]
    Particles,
    /// At the nodes, weighted by nodal mass (paper, Eq. 3); cheaper when nodes are few, but the particles'
    /// covariance shrinks by the variance of the kernel.
    Nodes,
}

/// Options of the calibrated sampler; `None` means: chosen by the rule in [`crate::defaults`].
#[derive(Clone, Debug, PartialEq)]
pub struct MpmOptions {
    /// Background basis.
    pub basis: BasisChoice,
    /// Velocity transfer.
    pub transfer: TransferChoice,
    /// Spacing h in frame units; > 0.
    pub spacing: Option<f64>,
    /// How the spacing varies around h from step to step.
    pub spacing_schedule: SpacingSchedule,
    /// Steps in all, settling included; ≥ 1.
    pub steps: Option<usize>,
    /// Time step Δt; > 0.
    pub time_step: Option<f64>,
    /// Friction γ ≥ 0 (v ← v e^{−γΔt}).
    pub friction: Option<f64>,
    /// Move the basis' origin every step by a Kronecker sequence.
    pub shifts: bool,
    /// Turn the lattice by a random rotation; has no meaning for splines.
    pub rotation: bool,
    /// How the run ends.
    pub settling: Settling,
    /// Finish with the affine Stein correction, which makes E\[s\] = 0 and E\[s xᵀ\] = −I hold for the particles.
    pub moment_correction: bool,
    /// Where the score is evaluated.
    pub score_location: ScoreLocation,
    /// Largest displacement per step in units of h; > 0.
    pub displacement_limit: f64,
    /// Measure residual and energy every so many steps (0: only at the end).
    pub trace_every: usize,
}

impl Default for MpmOptions {
    fn default() -> Self {
        Self {
            basis: BasisChoice::default(),
            transfer: TransferChoice::default(),
            spacing: None,
            spacing_schedule: SpacingSchedule::default(),
            steps: None,
            time_step: None,
            friction: None,
            shifts: true,
            rotation: false,
            settling: Settling::default(),
            moment_correction: true,
            score_location: ScoreLocation::default(),
            displacement_limit: 0.5,
            trace_every: 0,
        }
    }
}
