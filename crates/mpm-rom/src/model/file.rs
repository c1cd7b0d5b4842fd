use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{Model, Summary};
use crate::encoder::{Encoder, EncoderShape};
use crate::manifold::{Network, NetworkShape, Scaling};
use crate::tensor_file::{FileLayout, TensorFileError, TensorReader, TensorWriter};

const LAYOUT: FileLayout = ("model", 2);

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    dimension: usize,
    network: NetworkShape,
    encoder: EncoderShape,
    scaling: Scaling,
    summary: Summary,
}

impl<const D: usize> Model<D> {
    /// Writes the file whole or not at all. Tensors: `network`, weights and biases in the order of [`Network::new`], and `encoder`, in that of
    /// [`Encoder::new`]; sizes and scalings stand in the header.
    ///
    /// # Errors
    /// [`TensorFileError`].
    pub fn write(&self, path: &Path) -> Result<(), TensorFileError> {
        let header = Header {
            dimension: D,
            network: self.network.shape(),
            encoder: self.encoder.shape(),
            scaling: self.network.scaling().clone(),
            summary: self.summary.clone(),
        };
        let mut file = TensorWriter::default();
        file.add_list("network", self.network.parameters());
        file.add_list("encoder", self.encoder.parameters());
        file.write(path, LAYOUT, &header)
    }

    /// Reads a file of [`Self::write`].
    ///
    /// # Errors
    /// [`TensorFileError`]: another dimension or layout, cut off, a tensor that is missing, of another shape or not finite, sizes that
    /// contradict each other.
    pub fn read(path: &Path) -> Result<Self, TensorFileError> {
        let file = TensorReader::open(path, LAYOUT)?;
        let header: Header = file.header()?;
        file.expect_dimension(header.dimension, D)?;
        if header.network.coordinates != header.encoder.coordinates {
            return Err(file.inconsistent("network and encoder have different numbers of coordinates"));
        }
        let parameters = file.tensor("network", &[header.network.parameters(D)])?;
        let network = Network::new(header.network, header.scaling.clone(), parameters);
        let network = network.map_err(|error| file.inconsistent(error))?;
        let parameters = file.tensor("encoder", &[header.encoder.parameters(D)])?;
        let encoder = Encoder::new(header.encoder, header.scaling, parameters);
        let encoder = encoder.map_err(|error| file.inconsistent(error))?;
        Ok(Self::new(network, encoder, header.summary))
    }
}
