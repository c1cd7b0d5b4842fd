//! The memory of a run, measured in a process of its own, where no allocator has kept memory from earlier runs.

use std::process::{Command, Stdio};

use parvi_options::MethodSpecification;

use crate::machine::PEAK_MEMORY_KEY;
use crate::study::sampled::Sampled;

/// Runs `parvi sample` with the same settings and reads its peak; `None` where the system does not tell.
pub fn peak_of_own_process(work: &Sampled, method: &MethodSpecification, threads: Option<usize>) -> Option<u64> {
    let Sampled { target, run, .. } = work;
    let out = std::env::temp_dir().join(format!("parvi-memory-{}.npy", std::process::id()));
    let mut command = Command::new(std::env::current_exe().ok()?);
    command.args(["sample", "--target", &target.name, "--method", method.name.as_str()]);
    command.args(target.dim.iter().flat_map(|dim| ["--dim".to_owned(), dim.to_string()]));
    command.args([
        "--particles",
        &run.particles.to_string(),
        "--seed",
        &run.seed.to_string(),
    ]);
    command.args(method.options.flags()).arg("--out").arg(&out);
    command.envs(threads.map(|threads| ("RAYON_NUM_THREADS", threads.to_string())));
    let output = command.stdin(Stdio::null()).stderr(Stdio::null()).output();
    // A run that was stopped has left none.
    let _ = std::fs::remove_file(&out);
    let text = String::from_utf8(output.ok()?.stdout).ok()?;
    let mut lines = text.lines();
    let value = lines.find_map(|line| line.strip_prefix(PEAK_MEMORY_KEY)?.strip_prefix('='))?;
    value.parse().ok()
}
