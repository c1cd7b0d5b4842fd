//! The memory of a run, measured in a process of its own, where no allocator has kept memory from earlier runs.

use std::path::Path;
use std::process::{Command, Stdio};

use parvi::Run;

use crate::machine::PEAK_MEMORY_KEY;
use crate::options::{MethodSpecification, TargetSpecification};

/// Runs `parvi sample` with the same settings and reads its peak; `None` where the system does not tell.
pub fn peak_of_own_process(
    target: &TargetSpecification,
    method: &MethodSpecification,
    run: &Run,
    threads: Option<usize>,
) -> Option<u64> {
    let program = std::env::current_exe().ok()?;
    let name = format!("parvi-memory-{}.npy", std::process::id());
    let out = std::env::temp_dir().join(name);
    let mut command = Command::new(program);
    command
        .arg("sample")
        .args(["--target", &target.name, "--method", method.name.as_str()]);
    if let Some(dim) = target.dim {
        command.args(["--dim", &dim.to_string()]);
    }
    command.args([
        "--particles",
        &run.particles.to_string(),
        "--seed",
        &run.seed.to_string(),
    ]);
    command.args(method.options.flags());
    if let Some(threads) = threads {
        command.env("RAYON_NUM_THREADS", threads.to_string());
    }
    let peak = peak_of(command.arg("--out").arg(&out));
    remove(&out);
    peak
}

fn peak_of(command: &mut Command) -> Option<u64> {
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output().ok()?;
    let text = String::from_utf8(output.stdout).ok()?;
    let value = text
        .lines()
        .find_map(|line| line.strip_prefix(PEAK_MEMORY_KEY)?.strip_prefix('='))?;
    value.parse().ok()
}

fn remove(file: &Path) {
    // A run that was stopped has left none.
    let _ = std::fs::remove_file(file);
}
