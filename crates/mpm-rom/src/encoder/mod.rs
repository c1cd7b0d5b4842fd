//! From the positions of all material points to the generalised coordinates.

mod pass;
mod shape;

pub(crate) use pass::EncoderTape;
pub use shape::EncoderShape;
use shape::Layout;

use rand::Rng;

use crate::manifold::NetworkError;
use crate::manifold::network::{Layer, Scaling, draw_uniform};

/// x̂ = e(φ): the scaled positions of all points, x₁ y₁ z₁ x₂ …, as one channel through 1-D convolutions (kernel 6, stride 2, no padding,
/// ELU; one weight vector and one bias each) while the result is at least 32 wide, a dense layer with ELU and a dense layer to r
/// (Chen et al. 2023, §4.1 and Table 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Encoder<const D: usize> {
    shape: EncoderShape,
    scaling: Scaling,
    layout: Layout,
    parameters: Vec<f64>,
}

/// What makes no encoder, or cannot be encoded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EncoderError {
    /// Its layers cannot be made.
    #[error(transparent)]
    Layers(#[from] NetworkError),
    /// A frame has another number of points.
    #[error("the number of points is {found}, but the encoder is for {expected}")]
    Points {
        /// How many it has.
        found: usize,
        /// How many the encoder takes.
        expected: usize,
    },
}

impl<const D: usize> Encoder<D> {
    /// The encoder with these weights and biases: for each convolution six weights and a bias, then each dense layer's W row-major and b. Positions
    /// are scaled by mean and deviation of `scaling`.
    ///
    /// # Errors
    /// [`EncoderError`].
    pub fn new(shape: EncoderShape, scaling: Scaling, parameters: Vec<f64>) -> Result<Self, EncoderError> {
        let sizes = [shape.points, shape.width, shape.coordinates];
        NetworkError::check(&shape, sizes, &scaling, D)?;
        let layout = shape.layout(D);
        NetworkError::check_parameters(&parameters, layout.last.bias.end)?;
        Ok(Self {
            shape,
            scaling,
            layout,
            parameters,
        })
    }

    /// An encoder to start from: weights uniform in ±√(6 / (inputs + outputs)) (for a convolution ±√(6 / 12)), biases 0.
    ///
    /// # Errors
    /// [`EncoderError`].
    pub fn start(shape: EncoderShape, scaling: Scaling, generator: &mut impl Rng) -> Result<Self, EncoderError> {
        let mut encoder = Self::new(shape, scaling, vec![0.0; shape.parameters(D)])?;
        for convolution in &encoder.layout.convolutions {
            let weights = &mut encoder.parameters[convolution.weights.clone()];
            draw_uniform(weights, 2 * shape::KERNEL, generator);
        }
        encoder.layout.hidden.draw(&mut encoder.parameters, generator);
        encoder.layout.last.draw(&mut encoder.parameters, generator);
        Ok(encoder)
    }

    /// Its sizes.
    pub fn shape(&self) -> EncoderShape {
        self.shape
    }

    /// Weights and biases in the order of [`Self::new`].
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Convolutions and dense layers as layers of one kind: a convolution has six inputs and an output.
    pub(crate) fn layers(&self) -> Vec<Layer> {
        let dense = [&self.layout.hidden, &self.layout.last];
        self.layout.convolutions.iter().chain(dense).cloned().collect()
    }

    pub(crate) fn parameters_mut(&mut self) -> &mut [f64] {
        &mut self.parameters
    }

    /// x̂ of one frame; `positions` φ_p of all points in the order of training (m).
    ///
    /// # Errors
    /// [`EncoderError::Points`].
    pub fn encode(&self, positions: &[[f64; D]]) -> Result<Vec<f64>, EncoderError> {
        let (found, expected) = (positions.len(), self.shape.points);
        if found != expected {
            return Err(EncoderError::Points { found, expected });
        }
        let mut tape = EncoderTape::default();
        self.forward(positions, &mut tape);
        Ok(tape.latent)
    }
}

#[cfg(test)]
mod tests;
