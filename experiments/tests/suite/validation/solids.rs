//! Elastic solids: bar, disks, spinning square.

use super::problem::{pinned, run};

const SLOW: (&str, &str) = ("[0.75]", "[0.1]");

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
            changes.push(("spacing = 1.0", spacing));
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
    let spacing = |spacing: &'static str| ("spacing = 0.025", spacing);
    let flip = run("two_disks", &[spacing("spacing = 0.03125")]);
    flip.passes_as_pinned("two_disks");
    let loss = "energy lost";
    let coarse = run("two_disks", &[spacing("spacing = 0.0625")]);
    assert!(coarse.row(loss).measured > 1.5 * flip.row(loss).measured);
    let apic = [("\"flip\"", "\"apic\""), ("flip_share = 1.0\n", "")];
    let apic = run("two_disks", &[&apic[..], &[spacing("spacing = 0.0625")]].concat());
    assert!(apic.row(loss).measured > 2.0 * coarse.row(loss).measured);
    pinned("two_disks, apic", loss, apic.row(loss).measured);
}

/// 10⁴ steps; 10⁶ in docs/results/mechanics.
#[test]
fn the_spinning_square_keeps_its_momenta() {
    let end = run("spinning_square", &[]);
    assert!(
        end.rows.len() == 2 && end.rows.iter().all(|row| row.measured <= 0.01 * row.tolerance),
        "{:?}",
        end.rows
    );
}
