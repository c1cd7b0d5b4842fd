use serde::{Deserialize, Serialize};

use crate::manifold::network::Layer;

/// Entries under a convolution's window.
pub(crate) const KERNEL: usize = 6;
/// Entries between two windows.
pub(crate) const STRIDE: usize = 2;
/// Convolutions are added while what they leave is at least this wide.
const NARROWEST: usize = 32;

/// Sizes of an encoder.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EncoderShape {
    /// P, number of material points, ≥ 1.
    pub points: usize,
    /// Units of the dense hidden layer, ≥ 1 (paper: 32).
    pub width: usize,
    /// r, the number of generalised coordinates, ≥ 1.
    pub coordinates: usize,
}

/// Where the numbers of every layer stand in the list of parameters.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layout {
    /// As layers of six inputs and an output.
    pub convolutions: Vec<Layer>,
    pub hidden: Layer,
    pub last: Layer,
}

impl EncoderShape {
    /// Widths before, between and after the convolutions: w → (w − 6) / 2 + 1, rounded down, while the result is at least 32. For 1,368 points in
    /// three dimensions 4104, 2050, 1023, 509, 252, 124, 60.
    pub fn widths(&self, dimension: usize) -> Vec<usize> {
        let mut widths = vec![self.points.saturating_mul(dimension)];
        let next = |width: &usize| width.checked_sub(KERNEL).map(|rest| rest / STRIDE + 1);
        while let Some(width) = widths.last().and_then(next).filter(|&width| width >= NARROWEST) {
            widths.push(width);
        }
        widths
    }

    /// Number of weights and biases for D axes.
    pub fn parameters(&self, dimension: usize) -> usize {
        self.layout(dimension).last.bias.end
    }

    pub(crate) fn layout(&self, dimension: usize) -> Layout {
        let widths = self.widths(dimension);
        let size = KERNEL + 1;
        let convolutions: Vec<_> = (1..widths.len())
            .map(|n| Layer::at((n - 1) * size, KERNEL, 1))
            .collect();
        let start = convolutions.len() * size;
        let hidden = Layer::at(start, widths.last().copied().unwrap_or(0), self.width);
        let last = Layer::at(hidden.bias.end, self.width, self.coordinates);
        Layout {
            convolutions,
            hidden,
            last,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn widths_are_those_of_the_paper() {
        let shape = |points| EncoderShape {
            points,
            width: 32,
            coordinates: 6,
        };
        assert_eq!(shape(1368).widths(3), [4104, 2050, 1023, 509, 252, 124, 60]);
        assert_eq!(shape(3).widths(1), [3]);
        assert_eq!(shape(1368).parameters(3), 6 * 7 + 60 * 32 + 32 + 32 * 6 + 6);
    }
}
