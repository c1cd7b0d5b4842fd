//! A quasi-Newton method for a loss that stays the same from step to step.

mod damped;
mod inverse_hessian;
mod line_search;

pub(super) use damped::Damped;
pub(super) use inverse_hessian::InverseHessian;
use inverse_hessian::{Point, dot};

use super::Terms;

/// Parameters on their way down a deterministic loss.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct QuasiNewton {
    /// H.
    pub inverse: InverseHessian,
    /// ∇L at the parameters.
    pub gradient: Vec<f64>,
    /// H ∇L.
    pub product: Vec<f64>,
    /// L at the parameters.
    pub terms: Terms,
}

/// The loss and its gradient at some parameters.
pub(super) type Loss<'a> = &'a mut dyn FnMut(&[f64]) -> (Terms, Vec<f64>);

/// Damping that is tried, in this order.
const DAMPING: [f64; 8] = [1e2, 1e1, 1e0, 1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

impl QuasiNewton {
    /// With H = (A + λ diag A)⁻¹ for an approximate Hessian A, row-major, at parameters where the loss has these terms and this gradient: λ falls from 10² by tenths as long as that makes the
    /// loss after a full step less.
    pub fn new(matrix: &[f64], parameters: &[f64], (terms, gradient): (Terms, Vec<f64>), loss: Loss<'_>) -> Self {
        let size = parameters.len();
        let (mut best, mut least) = (None, f64::INFINITY);
        for damping in DAMPING {
            let Some(mut damped) = Damped::new(matrix, size, damping) else {
                break;
            };
            let step = damped.solve(&gradient);
            let moved: Vec<f64> = parameters.iter().zip(&step).map(|(x, step)| x - step).collect();
            let value = loss(&moved).0.total();
            if value >= least {
                break;
            }
            (least, best) = (value, Some(damped));
        }
        // Without any the step is zero, and the search for its length fails.
        let rows = best.map_or_else(|| vec![0.0; size * size], |mut damped| damped.inverse());
        let mut inverse = InverseHessian::new(size, rows);
        let product = inverse.apply(&gradient);
        Self {
            inverse,
            gradient,
            product,
            terms,
        }
    }

    /// One step along −H ∇L, with its length; `None`, and no step, where no length makes L smaller.
    pub fn step(&mut self, parameters: &mut [f64], loss: Loss<'_>) -> Option<f64> {
        let slope = -dot(&self.gradient, &self.product);
        let start = parameters.to_vec();
        let mut there = (self.terms, Vec::new());
        let length = line_search::search(self.terms.total(), slope, |length| {
            for ((parameter, start), d) in parameters.iter_mut().zip(&start).zip(&self.product) {
                *parameter = start - length * d;
            }
            there = loss(parameters);
            (there.0.total(), -dot(&there.1, &self.product))
        });
        let Some(length) = length else {
            parameters.copy_from_slice(&start);
            return None;
        };
        let (terms, gradient) = there;
        let product = self.inverse.apply(&gradient);
        let before = Point {
            gradient: &self.gradient,
            product: &self.product,
        };
        let after = Point {
            gradient: &gradient,
            product: &product,
        };
        let product = self.inverse.update(length, &before, &after);
        (self.gradient, self.product, self.terms) = (gradient, product, terms);
        Some(length)
    }
}

#[cfg(test)]
mod tests;
