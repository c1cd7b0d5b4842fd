//! Records what the binary was built from: commit, dirty flag and compiler.

use std::path::Path;
use std::process::Command;

/// The first line that a program prints, if it runs and succeeds.
fn output(program: &str, arguments: &[&str]) -> Option<String> {
    let result = Command::new(program).args(arguments).output().ok()?;
    result
        .status
        .success()
        .then(|| String::from_utf8_lossy(&result.stdout).trim().to_owned())
}

fn main() {
    let sources = [
        "../crates",
        "../experiments/src",
        "../experiments/build.rs",
        "../Cargo.toml",
        "../Cargo.lock",
    ];
    for source in sources {
        emit(&format!("rerun-if-changed={source}"));
    }
    // Commits move HEAD's log without touching a source file.
    if let Some(log) = output("git", &["rev-parse", "--git-path", "logs/HEAD"])
        && Path::new(&log).exists()
    {
        emit(&format!("rerun-if-changed={log}"));
    }
    let commit = output("git", &["rev-parse", "HEAD"]).unwrap_or_default();
    let mut status = vec!["--no-optional-locks", "status", "--porcelain", "--"];
    status.extend(sources);
    let dirty = output("git", &status)
        .map(|changes| (!changes.is_empty()).to_string())
        .unwrap_or_default();
    let compiler = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let version = output(&compiler, &["--version"]).unwrap_or_default();
    emit(&format!("rustc-env=PARVI_COMMIT={commit}"));
    emit(&format!("rustc-env=PARVI_DIRTY={dirty}"));
    emit(&format!("rustc-env=PARVI_RUSTC={version}"));
}

/// One instruction to cargo, which reads them from standard output.
fn emit(instruction: &str) {
    use std::io::Write;
    // A closed pipe means that cargo is gone: nothing is left to tell.
    let _ = writeln!(std::io::stdout(), "cargo:{instruction}");
}
