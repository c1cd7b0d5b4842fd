//! What the loop asks of one step.

use mpm_core::StepControl;
use mpm_tensor::Matrix;

/// One step of a plan.
#[derive(Clone, Copy, Debug)]
pub struct PlannedStep<const D: usize> {
    /// Where the basis has its origin, in coordinates of its unit cell.
    pub origin: [f64; D],
    /// Spacing h.
    pub spacing: f64,
    /// Turn of the basis.
    pub rotation: Option<Matrix<D>>,
    /// Factor α of the score.
    pub alpha: f64,
    /// Limits of the step.
    pub control: StepControl,
}
