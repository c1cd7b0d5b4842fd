//! The eggbox.

use std::f64::consts::PI;

use rand::{Rng, RngExt};

use super::logit;
use crate::gaussian::standard_normal;
use crate::{CatalogueTarget, ConstrainedTarget, Constraints, ExactDraws, Frame, Target, TargetError};

/// The side of the box.
const SIDE: f64 = 10.0 * PI;

/// log of the mean of exp((2 + cos u cos v)⁵) over a period: the trapezoidal rule with 400², 800² and 1,200² points gives the
/// same digits.
const LOG_EVIDENCE: f64 = 235.855_940_332_254_14;

/// (2 + c)⁵ lies below 243 − 211 (1 − c) for c in [0, 1], because it is convex, and 1 − cos a cos b above (2/π²)(a² + b²) for
/// a and b in [−π/2, π/2]: so exp(243 − 211 · (2/π²)(a² + b²)) is above the likelihood around a mode.
const ENVELOPE: f64 = 211.0 * 2.0 / (PI * PI);

/// Likelihood exp((2 + cos(x₁/2) cos(x₂/2))⁵) under the uniform prior on [0, 10π]², in the coordinates y = log x/(10π − x), where
/// everything is smooth and unbounded: log p(y) = (2 + cos(x₁/2) cos(x₂/2))⁵ + Σ log σ(y_k) σ(−y_k), σ the logistic function.
///
/// 18 equal modes of standard deviation 0.1 in x, of which 8 lie on an edge and are cut in half and 2 lie in a corner and are
/// quarters. log Z = ∫ p = 235.856, which the literature quotes as 235.88 from a coarse grid. Draws are exact to 10⁻⁹¹: what lies
/// beyond the 18 cells is left out.
///
/// Source: F. Feroz, M. P. Hobson, M. Bridges, MultiNest, *MNRAS* 398 (2009) 1601–1614, section 6.1.
#[derive(Clone, Debug)]
pub struct Eggbox(ConstrainedTarget<Likelihood, 2, 2>);

/// (2 + cos(x₁/2) cos(x₂/2))⁵ − 2 log 10π.
#[derive(Clone, Copy, Debug)]
struct Likelihood;

impl Target<2> for Likelihood {
    fn log_density(&self, x: &[f64; 2]) -> f64 {
        log_likelihood(x.map(|x| 0.5 * x)) - 2.0 * SIDE.ln()
    }

    fn score(&self, x: &[f64; 2]) -> [f64; 2] {
        let [(sine, cosine), (other_sine, other_cosine)] = x.map(|x| (0.5 * x).sin_cos());
        let slope = -2.5 * (2.0 + cosine * other_cosine).powi(4);
        [slope * sine * other_cosine, slope * cosine * other_sine]
    }
}

/// (2 + cos u cos v)⁵.
fn log_likelihood([u, v]: [f64; 2]) -> f64 {
    (2.0 + u.cos() * v.cos()).powi(5)
}

impl Eggbox {
    /// The problem with its constants.
    ///
    /// # Errors
    /// None in fact; those of the constraints.
    pub fn new() -> Result<Self, TargetError> {
        let constraints = Constraints::<2, 2>::builder().bounded(2, 0.0, SIDE).build()?;
        Ok(Self(constraints.target(Likelihood)))
    }

    /// x in the box of a point y.
    pub fn in_box(&self, y: &[f64; 2]) -> [f64; 2] {
        self.0.constraints().constrain(y)
    }
}

impl Target<2> for Eggbox {
    fn log_density(&self, y: &[f64; 2]) -> f64 {
        self.0.log_density(y)
    }

    fn score(&self, y: &[f64; 2]) -> [f64; 2] {
        self.0.score(y)
    }
}

impl ExactDraws<2> for Eggbox {
    /// By rejection from equal Gaussians around the 18 modes; one of five is accepted.
    fn draw(&self, rng: &mut dyn Rng) -> [f64; 2] {
        loop {
            // Modes lie where u/π and v/π are whole numbers with an even sum.
            let [i, j] = [0, 1].map(|_| rng.random_range(0..=5_u8));
            if (i + j) % 2 == 1 {
                continue;
            }
            let offset = standard_normal::<2>(rng).map(|z| z / (2.0 * ENVELOPE).sqrt());
            let square: f64 = offset.iter().map(|a| a * a).sum();
            let at = [f64::from(i) * PI + offset[0], f64::from(j) * PI + offset[1]];
            let inside = at.iter().all(|u| *u > 0.0 && *u < 5.0 * PI) && offset.iter().all(|a| a.abs() <= 0.5 * PI);
            let log_share = log_likelihood(offset) - (243.0 - ENVELOPE * square);
            if inside && rng.random::<f64>() < log_share.exp() {
                return at.map(|u| logit(u / (5.0 * PI)));
            }
        }
    }
}

impl CatalogueTarget<2> for Eggbox {
    fn name(&self) -> &str {
        "eggbox"
    }

    /// Mean and standard deviation of the prior, which is logistic in y.
    fn frame(&self) -> Frame<2> {
        Frame::diagonal([0.0; 2], [PI / 3.0_f64.sqrt(); 2])
    }

    fn domain(&self) -> [[f64; 2]; 2] {
        [[-10.0, 10.0]; 2]
    }

    fn exact_draws(&self) -> Option<&dyn ExactDraws<2>> {
        Some(self)
    }

    fn log_evidence(&self) -> Option<f64> {
        Some(LOG_EVIDENCE)
    }
}
