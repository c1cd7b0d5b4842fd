//! When a body meets a wall that it can leave, and where it stays.

use super::scenes::{BAR, series_of};

/// A column of length 1 with c = 10 that falls with speed 1 from 0.3 above y = 0.
const COLUMN: &str = r#"
title = "column"
dimension = 2
BACKGROUND
transfer = { kind = "apic" }
time = { end = 0.6 }
materials.rubber = { law = "linear-elastic", density = 1.0, young_modulus = 100.0, poisson_ratio = 0.0 }
output = { interval = 0.6, series_interval = 0.05 }

[[bodies]]
name = "column"
material = "rubber"
shape = { kind = "box", lower = [0.3, 0.3], upper = [0.7, 1.3] }
spacing = 0.05
velocity = [0.0, -1.0]
"#;

const GRID: &str = "grid = { spacing = 0.1 }\ndomain = { lower = [0.0, 0.0], upper = [1.0, 2.0] }";
const MESH: &str = "mesh = { generate = { kind = \"rectangle\", lower = [0.0, 0.0], upper = [1.0, 2.0], size = 0.1 } }";

/// Nothing pushes before it touches, at t = 0.3, nor after the wave has gone up and down, at 0.5; then it flies as it came.
#[test]
fn a_column_meets_a_surface_when_its_end_does() {
    let wall = "[[walls]]\naxis = \"y\"\nside = \"lower\"\ncondition = \"friction\"\nfriction = 0.3\n";
    let half_space = "shape = { kind = \"half-space\", point = [0.0, 0.0], normal = [0.0, 1.0] }";
    let obstacle = format!("[[obstacles]]\n{half_space}\ncontact = \"separate\"\nfriction = 0.3\n");
    let facets = "[[facets]]\ngroup = \"boundary\"\ncondition = \"friction\"\nfriction = 0.3\n";
    for (background, surface) in [(GRID, wall), (GRID, obstacle.as_str()), (MESH, facets)] {
        let fallen = series_of(&(COLUMN.replace("BACKGROUND", background) + surface));
        let momentum = fallen.column("momentum_y").expect("a column");
        let relative: Vec<f64> = momentum.iter().map(|p| p / 0.4).collect();
        assert!((relative[5] + 1.0).abs() < 1e-9, "{surface}: {relative:?}");
        assert!(relative[8].abs() < 0.15, "{surface}: {relative:?}");
        assert!(relative[12] > 0.85, "{surface}: {relative:?}");
    }
}

/// A surface that comes to a body at rest begins to push when it arrives: at t = 5, with ρ c v.
#[test]
fn a_surface_that_moves_begins_to_push_when_it_arrives() {
    let start = BAR.find("velocity = {").expect("a velocity");
    let (rest, output) = (&BAR[..start], &BAR[BAR.find("[output]").expect("an output")..]);
    let rest = rest
        .replace("upper = [12.0]", "upper = [13.0]")
        .replace("end = 2.0", "end = 6.6");
    let rest = rest.replace("lower = [0.0], upper = [10.0]", "lower = [1.0], upper = [11.0]");
    let piston = "[[obstacles]]\nshape = { kind = \"half-space\", point = [0.0], normal = [1.0] }\ncontact = \"separate\"\nvelocity = [0.2]\n";
    let output = output.replace("at = [10.0]", "at = [11.0]");
    let pushed = series_of(&format!("{rest}\n{piston}\n{output}"));
    let column = |name| pushed.column(name).expect("a column");
    let (time, momentum) = (column("time"), column("momentum_x"));
    assert!(momentum[..50].iter().all(|p| p.abs() < 1e-12), "{momentum:?}");
    let rate = (momentum[65] - momentum[55]) / (time[65] - time[55]);
    assert!((rate / 2.0 - 1.0).abs() < 0.02, "{rate}");
}

/// A hammer that is six times as fast as the waves of what it hits has it on its face within a cell: no step takes a surface farther than particles go in one.
#[test]
fn a_surface_that_is_faster_than_waves_does_not_jump_into_a_body() {
    let text = COLUMN
        .replace("BACKGROUND", &GRID.replace("2.0", "4.0"))
        .replace("linear-elastic", "neo-hookean")
        .replace("velocity = [0.0, -1.0]", "")
        .replace("end = 0.6", "end = 0.04")
        .replace("interval = 0.6, series_interval = 0.05", "interval = 0.04");
    let place = "shape = { kind = \"box\", lower = [-0.5, -2.0], upper = [1.5, -0.25] }\nvelocity = [0.0, 60.0]\n";
    for hammer in ["[[obstacles]]\ncontact = \"separate\"\n", "[[held]]\n"] {
        let hit = series_of(&format!("{text}\n{hammer}{place}"));
        let lower = hit.column("lower_y").expect("a column")[1];
        assert!((lower - (60.0 * 0.04 - 0.25)).abs() < 0.1, "{hammer}{lower}");
    }
}

/// A block that is loaded all at once swings, and comes to rest where it lay: it does not hover.
#[test]
fn a_block_that_swings_stays_on_its_floor() {
    let text = COLUMN
        .replace("BACKGROUND", &format!("{GRID}\ngravity = [0.0, -1.0]"))
        .replace("[0.3, 0.3], upper = [0.7, 1.3]", "[0.3, 0.0], upper = [0.7, 1.0]")
        .replace("velocity = [0.0, -1.0]", "")
        .replace("end = 0.6", "end = 6.0");
    let wall = "[[walls]]\naxis = \"y\"\nside = \"lower\"\ncondition = \"friction\"\nfriction = 0.3\n";
    let swung = series_of(&(text + wall));
    let column = |name| swung.column(name).expect("a column");
    assert!(column("lower_y").iter().all(|y| (y - 0.025).abs() < 0.003));
    let late = &column("centre_y")[60..];
    let mean = late.iter().sum::<f64>() / late.len() as f64;
    // ρ g L² / 3 E below where it began.
    assert!((0.5 - mean - 1.0 / 300.0).abs() < 5e-4, "{mean}");
}

const HUNG: &str = r#"
dimension = 1
title = "a bar that hangs from what begins at a node"
gravity = [1.0]
grid = { spacing = 0.1 }
domain = { lower = [LOWER], upper = [3.0] }
time = { end = 4.0, damping = 5.0 }
materials.rubber = { law = "linear-elastic", density = 1.0, young_modulus = 100.0, poisson_ratio = 0.0 }
output = { interval = 4.0, series_interval = 4.0 }

[[bodies]]
name = "bar"
material = "rubber"
shape = { kind = "box", lower = [BEGIN], upper = [END] }

[[probes]]
name = "tip"
at = [END]

"#;

/// Whether a node on the face of an obstacle or of a held region belongs to it is not for rounding to say: u(L) = ρ g L² / (2 E) wherever the face is.
#[test]
fn nodes_on_a_face_belong_to_it() {
    let stick = "[[obstacles]]\nshape = { kind = \"box\", lower = [-2.0], upper = [FACE] }\ncontact = \"stick\"\n";
    let held = "[[held]]\nshape = { kind = \"box\", lower = [-2.0], upper = [FACE] }\n";
    for (what, inside) in [(stick, 0.0), (held, 0.1)] {
        for (lower, face) in [-1.0, -0.5, 0.0]
            .into_iter()
            .flat_map(|lower| (1..10).map(move |k| (lower, k)))
        {
            let face = f64::from(face) / 10.0;
            let text = [
                ("LOWER", lower),
                ("BEGIN", face - inside),
                ("FACE", face),
                ("END", face + 1.0),
            ]
            .into_iter()
            .fold(format!("{HUNG}{what}"), |text, (name, value)| {
                text.replace(name, &format!("{value:?}"))
            });
            let tip = series_of(&text).column("tip_displacement_x").expect("a probe")[1];
            assert!((tip / 0.005 - 1.0).abs() < 0.1, "{what}, {lower}, {face}: {tip}");
        }
    }
}

/// A disk of radius ½, ten cells across, rolls down a slope of 10°: a rigid one goes ⅓ g sin 10° t², this one less, since nodes stop at every new touch.
#[test]
fn a_disk_of_ten_cells_is_slow_to_roll() {
    let rolled = series_of(
        r#"
title = "disk"
dimension = 2
gravity = [1.7364817766693033, -9.84807753012208]
domain = { lower = [-1.0, 0.0], upper = [3.0, 2.0] }
grid = { spacing = 0.1 }
transfer = { kind = "apic" }
time = { end = 1.0 }
materials.rubber = { law = "neo-hookean", density = 1000.0, young_modulus = 5e6, poisson_ratio = 0.3 }
output = { interval = 1.0 }

[[bodies]]
name = "disk"
material = "rubber"
fill = "rings"
spacing = 0.05
shape = { kind = "sphere", centre = [0.0, 0.51], radius = 0.5 }

[[walls]]
axis = "y"
side = "lower"
condition = "friction"
friction = 0.5
"#,
    );
    let share = rolled.column("centre_x").expect("a column")[1] / 0.5788;
    assert!((share - 0.78).abs() < 0.05, "{share}");
}

/// Sand that has come apart to four times its volume without a stress touches at half the size that it has, at t = 0.3, not at half of what is left of F.
#[test]
fn sand_that_has_come_apart_touches_by_its_volume() {
    let text = COLUMN
        .replace("BACKGROUND", GRID)
        .replace("law = \"linear-elastic\"", "law = \"drucker-prager\"")
        .replace("poisson_ratio = 0.0", "poisson_ratio = 0.0, friction_angle = 30.0")
        .replace("velocity =", "deformation = 2.0\nvelocity =")
        .replace("series_interval = 0.05", "series_interval = 0.01");
    let wall = "[[walls]]\naxis = \"y\"\nside = \"lower\"\ncondition = \"friction\"\nfriction = 0.3\n";
    let fallen = series_of(&(text + wall));
    let momentum = fallen.column("momentum_y").expect("a column");
    assert!((momentum[29] / momentum[0] - 1.0).abs() < 1e-9, "{momentum:?}");
    assert!(momentum[31] / momentum[0] < 0.999, "{momentum:?}");
}

/// A column at rest: σ = −ρ g (L − y) in its two lowest rows of particles, also where nodes behind the floor would take a share of it. An obstacle has no images.
#[test]
fn a_column_presses_as_it_weighs() {
    let rubs = "condition = \"friction\"\nfriction = 0.3\n";
    let wall = format!("[[walls]]\naxis = \"y\"\nside = \"lower\"\n{rubs}");
    let facets = format!("[[facets]]\ngroup = \"boundary\"\n{rubs}");
    let half_space = "shape = { kind = \"half-space\", point = [0.0, 0.0], normal = [0.0, 1.0] }";
    let obstacle = format!("[[obstacles]]\n{half_space}\ncontact = \"separate\"\nfriction = 0.3\n");
    let row = |name: &str, lower: f64| {
        let upper = lower + 0.04;
        let shape = format!("{{ kind = \"box\", lower = [0.0, {lower}], upper = [1.0, {upper}] }}");
        format!("[[probes]]\nname = \"{name}\"\nregion = {shape}\n")
    };
    for (background, floor, least, most) in [
        (GRID, &wall, 0.0, 0.03),
        (MESH, &facets, 0.0, 0.06),
        (GRID, &obstacle, 0.05, 0.35),
    ] {
        let text = COLUMN
            .replace("BACKGROUND", &format!("{background}\ngravity = [0.0, -1.0]"))
            .replace("[0.3, 0.3], upper = [0.7, 1.3]", "[0.3, 0.0], upper = [0.7, 1.0]")
            .replace("velocity = [0.0, -1.0]", "")
            .replace("end = 0.6", "end = 3.0, damping = 6.0");
        let rested = series_of(&format!("{text}{floor}{}{}", row("first", 0.005), row("second", 0.055)));
        let off = [("first", 0.975), ("second", 0.925)].map(|(name, weight)| {
            let stress = rested.column(&format!("{name}_stress_yy")).expect("a probe");
            (stress.last().expect("a row") / -weight - 1.0).abs()
        });
        let largest = off[0].max(off[1]);
        assert!((least..most).contains(&largest), "{floor}{off:?}");
    }
}
