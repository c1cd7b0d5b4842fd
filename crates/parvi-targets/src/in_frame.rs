//! A target in another frame than its own.

use crate::{BoxedTarget, CatalogueTarget, ExactDraws, Frame, Mode, Moments, Target, TargetError, UnitCubeTransport};

/// A target of the catalogue of whose place and scale a sampler knows what a frame says; [`Frame::identity`]: nothing.
pub struct InFrame<const D: usize> {
    /// The target.
    pub target: BoxedTarget<D>,
    /// What is known.
    pub frame: Frame<D>,
}

impl<const D: usize> Target<D> for InFrame<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.target.score(x)
    }

    fn has_log_density(&self) -> bool {
        self.target.has_log_density()
    }

    fn points_per_call(&self) -> usize {
        self.target.points_per_call()
    }

    fn scores_depend_on_calls(&self) -> bool {
        self.target.scores_depend_on_calls()
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        self.target.scores(xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        self.target.log_densities(xs, out);
    }
}

impl<const D: usize> CatalogueTarget<D> for InFrame<D> {
    fn name(&self) -> &str {
        self.target.name()
    }

    fn frame(&self) -> Frame<D> {
        self.frame
    }

    fn domain(&self) -> [[f64; 2]; D] {
        self.target.domain()
    }

    fn exact_draws(&self) -> Option<&dyn ExactDraws<D>> {
        self.target.exact_draws()
    }

    fn unit_cube_transport(&self) -> Option<&dyn UnitCubeTransport<D>> {
        self.target.unit_cube_transport()
    }

    fn moments(&self) -> Option<Moments<D>> {
        self.target.moments()
    }

    fn modes(&self) -> &[Mode<D>] {
        self.target.modes()
    }

    fn log_evidence(&self) -> Option<f64> {
        self.target.log_evidence()
    }

    fn fault(&self) -> Option<TargetError> {
        self.target.fault()
    }
}
