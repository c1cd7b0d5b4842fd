//! Every bad scene gets an error with file, field and value.

use mpm_scenes::Scene;

use super::refusal::refusal;
use super::scenes::BLOCK;

#[test]
fn errors_name_the_file_the_field_and_the_value() {
    let cases: &[(&str, &str, &[&str])] = &[
        // Unknown and missing keys, wrong types.
        (
            "spacing = 0.25",
            "spacing = 0.25\nspacings = 1",
            &["line 13, column 1", "unknown field", "of [grid]"],
        ),
        (
            "poisson_ratio = 0.3",
            "poisson = 0.3",
            &["materials.rubber", "unknown field `poisson`"],
        ),
        (
            "centre = [2.5, 1.0], radius",
            "center = [2.5, 1.0], radius",
            &["of [bodies]", "unknown field `center`"],
        ),
        (
            "rate = [4.0] }",
            "rates = [4.0] }",
            &["of [bodies]", "unknown field `rates`"],
        ),
        ("spacing = 0.25", "", &["grid", "missing field `spacing`"]),
        ("end = 0.2", "end = \"soon\"", &["end = \"soon\"", "of [time]"]),
        (
            "basis = \"quadratic\"",
            "basis = \"quartic\"",
            &["basis = \"quartic\"", "of [grid]"],
        ),
        ("title = ", "title ", &["line 2"]),
        // Values.
        ("dimension = 2", "dimension = 4", &["dimension = 4: must be 1, 2 or 3"]),
        (
            "gravity = [0.0, -10.0]",
            "gravity = [-10.0]",
            &["gravity = [-10.0]: must be 2 finite numbers"],
        ),
        (
            "gravity = [0.0, -10.0]",
            "gravity = [0.0, -10.0]\ngravity_ramp = -1.0",
            &["gravity_ramp = -1.0: must be at least 0"],
        ),
        (
            "young_modulus = 1e5",
            "young_modulus = -1e5",
            &["materials.rubber.young_modulus = -100000.0: must be positive"],
        ),
        (
            "poisson_ratio = 0.3",
            "poisson_ratio = 0.5",
            &["materials.rubber.poisson_ratio = 0.5: must", "1/2"],
        ),
        (
            "density = 1000.0",
            "density = 0.0",
            &["materials.rubber.density = 0.0: must be positive"],
        ),
        (
            "spacing = 0.25",
            "spacing = 0",
            &["grid.spacing = 0.0: must be positive"],
        ),
        (
            "upper = [4.0, 2.0]",
            "upper = [4.0, -0.5]",
            &["domain.upper = [4.0, -0.5]: must be above"],
        ),
        (
            "kind = \"apic\"",
            "kind = \"apic\"\nflip_share = 0.5",
            &["transfer.flip_share = 0.5: must be left out"],
        ),
        (
            "kind = \"apic\"",
            "kind = \"mls\"\npic_rate = 5.0",
            &["transfer.pic_rate = 5.0: must be left out"],
        ),
        (
            "kind = \"apic\"",
            "kind = \"affine-flip\"\npic_rate = -1.0",
            &["transfer.pic_rate = -1.0"],
        ),
        (
            "kind = \"apic\"",
            "kind = \"flip\"\npic_rate = 1.0\npic_order = 0",
            &["transfer.pic_order = 0: must be at least 1"],
        ),
        (
            "kind = \"apic\"",
            "kind = \"flip\"\npic_order = 2",
            &["transfer.pic_order = 2: must be left out unless transfer.pic_rate is given"],
        ),
        ("end = 0.2", "end = 0.2\ncourant = 2", &["time.courant = 2.0"]),
        (
            "material = \"foam\"",
            "material = \"foan\"",
            &["bodies.disk.material = \"foan\"", "foam"],
        ),
        ("name = \"disk\"", "name = \"block\"", &["bodies[1].name = \"block\""]),
        (
            "seed = 3",
            "particles_per_axis = 0",
            &["bodies.disk.particles_per_axis = 0"],
        ),
        ("radius = 0.4", "radius = -0.4", &["bodies.disk.shape.radius = -0.4"]),
        ("axis = \"y\"", "axis = \"z\"", &["walls[0].axis = \"z\""]),
        (
            "condition = \"friction\"\nfriction = 0.3",
            "condition = \"friction\"",
            &["walls[0].friction", "given with"],
        ),
        (
            "condition = \"friction\"",
            "condition = \"slip\"",
            &["walls[0].friction = 0.3: must be left out"],
        ),
        ("body = \"block\"", "body = \"blok\"", &["loads[0].body = \"blok\""]),
        (
            "lower = [0.5, 0.5], upper = [0.8, 0.75]",
            "lower = [0.5, 1.5], upper = [0.8, 1.7]",
            &["loads[0].region", "particles in it"],
        ),
        (
            "friction_speed = 0.01",
            "friction_speed = -0.01",
            &["barrier.friction_speed"],
        ),
        ("gap = 0.02", "gap = 0.0", &["barrier.gap = 0.0"]),
        (
            "series_interval = 0.01",
            "series_interval = 1e-9",
            &["output.series_interval"],
        ),
        ("name = \"middle\"", "name = \"a,b\"", &["probes[0].name = \"a,b\""]),
        (
            "name = \"middle\"",
            "name = \"middle\"\nat = [1.0, 1.0]",
            &["probes[0].at"],
        ),
        (
            "[[probes]]",
            "[validation]\nreference = \"nothing\"\n\n[[probes]]",
            &["validation.reference = \"nothing\""],
        ),
        (
            "[[probes]]",
            "[validation]\nreference = \"two-disks\"\n\n[[probes]]",
            &[
                "validation.reference = \"two-disks\": must be one for this scene",
                "two spheres in the plane on a grid or a generated mesh, with the probe `first`",
            ],
        ),
        // What only the particles tell.
        (
            "radius = 0.4",
            "radius = 1.2",
            &["bodies.disk and bodies.block overlap", "bodies.block"],
        ),
        (
            "lower = [0.5, 0.25], upper = [1.5, 0.75]",
            "lower = [0.5, 0.25], upper = [0.505, 0.255]",
            &["bodies.block.shape holds no particle"],
        ),
        (
            "centre = [2.5, 1.0], radius",
            "centre = [3.8, 1.0], radius",
            &["bodies.disk: particle", "outside the domain"],
        ),
        (
            "end = 0.2",
            "end = 0.2\nstep = 0.1",
            &["time.step = 0.1: must be at most"],
        ),
        (
            "point = [0.0, 0.2]",
            "point = [0.0, 0.4]",
            &["step 1 at t = 0: particle 0 is at distance -"],
        ),
    ];
    for (from, to, expected) in cases {
        let message = refusal(BLOCK, "block.toml", from, to);
        for part in *expected {
            assert!(message.contains(part), "{to}: {message}\nlacks {part}");
        }
        if !message.contains("step 1") {
            let after = message.strip_prefix("block.toml");
            assert!(after.is_some_and(|rest| rest.starts_with([':', ','])), "{message}");
        }
    }
}

#[test]
fn a_file_that_is_not_there_is_an_error_with_its_name() {
    let message = Scene::read("no/such/scene.toml")
        .expect_err("there is none")
        .to_string();
    assert!(message.starts_with("no/such/scene.toml: cannot be read"), "{message}");
}
