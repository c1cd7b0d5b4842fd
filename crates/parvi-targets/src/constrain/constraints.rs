//! Blocks of constrained coordinates, and the map to all of them.

use std::ops::Range;
use std::sync::Arc;

use super::transform::Transform;
use crate::{ConstrainedTarget, ConstraintsBuilder, Target, TargetError};

/// The map x = f(y) from D unconstrained coordinates y, which a sampler moves, to N ≥ D constrained ones x, a user's own.
///
/// The coordinates x consist of blocks, each with a constraint of its own; y has the blocks in the same order. A density p
/// of x becomes log q(y) = log p(f(y)) + log |det J|, with score ∇ log q = (∂x/∂y)ᵀ ∇ log p + ∇ log |det J|. Particles
/// that sample q are mapped back one by one, and their weights stay what they are.
///
/// ```
/// use parvi_targets::Constraints;
///
/// // A location, a scale, and three probabilities: six numbers, five of them independent.
/// let constraints = Constraints::<5, 4>::builder().free(1).positive(1).simplex(3).build()?;
/// let y = constraints.unconstrain(&[-1.5, 2.0, 0.2, 0.3, 0.5])?;
/// let x = constraints.constrain(&y);
/// assert!((x[1] - 2.0).abs() < 1e-15 && (x[4] - 0.5).abs() < 1e-15);
/// # Ok::<(), parvi_targets::TargetError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Constraints<const N: usize, const D: usize> {
    blocks: Vec<Block>,
}

#[derive(Clone, Debug)]
struct Block {
    transform: Arc<dyn Transform>,
    /// Its place in x.
    constrained: Range<usize>,
    /// Its place in y.
    unconstrained: Range<usize>,
}

impl<const N: usize, const D: usize> Constraints<N, D> {
    /// Begins a list of blocks.
    pub fn builder() -> ConstraintsBuilder<N, D> {
        ConstraintsBuilder::new()
    }

    /// Lines the blocks up, or says that they are too many or too few.
    pub(crate) fn new(transforms: Vec<Arc<dyn Transform>>) -> Result<Self, TargetError> {
        let (mut constrained, mut unconstrained) = (0_usize, 0_usize);
        let mut blocks = Vec::with_capacity(transforms.len());
        for transform in transforms {
            let next_constrained = constrained.saturating_add(transform.constrained_dimension());
            let next_unconstrained = unconstrained.saturating_add(transform.unconstrained_dimension());
            blocks.push(Block {
                transform,
                constrained: constrained..next_constrained,
                unconstrained: unconstrained..next_unconstrained,
            });
            (constrained, unconstrained) = (next_constrained, next_unconstrained);
        }
        let list = |range: fn(&Block) -> &Range<usize>| {
            // Counted from 1, as the columns of files are.
            let name = |block: &Block| {
                let places = range(block);
                format!("{} {} to {}", block.transform.name(), places.start + 1, places.end)
            };
            blocks.iter().map(name).collect::<Vec<_>>().join(", ")
        };
        let length = |field, expected, found| Err(TargetError::Length { field, expected, found });
        if constrained != N {
            let list = list(|block| &block.constrained);
            return length(format!("the list of constrained coordinates ({list})"), N, constrained);
        }
        if unconstrained != D {
            let list = list(|block| &block.unconstrained);
            return length(
                format!("the list of unconstrained coordinates ({list})"),
                D,
                unconstrained,
            );
        }
        for block in &blocks {
            let independent = block.transform.independent_coordinates();
            if independent.len() != block.unconstrained.len() {
                let field = format!("the list of independent coordinates of {}", block.transform.name());
                return length(field, block.unconstrained.len(), independent.len());
            }
        }
        Ok(Self { blocks })
    }

    /// x = f(y), inside the open support whatever y is; NaN gives NaN.
    pub fn constrain(&self, y: &[f64; D]) -> [f64; N] {
        let mut x = [0.0; N];
        for block in &self.blocks {
            let of_block = &mut x[block.constrained.clone()];
            block.transform.constrain(&y[block.unconstrained.clone()], of_block);
        }
        x
    }

    /// [`constrain`](Self::constrain) of many points, e.g. of the particles of a run.
    pub fn constrain_all(&self, ys: &[[f64; D]]) -> Vec<[f64; N]> {
        ys.iter().map(|y| self.constrain(y)).collect()
    }

    /// y = f⁻¹(x).
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] for the first coordinate that breaks its constraint.
    pub fn unconstrain(&self, x: &[f64; N]) -> Result<[f64; D], TargetError> {
        let mut y = [0.0; D];
        for block in &self.blocks {
            let transform = &block.transform;
            transform
                .unconstrain(&x[block.constrained.clone()], &mut y[block.unconstrained.clone()])
                .map_err(|outside| TargetError::OutOfRange {
                    field: format!(
                        "x{} ({} of x{} to x{})",
                        block.constrained.start + outside.coordinate + 1,
                        transform.name(),
                        block.constrained.start + 1,
                        block.constrained.end,
                    ),
                    value: outside.value,
                    allowed: outside.allowed,
                })?;
        }
        Ok(y)
    }

    /// log |det J| at y: of the [independent](Self::independent_coordinates) coordinates by y.
    pub fn log_jacobian(&self, y: &[f64; D]) -> f64 {
        self.log_jacobian_at(y, &self.constrain(y))
    }

    /// The D of the N constrained coordinates, counted from 0, whose Lebesgue measure densities refer to; the others follow
    /// from them.
    pub fn independent_coordinates(&self) -> Vec<usize> {
        let of_block = |block: &Block| {
            let start = block.constrained.start;
            let independent = block.transform.independent_coordinates();
            independent.into_iter().map(move |index| start + index)
        };
        self.blocks.iter().flat_map(of_block).collect()
    }

    /// The score in y, (∂x/∂y)ᵀ s + ∇ log |det J|, of a density whose score at x = f(y) is s = `score`.
    pub fn pull_back_score(&self, y: &[f64; D], score: &[f64; N]) -> [f64; D] {
        self.pull_back_score_at(y, &self.constrain(y), score)
    }

    /// The target in y of a density of x.
    ///
    /// `density` gives log p and ∇ log p in all N coordinates. Where some follow from others (simplex, Cholesky factor), any
    /// formula that is right on the support serves.
    pub fn target<T: Target<N>>(&self, density: T) -> ConstrainedTarget<T, N, D> {
        ConstrainedTarget::new(density, self.clone())
    }

    /// The log density in y of a log density of x, for example to give to
    /// [`FiniteDifferenceScore`](crate::FiniteDifferenceScore).
    pub fn log_density<F>(&self, log_density: F) -> impl Fn(&[f64; D]) -> f64 + Sync + use<F, N, D>
    where
        F: Fn(&[f64; N]) -> f64 + Sync,
    {
        let constraints = self.clone();
        move |y| {
            let x = constraints.constrain(y);
            log_density(&x) + constraints.log_jacobian_at(y, &x)
        }
    }

    /// [`log_jacobian`](Self::log_jacobian), x = f(y) being known.
    pub(crate) fn log_jacobian_at(&self, y: &[f64; D], x: &[f64; N]) -> f64 {
        let of_block = |block: &Block| {
            let (y, x) = (&y[block.unconstrained.clone()], &x[block.constrained.clone()]);
            block.transform.log_jacobian(y, x)
        };
        self.blocks.iter().map(of_block).sum()
    }

    /// [`pull_back_score`](Self::pull_back_score), x = f(y) being known.
    pub(crate) fn pull_back_score_at(&self, y: &[f64; D], x: &[f64; N], score: &[f64; N]) -> [f64; D] {
        let mut out = [0.0; D];
        for block in &self.blocks {
            let (unconstrained, constrained) = (block.unconstrained.clone(), block.constrained.clone());
            block.transform.pull_back(
                &y[unconstrained.clone()],
                &x[constrained.clone()],
                &score[constrained],
                &mut out[unconstrained],
            );
        }
        out
    }
}
