//! The files of a run.

use std::path::{Path, PathBuf};

use parvi_options::OptionError;

use super::Arguments;
use crate::CommandError;

/// Refuses one path in two roles; frames and pictures may share a directory, and files that are only read may be one.
pub fn check(arguments: &Arguments) -> Result<(), CommandError> {
    let options = &arguments.options;
    let files = [
        ("out", Some(arguments.out.as_path())),
        ("pool", options.pool_file(arguments.method)),
        ("best", options.best.as_deref().map(Path::new)),
        ("diagnostics", arguments.diagnostics.as_deref()),
        ("checkpoint", arguments.checkpoint.as_deref()),
        ("data", arguments.parameters.data.as_deref()),
        ("frames", arguments.frames.as_deref()),
        ("plots", arguments.plots.as_deref()),
        ("mesh", options.mesh.as_deref().map(Path::new)),
        ("start", options.start.as_deref().map(Path::new)),
        ("masses", options.masses.as_deref().map(Path::new)),
        ("volumes", options.volumes.as_deref().map(Path::new)),
        ("velocities", options.velocities.as_deref().map(Path::new)),
    ];
    let is_read = |name: &str| ["data", "mesh", "start", "masses", "volumes", "velocities"].contains(&name);
    let placed = |(name, path): (_, Option<_>)| Some((name, path?, place(path?)));
    let given: Vec<_> = files.into_iter().filter_map(placed).collect();
    for (k, (name, path, own)) in given.iter().enumerate() {
        let may_share = |other: &str| (other, *name) == ("frames", "plots") || (is_read(other) && is_read(name));
        let mut alike = given[..k].iter().filter(|(.., place)| place == own);
        if let Some((other, ..)) = alike.find(|(other, ..)| !may_share(other)) {
            return Err(OptionError::new(name, format!("{} is the file of --{other}", path.display())).into());
        }
    }
    Ok(())
}

/// A path in the one form that two spellings of it share, whether or not its file exists.
fn place(path: &Path) -> PathBuf {
    let directory = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let directory = directory.unwrap_or(Path::new(".")).canonicalize();
    match (path.canonicalize(), directory, path.file_name()) {
        (Ok(whole), _, _) => whole,
        (_, Ok(directory), Some(name)) => directory.join(name),
        _ => path.to_owned(),
    }
}
