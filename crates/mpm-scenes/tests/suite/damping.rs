//! Damping acts on all forces alike: bodies that come to rest are in balance, however long the steps.

use mpm_scenes::{Scene, Series, Snapshot, frames};

use super::scenes::series_of;

/// γΔt is 0.2 here and 0.15 below: what is not damped like the rest is off by as much.
const COLUMN: &str = r#"
title = "a column under pressure"
dimension = 2
transfer = { kind = "TRANSFER" }
time = { end = 0.5, step = 1e-3, damping = 200.0 }
materials.rubber = { law = "neo-hookean", density = 100.0, young_modulus = 1e5, poisson_ratio = 0.3 }
facets = [{ group = "boundary", condition = "traction", pressure = 1.0, ramp = 0.1 }]
probes = [{ name = "all", region = { kind = "box", lower = [0.0, 0.0], upper = [0.5, 1.0] } }]
output = { interval = 0.5, series_interval = 0.01, energy_budget = true }

[mesh]
generate = { kind = "rectangle", lower = [0.0, 0.0], upper = [0.5, 1.0], size = 0.25 }
kernel = "hat"

[[bodies]]
name = "column"
material = "rubber"
shape = { kind = "box", lower = [0.0, 0.0], upper = [0.5, 1.0] }
fill = "cells"
"#;

const BLOCK: &str = r#"
title = "a block on a floor"
dimension = 2
gravity = [PULL, -1.0]
gravity_ramp = 0.5
domain = { lower = [-2.0, -1.0], upper = [2.0, 2.0] }
grid = { spacing = 0.2 }
time = { end = 4.0, step = 5e-3, damping = 30.0 }
materials.rubber = { law = "neo-hookean", density = 1.0, young_modulus = 100.0, poisson_ratio = 0.0 }
output = { interval = 4.0, series_interval = 0.1, energy_budget = true }

[transfer]
kind = "TRANSFER"

[[bodies]]
name = "block"
material = "rubber"
shape = { kind = "box", lower = [-0.5, 0.0], upper = [0.5, 1.0] }

[barrier]
shapes = [{ kind = "half-space", point = [0.0, -0.02], normal = [0.0, 1.0] }]
stiffness = 1e4
gap = 0.05
friction = ROUGHNESS
integration = "INTEGRATION"
"#;

fn block(transfer: &str, integration: &str, [pull, roughness]: [f64; 2]) -> String {
    BLOCK
        .replace("TRANSFER", transfer)
        .replace("INTEGRATION", integration)
        .replace("PULL", &format!("{pull:?}"))
        .replace("ROUGHNESS", &format!("{roughness:?}"))
}

fn last(series: &Series, name: &str) -> f64 {
    let values = series.column(name).expect("a column");
    values[values.len() - 1]
}

/// The books close, and damping takes energy in every interval of the series.
fn damping_takes(series: &Series) {
    let (total, taken) = ("energy_balance", "damping_dissipation");
    let [total, taken] = [total, taken].map(|name: &str| series.column(name).expect("a budget"));
    let drift = total.iter().map(|now| (now - total[0]).abs()).fold(0.0, f64::max);
    assert!(taken.is_sorted() && taken[taken.len() - 1] > 0.0, "{taken:?}");
    assert!(drift < 1e-9 * taken[taken.len() - 1], "{drift}");
}

/// σ = −p 1; it was −p e^(γΔt) 1 if tractions were not damped.
#[test]
fn a_damped_column_under_pressure_has_the_stress_of_the_pressure() {
    for transfer in ["apic", "flip"] {
        let series = series_of(&COLUMN.replace("TRANSFER", transfer));
        for (stress, exact) in [("xx", -1.0), ("yy", -1.0), ("xy", 0.0)] {
            let stress = last(&series, &format!("all_stress_{stress}"));
            assert!((stress - exact).abs() < 1e-3, "{transfer}: {stress}, not {exact}");
        }
        damping_takes(&series);
    }
}

#[test]
fn a_damped_block_presses_on_the_floor_with_its_weight() {
    for (transfer, integration) in [("apic", "implicit"), ("flip", "implicit"), ("apic", "explicit")] {
        let text = block(transfer, integration, [0.0, 0.0]);
        let scene = Scene::parse(&text, std::path::Path::new("block.toml")).expect("a scene");
        let mut end = Snapshot::default();
        frames(&scene, &mut |snapshot| end = snapshot).expect("a run");
        let forces = end.scalars.iter().find(|(name, _)| name == "contact_force");
        let force = forces.expect("a barrier").1.iter().sum::<f64>();
        assert!((force - 1.0).abs() < 1e-3, "{transfer}, {integration}: {force}");
        damping_takes(&series_of(&text));
    }
}

/// At its last speed what pulls is what rubs and what is damped: v = e^(−γΔt) (v + Δt (g_x − μ g_y)). An explicit barrier has steps of its own, below 5 ms.
#[test]
fn a_damped_block_slides_at_the_speed_of_its_friction() {
    let (pull, roughness, step, rate) = (0.5, 0.3, 5e-3, 30.0);
    let exact = step * (pull - roughness) / f64::exp_m1(rate * step);
    let of_short_steps = (pull - roughness) / rate;
    for (integration, most) in [("implicit", 1.001 * exact), ("explicit", of_short_steps)] {
        let series = series_of(&block("apic", integration, [pull, roughness]));
        let speed = last(&series, "momentum_x");
        assert!(
            (0.999 * exact..most).contains(&speed),
            "{integration}: {speed}, not {exact} to {most}"
        );
    }
}
