use super::{Bounds, Shape};
use crate::rotation::Rotation;

/// A shape that has been turned.
#[derive(Debug)]
pub(crate) struct Rotated<const D: usize> {
    /// The shape before.
    pub shape: Box<dyn Shape<D>>,
    /// The turn.
    pub rotation: Rotation<D>,
}

impl<const D: usize> Shape<D> for Rotated<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        self.shape.distance(&self.rotation.undo(x))
    }

    /// A box around the turned bounds: with half widths w about the middle, Σ_b |R_ab| w_b.
    fn bounds(&self) -> Bounds<D> {
        let Bounds { lower, upper } = self.shape.bounds();
        if !lower.iter().chain(&upper).all(|c| c.is_finite()) {
            return Bounds::EVERYWHERE;
        }
        let middle = self
            .rotation
            .apply(&std::array::from_fn(|a| 0.5 * (lower[a] + upper[a])));
        let rows = &self.rotation.matrix.0;
        let width = |a: usize| {
            (0..D)
                .map(|b| 0.5 * rows[a][b].abs() * (upper[b] - lower[b]))
                .sum::<f64>()
        };
        Bounds {
            lower: std::array::from_fn(|a| middle[a] - width(a)),
            upper: std::array::from_fn(|a| middle[a] + width(a)),
        }
    }

    fn volume(&self) -> Option<f64> {
        self.shape.volume()
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        self.rotation.matrix.apply(&self.shape.normal(&self.rotation.undo(x)))
    }
}
