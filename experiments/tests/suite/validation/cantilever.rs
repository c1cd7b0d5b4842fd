//! The cantilever at rest, swinging and falling, on coarse grids and with long steps; as committed in docs/results/mechanics.

use super::problem::{pinned, run};

const COARSE: (&str, &str) = ("spacing = 0.25", "spacing = 0.5");
const LONG_STEPS: (&str, &str) = ("courant = 0.3", "courant = 0.6");

#[test]
fn at_rest_it_is_timoshenkos_beam() {
    let soon = ("end = 4.0", "end = 2.0");
    run("cantilever_static", &[COARSE, LONG_STEPS, soon]).passes_as_pinned("cantilever_static");
}

/// Euler and Bernoulli's frequency, without shear and rotary inertia, is 3 % too high for a beam five times as long as high.
#[test]
fn its_frequency_is_timoshenkos_and_not_the_slender_beams() {
    let two_swings = ("end = 6.0", "end = 3.0");
    let swing = run("cantilever_frequency", &[COARSE, LONG_STEPS, two_swings]);
    let thick = swing.row("first frequency, Timoshenko");
    assert!(thick.passes(), "{thick:?}");
    pinned("cantilever_frequency", &thick.quantity, thick.measured);
    let slender = swing.row("first frequency, Euler-Bernoulli");
    assert!(slender.measured < 0.98 * slender.reference, "{slender:?}");
}

#[test]
fn it_falls_as_the_fine_run() {
    let coarse = ("spacing = 0.25", "spacing = 0.3333333333333333");
    run("cantilever_dynamic", &[coarse, ("courant = 0.3", "courant = 0.8")]).passes_as_pinned("cantilever_dynamic");
}
