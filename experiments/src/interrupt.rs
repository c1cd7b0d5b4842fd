//! Ctrl-C: a flag that samplers and studies look at between steps and cases.

use std::sync::atomic::{AtomicBool, Ordering};

static REQUESTED: AtomicBool = AtomicBool::new(false);

/// The exit code of an interrupted command, 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// Turns the first Ctrl-C (or SIGTERM) into a request to stop; the second one ends the process at once.
///
/// Does nothing when a handler is already in place.
pub fn listen() {
    // A process whose signals cannot be caught is ended by them, and every file it leaves is whole anyway.
    let _ = ctrlc::set_handler(|| {
        if REQUESTED.swap(true, Ordering::SeqCst) {
            std::process::exit(i32::from(EXIT_CODE));
        }
    });
}

/// Whether a stop was requested.
pub fn requested() -> bool {
    REQUESTED.load(Ordering::SeqCst)
}
