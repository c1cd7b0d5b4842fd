//! The files of a run.

use std::path::{Path, PathBuf};

use super::Arguments;
use crate::CommandError;
use crate::options::OptionError;

/// Refuses one path in two roles; frames and pictures may share a directory, and files that are only read may be one.
pub fn check(arguments: &Arguments) -> Result<(), CommandError> {
    let files = [
        ("out", Some(&arguments.out)),
        ("pool", arguments.options.pool_file(arguments.method)),
        ("best", arguments.options.best.as_ref()),
        ("diagnostics", arguments.diagnostics.as_ref()),
        ("checkpoint", arguments.checkpoint.as_ref()),
        ("data", arguments.parameters.data.as_ref()),
        ("frames", arguments.frames.as_ref()),
        ("plots", arguments.plots.as_ref()),
        ("start", arguments.options.start.as_ref()),
        ("masses", arguments.options.masses.as_ref()),
        ("volumes", arguments.options.volumes.as_ref()),
        ("velocities", arguments.options.velocities.as_ref()),
    ];
    let is_read = |name: &str| ["data", "start", "masses", "volumes", "velocities"].contains(&name);
    let given: Vec<_> = files
        .into_iter()
        .filter_map(|(name, path)| Some((name, path?, place(path?))))
        .collect();
    for (k, (name, path, own)) in given.iter().enumerate() {
        let others = given[..k]
            .iter()
            .filter(|(other, ..)| (*other, *name) != ("frames", "plots") && !(is_read(other) && is_read(name)));
        if let Some((other, ..)) = others.into_iter().find(|(.., place)| place == own) {
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
