//! The affine Stein correction: the last, global move that makes the first two Stein moments exact.

use mpm_core::MpmError;
use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::framed_score::FramedScore;

/// Moves beyond this size (in frame units, or relative) are not a correction any more and are left undone.
const LIMIT: f64 = 0.25;

/// Stein's identity with the test functions 1 and x, which no grid of finite extent contains, reads E[s] = 0 and
/// E[s (x − x̄)ᵀ] = −I. One Newton step of the affine map x ← x̄ + b + A (x − x̄) towards it: with the covariance C of the
/// particles and the mean curvature Q = −sym(E[s (x − x̄)ᵀ] C⁻¹), b = Q⁻¹ E[s], and A is the symmetric map that takes C to
/// Q⁻¹, A = C^{−½} (C^{½} Q⁻¹ C^{½})^{½} C^{−½}. For a Gaussian target one step gives its mean and covariance exactly.
///
/// Returns the size of the move, or `None` where it was not made: too large to be a correction, or Q not positive.
pub(crate) fn correct_moments<const D: usize>(
    positions: &mut [[f64; D]],
    score: &mut FramedScore<'_, D>,
    scores: &mut [[f64; D]],
) -> Result<Option<f64>, MpmError> {
    score.evaluate(positions, scores)?;
    let Some((mean, shift, stretch)) = affine_move(positions, scores) else {
        return Ok(None);
    };
    let size = vector::norm(&shift).max((stretch - Matrix::IDENTITY).frobenius_norm());
    if size.is_nan() || size > LIMIT {
        return Ok(None);
    }
    for x in positions {
        let moved = stretch.apply(&vector::subtract(x, &mean));
        *x = std::array::from_fn(|a| mean[a] + shift[a] + moved[a]);
    }
    Ok(Some(size))
}

/// x̄, b and A.
fn affine_move<const D: usize>(positions: &[[f64; D]], scores: &[[f64; D]]) -> Option<([f64; D], [f64; D], Matrix<D>)> {
    let share = 1.0 / positions.len() as f64;
    let (mut mean, mut mean_score) = ([0.0; D], [0.0; D]);
    for (x, s) in positions.iter().zip(scores) {
        vector::accumulate(&mut mean, share, x);
        vector::accumulate(&mut mean_score, share, s);
    }
    let (mut covariance, mut stein) = (Matrix::<D>::ZERO, Matrix::<D>::ZERO);
    for (x, s) in positions.iter().zip(scores) {
        let x = vector::subtract(x, &mean);
        covariance = covariance + Matrix::outer(&x, &x) * share;
        stein = stein - Matrix::outer(s, &x) * share;
    }
    let of_covariance = SymmetricEigen::new(&covariance)?;
    let root = of_covariance.map(f64::sqrt);
    let inverse_root = of_covariance.map(|value| value.sqrt().recip());
    let curvature = (stein * (inverse_root * inverse_root)).symmetric_part();
    let inverse_curvature = SymmetricEigen::new(&curvature)?.map(|value| if value > 0.0 { value.recip() } else { f64::NAN });
    let middle = SymmetricEigen::new(&(root * inverse_curvature * root).symmetric_part())?.map(f64::sqrt);
    let stretch = inverse_root * middle * inverse_root;
    Some((mean, inverse_curvature.apply(&mean_score), stretch))
}
