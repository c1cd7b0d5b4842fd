//! The spike on a slab.

use rand::Rng;

use crate::{
    CatalogueTarget, ExactDraws, Frame, GaussianMixture, Mode, Moments, Target, TargetError, UnitCubeTransport,
};

/// Mass of the spike over that of the slab.
const RATIO: f64 = 100.0;

/// Where the spike stands on every axis, and the widths of spike and slab.
const OFFSET: f64 = 0.031;
const SPIKE: f64 = 0.01;
const SLAB: f64 = 0.1;

/// Likelihood 100 Π N(x_k; 0.031, 0.01²) + Π N(x_k; 0, 0.1²) under a prior of density 1: a narrow peak with nearly all of the mass beside the top of a broad one, which hides it the better the higher
/// D is. Methods that temper meet a phase transition: below some β the slab has all of the mass, above it the spike. log Z = ln 101; the cube [−½, ½]ᴰ of the literature leaves out 6 × 10⁻⁷ D of the slab.
///
/// Source: B. J. Brewer, D. Foreman-Mackey, DNest4, *J. Stat. Softw.* 86 (2018), the example SpikeSlab in D = 20, after J. Skilling, *Bayesian Analysis* 1 (2006).
#[derive(Clone, Debug)]
pub struct SpikeSlab<const D: usize>(GaussianMixture<D>);

impl<const D: usize> SpikeSlab<D> {
    /// The problem with its constants.
    ///
    /// # Errors
    /// None in fact; those of a mixture.
    pub fn new() -> Result<Self, TargetError> {
        let mode = |position: f64, width: f64, mass: f64| Mode {
            centre: [position; D],
            width,
            mass,
        };
        let modes = [mode(OFFSET, SPIKE, RATIO), mode(0.0, SLAB, 1.0)];
        Ok(Self(GaussianMixture::new("spike-slab", &modes)?))
    }
}

impl<const D: usize> Target<D> for SpikeSlab<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        (1.0 + RATIO).ln() + self.0.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.0.score(x)
    }
}

impl<const D: usize> ExactDraws<D> for SpikeSlab<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.0.draw(rng)
    }
}

impl<const D: usize> CatalogueTarget<D> for SpikeSlab<D> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn frame(&self) -> Frame<D> {
        self.0.frame()
    }

    fn domain(&self) -> [[f64; 2]; D] {
        self.0.domain()
    }

    fn exact_draws(&self) -> Option<&dyn ExactDraws<D>> {
        Some(self)
    }

    fn unit_cube_transport(&self) -> Option<&dyn UnitCubeTransport<D>> {
        Some(&self.0)
    }

    fn moments(&self) -> Option<Moments<D>> {
        self.0.moments()
    }

    fn log_evidence(&self) -> Option<f64> {
        Some((1.0 + RATIO).ln())
    }
}
