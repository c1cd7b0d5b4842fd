//! How gradients become steps.

mod adam;
mod soap;

use adam::Adam;
use serde::{Deserialize, Serialize};
use soap::Soap;

use crate::encoder::Encoder;
use crate::manifold::Network;

/// What turns the gradients of the batches into steps of the parameters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Optimizer {
    /// Adam in the eigenvectors of the gradients of each layer (N. Vyas et al. 2024, arXiv 2409.11321).
    #[default]
    Soap,
    /// D. P. Kingma, J. Ba 2015: the paper's.
    Adam,
}

/// An optimizer under way.
#[derive(Clone, Debug)]
pub(super) enum Descent {
    Soap(Soap),
    Adam(Adam),
}

impl Descent {
    /// Before its first step.
    pub fn new<const D: usize>(optimizer: Optimizer, network: &Network<D>, encoder: &Encoder<D>) -> Self {
        match optimizer {
            Optimizer::Soap => Self::Soap(Soap::new(network.layers(), &encoder.layers())),
            Optimizer::Adam => Self::Adam(Adam::new(network.parameters().len() + encoder.parameters().len())),
        }
    }

    /// One step down `gradient`; parameters and gradient are those of the network, then those of the encoder.
    pub fn step(&mut self, network: &mut [f64], encoder: &mut [f64], gradient: &[f64], rate: f64) {
        let change = match self {
            Self::Soap(soap) => soap.change(gradient, rate),
            Self::Adam(adam) => adam.change(gradient, rate),
        };
        for (parameter, change) in network.iter_mut().chain(encoder).zip(change) {
            *parameter += change;
        }
    }

    /// Steps taken.
    pub fn steps(&self) -> u64 {
        match self {
            Self::Soap(soap) => soap.steps,
            Self::Adam(adam) => adam.steps,
        }
    }

    /// All numbers that later steps depend on, but for the number of steps.
    pub fn state(&self) -> Vec<f64> {
        self.clone().numbers().map(|number| *number).collect()
    }

    /// The optimizer after `steps` steps, as [`Self::state`] told it; `state` has as many numbers.
    pub fn restore(&mut self, steps: u64, state: &[f64]) {
        match self {
            Self::Soap(soap) => soap.steps = steps,
            Self::Adam(adam) => adam.steps = steps,
        }
        for (number, value) in self.numbers().zip(state) {
            *number = *value;
        }
    }

    fn numbers(&mut self) -> Box<dyn Iterator<Item = &mut f64> + '_> {
        match self {
            Self::Soap(soap) => Box::new(soap.numbers()),
            Self::Adam(adam) => Box::new(adam.numbers()),
        }
    }
}
