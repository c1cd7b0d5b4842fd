//! Limits that scenes are warned of (`Scene::cautions`), and what does without them.

use std::path::Path;

use mpm_scenes::{Scene, frames};

fn scene(text: &str) -> Scene {
    Scene::parse(text, Path::new("limit.toml")).expect("a scene")
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
