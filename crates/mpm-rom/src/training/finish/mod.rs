//! A quasi-Newton method for a loss that stays the same from step to step.

mod inverse_hessian;
mod line_search;

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

impl QuasiNewton {
    /// At parameters where the loss has these terms and this gradient, with a diagonal H.
    pub fn new(scales: &[f64], terms: Terms, gradient: Vec<f64>) -> Self {
        let product = scales.iter().zip(&gradient).map(|(scale, g)| scale * g).collect();
        Self {
            inverse: InverseHessian::diagonal(scales),
            gradient,
            product,
            terms,
        }
    }

    /// The same H for another loss with these terms and this gradient.
    pub fn with_loss(mut self, terms: Terms, gradient: Vec<f64>) -> Self {
        self.product = self.inverse.apply(&gradient);
        (self.terms, self.gradient) = (terms, gradient);
        self
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
