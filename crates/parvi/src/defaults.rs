//! Every default of the calibrated sampler, in one place, in the units of the frame.
//!
//! Chosen by scans of ED² against N(0, I) over d = 1…6, M = 128…4,096 and five seeds; see docs/results.

use crate::BasisChoice;

/// Steps for M particles. With the three evaluations that the correction of the mean may take this makes at most 100 scores
/// per particle, 150 from 4,096 particles on.
pub fn steps(particles: usize) -> usize {
    if particles < 4096 { 97 } else { 147 }
}

/// Rounds of these steps, at most.
pub const ROUNDS: usize = 3;

/// Central spacing h for M particles in D dimensions.
///
/// Lattice: 0.34 D^{1.3} (M / 512)^{−1/(D+5)}. Tensor products: (0.3 D − 0.17) (M / 512)^{−1/(D+5)}; hats resolve less than quadratic splines at the same
/// spacing and cubic ones more, hence the factor.
pub fn spacing<const D: usize>(basis: BasisChoice, particles: usize) -> f64 {
    let d = D as f64;
    let at_512 = match basis {
        BasisChoice::Lattice => 0.34 * d.powf(1.3),
        BasisChoice::Linear => 1.15 * (0.3 * d - 0.17),
        BasisChoice::Quadratic => 0.3 * d - 0.17,
        BasisChoice::Cubic => 0.9 * (0.3 * d - 0.17),
    };
    at_512 * (particles as f64 / 512.0).powf(-1.0 / (d + 5.0))
}

/// Steps of the first round of a polish.
pub const POLISH_STEPS: usize = 4;

/// Rounds of a polish, at most, each of twice as many steps as the one before.
pub const POLISH_ROUNDS: usize = 4;

/// Spacing of a polish: 1.4 of the central one for a normal law, whose particles lie well already and are to keep their tails, and finer as the target is bent or in
/// pieces, by its entropy power N = e^{2 h(p)/D}/(2πe) over that of the normal law of the same covariance.
pub fn polish_spacing<const D: usize>(basis: BasisChoice, particles: usize, entropy_power: f64) -> f64 {
    1.4 * entropy_power.clamp(1e-3, 1.0) * spacing::<D>(basis, particles)
}

/// Particles that a survey is made for, at most: more of them are condensed from the same pool, and the material evens out what that cannot. Up to here evaluations are spent on
/// a larger pool, which takes away more than the material does for as many.
pub const LARGEST_POOL: usize = 16_384;

/// Entropy power of the target, over that of the normal law of its covariance, below which the moments of condensed particles are left as they are: a target that is so bent, or in so many
/// pieces, gains nothing by a shift of all particles.
pub const LEAST_CORRECTED_ENTROPY_POWER: f64 = 0.5;

/// Part of the energy distance of condensed particles from the target that standard deviations as large as the pool's may cost, as far as the pool can tell: single ones cost two to four times that.
pub const MOMENT_PRICE: f64 = 0.05;

/// Variance of a pool, over that of as many independent draws as there are particles, from which on particles that were condensed from it are polished, however few they are, and a
/// polish goes on after its first round.
pub const LARGEST_POOL_NOISE: f64 = 0.3;

/// Δt for spacing h: 0.6 h, but no more than 0.6 until 0.23 h is, from h = 2.6 on.
pub fn time_step(spacing: f64) -> f64 {
    (0.6 * spacing).min(0.6).max(0.23 * spacing)
}

pub use parvi_body::OSCILLATION_ANGLE;

/// Ratio of the largest to the smallest spacing that a run draws from.
pub const SPACING_RANGE: f64 = 3.0;

/// Spacing of the first step over the central one.
pub const COARSE_START: f64 = 1.0;

/// Share of the steps over which the spacing becomes the central one.
pub const COARSE_SHARE: f64 = 0.5;

/// Share of the steps over which Δt falls at the end.
pub const SETTLING_SHARE: f64 = 0.5;

/// Δt of the last step over the full one.
pub const SETTLING_TIME_STEP: f64 = 0.2;

/// Friction γ.
pub const FRICTION: f64 = 1.0;

/// Steps of the paper's algorithms.
pub const PAPER_STEPS: usize = 200;

/// Steps of Stein variational gradient descent.
pub const SVGD_STEPS: usize = 500;

/// Draws per chain that warm the No-U-Turn sampler up.
pub const NUTS_WARM_UP: usize = 400;

/// Chains of the No-U-Turn sampler.
pub const NUTS_CHAINS: usize = 4;

/// Acceptance that the No-U-Turn sampler aims at.
pub const NUTS_TARGET_ACCEPTANCE: f64 = 0.8;

/// Size of the sample that M points are condensed from: 50 M, but no more than 100,000 unless M is.
pub fn pool_size(particles: usize) -> usize {
    particles.saturating_mul(50).min(100_000).max(particles)
}

/// Iterations of support points, at most.
pub const SUPPORT_POINTS_STEPS: usize = 200;

/// Support points are at rest once none moves farther than this, in units of the sample's spread.
pub const SUPPORT_POINTS_TOLERANCE: f64 = 1e-4;

/// Edge of the cells in which a cached score is interpolated, in units of the frame, before cells are halved.
pub const CACHE_SPACING: f64 = 1.25;

/// Difference of fresh and cached scores that is tolerated in the root of the mean square, in units of one over the particles' standard deviation: along that it adds up to an error of log p.
pub const CACHE_TOLERANCE: f64 = 0.005;

/// Share of the particles in a cell from which on it is tested.
pub const CACHE_TESTED_SHARE: f64 = 1.0 / 256.0;

/// Rounds, at most, that go on with a finer cache of scores.
pub const CACHE_ROUNDS: usize = 6;

/// Evaluations from which on a cache of scores for M particles is not refined any more.
pub fn cache_evaluations(particles: usize) -> u64 {
    (particles as u64 / 10).max(1000)
}
