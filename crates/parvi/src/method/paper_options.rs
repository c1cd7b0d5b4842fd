use super::{Annealing, BasisChoice, ScoreLocation};

/// Elastic law of the paper's algorithms.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Elasticity {
    /// Small-strain linear elasticity (paper, §3).
    Linear,
    /// Compressible Neo-Hookean solid.
    NeoHookean,
}

/// Guards that the paper's algorithms need to stay finite; each can be switched off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Guards {
    /// Nodes lighter than this share of the mean particle mass receive no force (0: off).
    pub mass_floor: f64,
    /// Multiply the force by the nodal mass, which makes it a force per unit mass (the paper: `false`).
    pub mass_weighted_force: bool,
    /// Limit Δt by the wave speed and the particle velocity: Δt ≤ C h / (c + |v|) (`None`: off).
    pub courant: Option<f64>,
    /// Largest displacement of a node per step in units of h (`None`: off). Below 1/(2d) no particle can be turned inside
    /// out in a step: quadratic B-splines give |Δt ∂v_a/∂x_b| ≤ 2 · limit.
    pub displacement_limit: Option<f64>,
}

impl Default for Guards {
    fn default() -> Self {
        Self {
            mass_floor: 0.1,
            mass_weighted_force: true,
            courant: Some(0.5),
            displacement_limit: Some(0.2),
        }
    }
}

impl Guards {
    /// The algorithms exactly as the paper writes them.
    pub fn none() -> Self {
        Self {
            mass_floor: 0.0,
            mass_weighted_force: false,
            courant: None,
            displacement_limit: None,
        }
    }
}

/// Options of the paper's Algorithms 1 and 2.
#[derive(Clone, Debug, PartialEq)]
pub struct PaperOptions {
    /// Algorithm 2 (APIC) instead of Algorithm 1 (PIC).
    pub affine: bool,
    /// Background basis.
    pub basis: BasisChoice,
    /// Elastic law.
    pub elasticity: Elasticity,
    /// Young's modulus E > 0.
    pub youngs_modulus: f64,
    /// Poisson's ratio ν ∈ (−1, ½).
    pub poissons_ratio: f64,
    /// α(t).
    pub annealing: Annealing,
    /// Force at nodes (Eq. 3, as Algorithms 1 and 2 write it) or at particles (Eq. 5).
    pub score_location: ScoreLocation,
    /// Grid spacing h in frame units.
    pub spacing: Option<f64>,
    /// Steps.
    pub steps: Option<usize>,
    /// Time step Δt.
    pub time_step: Option<f64>,
    /// Guards.
    pub guards: Guards,
    /// Measure residual and energy every so many steps (0: only at the end).
    pub trace_every: usize,
}

impl Default for PaperOptions {
    fn default() -> Self {
        Self {
            affine: false,
            basis: BasisChoice::Quadratic,
            elasticity: Elasticity::NeoHookean,
            youngs_modulus: 1.0,
            poissons_ratio: 0.3,
            annealing: Annealing::Constant(1.0),
            score_location: ScoreLocation::Nodes,
            spacing: None,
            steps: None,
            time_step: None,
            guards: Guards::default(),
            trace_every: 0,
        }
    }
}
