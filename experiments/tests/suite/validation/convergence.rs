//! Manufactured solutions: orders of convergence. Finer grids and other transfers are in docs/results/mechanics.

use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use mpm_scenes::Snapshot;
use mpm_scenes::output::{Frame, frame_files};
use mpm_scenes::reference::validate;

use super::problem::{Finished, pinned, run_into};

/// A manufactured solution: its scene, which ends after one period, that period, and the spacings of its grids.
type Problem = (&'static str, f64, [f64; 3]);

const AXIS_ALIGNED: Problem = ("manufactured_axis_aligned", 0.5451, [0.125, 0.0625, 0.04]);
const VORTEX: Problem = ("generalized_vortex", 1.0, [0.125, 0.0833333333333333, 0.0625]);

/// Largest error at the quarters of the period, for each spacing. A single time would not do: the error swings with the body and
/// passes zero.
fn study((name, period, spacings): Problem, basis: &str) -> [(f64, f64); 3] {
    spacings.map(|spacing| {
        let changes = [
            ("spacing = 0.03125", format!("spacing = {spacing}")),
            ("courant = 0.2", "courant = 0.4".to_owned()),
            ("basis = \"cubic\"", format!("basis = {basis:?}")),
            ("\ninterval = 0.1", format!("\ninterval = {}", 0.25 * period)),
        ];
        let directory = tempfile::tempdir().expect("a directory");
        let changes = changes.each_ref().map(|(old, new)| (*old, new.as_str()));
        let Finished { scene, series, .. } = run_into(directory.path(), name, &changes);
        let reference = &scene.validation.as_ref().expect("a reference").reference;
        let error = |frame: &PathBuf| {
            let rows = validate(reference, &scene, &series, &moved(frame));
            rows.expect("a comparison")[0].measured
        };
        let quarters = &frame_files(directory.path())[1..];
        assert_eq!(quarters.len(), 4);
        (spacing, quarters.iter().map(error).fold(0.0, f64::max))
    })
}

/// Where the particles of a frame in the plane are and were.
fn moved(file: &Path) -> Snapshot {
    let frame = Frame::read(file).expect("a frame");
    let field = |name: &str| frame.field(name).expect("a field");
    let plane = |name: &str| -> Vec<f64> { field(name).chunks_exact(3).flat_map(|x| [x[0], x[1]]).collect() };
    let (positions, displacements) = (plane("position"), plane("displacement"));
    let from = positions.iter().zip(displacements).map(|(x, u)| x - u);
    let volumes = field("volume").into_iter().zip(field("volume_ratio"));
    Snapshot {
        dimension: 2,
        time: frame.time().expect("a time"),
        reference_positions: from.collect(),
        reference_volumes: volumes.map(|(volume, ratio)| volume / ratio).collect(),
        positions,
        ..Snapshot::default()
    }
}

/// Compared with the hat functions as well.
static CUBIC_ALONG_THE_AXES: LazyLock<[(f64, f64); 3]> = LazyLock::new(|| study(AXIS_ALIGNED, "cubic"));

fn is_of_second_order((name, ..): Problem, basis: &str, errors: &[(f64, f64)]) {
    let order = |pair: &[(f64, f64)]| (pair[0].1 / pair[1].1).ln() / (pair[0].0 / pair[1].0).ln();
    let orders: Vec<f64> = errors.windows(2).map(order).collect();
    assert!(
        orders.iter().all(|&order| order > 1.8),
        "{name} {basis}: {errors:?} {orders:?}"
    );
    let (spacing, error) = errors[2];
    pinned(name, &format!("{basis}, h = {spacing}"), error);
}

#[test]
fn quadratic_splines_are_of_second_order_along_the_axes() {
    is_of_second_order(AXIS_ALIGNED, "quadratic", &study(AXIS_ALIGNED, "quadratic"));
}

#[test]
fn cubic_splines_are_of_second_order_along_the_axes() {
    is_of_second_order(AXIS_ALIGNED, "cubic", &*CUBIC_ALONG_THE_AXES);
}

#[test]
fn quadratic_splines_are_of_second_order_in_a_vortex() {
    is_of_second_order(VORTEX, "quadratic", &study(VORTEX, "quadratic"));
}

#[test]
fn cubic_splines_are_of_second_order_in_a_vortex() {
    is_of_second_order(VORTEX, "cubic", &study(VORTEX, "cubic"));
}

/// Its gradient jumps at every face, so crossing particles kick.
#[test]
fn hat_functions_stall() {
    let errors = study(AXIS_ALIGNED, "linear").map(|(_, error)| error);
    let (_, smooth) = CUBIC_ALONG_THE_AXES[2];
    assert!(
        errors[2] > 0.5 * errors[1] && errors[2] > 5.0 * smooth,
        "{errors:?} {smooth}"
    );
}
