//! Small scenes that tests share.

use std::path::Path;

use mpm_scenes::Scene;

/// A bar that swings in its first mode, D = 1.
pub const BAR: &str = r#"
title = "bar"
dimension = 1

[domain]
lower = [0.0]
upper = [12.0]

[grid]
spacing = 1.0

[transfer]
kind = "flip"
flip_share = 1.0

[time]
end = 2.0
courant = 0.2

[materials.steel]
law = "linear-elastic"
density = 1.0
young_modulus = 100.0
poisson_ratio = 0.0

[[bodies]]
name = "bar"
shape = { kind = "box", lower = [0.0], upper = [10.0] }
material = "steel"
velocity = { kind = "sine", amplitude = [0.1], wave_vector = [0.15707963267948966] }

[[walls]]
axis = "x"
side = "lower"
condition = "fixed"

[output]
interval = 0.5
series_interval = 0.1

[[probes]]
name = "tip"
at = [10.0]
"#;

/// A block that falls on a floor and slides on it, beside a disk, D = 2.
pub const BLOCK: &str = r#"
title = "block and disk"
dimension = 2
gravity = [0.0, -10.0]
volume_averaging = true

[domain]
lower = [0.0, -0.5]
upper = [4.0, 2.0]

[grid]
spacing = 0.25
basis = "quadratic"

[transfer]
kind = "apic"

[time]
end = 0.2

[materials.rubber]
law = "neo-hookean"
density = 1000.0
young_modulus = 1e5
poisson_ratio = 0.3

[materials.foam]
law = "linear-elastic"
density = 100.0
young_modulus = 1e4
poisson_ratio = 0.2

[[bodies]]
name = "block"
shape = { kind = "box", lower = [0.5, 0.25], upper = [1.5, 0.75] }
material = "rubber"
velocity = [1.0, 0.0]

[[bodies]]
name = "disk"
shape = { kind = "sphere", centre = [2.5, 1.0], radius = 0.4 }
material = "foam"
fill = "poisson-disk"
seed = 3
velocity = { kind = "rotation", centre = [2.5, 1.0], rate = [4.0] }

[[walls]]
axis = "y"
side = "lower"
condition = "friction"
friction = 0.3

[[obstacles]]
shape = { kind = "half-space", point = [3.5, 0.0], normal = [-1.0, 0.5] }
contact = "separate"
friction = 0.1

[[loads]]
kind = "point-force"
region = { kind = "box", lower = [0.5, 0.5], upper = [0.8, 0.75] }
body = "block"
force = [500.0, 0.0]
ramp = 0.1

[barrier]
shapes = [{ kind = "half-space", point = [0.0, 0.2], normal = [0.0, 1.0] }]
stiffness = 1e7
gap = 0.02
friction = 0.2
friction_speed = 0.01

[output]
interval = 0.05
series_interval = 0.01
checkpoint_interval = 0.04

[[probes]]
name = "middle"
region = { kind = "sphere", centre = [1.0, 0.5], radius = 0.2 }
"#;

/// Sand, metal and water that fall side by side, D = 2: laws with memory and a stress that depends on the rate.
pub const HEAPS: &str = r#"
title = "heaps"
dimension = 2
gravity = [0.0, -10.0]

[domain]
lower = [0.0, 0.0]
upper = [6.0, 2.0]

[grid]
spacing = 0.25
basis = "linear"

[transfer]
kind = "flip"

[time]
end = 0.15
stress_update = "modified-last"
damping = 0.1

[materials.sand]
law = "drucker-prager"
density = 2000.0
young_modulus = 1e5
poisson_ratio = 0.3
friction_angle = 30.0

[materials.metal]
law = "softening-hencky"
density = 3000.0
young_modulus = 1e6
poisson_ratio = 0.3
peak_yield_stress = 3e3
residual_yield_stress = 1e3
softening_rate = 5.0

[materials.water]
law = "tait-fluid"
density = 1000.0
sound_speed = 20.0
viscosity = 1.0

[[bodies]]
name = "sand"
shape = { kind = "polygon", corners = [[0.5, 0.0], [1.5, 0.0], [1.0, 1.0]] }
material = "sand"
velocity = [0.0, -2.0]

[[bodies]]
name = "metal"
shape = { kind = "box", lower = [2.5, 0.0], upper = [3.0, 1.0] }
material = "metal"
velocity = [0.0, -2.0]

[[bodies]]
name = "water"
shape = { kind = "box", lower = [4.0, 0.0], upper = [5.0, 1.0] }
material = "water"
velocity = [0.0, -2.0]

[[walls]]
axis = "y"
side = "lower"
condition = "slip"

[output]
interval = 0.05
"#;

/// A cube in free rotation, D = 3.
pub const CUBE: &str = r#"
title = "cube"
dimension = 3

[domain]
lower = [-1.0, -1.0, -1.0]
upper = [1.0, 1.0, 1.0]

[grid]
spacing = 0.2
basis = "cubic"

[transfer]
kind = "mls"

[time]
end = 0.1
stress_update = "first"

[materials.rubber]
law = "neo-hookean"
density = 1.0
young_modulus = 10.0
poisson_ratio = 0.3

[[bodies]]
name = "cube"
shape = { kind = "box", lower = [-0.4, -0.4, -0.4], upper = [0.4, 0.4, 0.4] }
material = "rubber"
velocity = { kind = "rotation", centre = [0.0, 0.0, 0.0], rate = [0.0, 1.0, 2.0] }

[output]
interval = 0.05
"#;

/// A block that turns and swings freely on a lattice of triangles, D = 2.
pub const BLOCK_ON_MESH: &str = r#"
title = "a block on a lattice"
dimension = 2

[mesh]
generate = { kind = "lattice", lower = [-1.0, -1.0], upper = [1.0, 1.0], size = 0.2 }

[transfer]
kind = "apic"

[time]
end = 0.2

[materials.rubber]
law = "neo-hookean"
density = 1.0
young_modulus = 10.0
poisson_ratio = 0.3

[[bodies]]
name = "block"
material = "rubber"
shape = { kind = "box", lower = [-0.4, -0.3], upper = [0.4, 0.3] }
spacing = 0.1
velocity = { kind = "linear", centre = [0.0, 0.0], gradient = [[0.3, 0.2], [0.5, -0.1]] }

[output]
interval = 0.1
series_interval = 0.02
"#;

/// A block inside a square mesh whose boundary it cannot pass, D = 2.
pub const RUBBER_ON_MESH: &str = r#"
title = "rubber on a mesh"
dimension = 2

[mesh]
generate = { kind = "rectangle", lower = [0.0, 0.0], upper = [1.0, 1.0], size = 0.2 }

[time]
end = 0.1

[materials.rubber]
law = "neo-hookean"
density = 1.0
young_modulus = 1.0
poisson_ratio = 0.3

[[bodies]]
name = "block"
material = "rubber"
shape = { kind = "box", lower = [0.3, 0.3], upper = [0.6, 0.6] }
spacing = 0.05
velocity = [0.1, 0.0]

[[walls]]
axis = "x"
side = "lower"
condition = "slip"

[barrier]
against = "mesh"
stiffness = 1.0
gap = 0.05

[output]
interval = 0.05
"#;

/// The scene of a text.
pub fn scene(text: &str) -> Scene {
    Scene::parse(text, Path::new("test.toml")).expect("a good scene")
}
