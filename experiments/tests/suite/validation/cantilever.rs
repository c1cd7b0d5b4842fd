//! The cantilever at rest, swinging and falling, on coarse grids.

use super::problem::{pinned, run};

const COARSE: (&str, &str) = ("spacing = 0.25", "spacing = 0.5");

#[test]
fn at_rest_it_is_timoshenkos_beam() {
    run("cantilever_static", &[COARSE]).passes_as_pinned("cantilever_static");
}

/// Euler and Bernoulli's frequency, without shear and rotary inertia, is 3 % too high for a beam five times as long as high.
#[test]
fn its_frequency_is_timoshenkos_and_not_the_slender_beams() {
    let swing = run("cantilever_frequency", &[COARSE]);
    let thick = swing.row("first frequency, Timoshenko");
    assert!(thick.passes(), "{thick:?}");
    pinned("cantilever_frequency", &thick.quantity, thick.measured);
    let slender = swing.row("first frequency, Euler-Bernoulli");
    assert!(slender.measured < 0.98 * slender.reference, "{slender:?}");
}

#[test]
fn it_falls_as_the_fine_run() {
    run("cantilever_dynamic", &[]).passes_as_pinned("cantilever_dynamic");
}
