//! The problems of Cao et al. (2024) on meshes, shortened and coarse; whole ones in docs/results/umls.

use super::problem::{Finished, pinned, run};

/// The figures that a coarse run has, whether they are within the tolerances of the whole one or not.
fn figures(finished: &Finished, problem: &str) {
    assert!(!finished.rows.is_empty());
    for row in &finished.rows {
        pinned(problem, &row.quantity, row.measured);
    }
}

#[test]
fn the_bar_converges_with_second_order() {
    let size = |size: &str| run("umls_bar", &[("size = 1.0", &format!("size = {size}"))]);
    let coarse = size("2.0");
    figures(&coarse, "umls_bar, 2.0");
    let (middle, fine) = (size("1.0"), size("0.5"));
    middle.passes_as_pinned("umls_bar, 1.0");
    fine.passes_as_pinned("umls_bar, 0.5");
    let errors = [coarse, middle, fine].map(|run| run.row("error of the centre").measured);
    for pair in errors.windows(2) {
        assert!((1.8..2.2).contains(&(pair[0] / pair[1]).log2()), "{errors:?}");
    }
}

/// 2000 steps of 10⁶; a hundredth of what they may drift.
#[test]
fn the_square_keeps_its_momenta() {
    let changes = [
        ("end = 1.0", "end = 0.02"),
        ("\ninterval = 0.1", "\ninterval = 0.02"),
        ("size = 0.01", "size = 0.02"),
    ];
    let end = run("umls_square", &changes);
    assert!(
        end.rows.len() == 2 && end.rows.iter().all(|row| row.measured <= 0.01 * row.tolerance),
        "{:?}",
        end.rows
    );
}

#[test]
fn the_disks_rebound() {
    figures(
        &run(
            "umls_disks",
            &[
                ("size = 0.025", "size = 0.0625"),
                ("spacing = 0.025", "spacing = 0.0625"),
                ("courant = 0.2", "courant = 0.4"),
            ],
        ),
        "umls_disks, 0.0625",
    );
}

/// The scheme knows no direction: turning beam and mesh turns the motion, but for gravity, which the references follow.
#[test]
fn the_cantilever_swings_alike_at_all_angles() {
    let coarse = [
        ("size = 0.5", "size = 1.0"),
        ("spacing = 0.0625", "spacing = 0.25"),
        ("courant = 0.3", "courant = 0.6"),
    ];
    figures(&run("umls_cantilever", &coarse), "umls_cantilever, 1.0");
}

#[test]
fn the_ball_falls_into_the_channel() {
    let changes = [
        ("size = 0.05", "size = 0.4"),
        ("particles = 4735", "particles = 250"),
        ("end = 6.5", "end = 1.5"),
    ];
    let squeezed = run("umls_channel", &changes);
    assert!(squeezed.row("energy gained").passes());
    assert_eq!(squeezed.row("particles lost").measured, 0.0);
    pinned(
        "umls_channel, 0.4",
        "centre_y",
        squeezed.column("centre_y").last().copied().unwrap_or(f64::NAN),
    );
}

#[test]
fn the_slope_begins_to_fail() {
    // The rate of a grid: what is pinned is the run, not how far it goes.
    let changes = [
        ("size = 0.2", "size = 1.0"),
        ("spacing = 0.1", "spacing = 0.5"),
        ("softening_rate = 5.85", "softening_rate = 25.0"),
        ("end = 3.0", "end = 2.0"),
    ];
    figures(&run("umls_slope", &changes), "umls_slope, 1.0");
}

#[test]
fn the_cross_expands_inside_the_sphere() {
    let changes = [
        ("end = 1.5", "end = 5e-4"),
        ("\ninterval = 0.1", "\ninterval = 5e-4"),
        ("series_interval = 0.01", "series_interval = 1e-4"),
        ("size = 0.1", "size = 0.125"),
    ];
    let expanded = run("umls_expansion", &changes);
    figures(&expanded, "umls_expansion, 0.125");
    let strain = expanded.column("strain_energy");
    pinned(
        "umls_expansion, 0.125",
        "strain_energy",
        strain.last().copied().unwrap_or(f64::NAN),
    );
    let upper = expanded.column("upper_x");
    assert!(
        upper.iter().all(|&x| x < 0.5) && upper.last() > upper.first(),
        "{upper:?}"
    );
}

/// Tractions on tagged facets of a curved boundary that the mesh conforms to: within 2 % of Lamé's displacements. Stresses of single particles are not (docs/results/umls).
#[test]
fn the_cylinder_widens_under_pressure() {
    // Loaded and at rest sooner, in longer steps.
    let changes = [
        ("ramp = 1.0", "ramp = 0.12"),
        ("end = 2.0", "end = 0.36"),
        ("damping = 20.0", "damping = 40.0"),
        ("courant = 0.4", "courant = 0.8"),
    ];
    let finished = run("umls_cylinder", &changes);
    assert!(finished.row("error of displacements").passes(), "{:?}", finished.rows);
    figures(&finished, "umls_cylinder");
}

/// The same on a mesh graded 1 : 8, with exact gradients and particles that integrate in its triangles: stresses of single particles as well.
#[test]
fn the_hole_in_a_graded_mesh_widens_under_pressure() {
    let changes = [
        ("ramp = 0.5", "ramp = 0.06"),
        ("end = 1.0", "end = 0.12"),
        ("damping = 20.0", "damping = 40.0"),
        ("courant = 0.4", "courant = 0.8"),
        ("series_interval = 0.1", "series_interval = 0.02"),
    ];
    run("umls_graded", &changes).passes_as_pinned("umls_graded");
}

/// Tension in a wide plate with a hole, half as wide and with edges twice as long as the committed one: displacements and stresses beside Kirsch's solution, and the stress concentration as it is there.
#[test]
fn the_hole_concentrates_stress() {
    let changes = [
        ("20.0", "10.0"),
        ("size = 4.0", "size = 2.0"),
        ("size = 0.1,", "size = 0.2,"),
        ("ramp = 3.0", "ramp = 0.6"),
        ("end = 6.0", "end = 1.6"),
        ("\ninterval = 6.0", "\ninterval = 1.6"),
        ("damping = 4.0", "damping = 8.0"),
    ];
    let finished = run("umls_plate_with_hole", &changes);
    let errors = finished.rows.iter().filter(|row| row.quantity.starts_with("error"));
    assert!(
        errors.clone().count() == 3 && errors.clone().all(|row| row.passes()),
        "{:?}",
        finished.rows
    );
    figures(&finished, "umls_plate_with_hole");
}
