//! Plastic strain that is averaged: what flows has the size of its radius, and not of cells.

use mpm_scenes::{Scene, Snapshot, frames};

/// A block that is pressed between two rough plates: it gives way along bands.
pub const BLOCK: &str = r#"
title = "softening block"
dimension = 2
domain = { lower = [0.0, 0.0], upper = [3.0, 2.4] }
grid = { spacing = SPACING }
transfer = { kind = "apic" }
time = { end = 6.0, courant = 0.4 }
bodies = [{ name = "block", material = "soft", shape = { kind = "box", lower = [1.0, 0.2], upper = [2.0, 2.2] } }]
held = [
    { shape = { kind = "box", lower = [0.0, 0.0], upper = [3.0, 0.25] }, velocity = [0.0, 0.0] },
    { shape = { kind = "box", lower = [0.0, 2.15], upper = [3.0, 2.4] }, velocity = [0.0, -0.03] },
]
output = { interval = 6.0 }
materials.soft = { law = "softening-hencky", density = 1.0, young_modulus = 1.0, poisson_ratio = 0.3, peak_yield_stress = 0.02, residual_yield_stress = 0.004, softening_rate = 20.0 RADIUS }
"#;

fn last(spacing: &str, radius: &str) -> Snapshot {
    let text = BLOCK.replace("SPACING", spacing).replace("RADIUS", radius);
    let scene = Scene::parse(&text, "block.toml".as_ref()).expect("a scene");
    let mut last = Snapshot::default();
    frames(&scene, &mut |snapshot| last = snapshot).expect("a run");
    last
}

/// (Σ V q)² / Σ V q²: the area of what has flowed.
fn area(frame: &Snapshot) -> f64 {
    let known = frame.scalars.iter().find(|(name, _)| name == "plastic_strain");
    let flowed = &known.expect("plasticity").1;
    let volume = frame.reference_volumes[0];
    let sum: f64 = flowed.iter().map(|q| volume * q).sum();
    sum * sum / flowed.iter().map(|q| volume * q * q).sum::<f64>()
}

/// 1.00 and 0.57 without a radius; 1.81 and 1.84, of an area of 2, with one.
#[test]
fn a_softening_block_flows_where_cells_say_or_the_radius() {
    let over_finer = |radius: &str| area(&last("0.1", radius)) / area(&last("0.05", radius));
    assert!(over_finer("") > 1.6);
    assert!((over_finer(", nonlocal_radius = 0.4") - 1.0).abs() < 0.03);
}

#[test]
fn a_radius_that_is_none_is_refused() {
    for radius in ["0.0", "-1.0", "nan", "inf"] {
        let text = BLOCK
            .replace("SPACING", "0.1")
            .replace("RADIUS", &format!(", nonlocal_radius = {radius}"));
        let error = Scene::parse(&text, "block.toml".as_ref())
            .expect_err("no radius")
            .to_string();
        assert!(error.contains("materials.soft.nonlocal_radius"), "{error}");
    }
}
