//! Weights that are positive: the fit of one particle once more, where least squares give a node next to nothing or less.

mod problem;

use mpm_kernels::Lanes;

use self::problem::{Problem, State, System};
use super::fit::Fit;
use super::ring_lanes::RingLanes;

/// θ Σ d′: a node of weight w keeps what least squares give it while w is at least this share of the d′ / Σ d′ that it has in a ring without a lean (ours).
const LEAST_SHARE: f64 = 0.25;

/// The weights of a particle are w = d ψ(s), s = α + β·r, with
///
/// ψ(s) = s for s ≥ θ and θ² / (2θ − s) below,
///
/// and α, β such that Σ w = 1 and Σ w r = 0: the minimum of a convex function, Σ d Ψ(s) − α with Ψ′ = ψ. Where all s are at least θ this is the least squares fit itself. Gradients are
/// d ψ′(s) (β̂ + Γ r), the fit with the sample weights d ψ′(s), so that Σ g = 0 and Σ g rᵀ = I as before; both stay continuous.
///
/// Least squares give w = d s, which passes through zero where g does not. A node that only one particle reaches then has a mass that vanishes before the force on it does, m_p w and V τ g, and its velocity has no bound.
/// Here |g|² / w ≤ d |β̂ + Γ r|² / θ, which falls to zero with d.
///
/// d is stored as d ψ′(s), of which w is the multiple max(s, 2θ − s).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Floor<const D: usize> {
    /// 2θ; −∞ where weights are those of least squares.
    pub twice: f64,
    /// α̂, of the fit with the sample weights d ψ′.
    pub level: f64,
    /// β̂.
    pub slope: [f64; D],
}

impl<const D: usize> Floor<D> {
    /// None: least squares.
    pub fn none(fit: &Fit<D>) -> Self {
        Self {
            twice: f64::NEG_INFINITY,
            level: fit.level,
            slope: fit.slope,
        }
    }

    /// Whether weights are not those of least squares.
    #[inline(always)]
    pub fn is_reached(&self) -> bool {
        self.twice > f64::NEG_INFINITY
    }

    /// w / (d ψ′) from s.
    #[inline(always)]
    pub fn factor(&self, s: f64) -> f64 {
        s.max(self.twice - s)
    }

    /// ψ(s).
    #[inline(always)]
    pub fn value(&self, s: Lanes) -> Lanes {
        if !self.is_reached() {
            return s;
        }
        let floor = Lanes::splat(0.5 * self.twice);
        s.simd_lt(floor).select(floor * floor / (floor + floor - s), s)
    }

    /// −(∂ψ/∂θ) (∂θ/∂ Σ d) / ψ′(s) = 2 (θ − s) / Σ d below θ: θ falls as Σ d grows.
    #[inline(always)]
    pub fn lowering(&self, s: Lanes) -> Lanes {
        if !self.is_reached() {
            return Lanes::ZERO;
        }
        let per_total = self.twice / (2.0 * LEAST_SHARE);
        (Lanes::splat(self.twice) - s - s).fast_max(Lanes::ZERO) * Lanes::splat(per_total)
    }
}

impl<const D: usize> RingLanes<D> {
    /// Makes the weights of the particle that was solved at place `k` positive; its d′ become d ψ′. As they were where no such weights exist, because the particle is at the boundary of its ring or beyond.
    #[inline(never)]
    pub fn make_positive(&self, k: usize, spread: bool, samples: &mut [Lanes], fit: &mut Fit<D>) -> Floor<D> {
        let particle = &self.pending[k];
        let own = &samples[particle.samples()];
        let total = own.iter().fold(Lanes::ZERO, |sum, &sample| sum + sample).reduce_add();
        let problem = Problem {
            groups: &self.groups[particle.groups()],
            samples: own,
            point: particle.point.map(Lanes::splat),
            inverse_h: particle.inverse_h,
            floor: LEAST_SHARE / total,
        };
        let start = State {
            level: fit.level,
            slope: fit.slope,
        };
        if !problem.is_below(&start) {
            return Floor::none(fit);
        }
        let Some((state, sums)) = problem.solution(start) else {
            return Floor::none(fit);
        };
        let Some(system) = System::<D>::of(&sums) else {
            return Floor::none(fit);
        };
        let floor = Floor {
            twice: 2.0 * problem.floor,
            level: system.level,
            slope: system.slope,
        };
        let (tilted, inverse_spread) = problem.weighted(&state, spread);
        samples[particle.samples()].copy_from_slice(&tilted);
        (fit.level, fit.slope, fit.curvature) = (state.level, state.slope, system.curvature);
        fit.inverse_spread = inverse_spread;
        floor
    }
}
