//! Gaussian shells.

use std::f64::consts::{LN_2, PI};

use mpm_tensor::vector;
use rand::Rng;
use statrs::function::gamma::ln_gamma;

use crate::error::at_least_two;
use crate::gaussian::normal_quantiles;
use crate::ring::half_mass;
use crate::special::{HALF_LOG_TWO_PI, increasing_root};
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Mode, Moments, Target, TargetError, UnitCubeTransport};

/// Distance of each centre from the origin, along the first axis.
const OFFSET: f64 = 3.5;
const RADIUS: f64 = 2.0;
const WIDTH: f64 = 0.1;
/// The side of the prior's box.
const SIDE: f64 = 12.0;

/// Likelihood L = Σ_± N(|x ∓ c|; r, w²) with c = 3.5 e₁, r = 2, w = 0.1 under a uniform prior of density 12^(−D): two thin shells.
///
/// log p = log L − D log 12. The prior's box [−6, 6]ᴰ is not enforced: its faces are 5 w from the shells. With
/// M_k = ∫₀^∞ tᵏ e^(−(t − a)²/2) dt, a = r/w, M_k = a M_{k−1} + (k−1) M_{k−2} + [k = 1] e^(−a²/2) and the sphere's area S,
/// Z = 2 S w^(D−1) M_{D−1} / (√(2π) 12ᴰ): log Z = −1.75, −5.67, −14.59 for D = 2, 5, 10, as published. Mean 0, covariance
/// E ρ²/D · I + c cᵀ with E ρ² = w² M_{D+1}/M_{D−1}. At the centres, where the density has a cusp, the score is 0. Any D ≥ 2.
///
/// Source: F. Feroz, M. P. Hobson, M. Bridges, MultiNest, *MNRAS* 398 (2009) 1601–1614, section 6.2.
#[derive(Clone, Debug, PartialEq)]
pub struct GaussianShells<const D: usize> {
    log_evidence: f64,
    /// M_{D−1}.
    radial_mass: f64,
    /// E ρ² / D.
    variance: f64,
    modes: [Mode<D>; 2],
}

impl<const D: usize> GaussianShells<D> {
    /// The problem in dimension D.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2.
    pub fn new() -> Result<Self, TargetError> {
        at_least_two("shells", D)?;
        let d = D as f64;
        let [radial_mass, above] = [D - 1, D + 1].map(|power| mass_above(power, 0.0));
        let variance = WIDTH * WIDTH * above / radial_mass / d;
        let log_area = LN_2 + 0.5 * d * PI.ln() - ln_gamma(0.5 * d);
        let log_radial = (d - 1.0) * WIDTH.ln() + radial_mass.ln() - HALF_LOG_TWO_PI;
        let modes = [OFFSET, -OFFSET].map(|offset| Mode {
            centre: centre(offset),
            width: variance.sqrt(),
            mass: 0.5,
        });
        Ok(Self {
            log_evidence: LN_2 + log_area + log_radial - d * SIDE.ln(),
            radial_mass,
            variance,
            modes,
        })
    }

    /// The radius below which the share u of a shell lies.
    fn radial_quantile(&self, u: f64) -> f64 {
        let a = RADIUS / WIDTH;
        let missing = |t: f64| (1.0 - u) * self.radial_mass - mass_above(D - 1, t);
        let density = |t: f64| t.powi(D as i32 - 1) * (-0.5 * (t - a) * (t - a)).exp();
        WIDTH * increasing_root(missing, density, [0.0, a + 40.0], a)
    }
}

fn centre<const D: usize>(offset: f64) -> [f64; D] {
    std::array::from_fn(|axis| if axis == 0 { offset } else { 0.0 })
}

/// ∫_t^∞ sᵏ e^(−(s − a)²/2) ds by partial integration, for t ≥ 0.
fn mass_above(power: usize, t: f64) -> f64 {
    let a = RADIUS / WIDTH;
    let edge = (-0.5 * (t - a) * (t - a)).exp();
    let mut before = 0.0;
    let mut mass = half_mass(t - a);
    let mut edge_times_power = edge;
    for k in 1..=power {
        let next = a * mass + (k as f64 - 1.0) * before + edge_times_power;
        (before, mass) = (mass, next);
        edge_times_power *= t;
    }
    mass
}

/// The distances from the two centres, and the exponents −(ρ − r)²/2w².
fn shells<const D: usize>(x: &[f64; D]) -> [([f64; D], f64, f64); 2] {
    [OFFSET, -OFFSET].map(|offset| {
        let from_centre = vector::subtract(x, &centre(offset));
        let distance = from_centre.iter().fold(0.0_f64, |length, x| length.hypot(*x));
        let z = (distance - RADIUS) / WIDTH;
        (from_centre, distance, -0.5 * z * z)
    })
}

impl<const D: usize> Target<D> for GaussianShells<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let [(_, _, one), (_, _, other)] = shells(x);
        let both = one.max(other) + (-(one - other).abs()).exp().ln_1p();
        both - HALF_LOG_TWO_PI - WIDTH.ln() - D as f64 * SIDE.ln()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let shells = shells(x);
        let largest = shells[0].2.max(shells[1].2);
        let (mut score, mut total) = ([0.0; D], 0.0);
        for (from_centre, distance, exponent) in shells {
            let weight = (exponent - largest).exp();
            total += weight;
            if distance > 0.0 {
                let pull = (RADIUS - distance) / (WIDTH * WIDTH);
                let direction = from_centre.map(|x| x / distance);
                vector::accumulate(&mut score, weight * pull, &direction);
            }
        }
        score.map(|component| component / total)
    }
}

impl<const D: usize> ExactDraws<D> for GaussianShells<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.drawn(rng)
    }
}

impl<const D: usize> UnitCubeTransport<D> for GaussianShells<D> {
    /// Two more than D: shell, radius, and D normal numbers for the direction.
    fn cube_dimension(&self) -> usize {
        D + 2
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let [side, level] = [0, 1].map(|axis| u.get(axis).copied().unwrap_or(0.5));
        let normal: [f64; D] = normal_quantiles(u.get(2..).unwrap_or(&[]));
        let length = vector::norm(&normal).max(f64::MIN_POSITIVE);
        let mut x = vector::scale(&normal, self.radial_quantile(level) / length);
        x[0] += if side < 0.5 { OFFSET } else { -OFFSET };
        x
    }
}

impl<const D: usize> CatalogueTarget<D> for GaussianShells<D> {
    fn name(&self) -> &str {
        "shells"
    }

    /// The frame of mean and covariance.
    fn frame(&self) -> Frame<D> {
        let offset: [f64; D] = centre(OFFSET);
        Frame::diagonal([0.0; D], offset.map(|c| (c * c + self.variance).sqrt()))
    }

    fn domain(&self) -> [[f64; 2]; D] {
        let half = RADIUS + 5.0 * WIDTH;
        centre::<D>(OFFSET).map(|c| [-c - half, c + half])
    }

    its_own_source!(D);

    fn moments(&self) -> Option<Moments<D>> {
        let offset: [f64; D] = centre(OFFSET);
        Some(Moments::centred(offset.map(|c| c * c + self.variance)))
    }

    fn modes(&self) -> &[Mode<D>] {
        &self.modes
    }

    fn log_evidence(&self) -> Option<f64> {
        Some(self.log_evidence)
    }
}
