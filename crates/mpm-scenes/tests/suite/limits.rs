//! Limits that scenes are warned of (`Scene::cautions`), and what does without them.

use std::path::Path;

use mpm_scenes::{Scene, Snapshot, frames};

/// An undamped body under a pressure of E / 50 on all of its boundary, which grows over two seconds.
const PRESSED: &str = r#"
title = "a block under pressure"
dimension = 2
transfer = { kind = "apic" }
time = { end = 3.0 }
materials.rubber = { law = "neo-hookean", density = 1.0, young_modulus = 1000.0, poisson_ratio = 0.3 }
facets = [{ group = "boundary", condition = "traction", pressure = 20.0, ramp = 2.0 }]
output = { interval = 3.0 }

[mesh]
generate = { kind = "rectangle", lower = [-1.0, -0.5], upper = [1.0, 0.5], size = 0.2 }
KERNEL

[[bodies]]
name = "block"
material = "rubber"
shape = { kind = "box", lower = [-1.0, -0.5], upper = [1.0, 0.5] }
FILL
"#;

fn scene(text: &str) -> Scene {
    Scene::parse(text, Path::new("limit.toml")).expect("a scene")
}

fn pressed(kernel: &str, fill: &str) -> Scene {
    scene(&PRESSED.replace("KERNEL", kernel).replace("FILL", fill))
}

/// Least and largest normal stress of a particle at the end, over the pressure.
fn stresses(scene: &Scene) -> [f64; 2] {
    let mut end = Snapshot::default();
    frames(scene, &mut |snapshot| end = snapshot).expect("a run");
    let normal = end.stresses.chunks(4).flat_map(|stress| [stress[0], stress[3]]);
    normal.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], stress| {
        [least.min(stress / 20.0), most.max(stress / 20.0)]
    })
}

/// −1 is exact, but for waves.
#[test]
fn tractions_throw_single_particles_about_where_an_outer_layer_shares_them() {
    let lattice = "particles_per_axis = 2";
    let layer = pressed("outer_layer = true", lattice);
    let [least, most] = stresses(&layer);
    assert!(
        (-15.0..-13.0).contains(&least) && (8.0..10.0).contains(&most),
        "{least} to {most}"
    );
    assert!(layer.cautions()[0].starts_with("facets[0]: "));
    let exact = "kernel = \"smooth\"\ngradient = \"exact\"\nwidth = \"local\"";
    let cells = "fill = \"cells\"\nparticles_per_axis = 1";
    for (kernel, fill) in [("outer_layer = false", lattice), (exact, cells)] {
        let other = pressed(kernel, fill);
        let [least, most] = stresses(&other);
        assert!(least > -3.0 && most < 0.0, "{kernel}: {least} to {most}");
        assert_eq!(other.cautions(), [""; 0]);
    }
}

/// It swings with a thousandth of the speed of its waves, on a mesh of random points.
const SWINGING: &str = r#"
title = "a bar on hat functions"
dimension = 2
transfer = { kind = "apic" }
time = { end = 4.0, courant = 0.2 }
materials.rubber = { law = "neo-hookean", density = 1.0, young_modulus = 1.0, poisson_ratio = 0.0 }
walls = [{ axis = "x", side = "lower", condition = "fixed" }]
output = { interval = 4.0 }

[mesh]
generate = { kind = "rectangle", lower = [0.0, 0.0], upper = [1.2, 0.4], size = 0.05 }
delaunay = { seed = 5 }
kernel = "hat"

[[bodies]]
name = "bar"
material = "rubber"
shape = { kind = "box", lower = [0.0, 0.0], upper = [1.0, 0.4] }
spacing = 0.025
velocity = { kind = "sine", amplitude = [1e-3, 0.0], wave_vector = [1.5707963267948966, 0.0] }
"#;

#[test]
fn hat_functions_invert_particles_at_small_strains_on_random_meshes() {
    for courant in ["courant = 0.2", "courant = 0.05"] {
        let hats = scene(&SWINGING.replace("courant = 0.2", courant));
        let message = frames(&hats, &mut |_| {}).expect_err("it is inverted").to_string();
        assert!(message.contains("the volume ratio det F must be positive"), "{message}");
        assert!(hats.cautions()[0].starts_with("mesh.kernel = \"hat\": "));
    }
    let other = scene(&SWINGING.replace("kernel = \"hat\"\n", ""));
    frames(&other, &mut |_| {}).expect("a run");
    assert_eq!(other.cautions(), [""; 0]);
}
