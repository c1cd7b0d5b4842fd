//! Loads and moving obstacles against what a bar does exactly.

use mpm_scenes::Series;

use super::scenes::{BAR, series_of};

/// The series of the bar's scene with some texts replaced and others added at the end.
fn series(replaced: &[(&str, &str)], added: &str) -> Series {
    let mut text = BAR.to_owned();
    for (from, to) in replaced {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    series_of(&(text + added))
}

const SWING: &str = "velocity = { kind = \"sine\", amplitude = [0.1], wave_vector = [0.15707963267948966] }\n";
const WALL: &str = "[[walls]]\naxis = \"x\"\nside = \"lower\"\ncondition = \"fixed\"\n";

/// A piston of speed v that begins to move under a bar at rest sends a wave of pressure ρ c v through it: the momentum grows by ρ c v
/// per time up to t = 2 L / c, not later than the wave needs for a cell, and the bar's end follows the piston.
#[test]
fn a_moving_obstacle_pushes_with_the_pressure_of_its_wave() {
    let piston = "[[obstacles]]\nshape = { kind = \"half-space\", point = [0.0], normal = [1.0] }\ncontact = \"separate\"\nvelocity = [0.2]\n";
    let pushed = series(&[(SWING, ""), (WALL, "")], piston);
    let column = |name| pushed.column(name).expect("a column");
    let (time, momentum, lower) = (column("time"), column("momentum_x"), column("lower_x"));
    let rate = (momentum[15] - momentum[5]) / (time[15] - time[5]);
    assert!((rate / (10.0 * 0.2) - 1.0).abs() < 0.02, "{rate}");
    let delay = time[15] - momentum[15] / (10.0 * 0.2);
    assert!(delay > 0.0 && delay < 1.0 / 10.0, "{delay}");
    for k in [5, 10, 15] {
        assert!(
            (lower[k] - 0.25 - 0.2 * time[k]).abs() < 0.02,
            "t = {}: {}",
            time[k],
            lower[k]
        );
    }
}

/// A standing wave of wave number k dies out at the rate η k² / ρ: its energy is e^(−2 η k² t / ρ) of what it was after a whole period.
#[test]
fn a_viscous_bar_swings_out() {
    let swung = series(
        &[
            ("\"linear-elastic\"", "\"kelvin-voigt\"\nviscosity = 2.0"),
            ("end = 2.0", "end = 8.0"),
            ("spacing = 1.0", "spacing = 0.5"),
        ],
        "",
    );
    let energy = swung.column("kinetic_energy").expect("a column");
    let kept = energy[80] / energy[0];
    let expected = (-2.0 * 2.0 * 0.15707963267948966_f64.powi(2) * 8.0).exp();
    assert!((kept / expected - 1.0).abs() < 0.02, "{kept} of {expected}");
}

/// A viscous fluid that is torn apart, to 25 times its volume: nothing pushes, so its energy never grows, however thin it is.
#[test]
fn a_viscous_fluid_that_thins_makes_no_energy() {
    let text = r#"
title = "spray"
dimension = 2
materials.oil = { law = "tait-fluid", density = 1.0, sound_speed = 10.0, viscosity = 5.0 }
domain = { lower = [-6.0, -6.0], upper = [6.0, 6.0] }
grid = { spacing = 0.25 }
time = { end = 2.0 }
output = { interval = 2.0, series_interval = 0.1 }

[[bodies]]
name = "drop"
material = "oil"
shape = { kind = "sphere", centre = [0.0, 0.0], radius = 1.0 }
velocity = { kind = "linear", centre = [0.0, 0.0], gradient = [[2.0, 0.0], [0.0, 2.0]] }
"#;
    let torn = series_of(text);
    let column = |name| torn.column(name).expect("a column");
    let energies = column("kinetic_energy").into_iter().zip(column("affine_energy"));
    let energies: Vec<f64> = energies.map(|(kinetic, affine)| kinetic + affine).collect();
    assert!(
        energies.is_sorted_by(|before, after| *after <= before * (1.0 + 1e-3)),
        "{energies:?}"
    );
}

/// Sand that begins a tenth larger than it was has gaps and no tension: it stays where it is.
#[test]
fn sand_that_begins_apart_rests() {
    let text = r#"
title = "loose sand"
dimension = 2
materials.sand = { law = "drucker-prager", density = 2000.0, young_modulus = 1e6, poisson_ratio = 0.3, friction_angle = 30.0 }
bodies = [{ name = "heap", material = "sand", shape = { kind = "box", lower = [0.0, 0.0], upper = [1.0, 1.0] }, deformation = 1.05 }]
domain = { lower = [-1.0, -1.0], upper = [2.0, 2.0] }
grid = { spacing = 0.25 }
time = { end = 0.05 }
output = { interval = 0.05 }
"#;
    let rested = series_of(text);
    for column in ["kinetic_energy", "affine_energy", "strain_energy"] {
        let energy = rested.column(column).expect("a column");
        assert!(energy.iter().all(|energy| *energy < 1e-12), "{column}: {energy:?}");
    }
}

/// A bar at rest under a tension t on its end is t L / E longer; the layer that t is spread over takes half its length off.
#[test]
fn a_traction_stretches_by_its_stress_over_the_modulus() {
    let load = "[[loads]]\nkind = \"traction\"\nregion = { kind = \"box\", lower = [9.0], upper = [10.0] }\ntraction = [1.0]\nthickness = 1.0\nramp = 5.0\n";
    let relaxed = [
        (SWING, ""),
        ("end = 2.0", "end = 40.0\ndamping = 1.0"),
        ("series_interval = 0.1", ""),
        ("spacing = 1.0", "spacing = 0.5"),
    ];
    let stretched = series(&relaxed, load);
    let last = |name| {
        stretched
            .column(name)
            .and_then(|values| values.last().copied())
            .expect("a column")
    };
    // The outermost particle's middle is at 9.875: the integral of the tension, 1 up to 9 and then falling to 0 at 10, over E = 100.
    let expected = (9.0 + 0.875 * (1.0 + 0.125) / 2.0) / 100.0;
    assert!(
        (last("tip_displacement_x") / expected - 1.0).abs() < 1e-3,
        "{}",
        last("tip_displacement_x")
    );
    assert!(last("kinetic_energy") < 1e-6 * last("strain_energy"));
}

/// A disk that a barrier throws back has no more energy than before, whatever it hits it with.
#[test]
fn a_bounce_on_a_barrier_adds_no_energy() {
    let cases = [(0.5, "apic"), (2.0, "apic"), (2.0, "flip")];
    let cases = cases
        .iter()
        .flat_map(|case| ["explicit", "implicit"].map(|integration| (*case, integration)));
    for ((speed, transfer), integration) in cases {
        let text = format!(
            r#"
title = "bounce"
dimension = 2
domain = {{ lower = [0.0, 0.0], upper = [2.0, 2.0] }}
grid = {{ spacing = 0.1 }}
transfer = {{ kind = "{transfer}" }}
time = {{ end = {end} }}
materials.rubber = {{ law = "neo-hookean", density = 1000.0, young_modulus = 1e5, poisson_ratio = 0.3 }}
output = {{ interval = 1.0, series_interval = 0.005 }}
barrier = {{ shapes = [{{ kind = "half-space", point = [0.0, 0.5], normal = [0.0, 1.0] }}], stiffness = 1e8, gap = 0.02, integration = "{integration}" }}

[[bodies]]
name = "disk"
shape = {{ kind = "sphere", centre = [1.0, 0.95], radius = 0.4 }}
material = "rubber"
velocity = [0.0, -{speed}]
"#,
            end = 0.5 / speed
        );
        let series = series_of(&text);
        let names = ["kinetic_energy", "affine_energy", "strain_energy", "barrier_energy"];
        let energies: Vec<Vec<f64>> = names.iter().filter_map(|name| series.column(name)).collect();
        let total = |k: usize| energies.iter().map(|energy| energy[k]).sum::<f64>();
        let largest = (0..energies[0].len()).map(total).fold(0.0, f64::max);
        assert!(
            largest < 1.01 * total(0),
            "{speed}, {transfer}, {integration}: {largest} from {}",
            total(0)
        );
        let last = series.column("momentum_y").and_then(|values| values.last().copied());
        assert!(last.is_some_and(|momentum| momentum > 0.0), "{last:?}");
    }
}

/// A free body of mass M under g t / T has the momentum M g t² / 2T, and gains M g per time after T.
#[test]
fn gravity_grows_up_to_its_ramp() {
    let heavy = "dimension = 1\ngravity = [0.2]\ngravity_ramp = 1.0\n";
    let fallen = series(&[(SWING, ""), (WALL, ""), ("dimension = 1\n", heavy)], "");
    let column = |name| fallen.column(name).expect("a column");
    let (time, momentum) = (column("time"), column("momentum_x"));
    for (t, p) in time.iter().zip(&momentum) {
        let exact = 10.0 * 0.2 * if *t < 1.0 { 0.5 * t * t } else { t - 0.5 };
        assert!((p - exact).abs() < 0.03, "t = {t}: {p} in place of {exact}");
    }
    assert!(momentum[20] > 2.9);
}

/// A free body of mass M under a pulse s(t) F has the momentum F ∫ s dt: that of a force on all of it, and of a traction in a layer.
#[test]
fn a_pulse_gives_its_area_of_momentum() {
    let pulse = "amplitude = [[0.2, 0.0], [0.6, 3.0], [0.8, -1.0], [1.0, 0.0]]";
    let region = "region = { kind = \"box\", lower = [-99.0], upper = [99.0] }";
    for (load, force) in [
        ("kind = \"point-force\"\nforce = [5.0]", 5.0),
        ("kind = \"traction\"\ntraction = [0.5]\nthickness = 1.0", 5.0),
    ] {
        let table = format!("[[loads]]\n{load}\n{region}\n{pulse}\n");
        let pushed = series(&[(SWING, ""), (WALL, "")], &table);
        let momentum = pushed.column("momentum_x").expect("a column");
        let exact = force * (0.6 + 0.2 - 0.1);
        let last = momentum.last().copied().unwrap_or(f64::NAN);
        assert!(
            (last - exact).abs() < 0.02 * exact,
            "{load}: {last} in place of {exact}"
        );
    }
}

/// A block on a slope, turned so that the slope is level, its motion damped at the rate γ: with μ = 0.5 it stays where the slope is 0.4, and where it is 0.8 it slides at
/// g (sin θ − μ cos θ) / γ, whatever the small speed from which friction is full and whether the barrier is explicit or implicit.
#[test]
fn a_block_sticks_to_a_gentle_slope_and_slides_down_a_steep_one() {
    let slide = |slope: f64, friction_speed: f64, integration: &str| {
        let across = 10.0 / (1.0 + slope * slope).sqrt();
        let text = format!(
            r#"
title = "block on a slope"
dimension = 2
gravity = [{}, {}]
gravity_ramp = 0.4

domain = {{ lower = [0.0, 0.0], upper = [6.0, 2.0] }}
grid = {{ spacing = 0.25 }}
transfer = {{ kind = "apic" }}
time = {{ end = 1.2, step = 4e-4, damping = 20.0 }}
materials.rubber = {{ law = "neo-hookean", density = 1000.0, young_modulus = 1e6, poisson_ratio = 0.3 }}
bodies = [{{ name = "block", material = "rubber", shape = {{ kind = "box", lower = [1.0, 0.5], upper = [2.0, 1.0] }} }}]

[barrier]
shapes = [{{ kind = "half-space", point = [0.0, 0.44], normal = [0.0, 1.0] }}]
stiffness = 2e5
gap = 0.1225
friction = 0.5
friction_speed = {friction_speed}
integration = "{integration}"

[output]
interval = 1.2
series_interval = 0.05
"#,
            slope * across,
            -across
        );
        let series = series_of(&text);
        let column = |name| series.column(name).expect("a column").to_vec();
        let (centre, momentum) = (column("centre_x"), column("momentum_x"));
        let last = centre.len() - 1;
        (across, centre[last] - centre[last - 2], momentum[last] / 500.0)
    };
    let cases = [
        (0.0, "explicit"),
        (1e-6, "explicit"),
        (1e-3, "explicit"),
        (0.0, "implicit"),
    ];
    for (friction_speed, integration) in cases {
        let (_, way, speed) = slide(0.4, friction_speed, integration);
        let still = 2e-4 + friction_speed;
        assert!(
            way.abs() < still && speed.abs() < still,
            "{friction_speed}, {integration}: {way}, {speed}"
        );
        let (across, _, speed) = slide(0.8, friction_speed, integration);
        let expected = across * (0.8 - 0.5) / 20.0;
        assert!(
            (speed / expected - 1.0).abs() < 0.02,
            "{friction_speed}, {integration}: {speed} for {expected}"
        );
    }
}
