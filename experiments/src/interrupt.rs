//! Ctrl-C: a flag that samplers and studies look at between steps and cases.

use std::sync::atomic::{AtomicBool, Ordering};

use crate::console;

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// Whether a stop has to wait for a step, a case or a file to be finished.
static BEGUN: AtomicBool = AtomicBool::new(false);

/// The exit code of an interrupted command, 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// Turns the first Ctrl-C (or SIGTERM) into a request to stop, and says so; the second one ends the process at once.
///
/// Does nothing when a handler is already in place.
pub fn listen() {
    BEGUN.store(true, Ordering::SeqCst);
    listen_once_begun();
}

/// As [`listen`], but until requests are looked at for the first time a single one ends the process at once: nothing is lost before the first step, and filling bodies or making a mesh can take long.
pub fn listen_once_begun() {
    // A process whose signals cannot be caught is ended by them, and every file it leaves is whole anyway.
    let _ = ctrlc::set_handler(|| {
        if !BEGUN.load(Ordering::SeqCst) || REQUESTED.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(EXIT_CODE));
        }
        console::notice("stopping after the step or run at hand; a second signal ends it at once");
    });
}

/// Whether a stop was requested.
pub fn requested() -> bool {
    BEGUN.store(true, Ordering::SeqCst);
    REQUESTED.load(Ordering::SeqCst)
}
