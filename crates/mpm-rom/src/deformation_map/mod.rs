//! g from g̃: the map that starts at rest exactly.

mod at_rest;
mod points;
#[cfg(test)]
mod tests;

pub use at_rest::AtRestTable;
pub use points::MaterialPoints;

use mpm_tensor::{Matrix, vector};
use rayon::prelude::*;

use crate::least_squares::{GaussNewton, LeastSquaresError, Settings};
use crate::manifold::{Evaluation, Manifold, Wanted};

/// Why a family of maps cannot start at rest.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DeformationMapError {
    /// The first guess of x̂₀ has another length than the manifold has coordinates.
    #[error("{found} coordinates to start from, not {expected}")]
    Coordinates {
        /// Its length.
        found: usize,
        /// r.
        expected: usize,
    },
    /// x̂₀ cannot be found.
    #[error("coordinates at rest: {0}")]
    Rest(LeastSquaresError),
}

/// The deformation map g(X, x̂) = g̃(X, x̂) + a(X) (Chen et al. 2023, §3.1, Eqs. 24 to 26) of a body that starts at rest, for which the paper's b(X) is 0.
///
/// a(X) = X − g̃(X, x̂₀) with x̂₀ = argmin_y Σ|X_p − g̃(X_p, y)|², so that g(X, x̂₀) = X, and F = ∇g̃(X, x̂) + I − ∇g̃(X, x̂₀) = I there.
pub struct DeformationMap<'a, const D: usize> {
    manifold: &'a dyn Manifold<D>,
    rest: Vec<f64>,
    at_rest: Evaluation<D>,
}

impl<'a, const D: usize> DeformationMap<'a, D> {
    /// The map of a body that starts at rest. `reference` are the points in the sums for x̂₀, `start` is where the search begins: the encoder's
    /// coordinates of the body at rest, or zeros.
    ///
    /// # Errors
    /// [`DeformationMapError`].
    pub fn new(
        manifold: &'a dyn Manifold<D>,
        reference: &[[f64; D]],
        start: &[f64],
    ) -> Result<Self, DeformationMapError> {
        let expected = manifold.coordinates();
        if start.len() != expected {
            let found = start.len();
            return Err(DeformationMapError::Coordinates { found, expected });
        }
        let mut rest = start.to_vec();
        let evaluate =
            |y: &[f64], wanted: Wanted, out: &mut Evaluation<D>| manifold.evaluate(reference, y, wanted, out);
        let found = GaussNewton::default().minimise(reference, &mut rest, &Settings::default(), evaluate);
        found.map_err(DeformationMapError::Rest)?;
        Ok(Self {
            manifold,
            rest,
            at_rest: Evaluation::default(),
        })
    }

    /// The map with this x̂₀.
    #[cfg(test)]
    pub(crate) fn at(manifold: &'a dyn Manifold<D>, rest: Vec<f64>) -> Self {
        Self {
            manifold,
            rest,
            at_rest: Evaluation::default(),
        }
    }

    /// r.
    pub fn coordinates(&self) -> usize {
        self.manifold.coordinates()
    }

    /// x̂₀.
    pub fn rest(&self) -> &[f64] {
        &self.rest
    }

    /// What does not depend on x̂ at these points: a(X) and I − ∇g̃(X, x̂₀). `out` is overwritten.
    pub fn prepare(&mut self, reference: &[[f64; D]], out: &mut MaterialPoints<D>) {
        out.clear();
        out.reference.extend_from_slice(reference);
        self.manifold
            .evaluate(reference, &self.rest, Wanted::GRADIENTS, &mut self.at_rest);
        let pairs = reference.iter().zip(&self.at_rest.positions);
        out.offsets.extend(pairs.map(|(x, g)| vector::subtract(x, g)));
        let gradients = self.at_rest.gradients.iter();
        out.gradient_offsets
            .extend(gradients.map(|gradient| Matrix::IDENTITY - *gradient));
    }

    /// As [`prepare`](Self::prepare), into new storage.
    pub fn prepared(&mut self, reference: &[[f64; D]]) -> MaterialPoints<D> {
        let mut points = MaterialPoints::default();
        self.prepare(reference, &mut points);
        points
    }

    /// A table of a(X) with this spacing, in the box around these points and `margin` beyond it; `None` where it would be too large.
    pub fn tabulate(&self, reference: &[[f64; D]], margin: f64, spacing: f64) -> Option<AtRestTable<D>> {
        AtRestTable::around(reference, margin, spacing, |nodes| {
            let mut there = Evaluation::default();
            self.manifold.evaluate(nodes, &self.rest, Wanted::default(), &mut there);
            let pairs = nodes.iter().zip(&there.positions);
            pairs.map(|(x, g)| vector::subtract(x, g)).collect()
        })
    }

    /// As [`prepare`](Self::prepare), from a table; points outside it are computed.
    pub fn prepare_from(&mut self, table: &AtRestTable<D>, reference: &[[f64; D]], out: &mut MaterialPoints<D>) {
        let found: Vec<_> = reference.par_iter().with_min_len(256).map(|x| table.at(x)).collect();
        let outside: Vec<[f64; D]> = reference
            .iter()
            .zip(&found)
            .filter(|(_, found)| found.is_none())
            .map(|(x, _)| *x)
            .collect();
        self.prepare(&outside, out);
        let mut computed = out.offsets.drain(..).zip(out.gradient_offsets.drain(..));
        let (offsets, gradients) = found
            .into_iter()
            .filter_map(|found| found.or_else(|| computed.next()))
            .unzip();
        drop(computed);
        (out.offsets, out.gradient_offsets) = (offsets, gradients);
        out.reference.clear();
        out.reference.extend_from_slice(reference);
    }

    /// g, and where wanted F = ∇g and ∂g/∂x̂, at prepared points; `out` is overwritten.
    pub fn evaluate(&self, points: &MaterialPoints<D>, latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        self.manifold.evaluate(&points.reference, latent, wanted, out);
        out.velocities.clear();
        Self::start_at_rest(points, out);
    }

    /// g, F and the velocities v_p = ∂g/∂x̂ v̂ at prepared points; `out` is overwritten. Costs one tangent for the velocities, not r.
    pub fn evaluate_moving(&self, points: &MaterialPoints<D>, latent: &[f64], rates: &[f64], out: &mut Evaluation<D>) {
        self.manifold.evaluate_moving(&points.reference, latent, rates, out);
        Self::start_at_rest(points, out);
    }

    /// Adds a to g̃ and I − ∇g̃(X, x̂₀) to ∇g̃.
    fn start_at_rest(points: &MaterialPoints<D>, out: &mut Evaluation<D>) {
        for (g, a) in out.positions.iter_mut().zip(&points.offsets) {
            vector::accumulate(g, 1.0, a);
        }
        for (gradient, offset) in out.gradients.iter_mut().zip(&points.gradient_offsets) {
            *gradient += *offset;
        }
    }
}
