//! The nonlinear manifold: a fully connected network of X and x̂.

mod scaling;
mod seed;
mod shape;
mod tape;

pub use scaling::Scaling;
use seed::Seed;
pub(crate) use seed::SeedAdjoint;
pub use shape::NetworkShape;
pub(crate) use shape::{Layer, draw_uniform};
pub(crate) use tape::Tape;

use std::fmt::Debug;

use mpm_tensor::Matrix;
use rand::Rng;
use rayon::prelude::*;

use super::{Evaluation, Manifold, Wanted};
use crate::product::Weights;

/// Points that go through the layers together: as many as keep a layer's columns in the second-level cache.
pub(crate) const CHUNK: usize = 64;

/// g̃(X, x̂) = mean + deviation ∘ y(u, x̂) with u = (X − centre) ∘ factor and y fully connected, (D + r) → width → … → width → D, ELU between
/// (Chen et al. 2023, §4 and Table 1: width 30, depth 4 by its rows; its caption calls all five layers hidden).
///
/// Derivatives are forward tangents carried through the same layers: ẏ' = ELU'(z) ∘ (W ẏ).
#[derive(Clone, Debug, PartialEq)]
pub struct Network<const D: usize> {
    shape: NetworkShape,
    scaling: Scaling,
    layers: Vec<Layer>,
    parameters: Vec<f64>,
}

/// Sizes, scaling and parameters that make no network and no encoder.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// A size is zero.
    #[error("{0}: every size must be at least 1")]
    Shape(String),
    /// The scaling is not of D axes, or not finite and positive.
    #[error("{0:?} is no scaling of dimension {1}")]
    Scaling(Scaling, usize),
    /// There are more or fewer parameters than weights and biases.
    #[error("the number of parameters is {found}, that of weights and biases {expected}")]
    Parameters {
        /// How many there are.
        found: usize,
        /// How many the shape has.
        expected: usize,
    },
}

impl NetworkError {
    /// Whether these sizes and this scaling make a network for so many axes.
    pub(crate) fn check(
        shape: &impl Debug,
        sizes: [usize; 3],
        scaling: &Scaling,
        dimension: usize,
    ) -> Result<(), Self> {
        if sizes.contains(&0) {
            return Err(Self::Shape(format!("{shape:?}")));
        }
        match scaling.is_sound(dimension) {
            true => Ok(()),
            false => Err(Self::Scaling(scaling.clone(), dimension)),
        }
    }

    /// Whether there are as many parameters as weights and biases.
    pub(crate) fn check_parameters(parameters: &[f64], expected: usize) -> Result<(), Self> {
        match parameters.len() {
            found if found != expected => Err(Self::Parameters { found, expected }),
            _ => Ok(()),
        }
    }
}

impl<const D: usize> Network<D> {
    /// The network with these weights and biases: layer by layer W row-major (outputs × inputs; inputs of the first: X, then x̂), then b.
    ///
    /// # Errors
    /// [`NetworkError`].
    pub fn new(shape: NetworkShape, scaling: Scaling, parameters: Vec<f64>) -> Result<Self, NetworkError> {
        let sizes = [shape.coordinates, shape.width, shape.depth];
        NetworkError::check(&shape, sizes, &scaling, D)?;
        NetworkError::check_parameters(&parameters, shape.parameters(D))?;
        Ok(Self {
            shape,
            scaling,
            layers: shape.layers(D),
            parameters,
        })
    }

    /// A network to start from: weights uniform in ±√(6 / (inputs + outputs)) (Glorot, Bengio 2010), biases 0.
    ///
    /// # Errors
    /// [`NetworkError`].
    pub fn start(shape: NetworkShape, scaling: Scaling, generator: &mut impl Rng) -> Result<Self, NetworkError> {
        let mut network = Self::new(shape, scaling, vec![0.0; shape.parameters(D)])?;
        for layer in &network.layers {
            layer.draw(&mut network.parameters, generator);
        }
        Ok(network)
    }

    /// Its sizes.
    pub fn shape(&self) -> NetworkShape {
        self.shape
    }

    /// Its scaling.
    pub fn scaling(&self) -> &Scaling {
        &self.scaling
    }

    /// Weights and biases in the order of [`Self::new`].
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    pub(crate) fn layers(&self) -> &[Layer] {
        &self.layers
    }

    pub(crate) fn parameters_mut(&mut self) -> &mut [f64] {
        &mut self.parameters
    }

    /// W of a layer.
    fn weights(&self, layer: &Layer) -> Weights<'_> {
        Weights::new(&self.parameters[layer.weights.clone()], layer.outputs, layer.inputs)
    }

    /// Weights, biases and number of inputs of the first layer.
    fn first_layer(&self) -> (&[f64], &[f64], usize) {
        let first = &self.layers[0];
        let weights = &self.parameters[first.weights.clone()];
        (weights, &self.parameters[first.bias.clone()], first.inputs)
    }
}

impl<const D: usize> Manifold<D> for Network<D> {
    fn coordinates(&self) -> usize {
        self.shape.coordinates
    }

    fn evaluate(&self, reference: &[[f64; D]], latent: &[f64], wanted: Wanted, out: &mut Evaluation<D>) {
        let r = self.shape.coordinates;
        let unit = |k: usize| (0..r).map(move |j| f64::from(u8::from(j == k)));
        let basis: Vec<f64> = (0..if wanted.jacobians { r } else { 0 }).flat_map(unit).collect();
        let seed = self.seed(latent, wanted.gradients, basis.chunks_exact(r));
        self.fill(reference, &seed, wanted.gradients, out);
    }

    fn evaluate_moving(&self, reference: &[[f64; D]], latent: &[f64], rates: &[f64], out: &mut Evaluation<D>) {
        let seed = self.seed(latent, true, std::iter::once(rates));
        self.fill(reference, &seed, true, out);
        std::mem::swap(&mut out.velocities, &mut out.jacobians);
        out.jacobians.clear();
    }
}

impl<const D: usize> Network<D> {
    /// Values and tangents of a seed at all points, in metres; those along its directions are P × directions columns of the Jacobians.
    fn fill(&self, reference: &[[f64; D]], seed: &Seed, wanted: bool, out: &mut Evaluation<D>) {
        let Evaluation {
            positions,
            gradients,
            jacobians: along,
            ..
        } = out;
        let (points, skipped) = (reference.len(), if wanted { D } else { 0 });
        let directions = seed.count - skipped;
        positions.resize(points, [0.0; D]);
        gradients.resize(if wanted { points } else { 0 }, Matrix::ZERO);
        along.resize(points * directions, [0.0; D]);
        // Lists that were not wanted are empty; their chunks then have to come from somewhere.
        let chunks = points.div_ceil(CHUNK);
        let mut gradients: Vec<_> = gradients.chunks_mut(CHUNK).map(Some).collect();
        let mut along: Vec<_> = along.chunks_mut(CHUNK * directions.max(1)).map(Some).collect();
        gradients.resize_with(chunks, || None);
        along.resize_with(chunks, || None);
        let work = |tape: &mut Tape, ((reference, positions), (gradients, along)): Chunk<'_, D>| {
            self.forward(reference, seed, tape);
            let deviation = &self.scaling.deviation;
            for c in 0..D {
                for (position, y) in positions.iter_mut().zip(tape.output(c, 0)) {
                    position[c] = self.scaling.mean[c] + deviation[c] * y;
                }
            }
            if let Some(gradients) = gradients {
                for c in 0..D {
                    for k in 0..D {
                        for (gradient, y) in gradients.iter_mut().zip(tape.output(c, 1 + k)) {
                            gradient.0[c][k] = deviation[c] * y;
                        }
                    }
                }
            }
            if let Some(along) = along {
                for c in 0..D {
                    for k in 0..directions {
                        let columns = along.chunks_exact_mut(directions);
                        for (columns, y) in columns.zip(tape.output(c, 1 + skipped + k)) {
                            columns[k][c] = deviation[c] * y;
                        }
                    }
                }
            }
        };
        let lists = reference
            .chunks(CHUNK)
            .zip(positions.chunks_mut(CHUNK))
            .zip(gradients.into_iter().zip(along));
        let lists: Vec<Chunk<'_, D>> = lists.collect();
        // Handing a few chunks to other threads costs more than it saves.
        if chunks < 4 {
            let mut tape = Tape::default();
            lists.into_iter().for_each(|chunk| work(&mut tape, chunk));
        } else {
            lists.into_par_iter().for_each_init(Tape::default, work);
        }
    }
}

/// Points, positions, gradients and tangents along directions of a chunk.
type Chunk<'a, const D: usize> = (
    (&'a [[f64; D]], &'a mut [[f64; D]]),
    (Option<&'a mut [Matrix<D>]>, Option<&'a mut [[f64; D]]>),
);

#[cfg(test)]
mod tests;
