//! Where the energy of a run goes.

use std::sync::LazyLock;

use mpm_scenes::Series;

use super::scenes::{BAR, BLOCK, series_of};

/// Courant numbers of the bounces.
const LONG: f64 = 0.3;
const SHORT: f64 = 0.05;

/// A disk that bounces on a rough floor.
fn bounce(transfer: &str, integration: &str, courant: f64) -> Series {
    series_of(&format!(
        r#"
title = "bounce"
dimension = 2
gravity = [0.0, -2.0]
domain = {{ lower = [0.0, 0.0], upper = [4.0, 2.0] }}
grid = {{ spacing = 0.1 }}
transfer = {{ kind = "{transfer}" }}
time = {{ end = 0.5, courant = {courant} }}
materials.rubber = {{ law = "neo-hookean", density = 1000.0, young_modulus = 1e5, poisson_ratio = 0.3 }}
output = {{ interval = 0.5, series_interval = 0.01, energy_budget = true }}

[barrier]
shapes = [{{ kind = "half-space", point = [0.0, 0.5], normal = [0.0, 1.0] }}]
stiffness = 1e8
gap = 0.02
friction = 0.3
integration = "{integration}"

[[bodies]]
name = "disk"
shape = {{ kind = "sphere", centre = [1.0, 0.95], radius = 0.4 }}
material = "rubber"
velocity = [1.0, -2.0]
"#
    ))
}

/// With affine FLIP and a barrier that is implicit, in long and in short steps.
static AFFINE_FLIP: LazyLock<[Series; 2]> =
    LazyLock::new(|| [LONG, SHORT].map(|courant| bounce("affine-flip", "implicit", courant)));

/// The farthest that `energy_balance` goes from where it begins.
fn drift(series: &Series) -> f64 {
    let total = series.column("energy_balance").expect("a budget");
    total.iter().map(|now| (now - total[0]).abs()).fold(0.0, f64::max)
}

/// A viscous bar that swings: nearly all that it loses its viscosity takes, and the books close.
#[test]
fn what_a_viscous_bar_loses_is_its_viscositys() {
    let text = BAR
        .replace("\"linear-elastic\"", "\"kelvin-voigt\"\nviscosity = 2.0")
        .replace("courant = 0.2", "courant = 0.05")
        .replace("series_interval = 0.1", "series_interval = 0.1\nenergy_budget = true");
    let bar = series_of(&text);
    let column = |name: &str| bar.column(name).expect("a budget");
    let start = column("kinetic_energy")[0];
    assert!(drift(&bar) < 1e-12 * start, "{}", drift(&bar));
    let end = |name: &str| *column(name).last().expect("a row");
    let lost = start - end("kinetic_energy") - end("strain_energy");
    let viscous = column("viscous_dissipation");
    assert!(viscous.is_sorted() && lost > 0.05 * start);
    // The transfer has its share of so few cells.
    let share = end("viscous_dissipation") / lost;
    assert!((0.9..1.0).contains(&share), "{share}");
}

/// The largest size of a value.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, value| value.abs().max(largest))
}

/// Friction, contact, transfer, integration and what is left add up to what there was, whatever the step. In short steps friction and contact never give anything back; in long ones the
/// velocity before a step may point against the sliding that friction acts on.
fn closes(transfer: &str, courant: f64, disk: &Series) {
    let column = |name: &str| disk.column(name).expect("a budget");
    let last = |name: &str| *column(name).last().expect("a row");
    let start = column("kinetic_energy")[0];
    assert!(drift(disk) < 1e-9 * start, "{transfer}: {} of {start}", drift(disk));
    for part in ["friction_dissipation", "contact_dissipation", "transfer_dissipation"] {
        assert!(last(part) > 0.01 * start, "{transfer}: {part} is {}", last(part));
    }
    for part in ["friction_dissipation", "contact_dissipation"] {
        let never_back = courant == LONG || column(part).is_sorted();
        assert!(never_back, "{transfer}: {part} is given back");
    }
    assert_eq!(
        (last("boundary_work"), last("load_work"), last("damping_dissipation")),
        (0.0, 0.0, 0.0)
    );
}

#[test]
fn the_budget_of_a_bounce_with_friction_closes() {
    for (courant, affine_flip) in [LONG, SHORT].into_iter().zip(&*AFFINE_FLIP) {
        closes("affine-flip", courant, affine_flip);
        for transfer in ["apic", "mls", "flip"] {
            closes(transfer, courant, &bounce(transfer, "implicit", courant));
        }
    }
}

/// What the integration in time takes or gives goes with the step, and the forces of an explicit barrier are in it.
#[test]
fn the_share_of_the_time_integration_goes_with_the_step() {
    let explicit = [LONG, SHORT].map(|courant| bounce("affine-flip", "explicit", courant));
    for (integration, runs) in [("explicit", &explicit), ("implicit", &*AFFINE_FLIP)] {
        let [long, short] = runs.each_ref().map(|disk| {
            let start = disk.column("kinetic_energy").expect("a column")[0];
            assert!(drift(disk) < 1e-9 * start, "{integration}: {}", drift(disk));
            largest(&disk.column("time_integration_dissipation").expect("a budget"))
        });
        assert!(short < 0.6 * long, "{integration}: {short}, {long}");
    }
}

/// A bar that swings, fixed at one end: the integration takes part of the energy to and fro, and with it the sum stays.
#[test]
fn the_budget_of_a_swinging_bar_closes() {
    let swinging = BAR.replace("series_interval = 0.1", "series_interval = 0.1\nenergy_budget = true");
    let bar = series_of(&swinging);
    let start = bar.column("kinetic_energy").expect("a column")[0];
    let taken = largest(&bar.column("time_integration_dissipation").expect("a budget"));
    assert!(taken > 1e-3 * start, "{taken} of {start}");
    assert!(drift(&bar) < 1e-9 * start, "{} of {start}", drift(&bar));
}

/// A block of which particles are moved in a field of gravity that still grows, and beside a barrier: putting them in place is work.
#[test]
fn the_budget_of_particles_that_are_put_in_place_closes() {
    for integration in ["explicit", "implicit"] {
        let block = series_of(&format!(
            r#"
title = "lifted"
dimension = 2
gravity = [0.0, -9.81]
gravity_ramp = 0.1
domain = {{ lower = [0.0, -1.0], upper = [3.0, 2.0] }}
grid = {{ spacing = 0.1 }}
transfer = {{ kind = "apic" }}
time = {{ end = 0.2, step = 1e-3 }}
materials.rubber = {{ law = "neo-hookean", density = 1000.0, young_modulus = 1e5, poisson_ratio = 0.3 }}
output = {{ interval = 0.2, series_interval = 0.01, energy_budget = true }}

[barrier]
shapes = [{{ kind = "half-space", point = [0.0, -0.05], normal = [0.0, 1.0] }}]
stiffness = 1e6
gap = 0.1
integration = "{integration}"

[[bodies]]
name = "block"
shape = {{ kind = "box", lower = [1.0, 0.0], upper = [2.0, 0.5] }}
material = "rubber"

[[kinematic]]
region = {{ kind = "box", lower = [1.0, 0.0], upper = [1.2, 0.5] }}
velocity = [0.1, 0.2]
rotation = {{ centre = [1.1, 0.2], rate = [1.0] }}
until = 0.1
"#
        ));
        let work = block.column("boundary_work").expect("a budget");
        let most = largest(&work);
        assert!(most > 1.0, "{most}");
        assert!(
            drift(&block) < 1e-9 * most,
            "{integration}: {} of {most}",
            drift(&block)
        );
    }
}

/// A bar that is pulled and damped: the work of the load is what strain, motion and damping have.
#[test]
fn the_work_of_a_load_and_damping_are_in_the_budget() {
    let pulled = BAR
        .replace(
            "velocity = { kind = \"sine\", amplitude = [0.1], wave_vector = [0.15707963267948966] }\n",
            "",
        )
        .replace("courant = 0.2", "courant = 0.2\ndamping = 1.0")
        .replace("series_interval = 0.1", "series_interval = 0.1\nenergy_budget = true");
    let load = "[[loads]]\nkind = \"traction\"\nregion = { kind = \"box\", lower = [9.0], upper = [10.0] }\ntraction = [1.0]\nthickness = 1.0\nramp = 1.0\n";
    let bar = series_of(&(pulled + load));
    let last = |name: &str| {
        bar.column(name)
            .and_then(|values| values.last().copied())
            .expect("a budget")
    };
    let work = last("load_work");
    assert!(work > 0.0 && last("damping_dissipation") > 0.05 * work);
    assert!(drift(&bar) < 1e-9 * work, "{} of {work}", drift(&bar));
}

/// What a budget costs is its own: the run is the same.
#[test]
fn a_budget_changes_nothing_else() {
    let with = BLOCK.replace("[output]", "[output]\nenergy_budget = true");
    assert_ne!(with, BLOCK);
    let (with, without) = (series_of(&with), series_of(BLOCK));
    for name in without.columns() {
        assert_eq!(with.column(name), without.column(name), "{name}");
    }
}

/// A column of sand that falls apart on a rough floor at the domain's border.
fn column(courant: f64) -> Series {
    series_of(&format!(
        r#"
title = "column"
dimension = 2
gravity = [0.0, -9.81]
domain = {{ lower = [0.0, 0.0], upper = [1.0, 0.6] }}
grid = {{ spacing = 0.04 }}
time = {{ end = 0.5, courant = {courant} }}
materials.sand = {{ law = "drucker-prager", density = 1600.0, young_modulus = 1e6, poisson_ratio = 0.3, friction_angle = 30.0 }}
bodies = [{{ name = "column", material = "sand", shape = {{ kind = "box", lower = [0.0, 0.0], upper = [0.2, 0.4] }} }}]
output = {{ interval = 0.5, series_interval = 0.05, energy_budget = true }}

[[walls]]
axis = "x"
side = "lower"
condition = "slip"

[[walls]]
axis = "y"
side = "lower"
condition = "friction"
friction = 0.5
"#
    ))
}

/// What a return mapping takes back of long trials is no energy of the time integration: the balance falls, by as much whatever the step.
#[test]
fn plastic_laws_take_from_the_balance_what_they_dissipate() {
    let [long, short] = [0.3, 0.1].map(|courant| {
        let run = column(courant);
        let balance = run.column("energy_balance").expect("a budget");
        let falls = balance.array_windows().all(|[before, after]| after <= before);
        assert!(falls, "{balance:?}");
        let integration = largest(&run.column("time_integration_dissipation").expect("a budget"));
        let dissipated = balance[0] - balance[balance.len() - 1];
        assert!(integration < 0.1 * dissipated, "{integration} of {dissipated}");
        dissipated
    });
    assert!((short / long - 1.0).abs() < 0.15, "{short}, {long}");
}

/// A block that falls on a rough floor and yields. A step in which a particle yields begins with stresses that are smaller than those along it, and these do less work: the balance, which what
/// yields lowers, may rise there, by what is of second order in the step.
#[test]
fn the_balance_of_what_yields_rises_by_less_in_shorter_steps() {
    let rise = |courant: f64| {
        let block = series_of(&format!(
            r#"
title = "a block that softens"
dimension = 2
gravity = [0.0, -10.0]
domain = {{ lower = [-2.0, -2.0], upper = [2.0, 2.0] }}
grid = {{ spacing = 0.1 }}
transfer = {{ kind = "apic" }}
time = {{ end = 0.4, courant = {courant} }}
walls = [{{ point = [0.0, 0.0], normal = [0.0, 1.0], condition = "friction", friction = 0.4 }}]
output = {{ interval = 0.4, series_interval = 0.002, energy_budget = true }}

[materials.clay]
law = "softening-hencky"
density = 1000.0
young_modulus = 1e4
poisson_ratio = 0.3
peak_yield_stress = 300.0
residual_yield_stress = 100.0
softening_rate = 5.0

[[bodies]]
name = "block"
material = "clay"
shape = {{ kind = "box", lower = [-0.25, 0.1], upper = [0.35, 0.5] }}
spacing = 0.05
velocity = [0.5, -1.0]
"#
        ));
        let total = block.column("energy_balance").expect("a budget");
        let kinetic = block.column("kinetic_energy").expect("an energy")[0];
        assert!(total[total.len() - 1] < total[0] - 0.3 * kinetic, "{total:?}");
        let mut least = f64::INFINITY;
        let rises = total.iter().map(|&now| {
            least = least.min(now);
            now - least
        });
        rises.fold(0.0, f64::max) / kinetic
    };
    let [long, short] = [0.3, 0.1].map(rise);
    assert!(long < 2e-3 && short < 0.2 * long, "{long} {short}");
}

/// A plate that is pushed along on its left while a traction on its right holds against: t A v is taken in a second, and what pushes gives that and what damping takes.
#[test]
fn the_work_of_tractions_is_told_apart() {
    let pushed = |left: &str| {
        series_of(&format!(
            r#"
title = "a plate between a hand and a load"
dimension = 2
transfer = {{ kind = "apic" }}
time = {{ end = 1.0, damping = 2.0 }}
materials.rubber = {{ law = "neo-hookean", density = 1.0, young_modulus = 1000.0, poisson_ratio = 0.3 }}
facets = [{left}{{ group = "x-upper", condition = "traction", traction = [-1.0, 0.0], ramp = 0.25 }}]
output = {{ interval = 1.0, series_interval = 0.5, energy_budget = true }}
mesh = {{ generate = {{ kind = "rectangle", lower = [0.0, 0.0], upper = [2.0, 1.0], size = 0.2 }} }}

[[bodies]]
name = "plate"
material = "rubber"
shape = {{ kind = "box", lower = [0.0, 0.0], upper = [2.0, 1.0] }}
velocity = [0.1, 0.0]

[[probes]]
name = "middle"
at = [1.0, 0.5]
"#
        ))
    };
    let free = pushed("");
    let column = |run: &Series, name: &str| run.column(name).expect("a budget");
    assert_eq!(column(&free, "traction_work"), column(&free, "boundary_work"));
    assert_eq!(free.columns().last().map(String::as_str), Some("traction_work"));
    let held = pushed("{ group = \"x-lower\", condition = \"prescribed\", velocity = [0.1, 0.0] }, ");
    let [tractions, boundary] = ["traction_work", "boundary_work"].map(|name| column(&held, name));
    let taken = tractions[1] - tractions[2];
    assert!((taken - 0.05).abs() < 0.005, "{tractions:?}");
    let hand = boundary[2] - boundary[1] + taken;
    let damped = column(&held, "damping_dissipation");
    let given = taken + damped[2] - damped[1];
    assert!((hand / given - 1.0).abs() < 0.1, "{hand} for {given}");
    assert!(drift(&held) < 1e-9 * hand, "{} of {hand}", drift(&held));
}
