//! What the first layer adds to every point: x̂ is the same for all of them, so its part is one vector, and so are the tangents.

use super::Network;

/// The first layer's constants for one x̂, and the tangents that an evaluation carries: first D for ∂/∂X_k if gradients are wanted, then one for
/// each direction w of x̂.
#[derive(Clone, Debug)]
pub(crate) struct Seed {
    /// W_x̂ x̂ + b, one entry per unit of the first layer.
    pub offset: Vec<f64>,
    /// Before the first activation, tangent × unit: W_X e_k factor_k, then W_x̂ w.
    pub tangents: Vec<f64>,
    /// Number of tangents.
    pub count: usize,
}

/// Adjoints of a seed's constants, summed over points.
#[derive(Clone, Debug)]
pub(crate) struct SeedAdjoint {
    pub offset: Vec<f64>,
    pub tangents: Vec<f64>,
}

impl SeedAdjoint {
    pub fn zero(seed: &Seed) -> Self {
        Self {
            offset: vec![0.0; seed.offset.len()],
            tangents: vec![0.0; seed.tangents.len()],
        }
    }
}

impl<const D: usize> Network<D> {
    /// The seed at `latent` with tangents along `directions` (r entries each).
    pub(crate) fn seed<'a>(
        &self,
        latent: &[f64],
        gradients: bool,
        directions: impl Iterator<Item = &'a [f64]>,
    ) -> Seed {
        let (weights, bias, inputs) = self.first_layer();
        let dot = |row: &[f64], x: &[f64]| row[D..].iter().zip(x).map(|(w, x)| w * x).sum::<f64>();
        let rows = || weights.chunks_exact(inputs);
        let offset = rows().zip(bias).map(|(row, bias)| bias + dot(row, latent)).collect();
        let mut tangents = Vec::new();
        if gradients {
            for k in 0..D {
                tangents.extend(rows().map(|row| row[k] * self.scaling.factor[k]));
            }
        }
        for direction in directions {
            tangents.extend(rows().map(|row| dot(row, direction)));
        }
        Seed {
            offset,
            count: tangents.len() / bias.len(),
            tangents,
        }
    }

    /// The reverse of [`Self::seed`]: adds to the adjoints of the parameters, and returns those of x̂ and of the one direction, zeros if there is none.
    pub(crate) fn reverse_seed(
        &self,
        adjoint: &SeedAdjoint,
        gradients: bool,
        latent: &[f64],
        direction: Option<&[f64]>,
        parameters: &mut [f64],
    ) -> (Vec<f64>, Vec<f64>) {
        let (weights, bias, inputs) = self.first_layer();
        let units = bias.len();
        let (weights_adjoint, rest) = parameters.split_at_mut(weights.len());
        let skipped = if gradients { D } else { 0 };
        let (mut of_latent, mut along) = (vec![0.0; latent.len()], vec![0.0; latent.len()]);
        for unit in 0..units {
            let row = unit * inputs..(unit + 1) * inputs;
            let (row, row_adjoint) = (&weights[row.clone()], &mut weights_adjoint[row]);
            let offset = adjoint.offset[unit];
            rest[unit] += offset;
            for (k, x) in latent.iter().enumerate() {
                row_adjoint[D + k] += offset * x;
                of_latent[k] += offset * row[D + k];
            }
            for k in 0..skipped {
                row_adjoint[k] += adjoint.tangents[k * units + unit] * self.scaling.factor[k];
            }
            if let Some(direction) = direction {
                let tangent = adjoint.tangents[skipped * units + unit];
                for (k, w) in direction.iter().enumerate() {
                    row_adjoint[D + k] += tangent * w;
                    along[k] += tangent * row[D + k];
                }
            }
        }
        (of_latent, along)
    }
}
