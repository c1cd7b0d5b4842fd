use std::path::Path;

use mpm_tensor::Matrix;
use serde::{Deserialize, Serialize};

use super::{Body, Frame, Run, Snapshots};
use crate::tensor_file::{FileLayout, TensorFileError, TensorReader, TensorWriter};

/// 1 had no times: frames were one interval apart.
const LAYOUT: FileLayout = ("snapshots", 2);

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Header {
    dimension: usize,
    scene: String,
    points: usize,
    interval: f64,
    density: f64,
    parameters: Vec<String>,
    /// Number of frames of each run.
    frames: Vec<usize>,
}

impl<const D: usize> Snapshots<D> {
    /// Writes the file whole or not at all. The tensors, for P points, K parameters, R runs and N frames of all runs, one run after the
    /// other: `reference` P × D, `centroid` D, `parameters` R × K, `times` N, `positions` N × P × D, `deformation_gradients` N × P × D × D,
    /// `velocities` N × P × D.
    ///
    /// # Errors
    /// [`TensorFileError`].
    pub fn write(&self, path: &Path) -> Result<(), TensorFileError> {
        let (body, points) = (&self.body, self.points());
        let header = Header {
            dimension: D,
            scene: body.scene.clone(),
            points,
            interval: body.interval,
            density: body.density,
            parameters: body.parameters.clone(),
            frames: self.runs.iter().map(|run| run.frames.len()).collect(),
        };
        let total = self.frames().count();
        let mut file = TensorWriter::default();
        file.add("reference", &[points, D], body.reference.iter().flatten().copied());
        file.add("centroid", &[D], body.centroid);
        let parameters = self.runs.iter().flat_map(|run| run.parameters.iter().copied());
        file.add("parameters", &[self.runs.len(), body.parameters.len()], parameters);
        file.add("times", &[total], self.frames().map(|frame| frame.time));
        let positions = self
            .frames()
            .flat_map(|frame| frame.positions.iter().flatten().copied());
        file.add("positions", &[total, points, D], positions);
        let gradients = self.frames().flat_map(|frame| &frame.deformation_gradients);
        let gradients = gradients.flat_map(|gradient| gradient.0.into_iter().flatten());
        file.add("deformation_gradients", &[total, points, D, D], gradients);
        let velocities = self
            .frames()
            .flat_map(|frame| frame.velocities.iter().flatten().copied());
        file.add("velocities", &[total, points, D], velocities);
        file.write(path, LAYOUT, &header)
    }

    /// Reads a file of [`Self::write`] and checks it as [`Self::new`] does.
    ///
    /// # Errors
    /// [`TensorFileError`]; [`TensorFault::Inconsistent`](crate::tensor_file::TensorFault::Inconsistent) holds what [`Self::new`] says.
    pub fn read(path: &Path) -> Result<Self, TensorFileError> {
        let file = TensorReader::open(path, LAYOUT)?;
        let header: Header = file.header()?;
        file.expect_dimension(header.dimension, D)?;
        let points = header.points;
        let total = header
            .frames
            .iter()
            .try_fold(0_usize, |sum, &count| sum.checked_add(count))
            .ok_or_else(|| file.inconsistent("more frames than can be counted"))?;
        let centroid = vectors::<D>(&file.unchecked("centroid", &[D])?);
        let body = Body {
            reference: vectors(&file.unchecked("reference", &[points, D])?),
            centroid: centroid.first().copied().unwrap_or([0.0; D]),
            scene: header.scene,
            interval: header.interval,
            density: header.density,
            parameters: header.parameters,
        };
        let count = body.parameters.len();
        let parameters = file.unchecked("parameters", &[header.frames.len(), count])?;
        let times = file.unchecked("times", &[total])?;
        let positions: Vec<[f64; D]> = vectors(&file.unchecked("positions", &[total, points, D])?);
        let gradients = matrices::<D>(&file.unchecked("deformation_gradients", &[total, points, D, D])?);
        let velocities: Vec<[f64; D]> = vectors(&file.unchecked("velocities", &[total, points, D])?);
        // A body without points fails in `new`; the length 1 keeps `chunks` from failing before.
        let length = points.max(1);
        let rows = times
            .into_iter()
            .zip(positions.chunks(length))
            .zip(gradients.chunks(length))
            .zip(velocities.chunks(length));
        let mut frames = rows.map(|(((time, positions), gradients), velocities)| Frame {
            time,
            positions: positions.to_vec(),
            deformation_gradients: gradients.to_vec(),
            velocities: velocities.to_vec(),
        });
        let mut parameters = parameters.into_iter();
        let runs = header.frames.iter().map(|&number| Run {
            parameters: parameters.by_ref().take(count).collect(),
            frames: frames.by_ref().take(number).collect(),
        });
        let runs = runs.collect();
        Self::new(body, runs).map_err(|error| file.inconsistent(error))
    }
}

fn vectors<const D: usize>(values: &[f64]) -> Vec<[f64; D]> {
    values.as_chunks::<D>().0.to_vec()
}

fn matrices<const D: usize>(values: &[f64]) -> Vec<Matrix<D>> {
    values
        .as_chunks::<D>()
        .0
        .as_chunks::<D>()
        .0
        .iter()
        .map(|rows| Matrix(*rows))
        .collect()
}
