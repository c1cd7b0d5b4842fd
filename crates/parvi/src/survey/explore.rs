//! Scouts, their summits, and a Gaussian with a mass for each separate piece of the target.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use super::ascent::ascend;
use super::clusters::clusters;
use super::density::{Density, Valued};
use super::gaussian_fit::{GaussianFit, fit, quadrature_nodes};
use super::masses::masses;
use crate::SampleError;
use crate::start::quasi_random_normal;

/// Scouts of the first round, which begin where the run begins and around the frame.
const FIRST_SCOUTS: usize = 16;

/// Distances of the second round from the best summit, in standard deviations of its fit.
const RINGS: [f64; 3] = [5.0, 12.0, 30.0];

/// Scouts at each of these.
const SCOUTS_PER_RING: usize = 8;

/// Evaluations of one scout.
const ASCENT: usize = 40;

/// Points from which the masses of several modes are estimated, per mode.
const MASS_POINTS: usize = 512;

/// Separate pieces lighter than this are left out.
const SMALLEST_MASS: f64 = 1e-3;

/// Where scouts came to rest, and the Gaussian at the highest of these summits.
pub(super) struct Scouted<const D: usize> {
    pub summits: Vec<Valued<D>>,
    pub best: Valued<D>,
    pub fit: GaussianFit<D>,
    nodes: Vec<[f64; D]>,
}

/// Gaussians for the pieces of a target, with their masses, and one for the whole.
pub(super) struct Found<const D: usize> {
    pub pieces: Vec<Piece<D>>,
    pub whole: GaussianFit<D>,
}

/// A separate piece of a target.
pub(super) struct Piece<const D: usize> {
    pub fit: GaussianFit<D>,
    /// Its share of the target's mass.
    pub mass: f64,
    /// The standard error of that.
    pub mass_error: f64,
}

/// Two rounds of scouts; `None` where the target cannot be evaluated.
pub(super) fn scout<const D: usize>(
    density: &mut Density<'_, D>,
    positions: &[[f64; D]],
    seed: u64,
) -> Result<Option<Scouted<D>>, SampleError> {
    let directions: Vec<[f64; D]> = quasi_random_normal(FIRST_SCOUTS + RINGS.len() * SCOUTS_PER_RING, seed)?;
    let nodes = quadrature_nodes::<D>(seed)?;
    let half = FIRST_SCOUTS / 2;
    let from_start = positions.iter().take(half).copied();
    let around_frame = directions[half..FIRST_SCOUTS].iter().map(|u| vector::scale(u, 2.0));
    let mut summits: Vec<Valued<D>> = from_start
        .chain(around_frame)
        .filter_map(|start| ascend(density, &start, None, ASCENT))
        .collect();
    let Some(best) = summits
        .iter()
        .max_by(|a, b| a.log_density.total_cmp(&b.log_density))
        .copied()
    else {
        return Ok(None);
    };
    let curvature = local_root(density, &best);
    let Some(fit) = fit(density, best.point, curvature, &nodes) else {
        return Ok(None);
    };
    let metric = fit.root * fit.root.transpose();
    for (ring, scouts) in RINGS.iter().zip(directions[FIRST_SCOUTS..].chunks(SCOUTS_PER_RING)) {
        for u in scouts {
            let reach = ring / vector::norm(u).max(1e-9);
            let start = vector::add_scaled(&fit.mean, reach, &fit.root.apply(u));
            summits.extend(ascend(density, &start, Some(&metric), ASCENT));
        }
    }
    Ok(Some(Scouted {
        summits,
        best,
        fit,
        nodes,
    }))
}

/// The summits' clusters, and a Gaussian with a mass for each; `None` where the target cannot be evaluated.
pub(super) fn pieces<const D: usize>(
    density: &mut Density<'_, D>,
    scouted: Scouted<D>,
    seed: u64,
) -> Result<Option<Found<D>>, SampleError> {
    let mut fits = Vec::new();
    for cluster in clusters(density, scouted.summits) {
        let summit = &cluster[0];
        if summit.point == scouted.best.point {
            fits.push(scouted.fit);
        } else {
            let start = local_root(density, summit);
            fits.extend(fit(density, summit.point, start, &scouted.nodes));
        }
    }
    if fits.len() < 2 {
        return Ok(fits.pop().map(|only| Found {
            pieces: vec![Piece {
                fit: only,
                mass: 1.0,
                mass_error: 0.0,
            }],
            whole: only,
        }));
    }
    let points = quasi_random_normal(MASS_POINTS, seed.wrapping_add(1))?;
    let Some(found) = masses(density, &fits, &points) else {
        return Ok(None);
    };
    let heavy: f64 = found.values.iter().filter(|&&mass| mass >= SMALLEST_MASS).sum();
    let pieces = fits
        .into_iter()
        .zip(found.values.into_iter().zip(found.errors))
        .filter(|&(_, (mass, _))| mass >= SMALLEST_MASS)
        .map(|(fit, (mass, error))| Piece {
            fit,
            mass: mass / heavy,
            mass_error: error / heavy,
        })
        .collect();
    Ok(Some(Found {
        pieces,
        whole: found.whole,
    }))
}

/// A root of the inverse curvature at a summit, from differences of scores; directions that are not concave get the widest scale
/// that the others have, or 1.
fn local_root<const D: usize>(density: &mut Density<'_, D>, summit: &Valued<D>) -> Matrix<D> {
    const STEP: f64 = 1e-4;
    let mut hessian = Matrix::<D>::ZERO;
    for axis in 0..D {
        let mut ahead = summit.point;
        let step = STEP * ahead[axis].abs().max(1.0);
        ahead[axis] += step;
        if let Some(value) = density.value(&ahead) {
            let column = vector::scale(&vector::subtract(&summit.score, &value.score), 1.0 / step);
            for (row, entry) in hessian.0.iter_mut().zip(column) {
                row[axis] = entry;
            }
        }
    }
    match SymmetricEigen::new(&hessian.symmetric_part()) {
        Some(eigen) => {
            let least = eigen
                .values
                .iter()
                .copied()
                .filter(|&q| q > 0.0)
                .fold(f64::INFINITY, f64::min);
            let floor = if least.is_finite() { least } else { 1.0 };
            eigen.map(|q| q.max(floor).sqrt().recip())
        }
        None => Matrix::IDENTITY,
    }
}
