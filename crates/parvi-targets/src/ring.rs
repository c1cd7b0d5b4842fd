//! A ring around the origin of the plane.

use std::f64::consts::{PI, TAU};

use rand::Rng;
use statrs::function::gamma::gamma_ur;

use crate::error::{finite, positive, within};
use crate::special::increasing_root;
use crate::target::its_own_source;
use crate::{CatalogueTarget, ExactDraws, Frame, Moments, Target, TargetError, UnitCubeTransport};

/// p(x) ∝ exp(−(‖x‖ − r)² / 2σ²) on the plane, with radius r ≥ 0 and width σ.
///
/// The angle is uniform; the radius ρ has density ρ exp(−(ρ − r)² / 2σ²) / Z₁ on ρ > 0, so that p = exp(…) / 2π Z₁
/// (normalised). Score −(ρ − r)/σ² · x/ρ; at the origin, where the density has a cusp, it is set to 0.
///
/// With M_k = ∫₀^∞ ρᵏ exp(−(ρ − r)²/2σ²) dρ, partial integration gives Z₁ = M₁ = r M₀ + σ² e^(−r²/2σ²),
/// M₂ = r M₁ + σ² M₀, M₃ = r M₂ + 2σ² M₁ and the covariance ½ M₃/M₁ · I. The distribution function of ρ is closed as
/// well and is inverted numerically for draws.
#[derive(Clone, Debug, PartialEq)]
pub struct Ring {
    radius: f64,
    width: f64,
    /// M₁ / σ².
    scaled_normalisation: f64,
    /// ½ M₃ / M₁.
    variance: f64,
}

impl Ring {
    /// A ring of the given radius r and width σ.
    ///
    /// # Errors
    /// [`TargetError::NotFinite`], or [`TargetError::OutOfRange`] unless r ≥ 0 and σ > 0.
    pub fn new(radius: f64, width: f64) -> Result<Self, TargetError> {
        finite("radius", radius)?;
        within("radius", radius, radius >= 0.0, "a number from 0 on")?;
        positive("width", width)?;
        let ring = Self::of_valid(radius, width);
        finite("the variance of the ring", ring.variance)?;
        Ok(ring)
    }

    fn of_valid(radius: f64, width: f64) -> Self {
        // In units of σ: a = r/σ.
        let a = radius / width;
        let m0 = half_mass(-a);
        let m1 = a * m0 + (-0.5 * a * a).exp();
        let m2 = a * m1 + m0;
        let m3 = a * m2 + 2.0 * m1;
        Self {
            radius,
            width,
            scaled_normalisation: m1,
            variance: 0.5 * m3 / m1 * width * width,
        }
    }

    /// The radius below which the mass `u` lies.
    ///
    /// With t = ρ/σ and a = r/σ the mass above ρ is [e^(−(t−a)²/2) + a √(2π) Φ(a − t)] / M₁.
    fn radial_quantile(&self, u: f64) -> f64 {
        let a = self.radius / self.width;
        let above = |t: f64| (-0.5 * (t - a) * (t - a)).exp() + a * half_mass(t - a);
        let below = |t: f64| {
            let bump = (-0.5 * a * a).exp() - (-0.5 * (t - a) * (t - a)).exp();
            bump + a * (half_mass(a - t) - half_mass(a))
        };
        let density = |t: f64| t * (-0.5 * (t - a) * (t - a)).exp();
        let total = self.scaled_normalisation;
        // The smaller tail, for its relative accuracy. Beyond a ± 40 there is no mass that a number could hold.
        let bracket = [(a - 40.0).max(0.0), a + 40.0];
        let t = if u > 0.5 {
            increasing_root(|t| (1.0 - u) * total - above(t), density, bracket, a.max(1.0))
        } else {
            increasing_root(|t| below(t) - u * total, density, bracket, a.max(1.0))
        };
        t * self.width
    }
}

/// ∫_t^∞ e^(−s²/2) ds = √(2π) Φ(−t) = √(π/2) Q(½, ½t²) for t > 0, Q the upper regularised incomplete gamma function.
///
/// Not by way of erfc: the one of statrs 0.19 has a relative error of 1e-10 around ½.
pub(crate) fn half_mass(t: f64) -> f64 {
    let square = 0.5 * t * t;
    let tail = if square == 0.0 {
        1.0
    } else if square < 740.0 {
        gamma_ur(0.5, square)
    } else {
        0.0
    };
    (0.5 * PI).sqrt() * if t < 0.0 { 2.0 - tail } else { tail }
}

impl Default for Ring {
    /// r = 2, σ = 0.2.
    fn default() -> Self {
        Self::of_valid(2.0, 0.2)
    }
}

impl Target<2> for Ring {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        let offset = (x[0].hypot(x[1]) - self.radius) / self.width;
        -0.5 * offset * offset - (TAU * self.scaled_normalisation * self.width * self.width).ln()
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        let distance = x[0].hypot(x[1]);
        if distance == 0.0 {
            return [0.0; 2];
        }
        let pull = (self.radius - distance) / (self.width * self.width);
        [pull * (x[0] / distance), pull * (x[1] / distance)]
    }
}

impl ExactDraws<2> for Ring {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; 2] {
        self.drawn(rng)
    }
}

impl UnitCubeTransport<2> for Ring {
    fn transport(&self, u: &[f64]) -> [f64; 2] {
        let [u, v] = [0, 1].map(|axis| u.get(axis).copied().unwrap_or(0.5));
        let (sine, cosine) = (TAU * v).sin_cos();
        let distance = self.radial_quantile(u);
        [distance * cosine, distance * sine]
    }
}

impl CatalogueTarget<2> for Ring {
    fn name(&self) -> &str {
        "ring"
    }

    fn frame(&self) -> Frame<2> {
        Frame::diagonal([0.0; 2], [self.variance.sqrt(); 2])
    }

    fn domain(&self) -> [[f64; 2]; 2] {
        let half = self.radius + 4.0 * self.width;
        [[-half, half]; 2]
    }

    its_own_source!(2);

    fn moments(&self) -> Option<Moments<2>> {
        Some(Moments::centred([self.variance; 2]))
    }

    /// The density is normalised.
    fn log_evidence(&self) -> Option<f64> {
        Some(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Composite Simpson rule over the radial density.
    fn radial_integral(ring: &Ring, power: i32, end: f64) -> f64 {
        let intervals = 200_000;
        let step = end / f64::from(intervals);
        let f = |rho: f64| rho.powi(power) * (-0.5 * ((rho - ring.radius) / ring.width).powi(2)).exp();
        let inner: f64 = (1..intervals)
            .map(|i| f(f64::from(i) * step) * if i % 2 == 1 { 4.0 } else { 2.0 })
            .sum();
        (f(0.0) + inner + f(end)) * step / 3.0
    }

    #[test]
    fn variance_and_quantiles_agree_with_quadrature() {
        for (radius, width) in [(2.0, 0.2), (0.0, 1.0), (1.0, 2.0), (10.0, 0.01)] {
            let ring = Ring::new(radius, width).unwrap();
            let end = radius + 12.0 * width;
            let mass = radial_integral(&ring, 1, end);
            let variance = 0.5 * radial_integral(&ring, 3, end) / mass;
            assert!((variance / ring.variance - 1.0).abs() < 1e-11, "{radius}, {width}");
            for u in [1e-9, 1e-3, 0.2, 0.5, 0.8, 0.999, 1.0 - 1e-9] {
                let below = radial_integral(&ring, 1, ring.radial_quantile(u)) / mass;
                assert!((below - u).abs() < 1e-11, "{radius}, {width}: {below} for {u}");
            }
        }
    }
}
