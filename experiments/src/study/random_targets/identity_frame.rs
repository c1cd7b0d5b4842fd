//! A target of whose place and scale nothing is known.

use parvi_targets::{BoxedTarget, CatalogueTarget, ExactDraws, Frame, Target, UnitCubeTransport};

/// The target in the frame x = z.
pub struct InIdentityFrame<const D: usize>(pub BoxedTarget<D>);

impl<const D: usize> Target<D> for InIdentityFrame<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.0.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.0.score(x)
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        self.0.scores(xs, out);
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        self.0.log_densities(xs, out);
    }
}

impl<const D: usize> CatalogueTarget<D> for InIdentityFrame<D> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn frame(&self) -> Frame<D> {
        Frame::identity()
    }

    fn domain(&self) -> [[f64; 2]; D] {
        self.0.domain()
    }

    fn exact_draws(&self) -> Option<&dyn ExactDraws<D>> {
        self.0.exact_draws()
    }

    fn unit_cube_transport(&self) -> Option<&dyn UnitCubeTransport<D>> {
        self.0.unit_cube_transport()
    }

    fn log_evidence(&self) -> Option<f64> {
        self.0.log_evidence()
    }
}
