//! Small runs in one, two and three dimensions.

use std::path::Path;

use mpm_scenes::output::read_series;
use mpm_scenes::{Outcome, Scene, Series, Snapshot, Summary, frames, simulate};

use super::scenes::{BAR, BLOCK, CUBE, HEAPS, scene};

/// Runs a scene; its summary and series as a reader of the files gets it.
fn run(scene: &Scene, directory: &Path) -> (Summary, Series) {
    let summary = simulate(scene, directory, &mut ()).expect("runs");
    let series = read_series(directory).expect("written");
    (summary, series)
}

fn column(series: &Series, name: &str) -> Vec<f64> {
    series
        .column(name)
        .unwrap_or_else(|| panic!("{name} in {:?}", series.columns()))
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

#[test]
fn a_bar_swings_and_keeps_its_energy() {
    let directory = tempfile::tempdir().expect("a directory");
    let (summary, series) = run(&scene(BAR), directory.path());
    assert_eq!(
        (summary.outcome, summary.time, summary.particles),
        (Outcome::Finished, 2.0, 20)
    );
    assert_eq!(summary.steps, summary.steps_here);
    let times = column(&series, "time");
    assert_eq!(times.len(), 21);
    assert!(
        times
            .iter()
            .enumerate()
            .all(|(k, &time)| (time - 0.1 * k as f64).abs() < 1e-15)
    );
    let (kinetic, strain) = (column(&series, "kinetic_energy"), column(&series, "strain_energy"));
    let start = kinetic[0] + strain[0];
    assert!((start - 0.25 * 0.1 * 0.1 * 10.0).abs() < 2e-4, "{start}");
    assert!(
        kinetic
            .iter()
            .zip(&strain)
            .all(|(k, s)| (k + s - start).abs() < 0.02 * start)
    );
    // The exact tip: u = V / ω sin ωt with ω = π c / 2 L, c = 10.
    let frequency = std::f64::consts::PI * 10.0 / 20.0;
    let tip = column(&series, "tip_displacement_x");
    for (time, u) in times.iter().zip(tip) {
        let exact = 0.1 / frequency * (frequency * time).sin();
        assert!(
            (u - exact).abs() < 0.05 * 0.1 / frequency,
            "t = {time}: {u}, not {exact}"
        );
    }
    for name in [
        "particles_000000.vtu",
        "particles_000004.vtu",
        "particles.pvd",
        "checkpoint.cbor",
        "scene.toml",
    ] {
        assert!(directory.path().join(name).exists(), "{name}");
    }
    assert!(!directory.path().join("particles_000005.vtu").exists());
    let index = std::fs::read_to_string(directory.path().join("particles.pvd")).expect("written");
    assert_eq!(index.matches("<DataSet").count(), 5);
    assert!(index.contains("timestep=\"1.5\" part=\"0\" file=\"particles_000003.vtu\""));
}

#[test]
fn a_block_falls_slides_and_is_pushed() {
    let directory = tempfile::tempdir().expect("a directory");
    let (summary, series) = run(&scene(BLOCK), directory.path());
    assert_eq!(summary.outcome, Outcome::Finished);
    let lower = column(&series, "lower_y");
    assert!(lower.iter().all(|&y| y > 0.2), "the barrier holds: {lower:?}");
    assert!(largest(&column(&series, "barrier_energy")) > 0.0);
    assert!(
        column(&series, "middle_displacement_x")
            .last()
            .is_some_and(|&x| x > 0.15)
    );
    // Before anything touches the floor, m g t and the force's impulse are all there is.
    let times = column(&series, "time");
    let (momentum_x, momentum_y) = (column(&series, "momentum_x"), column(&series, "momentum_y"));
    let mass = 1000.0 * 0.5 + 100.0 * std::f64::consts::PI * 0.16;
    let fallen = momentum_y[5] - momentum_y[0];
    assert!((fallen + mass * 10.0 * times[5]).abs() < 1e-9 * mass, "{fallen}");
    let impulse = 500.0 * times[5] * times[5] / 0.2;
    // The force is that at the start of every step, and no step is longer than a row.
    let late = 5000.0 * times[5] * 0.5 * 0.01;
    assert!((momentum_x[5] - momentum_x[0] - impulse).abs() < late);
}

#[test]
fn a_cube_turns_freely() {
    let directory = tempfile::tempdir().expect("a directory");
    let (summary, series) = run(&scene(CUBE), directory.path());
    assert_eq!((summary.outcome, summary.particles), (Outcome::Finished, 512));
    for name in ["momentum_x", "momentum_y", "momentum_z", "centre_x"] {
        assert!(largest(&column(&series, name)) < 1e-13, "{name}");
    }
    for name in ["angular_momentum_x", "angular_momentum_y", "angular_momentum_z"] {
        let values = column(&series, name);
        assert!(
            values.iter().all(|value| (value - values[0]).abs() < 1e-12),
            "{name}: {values:?}"
        );
    }
}

/// By what affine parts of zero take at the surface: energies of a rigid turn are as squares of its rate.
#[test]
fn a_body_that_turns_is_slowed_by_its_first_step() {
    let share_left = |spacing: &str| {
        let block = "lower = [-0.6, -0.4, -0.2], upper = [0.6, 0.4, 0.2]";
        let text = CUBE
            .replace("lower = [-0.4, -0.4, -0.4], upper = [0.4, 0.4, 0.4]", block)
            .replace("rate = [0.0, 1.0, 2.0]", "rate = [0.0, 0.1, 0.0]")
            .replace("spacing = 0.2", &format!("spacing = {spacing}"))
            .replace("\"cubic\"", "\"quadratic\"")
            .replace("\"mls\"", "\"apic\"")
            .replace("stress_update = \"first\"", "")
            .replace("end = 0.1", "end = 0.001")
            .replace("interval = 0.05", "interval = 0.001");
        let directory = tempfile::tempdir().expect("a directory");
        let energy = column(&run(&scene(&text), directory.path()).1, "kinetic_energy");
        (energy[1] / energy[0]).sqrt()
    };
    let (coarse, fine) = (share_left("0.1"), share_left("0.05"));
    assert!((coarse - 0.97).abs() < 0.005, "{coarse}");
    assert!((fine - 0.99).abs() < 0.003, "{fine}");
}

#[test]
fn laws_remember_and_frames_say_what() {
    let directory = tempfile::tempdir().expect("a directory");
    let (_, series) = run(&scene(HEAPS), directory.path());
    // Plasticity and damping lose energy, and nothing adds any.
    let names = ["kinetic_energy", "strain_energy", "potential_energy"];
    let energies: Vec<Vec<f64>> = names.iter().map(|name| column(&series, name)).collect();
    let total: Vec<f64> = (0..energies[0].len())
        .map(|k| energies.iter().map(|energy| energy[k]).sum())
        .collect();
    assert!(total.windows(2).all(|pair| pair[1] < pair[0]), "{total:?}");
    let frame = std::fs::read(directory.path().join("particles_000003.vtu")).expect("written");
    let text = String::from_utf8_lossy(&frame);
    for name in ["plastic_strain", "volume_correction"] {
        assert!(text.contains(&format!("Name=\"{name}\"")), "{name}");
    }
}

/// The tip of the bar after two thirds of half a period, on hats averaged over the particles.
#[test]
fn generalised_interpolation_swings_the_bar_as_splines_do() {
    for particles in 1..=4 {
        let gimp = BAR.replace("spacing = 1.0", "spacing = 1.0\nbasis = \"gimp\"").replace(
            "material = \"steel\"",
            &format!("material = \"steel\"\nparticles_per_axis = {particles}"),
        );
        let directory = tempfile::tempdir().expect("a directory");
        let (_, series) = run(&scene(&gimp), directory.path());
        let frequency = std::f64::consts::PI * 10.0 / 20.0;
        let exact = 0.1 / frequency * (2.0 / 3.0f64 * std::f64::consts::PI).sin();
        let (times, tip) = (column(&series, "time"), column(&series, "tip_displacement_x"));
        let at = 4.0 / 3.0;
        let after = times.partition_point(|&time| time < at);
        let share = (at - times[after - 1]) / (times[after] - times[after - 1]);
        let measured = tip[after - 1] + share * (tip[after] - tip[after - 1]);
        assert!(
            (measured - exact).abs() < 0.06 * 0.1 / frequency,
            "{particles} particles: {measured}, not {exact}"
        );
    }
}

/// Particles of a gas farther apart than cells: each is sheared and thinned by its own pressure as long as the run lasts, which no force reads.
#[test]
fn a_gas_of_few_particles_runs_on() {
    let text = r#"
title = "thin gas"
dimension = 2
domain = { lower = [0.0, 0.0], upper = [1.0, 1.0] }
grid = { spacing = 0.05 }
transfer = { kind = "apic" }
time = { end = 2.0, courant = 0.3 }
materials.gas = { law = "isothermal-gas", density = 1.0, pressure_per_density = 1.0 }
output = { interval = 2.0 }
bodies = [{ name = "gas", material = "gas", shape = { kind = "box", lower = [0.0, 0.0], upper = [0.3, 1.0] }, fill = "random", particles = 60 }]
walls = [
    { axis = "x", side = "lower", condition = "slip" },
    { axis = "x", side = "upper", condition = "slip" },
    { axis = "y", side = "lower", condition = "slip" },
    { axis = "y", side = "upper", condition = "slip" },
]
"#;
    let mut last = Snapshot::default();
    frames(&scene(text), &mut |frame| last = frame).expect("runs");
    assert_eq!(last.time, 2.0);
    assert!(last.volume_ratios.iter().all(|ratio| *ratio > 0.0 && *ratio < 1.01e100));
    assert!(last.positions.chunks_exact(2).any(|x| x[0] > 0.7));
}

/// Mass around a node at a surface is not centred on it, so that FLIP hands on less than the angular momentum of the nodes; APIC carries the rest.
#[test]
fn flip_loses_angular_momentum_at_surfaces() {
    let spun = |transfer: &str, spacing: f64| {
        let text = format!(
            r#"
title = "square"
dimension = 2
domain = {{ lower = [-2.0, -2.0], upper = [2.0, 2.0] }}
grid = {{ spacing = {spacing} }}
transfer = {{ {transfer} }}
time = {{ end = 2.0, courant = 0.3 }}
materials.square = {{ law = "neo-hookean", density = 1.0, young_modulus = 100.0, poisson_ratio = 0.3 }}
output = {{ interval = 2.0, series_interval = 2.0 }}

[[bodies]]
name = "square"
material = "square"
shape = {{ kind = "box", lower = [-0.5, -0.5], upper = [0.5, 0.5] }}
velocity = {{ kind = "rotation", centre = [0.0, 0.0], rate = [0.5] }}
"#
        );
        let directory = tempfile::tempdir().expect("a directory");
        let momentum = column(&run(&scene(&text), directory.path()).1, "angular_momentum");
        1.0 - momentum[1] / momentum[0]
    };
    let lost = [0.25, 0.125, 0.0625].map(|spacing| spun("kind = \"flip\", flip_share = 1.0", spacing));
    for (lost, expected) in lost.iter().zip([0.227, 0.065, 0.0124]) {
        assert!((lost / expected - 1.0).abs() < 0.05, "{lost}, not {expected}");
    }
    assert!(spun("kind = \"apic\"", 0.125).abs() < 1e-10);
}
