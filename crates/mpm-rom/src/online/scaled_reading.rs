//! Readings in coordinates that all points together see alike.

use mpm_dense::{Cholesky, DenseMatrix};
use mpm_tensor::vector;
use rayon::prelude::*;

use super::{OnlineError, Reading};

/// A reading whose coordinates are scaled so that N⁻¹ Σ_p J_pᵀ J_p = I over all points.
pub(super) struct ScaledReading<const D: usize> {
    /// J_p, entry p r + k.
    pub columns: Vec<[f64; D]>,
    /// e_p = v_p − J_p v̂ with v̂ = argmin Σ|J_p v̂ − v_p|² over all points, so that Σ_p J_pᵀ e_p = 0.
    pub errors: Vec<[f64; D]>,
    /// The mean square of the components of e; that of rounding, at least.
    pub mean_square: f64,
}

/// What errors are, at least, over the velocities: those that are rounding foretell nothing.
const SMALLEST: f64 = 1e-6;

impl<const D: usize> ScaledReading<D> {
    /// Those of readings of so many points. Readings without any velocity, and those whose Jacobians do not tell the coordinates apart at all points, are left out.
    ///
    /// # Errors
    /// [`OnlineError::Readings`] where none is left.
    pub fn all(coordinates: usize, points: usize, readings: &[Reading<D>]) -> Result<Vec<Self>, OnlineError> {
        let fits = |reading: &&Reading<D>| {
            reading.velocities.len() == points && reading.jacobians.len() == points * coordinates
        };
        let fitting = readings.par_iter().filter(fits);
        let scaled: Vec<_> = fitting.filter_map(|reading| Self::of(coordinates, reading)).collect();
        if scaled.is_empty() {
            let readings = readings.len();
            return Err(OnlineError::Readings { readings, points });
        }
        Ok(scaled)
    }

    fn of(r: usize, reading: &Reading<D>) -> Option<Self> {
        let columns = whitened(r, &reading.jacobians)?;
        let share = 1.0 / reading.velocities.len().max(1) as f64;
        // N⁻¹ Σ JᵀJ = I makes the normal equations trivial.
        let mut rates = vec![0.0; r];
        for (rows, velocity) in columns.chunks_exact(r.max(1)).zip(&reading.velocities) {
            for (rate, row) in rates.iter_mut().zip(rows) {
                *rate += share * vector::dot(row, velocity);
            }
        }
        let rows = columns.chunks_exact(r.max(1)).zip(&reading.velocities);
        let errors = rows.map(|(rows, velocity)| {
            let mut error = *velocity;
            for (row, rate) in rows.iter().zip(&rates) {
                vector::accumulate(&mut error, -rate, row);
            }
            error
        });
        let errors: Vec<_> = errors.collect();
        let mean_of = |vectors: &[[f64; D]]| {
            vectors.iter().map(vector::norm_squared).sum::<f64>() / (vectors.len() * D).max(1) as f64
        };
        let rounding = SMALLEST * SMALLEST * mean_of(&reading.velocities);
        let mean_square = mean_of(&errors).max(rounding);
        (mean_square > 0.0).then_some(Self {
            columns,
            errors,
            mean_square,
        })
    }
}

/// J L⁻ᵀ with L Lᵀ = N⁻¹ Σ J_pᵀ J_p; `None` where that is not positive definite.
fn whitened<const D: usize>(r: usize, columns: &[[f64; D]]) -> Option<Vec<[f64; D]>> {
    let factor = Cholesky::new(&mean_product(r, columns))?;
    let mut all = columns.to_vec();
    for rows in all.chunks_exact_mut(r.max(1)) {
        // J̃ Lᵀ = J, hence forward substitution.
        for k in 0..r {
            for j in 0..k {
                let earlier = rows[j];
                vector::accumulate(&mut rows[k], -factor.lower(k, j), &earlier);
            }
            rows[k] = vector::scale(&rows[k], 1.0 / factor.lower(k, k));
        }
    }
    all.iter().all(vector::is_finite).then_some(all)
}

/// N⁻¹ Σ_p J_pᵀ J_p.
pub(super) fn mean_product<const D: usize>(r: usize, columns: &[[f64; D]]) -> DenseMatrix {
    let share = 1.0 / (columns.len() / r.max(1)).max(1) as f64;
    let mut mean = DenseMatrix::zeros(r, r);
    for rows in columns.chunks_exact(r.max(1)) {
        for i in 0..r {
            for j in 0..r {
                mean[(i, j)] += share * vector::dot(&rows[i], &rows[j]);
            }
        }
    }
    mean
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// J and v of a state that are known by formula.
    pub fn reading(points: usize, r: usize, seed: f64) -> Reading<2> {
        let value = |n: usize| (1.0 + seed * n as f64).sin() + (0.31 * seed * (n * n) as f64).cos();
        Reading {
            jacobians: (0..points * r).map(|n| [value(n), value(3 * n + 7)]).collect(),
            velocities: (0..points).map(|n| [value(5 * n + 1), value(2 * n + 9)]).collect(),
        }
    }

    #[test]
    fn all_points_see_the_coordinates_alike_and_errors_are_none_of_their_motions() {
        let scaled = ScaledReading::all(3, 40, &[reading(40, 3, 0.23), reading(39, 3, 0.23)]).expect("one");
        assert_eq!(scaled.len(), 1, "one is of another body");
        let (columns, errors) = (&scaled[0].columns, &scaled[0].errors);
        for i in 0..3 {
            for j in 0..3 {
                let sum: f64 = (0..40)
                    .map(|p| vector::dot(&columns[3 * p + i], &columns[3 * p + j]))
                    .sum();
                assert!((sum / 40.0 - if i == j { 1.0 } else { 0.0 }).abs() < 1e-12);
            }
            let along: f64 = (0..40).map(|p| vector::dot(&columns[3 * p + i], &errors[p])).sum();
            assert!(along.abs() < 1e-11, "{along}");
        }
        let squares: f64 = errors.iter().map(vector::norm_squared).sum();
        assert!((scaled[0].mean_square - squares / 80.0).abs() < 1e-15);
        let flat = Reading {
            jacobians: vec![[0.0; 2]; 120],
            velocities: vec![[1.0; 2]; 40],
        };
        let still = Reading {
            velocities: vec![[0.0; 2]; 40],
            ..reading(40, 3, 0.23)
        };
        assert!(ScaledReading::all(3, 40, &[flat, still]).is_err());
    }
}
