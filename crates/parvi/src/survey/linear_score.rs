//! How Gaussian the target is where the particles are: the regression of scores on positions.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use super::density::{Density, Valued};

/// Points that are looked at.
pub(super) fn look_count<const D: usize>() -> usize {
    8 * (D + 1)
}

/// The regression over the first few of `positions`; `None` where log p or the score is not finite at one of them.
pub(super) fn look<const D: usize>(density: &mut Density<'_, D>, positions: &[[f64; D]]) -> Option<LinearScore<D>> {
    let count = positions.len().min(look_count::<D>());
    LinearScore::of(&density.values(&positions[..count])?)
}

/// s ≈ s̄ − Q (z − z̄), and what it says about the target.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinearScore<const D: usize> {
    /// Eigenvalues of sym Q: the curvatures of −log p, 1 in a frame that fits.
    curvatures: [f64; D],
    /// z̄ + Q⁻¹ s̄: the mean of the Gaussian that has this score.
    implied_mean: [f64; D],
    /// Σ |s − s̄ + Q (z − z̄)|² / Σ |s|².
    unexplained: f64,
    /// −Σ (s − s̄)·(z − z̄) / Σ |z − z̄|² over the inner half of the points relative to the outer half, at least 1: 1 for a Gaussian,
    /// more where tails are heavy.
    pub tails: f64,
}

impl<const D: usize> LinearScore<D> {
    /// `None` if the points lie in a plane.
    fn of(values: &[Valued<D>]) -> Option<Self> {
        let share = 1.0 / values.len() as f64;
        let (mut mean, mut mean_score) = ([0.0; D], [0.0; D]);
        for value in values {
            vector::accumulate(&mut mean, share, &value.point);
            vector::accumulate(&mut mean_score, share, &value.score);
        }
        let mut centred: Vec<([f64; D], [f64; D])> = values
            .iter()
            .map(|value| {
                let z = vector::subtract(&value.point, &mean);
                (z, vector::subtract(&value.score, &mean_score))
            })
            .collect();
        let (mut covariance, mut product) = (Matrix::<D>::ZERO, Matrix::<D>::ZERO);
        for (z, s) in &centred {
            covariance += Matrix::outer(z, z) * share;
            product -= Matrix::outer(s, z) * share;
        }
        let slope = product * covariance.inverse()?;
        let eigen = SymmetricEigen::new(&slope.symmetric_part())?;
        let left: f64 = centred
            .iter()
            .map(|(z, s)| vector::norm_squared(&vector::add(s, &slope.apply(z))))
            .sum();
        let total: f64 = values.iter().map(|value| vector::norm_squared(&value.score)).sum();
        centred.sort_by(|(a, _), (b, _)| vector::norm_squared(a).total_cmp(&vector::norm_squared(b)));
        let (inner, outer) = centred.split_at(centred.len() / 2);
        let tails = stiffness(inner) / stiffness(outer);
        Some(Self {
            curvatures: eigen.values,
            implied_mean: vector::add(&mean, &eigen.map(f64::recip).apply(&mean_score)),
            unexplained: left / total,
            tails: if tails.is_finite() { tails.max(1.0) } else { 1.0 },
        })
    }

    /// Whether the scores are those of a Gaussian that fits the frame: then there is nothing to find.
    pub fn fits(&self) -> bool {
        self.unexplained <= 0.1
            && vector::maximum_norm(&self.implied_mean) <= 1.5
            && self.curvatures.iter().all(|q| (0.25..=4.0).contains(q))
    }
}

/// −Σ s·z / Σ |z|²; NaN unless positive.
fn stiffness<const D: usize>(centred: &[([f64; D], [f64; D])]) -> f64 {
    let product: f64 = centred.iter().map(|(z, s)| vector::dot(s, z)).sum();
    let squares: f64 = centred.iter().map(|(z, _)| vector::norm_squared(z)).sum();
    let stiffness = -product / squares;
    if stiffness > 0.0 { stiffness } else { f64::NAN }
}
