//! Two crescents.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, LN_2, PI};

use rand::{Rng, RngExt};

use super::box_posterior::BoxPosterior;
use super::simulator::{Simulator, numbered};
use crate::gaussian::standard_normal;
use crate::special::HALF_LOG_TWO_PI;
use crate::{Target, TargetError};

/// Mean of the radius r.
const RADIUS: f64 = 0.1;

/// Standard deviation of the radius.
const SPREAD: f64 = 0.01;

/// Where the crescent's centre lies.
const OFFSET: f64 = 0.25;

/// The pole of the density at ρ = 0, of mass 10⁻²², is cut off here.
const SMALLEST_RADIUS: f64 = 1e-6;

const OBSERVATIONS: [(&str, [f64; 2]); 3] = [
    ("sbibm-two-moons-1", [-0.639_670_6, 0.162_346_57]),
    ("sbibm-two-moons-2", [-0.567_668_8, -0.331_948_34]),
    ("sbibm-two-moons-3", [0.003_010_958_4, -0.645_766_2]),
];

/// x = (r cos a + ¼, r sin a) + (−|θ₁ + θ₂|, θ₂ − θ₁)/√2, a uniform on (−π/2, π/2), r ~ N(0.1, 0.01²), θ in (−1, 1)².
///
/// With (u, v) = x − (¼, 0) − (−|θ₁ + θ₂|, θ₂ − θ₁)/√2, ρ = ‖(u, v)‖ and r = ρ for u > 0, −ρ for u < 0:
/// p(x | θ) = N(r; 0.1, 0.01²)/(π ρ). Two crescents, mirror images about θ₁ + θ₂ = 0, of thickness 0.01 with ends cut straight, where log p falls
/// by 200. Of the observations here all but 10⁻¹⁷ of the posterior is inside of the box, so that the evidence is ¼ for each.
#[derive(Clone, Copy, Debug)]
pub struct TwoMoons {
    name: &'static str,
    observed: [f64; 2],
}

/// What a point has in common with a crescent.
struct Place {
    /// (u, v)/ρ.
    direction: [f64; 2],
    /// ρ.
    distance: f64,
    /// The sign of r.
    side: f64,
    /// The sign of θ₁ + θ₂.
    moon: f64,
}

impl TwoMoons {
    /// The posterior of the benchmark's first, second or third observation.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] for another number.
    pub fn posterior(number: usize) -> Result<BoxPosterior<Self, 2>, TargetError> {
        let (name, observed) = numbered(&OBSERVATIONS, number)?;
        BoxPosterior::new(Self { name, observed })
    }

    fn place(&self, theta: &[f64; 2]) -> Place {
        let along = FRAC_1_SQRT_2 * (theta[0] + theta[1]);
        let u = self.observed[0] - OFFSET + along.abs();
        let v = self.observed[1] - FRAC_1_SQRT_2 * (theta[1] - theta[0]);
        let distance = u.hypot(v).max(SMALLEST_RADIUS);
        Place {
            direction: [u / distance, v / distance],
            distance,
            side: 1_f64.copysign(u),
            moon: 1_f64.copysign(along),
        }
    }
}

impl Target<2> for TwoMoons {
    fn log_density(&self, theta: &[f64; 2]) -> f64 {
        let Place { distance, side, .. } = self.place(theta);
        let z = (side * distance - RADIUS) / SPREAD;
        -0.5 * z * z - HALF_LOG_TWO_PI - (PI * SPREAD * distance).ln()
    }

    fn score(&self, theta: &[f64; 2]) -> [f64; 2] {
        let place = self.place(theta);
        let z = (place.side * place.distance - RADIUS) / SPREAD;
        let slope = -place.side * z / SPREAD - place.distance.recip();
        let [by_u, by_v] = place.direction.map(|part| FRAC_1_SQRT_2 * slope * part);
        [place.moon * by_u + by_v, place.moon * by_u - by_v]
    }
}

impl Simulator<2> for TwoMoons {
    const HALF_WIDTH: f64 = 1.0;

    fn name(&self) -> &'static str {
        self.name
    }

    /// The simulator turned round: radius, angle and crescent give θ.
    fn posterior_draw(&self, rng: &mut dyn Rng) -> [f64; 2] {
        loop {
            let [normal] = standard_normal(rng);
            let (sine, cosine) = rng.random_range(-FRAC_PI_2..FRAC_PI_2).sin_cos();
            let r = RADIUS + SPREAD * normal;
            let size = r * cosine + OFFSET - self.observed[0];
            let along = if rng.random() { size } else { -size };
            let across = self.observed[1] - r * sine;
            let theta = [along - across, along + across].map(|sum| FRAC_1_SQRT_2 * sum);
            if size >= 0.0 && theta.iter().all(|theta| theta.abs() < 1.0) {
                return theta;
            }
        }
    }

    fn log_evidence(&self) -> f64 {
        -LN_2
    }

    fn centres(&self) -> Vec<[f64; 2]> {
        vec![[-0.5; 2], [0.5; 2]]
    }
}
