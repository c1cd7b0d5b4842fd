//! The log-gamma problem.

use rand::Rng;

use super::log_gamma_part::{BOTH, Part, WIDTH, inside, on_axis};
use super::logit;
use crate::error::at_least_two;
use crate::target::its_own_source;
use crate::{
    CatalogueTarget, ConstrainedTarget, Constraints, ExactDraws, Frame, Mode, Target, TargetError, UnitCubeTransport,
};

/// Likelihood Π L_k of D coordinates of the unit cube under its uniform prior: L₁ is half log-gamma about ⅓ and half about ⅔, L₂ the
/// same of normal laws, L_k for 3 ≤ k ≤ (D+2)/2 log-gamma about ⅔ and beyond it normal about ⅔. In the coordinates
/// y = log x/(1 − x): log p(y) = Σ log L_k(x_k) + Σ log σ(y_k) σ(−y_k), σ the logistic function.
///
/// Log-gamma law about m: z = (x − m)/β, density e^(z − e^z)/β, β = 1/30, distribution function 1 − e^(−e^z), a long tail to the
/// left; normal laws have σ = 1/30. Four modes. log Z is 0 in the literature; exactly it is the logarithm of what lies inside of
/// the cube, −2.3 × 10⁻⁵, most of which the tail of log-gamma about ⅓ leaves out.
///
/// Source: F. Beaujean, A. Caldwell, arXiv 1304.7808 (2013), section 3; F. Feroz et al., *Open J. Astrophys.* 2 (2019), section 5.
#[derive(Clone, Debug)]
pub struct LogGamma<const D: usize> {
    target: ConstrainedTarget<Likelihood, D, D>,
    modes: Vec<Mode<D>>,
}

/// log Π L_k.
#[derive(Clone, Copy, Debug)]
struct Likelihood;

impl<const D: usize> Target<D> for Likelihood {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        (0..D).map(|axis| on_axis(x[axis], axis, D)[0]).sum()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|axis| on_axis(x[axis], axis, D)[1])
    }
}

impl<const D: usize> LogGamma<D> {
    /// The problem in dimension D.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] for D < 2.
    pub fn new() -> Result<Self, TargetError> {
        at_least_two("log-gamma", D)?;
        let constraints = Constraints::<D, D>::builder().bounded(D, 0.0, 1.0).build()?;
        let [first, second] = [0, 1].map(|axis| inside(axis, D)[1]);
        let mut modes = Vec::new();
        for (x, mass) in [(BOTH[0], first), (BOTH[1], 1.0 - first)] {
            for (other_x, other_mass) in [(BOTH[0], second), (BOTH[1], 1.0 - second)] {
                let mut centre = [logit(BOTH[1]); D];
                (centre[0], centre[1]) = (logit(x), logit(other_x));
                modes.push(Mode {
                    centre,
                    // dy/dx = 1/x(1 − x) = 9/2 at either centre.
                    width: 4.5 * WIDTH,
                    mass: mass * other_mass,
                });
            }
        }
        Ok(Self {
            target: constraints.target(Likelihood),
            modes,
        })
    }

    /// x in the cube of a point y.
    pub fn in_cube(&self, y: &[f64; D]) -> [f64; D] {
        self.target.constraints().constrain(y)
    }
}

impl<const D: usize> Target<D> for LogGamma<D> {
    fn log_density(&self, y: &[f64; D]) -> f64 {
        self.target.log_density(y)
    }

    fn score(&self, y: &[f64; D]) -> [f64; D] {
        self.target.score(y)
    }
}

impl<const D: usize> ExactDraws<D> for LogGamma<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.drawn(rng)
    }
}

impl<const D: usize> UnitCubeTransport<D> for LogGamma<D> {
    /// Two more than D: the first two choose the centres of the first two axes.
    fn cube_dimension(&self) -> usize {
        D + 2
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let level = |index: usize| u.get(index).copied().unwrap_or(0.5);
        std::array::from_fn(|axis| {
            let (part, centres) = Part::of_axis(axis, D);
            let chosen = usize::from(axis < 2 && level(axis) >= inside(axis, D)[1]);
            logit(part.quantile(level(axis + 2), centres[chosen]))
        })
    }
}

impl<const D: usize> CatalogueTarget<D> for LogGamma<D> {
    fn name(&self) -> &str {
        "log-gamma"
    }

    /// Centre and scale of all modes together.
    fn frame(&self) -> Frame<D> {
        let middle = logit(BOTH[1]);
        let (mut centre, mut scales) = ([middle; D], [5.0 * WIDTH; D]);
        for axis in 0..2 {
            (centre[axis], scales[axis]) = (0.0, middle);
        }
        Frame::diagonal(centre, scales)
    }

    fn domain(&self) -> [[f64; 2]; D] {
        let edge = logit(BOTH[1]);
        let mut domain = [[edge - 1.3, edge + 0.8]; D];
        domain[0] = [-edge - 2.5, edge + 0.8];
        domain[1] = [-edge - 0.8, edge + 0.8];
        domain
    }

    its_own_source!(D);

    fn modes(&self) -> &[Mode<D>] {
        &self.modes
    }

    fn log_evidence(&self) -> Option<f64> {
        Some((0..D).map(|axis| inside(axis, D)[0].ln()).sum())
    }
}
