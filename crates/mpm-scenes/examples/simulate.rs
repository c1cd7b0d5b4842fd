//! Runs a scene into a directory and prints what `parvi simulate` prints of its validation: `simulate SCENE.toml DIRECTORY`.

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use mpm_scenes::{Scene, simulate};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let (Some(scene), Some(out)) = (arguments.next(), arguments.next()) else {
        return Err("usage: simulate SCENE.toml DIRECTORY".into());
    };
    let scene = Scene::read(scene)?;
    let start = Instant::now();
    let summary = simulate(&scene, &out, &mut ())?;
    let seconds = start.elapsed().as_secs_f64();
    let updates = summary.steps_here as f64 * summary.particles as f64;
    let mut output = std::io::stdout().lock();
    writeln!(
        output,
        "{}: {} steps, {} particles, {seconds:.1} s, {:.0} ns per particle and step",
        scene.title,
        summary.steps,
        summary.particles,
        1e9 * seconds / updates
    )?;
    for row in summary.validation {
        writeln!(output, "{row:?}, passes: {}", row.passes())?;
    }
    Ok(())
}
