//! Averaged volumes take away locking, and leave a body at rest its pressure where their changes are averaged.

use mpm_scenes::{Scene, Snapshot, frames};

const COLUMN: &str = r#"
title = "column under its weight"
dimension = 1
gravity = [-2.0]
gravity_ramp = 1.0
domain = { lower = [0.0], upper = [2.0] }
grid = { spacing = 0.1 }
time = { end = 20.0, damping = 5.0, step = 0.001 }
materials.soft = { law = "neo-hookean", density = 1000.0, young_modulus = 1e5, poisson_ratio = 0.3 }
bodies = [{ name = "column", material = "soft", shape = { kind = "box", lower = [0.0], upper = [1.0] } }]
walls = [{ axis = "x", side = "lower", condition = "slip" }]
output = { interval = 20.0 }
"#;

/// A cantilever two cells thick, of a nearly incompressible material.
const BEAM: &str = r#"
title = "cantilever under its weight"
dimension = 2
gravity = [0.0, -0.01]
gravity_ramp = 8.0
domain = { lower = [0.0, 0.0], upper = [5.0, 2.0] }
grid = { spacing = 0.25 }
time = { end = 20.0, damping = 2.0, step = 0.0005 }
materials.soft = { law = "neo-hookean", density = 1000.0, young_modulus = 1e6, poisson_ratio = 0.49 }
bodies = [{ name = "beam", material = "soft", shape = { kind = "box", lower = [0.0, 1.0], upper = [4.0, 1.5] } }]
walls = [{ axis = "x", side = "lower", condition = "fixed" }]
output = { interval = 20.0 }
"#;

/// The last frame of a scene with such averaging.
fn last(scene: &str, averaging: &str) -> Snapshot {
    let text = scene.replace("domain =", &format!("volume_averaging = {averaging}\ndomain ="));
    let scene = Scene::parse(&text, "scene.toml".as_ref()).expect("a scene");
    let mut last = Snapshot::default();
    frames(&scene, &mut |snapshot| last = snapshot).expect("a run");
    last
}

/// p = ρ g (1 − X) over the reference height: the weight above.
#[test]
fn a_column_at_rest_keeps_its_pressure() {
    let pressure_at = |averaging: &str, height: f64| {
        let frame = last(COLUMN, averaging);
        let of = |x: f64| (x - height).abs();
        let nearest = (0..frame.reference_positions.len())
            .min_by(|&a, &b| of(frame.reference_positions[a]).total_cmp(&of(frame.reference_positions[b])));
        let particle = nearest.expect("particles");
        -frame.stresses[particle] / (2000.0 * (1.0 - frame.reference_positions[particle]))
    };
    for height in [0.25, 0.5] {
        let changes = pressure_at("\"changes\"", height);
        assert!((changes - 1.0).abs() < 0.03, "{changes} at {height}");
    }
    // The ratios are averaged until nothing is left of their gradient.
    let slope = |averaging| 0.75 * pressure_at(averaging, 0.25) - 0.25 * pressure_at(averaging, 0.75);
    assert!((slope("\"changes\"") - 0.5).abs() < 0.03 && slope("true") < 0.1);
}

/// The deflection of the end over that of a Timoshenko beam in plane strain, q L⁴/(8 E' I) + q L²/(2 κ G A) with E' = E/(1 − ν²), κ = 5/6.
fn deflection(poisson_ratio: f64, averaging: &str) -> f64 {
    let scene = BEAM.replace("poisson_ratio = 0.49", &format!("poisson_ratio = {poisson_ratio}"));
    let frame = last(&scene, averaging);
    let pairs = frame
        .reference_positions
        .chunks_exact(2)
        .zip(frame.positions.chunks_exact(2));
    let end: Vec<f64> = pairs
        .filter(|(start, _)| start[0] > 3.9)
        .map(|(start, x)| start[1] - x[1])
        .collect();
    let (load, length, height) = (5.0, 4.0, 0.5_f64);
    let bending = 1e6 / (1.0 - poisson_ratio * poisson_ratio) * height.powi(3) / 12.0;
    let shearing = 5.0 / 6.0 * 1e6 / (2.0 + 2.0 * poisson_ratio) * height;
    let theory = load * length * length * (length * length / (8.0 * bending) + 1.0 / (2.0 * shearing));
    end.iter().sum::<f64>() / end.len() as f64 / theory
}

/// Compressible beams of two cells are softened.
#[test]
fn a_nearly_incompressible_cantilever_does_not_lock() {
    let (locked, averaged) = (deflection(0.49, "false"), deflection(0.49, "\"changes\""));
    assert!(locked < 0.94, "{locked}");
    assert!((averaged - 1.0).abs() < 0.04, "{averaged}");
    let (compressible, softened) = (deflection(0.3, "false"), deflection(0.3, "\"changes\""));
    assert!((compressible - 1.0).abs() < 0.05, "{compressible}");
    assert!((softened - 1.25).abs() < 0.07, "{softened}");
}

/// Water at rest under its weight, between walls.
const WATER: &str = r#"
title = "water at rest"
dimension = 2
materials.water = { law = "tait-fluid", density = 1000.0, sound_speed = 30.0, viscosity = 1.0 }
bodies = [{ name = "water", material = "water", shape = { kind = "box", lower = [0.0, 0.0], upper = [1.0, 1.0] } }]
gravity = [0.0, -10.0]
gravity_ramp = 0.5
domain = { lower = [0.0, 0.0], upper = [1.0, 1.5] }
grid = { spacing = 0.1 }
transfer = { kind = "flip", flip_share = 1.0 }
time = { end = 2.0 }
walls = [
    { axis = "x", side = "lower", condition = "slip" },
    { axis = "x", side = "upper", condition = "slip" },
    { axis = "y", side = "lower", condition = "slip" },
]
output = { interval = 2.0 }
"#;

/// Particles are sheared by noise, each differently: that must not make ripples of a volume that all have lost. In water nothing else holds particles' volumes against each other; the soft
/// and nearly incompressible solid is damped.
#[test]
fn averaged_changes_leave_what_rests_at_rest() {
    let flip = "kind = \"flip\", flip_share = 1.0";
    let water = "law = \"tait-fluid\", density = 1000.0, sound_speed = 30.0, viscosity = 1.0";
    let soft = "law = \"neo-hookean\", density = 1000.0, young_modulus = 5e3, poisson_ratio = 0.49";
    let solid = WATER
        .replace(water, soft)
        .replace("end = 2.0", "end = 2.0, damping = 20.0");
    let transfers = [
        flip,
        "kind = \"flip\", pic_rate = 5.0",
        "kind = \"flip\", flip_share = 0.99",
        "kind = \"apic\"",
        "kind = \"mls\"",
    ];
    let fluids = transfers.map(|transfer| WATER.replace(flip, transfer));
    for scene in fluids.into_iter().chain([solid]) {
        let frame = last(&scene, "\"changes\"");
        let squares = frame.velocities.chunks_exact(2).map(|v| v[0] * v[0] + v[1] * v[1]);
        let energies = squares.zip(&frame.masses).map(|(square, mass)| 0.5 * mass * square);
        let energy: f64 = energies.sum();
        assert!(energy < 0.2, "{energy} J: {scene}");
        // Over the pressure at the bottom.
        let stresses = frame.stresses.chunks_exact(4).map(|stress| stress[3] / 1e4);
        let places = frame.reference_positions.chunks_exact(2);
        let errors = stresses
            .zip(places)
            .map(|(stress, start)| (stress + 1.0 - start[1]).abs());
        let largest = errors.fold(0.0, f64::max);
        assert!(largest < 0.08, "{largest}: {scene}");
    }
}
