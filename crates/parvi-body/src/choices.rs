//! What a body can be asked to be, by name.

/// Background basis of the mechanics.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum BasisChoice {
    /// Hat functions on the simplices of the lattice A_D*: D + 1 nodes per particle.
    #[default]
    Lattice,
    /// Tensor-product hat functions: 2ᴰ nodes per particle.
    Linear,
    /// Tensor-product quadratic B-splines: 3ᴰ nodes per particle.
    Quadratic,
    /// Tensor-product cubic B-splines: 4ᴰ nodes per particle.
    Cubic,
}

/// How velocities travel between particles and nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum TransferChoice {
    /// Particle in cell: v_p = Σ w_ip v_i.
    #[default]
    Pic,
    /// Affine particle in cell: PIC with a velocity gradient per particle.
    Apic,
    /// FLIP blend with share `a` ∈ [0, 1] of FLIP.
    Flip(f64),
    /// The same with a velocity gradient per particle (affine FLIP, Fei et al. 2021).
    AffineFlip(f64),
}

/// Where the score is evaluated.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ScoreLocation {
    /// At the particles, where the paper's Eq. 5 begins; exact moments.
    #[default]
    Particles,
    /// At the nodes, as in the paper's Eq. 3, there without nodal mass, here weighted by it; cheaper when nodes are few, but the particles'
    /// covariance shrinks by the variance of the kernel.
    Nodes,
    /// At the particles, but evaluated at the nodes of a grid of its own only, each once, and interpolated (docs/theory.md, §15): for targets whose score takes seconds. Without a survey,
    /// which would take more evaluations than the grid. Of the calibrated sampler.
    Cached,
}

/// What is done about a particle whose score is not finite.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NonFiniteScores {
    /// It is pulled towards the centre of the frame with the score of N(0, I) there, −z; such replacements are counted. A score that is not finite at the end is an error, unless scores are
    /// cached: then nodes of their grid are replaced.
    #[default]
    PullBack,
    /// Steps are taken back to the last good state and made again with half of Δt, a limited number of times; then it is an error.
    RejectStep,
    /// It is an error at once.
    Report,
}
