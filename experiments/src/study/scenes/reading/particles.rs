//! How far particles are from where they should be.

use mpm_scenes::output::{Frame, frame_files};
use mpm_scenes::reference::{self, Displacement};

use super::FinishedRun;
use super::field::{Stencil, stencils};
use crate::CommandError;

/// How far particles of the other run count around a place, in distances between them.
const REACH: f64 = 2.5;

/// The particles of a frame.
struct Cloud {
    time: f64,
    /// u_p.
    displacements: Vec<[f64; 3]>,
}

/// Root mean square of |u_p − u(X_p)| by volume, over the particles and all frames but that of the start, over the largest |u|. u is the displacement of the other run, by
/// quadratic polynomials between its particles ([`stencils`]), or without one the exact one of the scene's reference.
///
/// An error inside is what the run lacks, in words.
pub fn displacement_error(run: &FinishedRun, other: Option<&FinishedRun>) -> Result<Result<f64, String>, CommandError> {
    let files = frame_files(&run.directory);
    let Some(first) = files.first() else {
        return Ok(Err("the run has no frames".to_owned()));
    };
    let first = Frame::read(first)?;
    let (starts, volumes) = (triples(&first.field("position")?), first.field("volume")?);
    let truth = match other {
        Some(other) => Truth::of_run(other, &starts, run.prepared.scene.dimension)?,
        None => reference::displacement(&run.prepared.scene)
            .map(Truth::Exact)
            .ok_or_else(|| "the scene's reference knows no displacement, and `against` is missing".to_owned()),
    };
    let truth = match truth {
        Ok(truth) => truth,
        Err(message) => return Ok(Err(message)),
    };
    let (mut squares, mut weight, mut peak) = (0.0, 0.0, 0.0f64);
    for file in files.iter().skip(1) {
        let cloud = Cloud::read(&Frame::read(file)?)?;
        let Some(expected) = truth.at(cloud.time, &starts) else {
            return Ok(Err(format!("the other run has no frame at {} s", cloud.time)));
        };
        for ((found, expected), volume) in cloud.displacements.iter().zip(&expected).zip(&volumes) {
            squares += volume * mpm_tensor::vector::distance_squared(found, expected);
            weight += volume;
            peak = peak.max(mpm_tensor::vector::norm(expected));
        }
    }
    Ok(Ok((squares / weight).sqrt() / peak))
}

/// Where particles should be.
enum Truth {
    /// u(X, t).
    Exact(Displacement),
    /// Another run: for each particle the ones around its start, and their displacements.
    Run(Vec<Stencil>, Vec<Cloud>),
}

impl Truth {
    fn of_run(
        other: &FinishedRun,
        starts: &[[f64; 3]],
        dimension: usize,
    ) -> Result<Result<Self, String>, CommandError> {
        let files = frame_files(&other.directory);
        let frames: Result<Vec<Frame>, _> = files.iter().map(|file| Frame::read(file)).collect();
        let frames = frames?;
        let Some(first) = frames.first() else {
            return Ok(Err("the other run has no frames".to_owned()));
        };
        let (points, volumes) = (triples(&first.field("position")?), first.field("volume")?);
        let distance = (volumes.iter().sum::<f64>() / points.len() as f64).powf(1.0 / dimension as f64);
        let clouds: Result<Vec<Cloud>, CommandError> = frames.iter().map(Cloud::read).collect();
        Ok(match stencils(&points, starts, REACH * distance, dimension) {
            Ok(stencils) => Ok(Self::Run(stencils, clouds?)),
            Err(place) => Err(format!("the other run has too few particles around {place:?}")),
        })
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
                        mpm_tensor::vector::accumulate(&mut sum, weight, &cloud.displacements[q]);
                    }
                    sum
                };
                Some(stencils.iter().map(field).collect())
            }
        }
    }
}

impl Cloud {
    fn read(frame: &Frame) -> Result<Self, CommandError> {
        Ok(Self {
            time: frame.time()?,
            displacements: triples(&frame.field("displacement")?),
        })
    }
}

fn triples(list: &[f64]) -> Vec<[f64; 3]> {
    list.as_chunks().0.to_vec()
}
