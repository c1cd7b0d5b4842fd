//! Stresses of plane runs on a mesh, as they are and recovered.

use mpm_mesh::{CellSearch, recovered};
use mpm_tensor::Matrix;

use super::parts::Run;
use crate::background::Background;
use crate::{SceneFault, Snapshot};

/// The weight of a point that asks, beside those that tell.
const ASKS: f64 = 1e-200;

/// A particle's entry in a list of plane vectors.
pub fn point(last: &Snapshot, list: &[f64], particle: usize) -> [f64; 2] {
    let entry = last.vector(list, particle).and_then(|x| x.try_into().ok());
    entry.unwrap_or([f64::NAN; 2])
}

/// The stresses of the particles in the plane.
pub fn stresses(last: &Snapshot) -> Vec<Matrix<2>> {
    let entry = |p| match last.tensor(&last.stresses, p) {
        Some(&[xx, xy, yx, yy]) => Matrix([[xx, xy], [yx, yy]]),
        _ => Matrix::from_fn(|_, _| f64::NAN),
    };
    (0..last.len()).map(entry).collect()
}

/// The stresses of the particles as [`recovered`] on the mesh of the scene, and behind them those at `elsewhere`; on a grid as they are, and NaN.
///
/// # Errors
/// [`SceneFault::Value`] for a mesh that cannot be made again.
pub fn recovered_stresses(
    run: &Run,
    stresses: &[Matrix<2>],
    elsewhere: &[[f64; 2]],
) -> Result<Vec<Matrix<2>>, SceneFault> {
    let unknown = Matrix::from_fn(|_, _| f64::NAN);
    let Background::Mesh { whole, .. } = Background::<2>::build(run.scene)? else {
        return Ok([stresses, &vec![unknown; elsewhere.len()]].concat());
    };
    let last = run.last;
    let particles = (0..last.len()).map(|p| point(last, &last.positions, p));
    let points: Vec<[f64; 2]> = particles.chain(elsewhere.iter().copied()).collect();
    let weights = [last.reference_volumes.as_slice(), &vec![ASKS; elsewhere.len()]].concat();
    let values = [stresses, &vec![Matrix::ZERO; elsewhere.len()]].concat();
    Ok(recovered(&CellSearch::new(whole), &points, &weights, &values))
}

/// Root mean square over the particles that are `counted`, by volume, of the difference of their stresses in the plane (Frobenius norm) from `exact`, a function of the positions; NaN where none is.
pub fn stress_error(
    last: &Snapshot,
    positions: &[f64],
    stresses: &[Matrix<2>],
    counted: impl Fn(&[f64; 2]) -> bool,
    exact: impl Fn(&[f64; 2]) -> Matrix<2>,
) -> f64 {
    let (mut squares, mut volumes) = (0.0, 0.0);
    for (p, (&volume, sigma)) in last.reference_volumes.iter().zip(stresses).enumerate() {
        let x = point(last, positions, p);
        if counted(&x) {
            squares += volume * (*sigma - exact(&x)).frobenius_norm().powi(2);
            volumes += volume;
        }
    }
    (squares / volumes).sqrt()
}
