use std::path::Path;
use std::{fs, io};

use super::body::Body;
use super::driver::Driver;
use super::{Observer, SimulationError, Summary};
use crate::output::{names, write_whole};
use crate::{Scene, SceneFault};

/// Runs a scene and writes its files into the directory `out`, which is made if it does not exist.
///
/// If the directory holds a checkpoint of the same scene, the run goes on from it and ends with the same files, to the bit, as one that was never stopped. Titles may differ, and the scene may end later
/// than that of the checkpoint: bits are then the same if the earlier end is a time, k · interval, that the longer run stops at as well.
/// Without a checkpoint the run begins anew, and frames, index and comparison of an earlier run are removed first.
/// Files: `scene.toml`, `series.csv`, `particles_000000.vtu` …, `particles.pvd`, `checkpoint.cbor`, and `validation.csv` where the scene has a reference.
///
/// # Errors
/// [`SimulationError`], also where another process runs a scene in this directory; what was written up to then stays.
pub fn simulate(scene: &Scene, out: &Path, observer: &mut dyn Observer) -> Result<Summary, SimulationError> {
    match scene.dimension {
        1 => simulate_in::<1>(scene, out, observer),
        2 => simulate_in::<2>(scene, out, observer),
        3 => simulate_in::<3>(scene, out, observer),
        other => Err(scene.error(SceneFault::value("dimension", other, "1, 2 or 3")).into()),
    }
}

fn simulate_in<const D: usize>(
    scene: &Scene,
    out: &Path,
    observer: &mut dyn Observer,
) -> Result<Summary, SimulationError> {
    let body = Body::<D>::begin(scene)?;
    if out.exists() && !out.is_dir() {
        let reason = "is a file, and a directory is needed";
        return Err(SimulationError::file(
            "write into",
            out,
            io::Error::new(io::ErrorKind::NotADirectory, reason),
        ));
    }
    fs::create_dir_all(out).map_err(|error| SimulationError::file("create", out, error))?;
    let _claimed = mpm_document::claim(out).map_err(|error| SimulationError::file("write into", out, error))?;
    let driver = Driver::begin(scene, out, body)?;
    write_whole(&out.join(names::SCENE), scene.text.as_bytes())?;
    driver.run(observer)
}
