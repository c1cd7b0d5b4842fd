//! Elastic solids: bar, disks, spinning square.

use super::problem::{pinned, run};

const SLOW: (&str, &str) = ("[0.75]", "[0.1]");
const LONG_STEPS: (&str, &str) = ("courant = 0.2", "courant = 0.4");

#[test]
fn the_bar_swings_as_the_exact_solution_at_both_speeds() {
    run("vibrating_bar", &[]).passes_as_pinned("vibrating_bar");
    run("vibrating_bar", &[SLOW]).passes_as_pinned("vibrating_bar, slow");
}

#[test]
fn the_bar_converges_with_second_order() {
    for changes in [
        vec![],
        vec![SLOW],
        vec![("\"flip\"", "\"apic\""), ("flip_share = 1.0\n", "")],
    ] {
        let error = |spacing: &str| {
            let mut changes = changes.clone();
            changes.extend([("spacing = 1.0", spacing), LONG_STEPS]);
            run("vibrating_bar", &changes).row("error").measured
        };
        let errors = ["spacing = 1.0", "spacing = 0.5", "spacing = 0.25"].map(error);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.8..2.3).contains(&order), "{errors:?}");
        }
    }
}

#[test]
fn the_disks_rebound_and_flip_loses_little() {
    let flip = run("two_disks", &[("spacing = 0.025", "spacing = 0.03125")]);
    flip.passes_as_pinned("two_disks");
    let loss = "energy lost";
    let coarse = [("spacing = 0.025", "spacing = 0.0625"), LONG_STEPS];
    let apic = [("\"flip\"", "\"apic\""), ("flip_share = 1.0\n", "")];
    let apic = run("two_disks", &[apic, coarse].concat());
    let coarse = run("two_disks", &coarse);
    assert!(coarse.row(loss).measured > 1.5 * flip.row(loss).measured);
    assert!(apic.row(loss).measured > 2.0 * coarse.row(loss).measured);
    pinned("two_disks, apic", loss, apic.row(loss).measured);
}

/// 4000 steps; 10⁶ in docs/results/mechanics.
#[test]
fn the_spinning_square_keeps_its_momenta() {
    let end = run("spinning_square", &[("end = 65.0", "end = 24.0")]);
    assert!(
        end.rows.len() == 2 && end.rows.iter().all(|row| row.measured <= 0.01 * row.tolerance),
        "{:?}",
        end.rows
    );
}

/// Hertz's contact, two spacings to its half-width, where particles follow the surface; a lattice stands on its lowest row.
#[test]
fn the_cylinder_is_flattened_as_by_hertz() {
    let filled = |spacing: &str, fill: &str| {
        let changes = [
            ("spacing = 0.02", spacing),
            ("gravity_ramp = 0.5", "gravity_ramp = 0.3"),
            ("end = 1.0", "end = 0.6"),
            ("\ninterval = 1.0", "\ninterval = 0.6"),
            ("\"vertices\"", fill),
        ];
        run("hertz_cylinder", &changes)
    };
    let coarse = filled("spacing = 0.05", "\"vertices\"");
    for name in ["half-width", "error of stresses near", "error of stresses above"] {
        assert!(coarse.row(name).passes(), "{:?}", coarse.rows);
    }
    for row in &coarse.rows {
        pinned("hertz_cylinder, 0.05", &row.quantity, row.measured);
    }
    let on_a_lattice = filled("spacing = 0.1", "\"regular\"").row("half-width").measured;
    assert!(on_a_lattice > 1.8, "{on_a_lattice}");
}
