use std::ops::Range;

use rand::{Rng, RngExt};
use serde::{Deserialize, Serialize};

/// Sizes of a fully connected network (D + r) → width × depth → D.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NetworkShape {
    /// r, the number of generalised coordinates, ≥ 1.
    pub coordinates: usize,
    /// Units of a hidden layer, ≥ 1 (paper: 30).
    pub width: usize,
    /// Number of hidden layers, ≥ 1 (paper: 4).
    pub depth: usize,
}

/// One dense layer z = W a + b and where its numbers stand in the list of parameters: W row-major, then b.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Layer {
    pub inputs: usize,
    pub outputs: usize,
    pub weights: Range<usize>,
    pub bias: Range<usize>,
}

impl Layer {
    /// The layer whose parameters begin at `start`.
    pub fn at(start: usize, inputs: usize, outputs: usize) -> Self {
        // Sizes may come from a file: those that cannot be counted fit no list of parameters.
        let middle = start.saturating_add(inputs.saturating_mul(outputs));
        Self {
            inputs,
            outputs,
            weights: start..middle,
            bias: middle..middle.saturating_add(outputs),
        }
    }

    /// X. Glorot, Y. Bengio 2010, Eq. 16: weights uniform in ±√(6 / (inputs + outputs)), biases 0.
    pub fn draw(&self, parameters: &mut [f64], generator: &mut impl Rng) {
        draw_uniform(
            &mut parameters[self.weights.clone()],
            self.inputs + self.outputs,
            generator,
        );
        parameters[self.bias.clone()].fill(0.0);
    }
}

/// Uniform numbers in ±√(6 / fan), fan = inputs + outputs of a unit.
pub(crate) fn draw_uniform(weights: &mut [f64], fan: usize, generator: &mut impl Rng) {
    let bound = (6.0 / fan as f64).sqrt();
    for weight in weights {
        *weight = generator.random_range(-bound..bound);
    }
}

impl NetworkShape {
    /// The dense layers in a network for D axes, first to last.
    pub(crate) fn layers(&self, dimension: usize) -> Vec<Layer> {
        let mut layers = Vec::with_capacity(self.depth + 1);
        let (mut start, mut inputs) = (0, dimension + self.coordinates);
        for number in 0..=self.depth {
            let outputs = if number == self.depth { dimension } else { self.width };
            let layer = Layer::at(start, inputs, outputs);
            (start, inputs) = (layer.bias.end, outputs);
            layers.push(layer);
        }
        layers
    }

    /// Number of weights and biases of a network for D axes; `usize::MAX` where it cannot be counted.
    pub fn parameters(&self, dimension: usize) -> usize {
        let of_layer = |inputs: usize, outputs: usize| inputs.saturating_add(1).saturating_mul(outputs);
        let inputs = dimension.saturating_add(self.coordinates);
        let Some(between) = self.depth.checked_sub(1) else {
            return of_layer(inputs, dimension);
        };
        of_layer(inputs, self.width)
            .saturating_add(between.saturating_mul(of_layer(self.width, self.width)))
            .saturating_add(of_layer(self.width, dimension))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_follow_one_another() {
        let shape = NetworkShape {
            coordinates: 6,
            width: 30,
            depth: 4,
        };
        let layers = shape.layers(3);
        assert_eq!(layers.len(), 5);
        assert_eq!(shape.parameters(3), 30 * 9 + 30 + 3 * (30 * 30 + 30) + 3 * 30 + 3);
        assert_eq!(layers.last().map(|layer| layer.bias.end), Some(shape.parameters(3)));
        let flat = NetworkShape { depth: 0, ..shape };
        assert_eq!(
            flat.layers(3).last().map(|layer| layer.bias.end),
            Some(flat.parameters(3))
        );
        for pair in layers.windows(2) {
            assert_eq!(pair[0].bias.end, pair[1].weights.start);
            assert_eq!(pair[0].outputs, pair[1].inputs);
        }
    }
}
