//! How far particles are from where they should be.

use std::path::Path;

use mpm_tensor::vector;

use super::stencil::{Stencil, stencils};
use crate::output::{Frame, frame_files};
use crate::reference::{self, Displacement};
use crate::{Scene, SimulationError};

/// How far particles of the other run count around a place, in distances between them.
const REACH: f64 = 2.5;

/// The particles of a frame.
struct Cloud {
    time: f64,
    /// u_p.
    displacements: Vec<[f64; 3]>,
}

/// Why there is no number.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReadingError {
    /// A frame cannot be read.
    #[error(transparent)]
    File(#[from] SimulationError),
    /// What a run lacks.
    #[error("{0}")]
    Lacks(String),
    /// A field of a [`Reading`](super::Reading) that does not fit the others, or the run.
    #[error("{field}: {message}")]
    Unfit {
        /// The field; empty for the whole.
        field: &'static str,
        /// What is wrong.
        message: String,
    },
}

/// Root mean square of |u_p − u(X_p)| by volume, over the particles and all frames of a run's directory but that of the start, over the largest |u|. u is the displacement of the run in
/// another directory, by quadratic polynomials between its particles (weighted least squares), or without one the exact one of the scene's reference.
///
/// # Errors
/// [`ReadingError`].
pub fn displacement_error(scene: &Scene, directory: &Path, other: Option<&Path>) -> Result<f64, ReadingError> {
    let files = frame_files(directory);
    let first = files.first().ok_or_else(|| lacks("the run has no frames"))?;
    let first = Frame::read(first)?;
    let (starts, volumes) = (triples(&first.field("position")?), first.field("volume")?);
    let truth = match other {
        Some(other) => Truth::of_run(other, &starts, scene.dimension)?,
        None => reference::displacement(scene)
            .map(Truth::Exact)
            .ok_or_else(|| lacks("the scene's reference knows no displacement, and `against` is missing"))?,
    };
    let (mut squares, mut weight, mut peak) = (0.0, 0.0, 0.0f64);
    for file in files.iter().skip(1) {
        let cloud = Cloud::read(&Frame::read(file)?)?;
        let expected = truth.at(cloud.time, &starts);
        let expected = expected.ok_or_else(|| lacks(format!("the other run has no frame at {} s", cloud.time)))?;
        for ((found, expected), volume) in cloud.displacements.iter().zip(&expected).zip(&volumes) {
            squares += volume * vector::distance_squared(found, expected);
            weight += volume;
            peak = peak.max(vector::norm(expected));
        }
    }
    Ok((squares / weight).sqrt() / peak)
}

fn lacks(what: impl Into<String>) -> ReadingError {
    ReadingError::Lacks(what.into())
}

/// Where particles should be.
enum Truth {
    /// u(X, t).
    Exact(Displacement),
    /// Another run: for each particle the ones around its start, and their displacements.
    Run(Vec<Stencil>, Vec<Cloud>),
}

impl Truth {
    fn of_run(other: &Path, starts: &[[f64; 3]], dimension: usize) -> Result<Self, ReadingError> {
        let files = frame_files(other);
        let frames: Result<Vec<Frame>, _> = files.iter().map(|file| Frame::read(file)).collect();
        let frames = frames?;
        let first = frames.first().ok_or_else(|| lacks("the other run has no frames"))?;
        let (points, volumes) = (triples(&first.field("position")?), first.field("volume")?);
        let distance = (volumes.iter().sum::<f64>() / points.len() as f64).powf(1.0 / dimension as f64);
        let clouds: Result<Vec<Cloud>, SimulationError> = frames.iter().map(Cloud::read).collect();
        let stencils = stencils(&points, starts, REACH * distance, dimension);
        let few = |place| lacks(format!("the other run has too few particles around {place:?}"));
        Ok(Self::Run(stencils.map_err(few)?, clouds?))
    }

    /// The displacements of all particles; none where the other run has no frame.
    fn at(&self, time: f64, starts: &[[f64; 3]]) -> Option<Vec<[f64; 3]>> {
        match self {
            Self::Exact(displacement) => {
                let each = starts.iter().map(|start| displacement(start, time).try_into().ok());
                each.collect()
            }
            Self::Run(stencils, clouds) => {
                let cloud = clouds.iter().find(|cloud| (cloud.time - time).abs() < 1e-9)?;
                let field = |stencil: &Stencil| {
                    let mut sum = [0.0; 3];
                    for &(q, weight) in stencil {
                        vector::accumulate(&mut sum, weight, &cloud.displacements[q]);
                    }
                    sum
                };
                Some(stencils.iter().map(field).collect())
            }
        }
    }
}

impl Cloud {
    fn read(frame: &Frame) -> Result<Self, SimulationError> {
        Ok(Self {
            time: frame.time()?,
            displacements: triples(&frame.field("displacement")?),
        })
    }
}

fn triples(list: &[f64]) -> Vec<[f64; 3]> {
    list.as_chunks().0.to_vec()
}
