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
pub(super) struct Descent {
    method: Method,
    /// Steps taken.
    pub steps: u64,
}

#[derive(Clone, Debug)]
enum Method {
    Soap(Soap),
    Adam(Adam),
}

impl Descent {
    /// Before its first step.
    pub fn new<const D: usize>(optimizer: Optimizer, network: &Network<D>, encoder: &Encoder<D>) -> Self {
        let parameters = network.parameters().len() + encoder.parameters().len();
        let method = match optimizer {
            Optimizer::Soap => Method::Soap(Soap::new(network.layers(), &encoder.layers())),
            Optimizer::Adam => Method::Adam(Adam::new(parameters)),
        };
        Self { method, steps: 0 }
    }

    /// One step down `gradient`; parameters and gradient are those of the network, then those of the encoder.
    pub fn step(&mut self, network: &mut [f64], encoder: &mut [f64], gradient: &[f64], rate: f64) {
        self.steps += 1;
        let change = match &mut self.method {
            Method::Soap(soap) => soap.change(gradient, rate, self.steps),
            Method::Adam(adam) => adam.change(gradient, rate, self.steps),
        };
        for (parameter, change) in network.iter_mut().chain(encoder).zip(change) {
            *parameter += change;
        }
    }

    /// All numbers that later steps depend on, but for the number of steps.
    pub fn state(&self) -> Vec<f64> {
        self.clone().numbers().map(|number| *number).collect()
    }

    /// The optimizer after `steps` steps, as [`Self::state`] told it; `state` has as many numbers.
    pub fn restore(&mut self, steps: u64, state: &[f64]) {
        self.steps = steps;
        for (number, value) in self.numbers().zip(state) {
            *number = *value;
        }
    }

    fn numbers(&mut self) -> Box<dyn Iterator<Item = &mut f64> + '_> {
        match &mut self.method {
            Method::Soap(soap) => Box::new(soap.numbers()),
            Method::Adam(adam) => Box::new(adam.numbers()),
        }
    }
}
