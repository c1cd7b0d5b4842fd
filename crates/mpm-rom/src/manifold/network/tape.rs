//! One chunk of points through the layers, values and tangents side by side.

use super::Network;
use super::seed::{Seed, SeedAdjoint};
use crate::activation::elu;
use crate::product::{LANES, add_products, multiply};

/// What the passes of one chunk leave behind, reused from chunk to chunk.
///
/// Lists of a layer are unit × column × point: column 0 holds the values, column 1 + t the tangent t, so that one product with the layer's weights
/// carries all of them. The points are padded to a multiple of [`LANES`]; the padding holds points of its own that nothing reads.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tape {
    points: usize,
    columns: usize,
    hidden: Vec<Hidden>,
    /// y, scaled output and its tangents; after the reverse pass' start, their adjoints.
    pub output: Vec<f64>,
    adjoint: Vec<f64>,
    adjoint_before: Vec<f64>,
}

#[derive(Clone, Debug, Default)]
struct Hidden {
    /// Tangents before the activation; the block of the values is scratch.
    before: Vec<f64>,
    /// Values and tangents after it.
    after: Vec<f64>,
    /// ELU'(z), unit × point.
    slope: Vec<f64>,
}

impl Tape {
    /// The block of the output's component c and column k, one entry per point.
    pub fn output(&self, component: usize, column: usize) -> &[f64] {
        let start = (component * self.columns + column) * self.points;
        &self.output[start..start + self.points]
    }

    /// The same block, to be overwritten with the adjoint before [`Network::reverse`].
    pub fn output_mut(&mut self, component: usize, column: usize) -> &mut [f64] {
        let start = (component * self.columns + column) * self.points;
        &mut self.output[start..start + self.points]
    }

    fn resize(&mut self, points: usize, columns: usize, width: usize, depth: usize, outputs: usize) {
        (self.points, self.columns) = (points, columns);
        let size = width * points * columns;
        self.hidden.resize_with(depth, Hidden::default);
        for hidden in &mut self.hidden {
            hidden.before.resize(size, 0.0);
            hidden.after.resize(size, 0.0);
            hidden.slope.resize(width * points, 0.0);
        }
        self.output.resize(outputs * points * columns, 0.0);
    }
}

impl Hidden {
    /// z += b; after = ELU(z), tangents after = ELU'(z) tangents before.
    fn activate(&mut self, bias: &[f64], points: usize, columns: usize) {
        let units = self
            .before
            .chunks_exact_mut(points * columns)
            .zip(self.after.chunks_exact_mut(points * columns));
        for (((before, after), slope), &bias) in units.zip(self.slope.chunks_exact_mut(points)).zip(bias) {
            let (z, tangents) = before.split_at(points);
            let (value, tangents_after) = after.split_at_mut(points);
            for ((z, value), slope) in z.iter().zip(value).zip(slope.iter_mut()) {
                (*value, *slope) = elu(z + bias);
            }
            for (before, after) in tangents
                .chunks_exact(points)
                .zip(tangents_after.chunks_exact_mut(points))
            {
                for ((before, after), slope) in before.iter().zip(after).zip(slope.iter()) {
                    *after = slope * before;
                }
            }
        }
    }

    /// Adjoints before the activation from those after it: T̅ = ELU' T̅_after, z̅ = ELU' v̅ + ELU'' Σ_t T_t T̅_after,t.
    fn reverse(&self, adjoint: &[f64], before_adjoint: &mut [f64], points: usize, columns: usize) {
        let size = points * columns;
        let units = adjoint.chunks_exact(size).zip(before_adjoint.chunks_exact_mut(size));
        let stored = self.before.chunks_exact(size).zip(self.slope.chunks_exact(points));
        for ((after, out), (before, slope)) in units.zip(stored) {
            let (value, tangents) = after.split_at(points);
            let (z, out_tangents) = out.split_at_mut(points);
            z.fill(0.0);
            let blocks = tangents.chunks_exact(points).zip(out_tangents.chunks_exact_mut(points));
            for ((after, out), before) in blocks.zip(before[points..].chunks_exact(points)) {
                for i in 0..points {
                    z[i] += before[i] * after[i];
                    out[i] = slope[i] * after[i];
                }
            }
            for ((z, value), &slope) in z.iter_mut().zip(value).zip(slope) {
                let curvature = if slope < 1.0 { slope } else { 0.0 };
                *z = slope * value + curvature * *z;
            }
        }
    }
}

impl<const D: usize> Network<D> {
    /// Values and tangents of the scaled output at the chunk's points.
    pub(crate) fn forward(&self, reference: &[[f64; D]], seed: &Seed, tape: &mut Tape) {
        let (points, columns) = (reference.len().next_multiple_of(LANES), 1 + seed.count);
        let (width, depth) = (self.shape.width, self.shape.depth);
        tape.resize(points, columns, width, depth, D);
        let (weights, _, inputs) = self.first_layer();
        let first = &mut tape.hidden[0];
        for (unit, block) in first.before.chunks_exact_mut(points * columns).enumerate() {
            let row = &weights[unit * inputs..unit * inputs + D];
            block[reference.len()..points].fill(0.0);
            for (z, position) in block.iter_mut().zip(reference) {
                let mut sum = 0.0;
                for k in 0..D {
                    sum += row[k] * (position[k] - self.scaling.centre[k]) * self.scaling.factor[k];
                }
                *z = sum;
            }
            for (t, tangent) in block[points..].chunks_exact_mut(points).enumerate() {
                tangent.fill(seed.tangents[t * width + unit]);
            }
        }
        first.activate(&seed.offset, points, columns);
        for number in 1..depth {
            let layer = &self.layers[number];
            let (done, rest) = tape.hidden.split_at_mut(number);
            let (previous, next) = (&done[number - 1], &mut rest[0]);
            multiply(&mut next.before, self.weights(layer), &previous.after, points * columns);
            next.activate(&self.parameters[layer.bias.clone()], points, columns);
        }
        let last = &self.layers[depth];
        let after = &tape.hidden[depth - 1].after;
        multiply(&mut tape.output, self.weights(last), after, points * columns);
        for (component, bias) in self.parameters[last.bias.clone()].iter().enumerate() {
            tape.output_mut(component, 0).iter_mut().for_each(|y| *y += bias);
        }
    }

    /// Adds the adjoints of the parameters, but for what passes through the seed, which goes to `seed`; `tape.output` holds the adjoints
    /// of the scaled output and of its tangents.
    pub(crate) fn reverse(
        &self,
        reference: &[[f64; D]],
        tape: &mut Tape,
        parameters: &mut [f64],
        seed: &mut SeedAdjoint,
    ) {
        let (points, columns) = (tape.points, tape.columns);
        let stacked = points * columns;
        std::mem::swap(&mut tape.output, &mut tape.adjoint_before);
        for number in (1..self.layers.len()).rev() {
            let layer = &self.layers[number];
            let hidden = &tape.hidden[number - 1];
            let z = &tape.adjoint_before;
            let bias = &mut parameters[layer.bias.clone()];
            for (bias, block) in bias.iter_mut().zip(z.chunks_exact(stacked)) {
                *bias += block[..points].iter().sum::<f64>();
            }
            let weights = &mut parameters[layer.weights.clone()];
            add_products(weights, z, &hidden.after, stacked);
            tape.adjoint.resize(layer.inputs * stacked, 0.0);
            multiply(&mut tape.adjoint, self.weights(layer).transpose(), z, stacked);
            tape.adjoint_before.resize(layer.inputs * stacked, 0.0);
            hidden.reverse(&tape.adjoint, &mut tape.adjoint_before, points, columns);
        }
        let (_, _, inputs) = self.first_layer();
        let width = self.shape.width;
        for (unit, block) in tape.adjoint_before.chunks_exact(stacked).enumerate() {
            let (values, tangents) = block.split_at(points);
            seed.offset[unit] += values.iter().sum::<f64>();
            for (t, tangent) in tangents.chunks_exact(points).enumerate() {
                seed.tangents[t * width + unit] += tangent.iter().sum::<f64>();
            }
            for (z, position) in values.iter().zip(reference) {
                for k in 0..D {
                    let scaled = (position[k] - self.scaling.centre[k]) * self.scaling.factor[k];
                    parameters[unit * inputs + k] += z * scaled;
                }
            }
        }
    }
}
