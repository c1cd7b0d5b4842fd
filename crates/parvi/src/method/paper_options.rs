use serde::Deserialize;

use parvi_body::{BasisChoice, ScoreLocation};

use super::with_defaults::with_defaults;
use super::{Annealing, PaperMaterial, Watch};

/// In which coordinates the body moves: those of grid, masses per volume, F and Δt.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Coordinates {
    /// Those of the frame, in which the target has unit scale.
    #[default]
    Frame,
    /// The target's own (the paper): the identity frame, nothing is whitened. The start's law and the spacing are then in the target's own units.
    Own,
}

/// The volumes V⁰_p that the stress of undeformed particles acts on, in the coordinates of the body, where they are not given
/// ([`GivenParticles::reference_volumes`](crate::GivenParticles::reference_volumes)).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ReferenceVolumes {
    /// V⁰_p = 1/M.
    #[default]
    Uniform,
    /// V⁰_p = m_p / p⁰(X_p), p⁰ the density of the run's start law: what the particle stands for of space. Not for given positions, whose law is not known.
    OfStartDensity,
    /// V⁰_p = m_p / ρ_h(X_p), ρ_h(X_p) = Σ_i w_ip m_i / h^D the density on the grid (Stomakhin et al. 2013).
    OfGrid,
}

with_defaults! {
    /// Guards that the paper's algorithms need to stay finite; each can be switched off.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct Guards {
        /// Nodes lighter than this share of the mean particle mass receive no force (0: off).
        pub mass_floor: f64 = 0.1,
        /// Multiply the force by the mass, m_i at nodes and m_p at particles, which makes it a force per unit mass (the paper, Eq. 3 and 5: `false`).
        pub mass_weighted_force: bool = true,
        /// Limit Δt by the wave speed and the particle velocity: Δt ≤ C h / (c + |v|) (`None`: off).
        pub courant: Option<f64> = Some(0.5),
        /// Largest displacement of a node per step in units of h (`None`: off). Below 1/(2d) no particle can be turned inside
        /// out in a step: quadratic B-splines give |Δt ∂v_a/∂x_b| ≤ 2 · limit.
        pub displacement_limit: Option<f64> = Some(0.2),
        /// Principal stretches of F are kept in [1/k, k], k > 1, and det F > 0 (`None`: off): without, a material that yields is crushed or sheared until det F is nothing but rounding.
        pub stretch_limit: Option<f64> = Some(1e3),
    }
}

impl Guards {
    /// None of them, as the paper has it. For the algorithms exactly as the paper writes them see [`PaperOptions::as_written`].
    pub fn none() -> Self {
        Self {
            mass_floor: 0.0,
            mass_weighted_force: false,
            courant: None,
            displacement_limit: None,
            stretch_limit: None,
        }
    }
}

with_defaults! {
    /// Options of the paper's Algorithms 1 and 2 (Huang, arXiv 2407.20287).
    ///
    /// [`as_written`](Self::as_written) has them to the letter. Every departure from that is one option: [`coordinates`](Self::coordinates) and those of
    /// [`guards`](Self::guards). The defaults have them all, since few runs stay finite without.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PaperOptions {
        /// Algorithm 2 (APIC) instead of Algorithm 1 (PIC).
        pub affine: bool = false,
        /// Share a ∈ [0, 1] of FLIP in the new velocities (the paper, footnote 2 of Algorithm 1: hybrid of PIC and FLIP): v_p ← (1−a) Σ w_ip v_iⁿ⁺¹ + a (v_p + Σ w_ip (v_iⁿ⁺¹ − v_iⁿ)); 0 in the algorithms.
        pub flip_share: f64 = 0.0,
        /// Background basis.
        pub basis: BasisChoice = BasisChoice::Quadratic,
        /// What the body is made of (the paper's energy density Ψ); for a material of one's own see [`PaperBody`](crate::PaperBody).
        pub material: PaperMaterial = PaperMaterial::default(),
        /// α(t).
        pub annealing: Annealing = Annealing::Constant { alpha: 1.0 },
        /// Force at nodes (Eq. 3, as Algorithms 1 and 2 write it) or at particles (Eq. 5).
        pub score_location: ScoreLocation = ScoreLocation::Nodes,
        /// Grid spacing h in frame units.
        pub spacing: Option<f64> = None,
        /// Steps.
        pub steps: Option<usize> = None,
        /// Time step Δt.
        pub time_step: Option<f64> = None,
        /// Friction γ ≥ 0 (v ← v e^{−γΔt}); 0 in the paper's algorithms. Of APIC nothing else dissipates.
        pub friction: f64 = 0.0,
        /// Guards.
        pub guards: Guards = Guards::default(),
        /// Coordinates that the body moves in.
        pub coordinates: Coordinates = Coordinates::default(),
        /// V⁰_p.
        pub reference_volumes: ReferenceVolumes = ReferenceVolumes::default(),
        /// Take a new grid, whose origin is drawn anew, every so many steps (paper, §3: "a new grid is used (every several iterations)"); `None`: one grid, with nodes at
        /// the integer multiples of h, serves the whole run.
        pub grid_renewal: Option<usize> = None,
        /// Evaluate the score at each node once, for as long as the grid stands; the same bits as without. A score that is estimated anew with every call is then that of its
        /// first estimate.
        pub cached_scores: bool = true,
        /// State an outcome at the end, by the M evaluations of the score there that the residual takes in any case ([`Samples::judging_evaluations`](crate::Samples::judging_evaluations)).
        pub certificate: bool = true,
        /// Measure residual and energy every so many steps (0: only at the end).
        pub trace_every: usize = 0,
        /// Find the best configuration on the way, beside the last one.
        pub watch: Option<Watch> = None,
    }
}

impl PaperOptions {
    /// Algorithm 1, or 2 if `affine`, exactly as the paper writes them: the target's own coordinates, f_i = α ∇log p(x_i) at the nodes {h k : k ∈ ℤᴰ} as it stands (Eq. 3),
    /// no guard; V⁰_p = 1/M, Neo-Hookean E = 1, ν = 0.3, α = 1. Masses 1/M and velocities 0, unless a run gives others.
    pub fn as_written(affine: bool) -> Self {
        Self {
            affine,
            guards: Guards::none(),
            coordinates: Coordinates::Own,
            ..Self::default()
        }
    }
}
