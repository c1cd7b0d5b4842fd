//! Forward and reverse pass of one frame.

use super::Encoder;
use super::shape::{KERNEL, STRIDE};
use crate::activation::elu;
use crate::manifold::network::Layer;

/// What the forward pass leaves behind for the reverse pass.
#[derive(Clone, Debug, Default)]
pub(crate) struct EncoderTape {
    /// Values: the scaled positions, then those after each activation.
    values: Vec<Vec<f64>>,
    /// ELU' of each activation.
    slopes: Vec<Vec<f64>>,
    /// x̂.
    pub latent: Vec<f64>,
}

impl<const D: usize> Encoder<D> {
    /// x̂ of a frame, `positions` in metres.
    pub(crate) fn forward(&self, positions: &[[f64; D]], tape: &mut EncoderTape) {
        let activations = self.layout.convolutions.len() + 1;
        tape.values.resize_with(activations + 1, Vec::new);
        tape.slopes.resize_with(activations, Vec::new);
        let input = &mut tape.values[0];
        input.clear();
        for position in positions {
            for c in 0..D {
                input.push((position[c] - self.scaling.mean[c]) / self.scaling.deviation[c]);
            }
        }
        for (number, layer) in self.layout.convolutions.iter().enumerate() {
            let (weights, bias) = (
                &self.parameters[layer.weights.clone()],
                self.parameters[layer.bias.start],
            );
            let (done, rest) = tape.values.split_at_mut(number + 1);
            let (input, output) = (&done[number], &mut rest[0]);
            convolve(input, weights, bias, output);
            activate(output, &mut tape.slopes[number]);
        }
        let number = activations - 1;
        let (done, rest) = tape.values.split_at_mut(number + 1);
        dense(&self.parameters, &self.layout.hidden, &done[number], &mut rest[0]);
        activate(&mut rest[0], &mut tape.slopes[number]);
        dense(&self.parameters, &self.layout.last, &rest[0], &mut tape.latent);
    }

    /// Adds the adjoints of the parameters, given those of x̂.
    pub(crate) fn reverse(&self, tape: &EncoderTape, latent: &[f64], parameters: &mut [f64]) {
        let layout = &self.layout;
        let number = layout.convolutions.len();
        let mut adjoint = dense_reverse(
            &self.parameters,
            &layout.last,
            &tape.values[number + 1],
            latent,
            parameters,
        );
        scale(&mut adjoint, &tape.slopes[number]);
        adjoint = dense_reverse(
            &self.parameters,
            &layout.hidden,
            &tape.values[number],
            &adjoint,
            parameters,
        );
        for (number, layer) in layout.convolutions.iter().enumerate().rev() {
            scale(&mut adjoint, &tape.slopes[number]);
            let input = &tape.values[number];
            parameters[layer.bias.start] += adjoint.iter().sum::<f64>();
            let mut sums = [0.0; KERNEL];
            for (&z, window) in adjoint.iter().zip(input.windows(KERNEL).step_by(STRIDE)) {
                for k in 0..KERNEL {
                    sums[k] += z * window[k];
                }
            }
            for k in 0..KERNEL {
                parameters[layer.weights.start + k] += sums[k];
            }
            // The positions are data: nothing asks for their adjoint.
            if number > 0 {
                adjoint = spread(&adjoint, &self.parameters[layer.weights.clone()], input.len());
            }
        }
    }
}

/// z_n = b + Σ_k w_k a_{2n+k}, seen as pairs of entries so that neighbouring outputs are computed together.
fn convolve(input: &[f64], weights: &[f64], bias: f64, output: &mut Vec<f64>) {
    output.clear();
    let (pairs, _) = input.as_chunks::<STRIDE>();
    let [w0, w1, w2, w3, w4, w5] = array(weights);
    let windows = pairs.iter().zip(pairs.iter().skip(1)).zip(pairs.iter().skip(2));
    output.extend(
        windows.map(|((a, b), c)| bias + (w0 * a[0] + w1 * a[1]) + (w2 * b[0] + w3 * b[1]) + (w4 * c[0] + w5 * c[1])),
    );
}

/// a̅_{2n+k} = Σ z̅_n w_k over all n and k that meet there, for so many inputs.
fn spread(adjoint: &[f64], weights: &[f64], inputs: usize) -> Vec<f64> {
    let [w0, w1, w2, w3, w4, w5] = array(weights);
    let mut padded = vec![0.0; adjoint.len() + 4];
    for (padded, z) in padded.iter_mut().skip(2).zip(adjoint) {
        *padded = *z;
    }
    let mut input = vec![0.0; inputs];
    let (pairs, _) = input.as_chunks_mut::<STRIDE>();
    for (pair, z) in pairs.iter_mut().zip(padded.windows(3)) {
        *pair = [w0 * z[2] + w2 * z[1] + w4 * z[0], w1 * z[2] + w3 * z[1] + w5 * z[0]];
    }
    input
}

fn array(weights: &[f64]) -> [f64; KERNEL] {
    std::array::from_fn(|k| weights[k])
}

/// ELU in place; its slopes beside it.
fn activate(values: &mut [f64], slopes: &mut Vec<f64>) {
    slopes.resize(values.len(), 0.0);
    for (value, slope) in values.iter_mut().zip(slopes) {
        (*value, *slope) = elu(*value);
    }
}

fn scale(adjoint: &mut [f64], slopes: &[f64]) {
    for (adjoint, slope) in adjoint.iter_mut().zip(slopes) {
        *adjoint *= slope;
    }
}

/// z = W a + b.
fn dense(parameters: &[f64], layer: &Layer, input: &[f64], output: &mut Vec<f64>) {
    output.clear();
    let rows = parameters[layer.weights.clone()].chunks_exact(layer.inputs);
    output.extend(
        rows.zip(&parameters[layer.bias.clone()])
            .map(|(row, bias)| bias + row.iter().zip(input).map(|(weight, a)| weight * a).sum::<f64>()),
    );
}

/// W̅ += z̅ aᵀ, b̅ += z̅; returns a̅ = Wᵀ z̅.
fn dense_reverse(parameters: &[f64], layer: &Layer, input: &[f64], z: &[f64], adjoint: &mut [f64]) -> Vec<f64> {
    let mut input_adjoint = vec![0.0; layer.inputs];
    for (bias, z) in adjoint[layer.bias.clone()].iter_mut().zip(z) {
        *bias += z;
    }
    let rows = parameters[layer.weights.clone()].chunks_exact(layer.inputs);
    let adjoint_rows = adjoint[layer.weights.clone()].chunks_exact_mut(layer.inputs);
    for ((row, row_adjoint), z) in rows.zip(adjoint_rows).zip(z) {
        for k in 0..layer.inputs {
            row_adjoint[k] += z * input[k];
            input_adjoint[k] += z * row[k];
        }
    }
    input_adjoint
}
