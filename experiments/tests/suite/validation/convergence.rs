//! Manufactured solutions: orders of convergence.

use mpm_scenes::reference::convergence;

use super::problem::{pinned, run};

/// A manufactured solution: its scene, and the line of it that says when it ends, after one period.
type Problem = (&'static str, &'static str, f64);

const AXIS_ALIGNED: Problem = ("manufactured_axis_aligned", "end = 0.5451", 0.5451);
const VORTEX: Problem = ("generalized_vortex", "end = 1.0", 1.0);

/// Largest error at the quarters of the period, for each spacing, and the orders between them. A single time would not do: the
/// error swings with the body and passes zero.
fn study((name, end, period): Problem, basis: &str, spacings: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let basis = format!("basis = {basis:?}");
    let error = |spacing: f64, quarter: f64| {
        let (spacing, time) = (
            format!("spacing = {spacing}"),
            format!("end = {}", 0.25 * quarter * period),
        );
        let changes = [
            ("spacing = 0.03125", spacing.as_str()),
            ("basis = \"cubic\"", basis.as_str()),
            (end, time.as_str()),
        ];
        run(name, &changes).row("L2 error").measured
    };
    let worst = |&spacing: &f64| {
        let quarters = [1.0, 2.0, 3.0, 4.0].map(|quarter| error(spacing, quarter));
        (spacing, quarters.into_iter().fold(0.0, f64::max))
    };
    let errors: Vec<(f64, f64)> = spacings.iter().map(worst).collect();
    let orders = convergence::orders(&errors);
    (errors.into_iter().map(|(_, error)| error).collect(), orders)
}

fn is_of_second_order(problem: Problem, basis: &str) {
    let (errors, orders) = study(problem, basis, &[0.125, 0.0625, 0.03125]);
    let name = problem.0;
    assert!(
        orders.iter().all(|&order| order > 1.8),
        "{name} {basis}: {errors:?} {orders:?}"
    );
    pinned(name, &format!("{basis}, h = 1/32"), errors[2]);
}

#[test]
fn quadratic_splines_are_of_second_order_along_the_axes() {
    is_of_second_order(AXIS_ALIGNED, "quadratic");
}

#[test]
fn cubic_splines_are_of_second_order_along_the_axes() {
    is_of_second_order(AXIS_ALIGNED, "cubic");
}

#[test]
fn quadratic_splines_are_of_second_order_in_a_vortex() {
    is_of_second_order(VORTEX, "quadratic");
}

#[test]
fn cubic_splines_are_of_second_order_in_a_vortex() {
    is_of_second_order(VORTEX, "cubic");
}

/// Its gradient jumps at every face, so crossing particles kick.
#[test]
fn hat_functions_stall() {
    let (errors, _) = study(AXIS_ALIGNED, "linear", &[0.125, 0.0625, 0.03125]);
    let (smooth, _) = study(AXIS_ALIGNED, "cubic", &[0.03125]);
    assert!(
        errors[2] > 0.5 * errors[1] && errors[2] > 5.0 * smooth[0],
        "{errors:?} {smooth:?}"
    );
}
