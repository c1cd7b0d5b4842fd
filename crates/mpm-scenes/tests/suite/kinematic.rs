//! Particles with a prescribed motion, and runs in memory.

use mpm_scenes::{HeldRegion, Kinematics, Population, Scene, Snapshot, frames};

use super::scenes::scene;

const STRIP: &str = include_str!("../data/strip.toml");

/// Turned at one end and held at the other.
const TURNED: &str = r#"
[[kinematic]]
region = { kind = "box", lower = [0.0, 0.0], upper = [0.25, 0.5] }

[[kinematic]]
region = { kind = "box", lower = [1.75, 0.0], upper = [2.0, 0.5] }
velocity = [0.1, 0.0]
rotation = { centre = [2.0, 0.25], rate = [1.5] }
until = 0.1
"#;

/// The strip with these regions.
fn strip(regions: &str) -> String {
    format!("{STRIP}{regions}")
}

fn all_frames(scene: &Scene) -> Vec<Snapshot> {
    let mut all = Vec::new();
    let effort = frames(scene, &mut |frame| all.push(frame)).expect("runs");
    assert_eq!(effort.steps, 40);
    all
}

#[test]
fn steps_that_divide_a_frame_are_not_cut_by_rounding() {
    for (step, steps) in [("0.005", 40), ("0.0025", 80), ("0.002", 100), ("0.001", 200)] {
        let scene = scene(&STRIP.replace("0.0050000001", step));
        let effort = frames(&scene, &mut |_| {}).expect("runs");
        assert_eq!(effort.steps, steps, "{step}");
    }
}

#[test]
fn kinematic_particles_are_where_their_motion_puts_them_until_they_are_let_go() {
    let scene = scene(&strip(TURNED));
    let population = Population::<2>::fill(&scene).expect("fills");
    let kinematics = Kinematics::of(&scene, &population).expect("both regions hold particles");
    assert_eq!(
        kinematics.regions().iter().map(|r| r.members.len()).collect::<Vec<_>>(),
        [8, 8]
    );
    let all = all_frames(&scene);
    assert_eq!(all.len(), 5);
    for frame in &all {
        for (p, start) in population.positions.iter().enumerate() {
            let Some((x, v)) = kinematics.prescribed(p, start, frame.time) else {
                continue;
            };
            assert_eq!(frame.vector(&frame.positions, p), Some(&x[..]));
            if frame.time > 0.0 {
                assert_eq!(frame.vector(&frame.velocities, p), Some(&v[..]));
            }
        }
    }
    let turned = &kinematics.regions()[1];
    assert!(turned.prescribes(0.1) && !turned.prescribes(0.15));
    // What was let go comes back.
    let (p, last) = (turned.members[0], &all[4]);
    let held = turned.motion.position(&population.positions[p], 0.2);
    let free = last.vector(&last.positions, p).expect("a particle");
    assert!((held[1] - free[1]).abs() > 1e-3, "{held:?} {free:?}");
}

/// The grid takes what is free along with what moves, from the first step on.
#[test]
fn the_first_step_knows_the_prescribed_velocity() {
    let half =
        "\n[[kinematic]]\nregion = { kind = \"box\", lower = [0.0, 0.0], upper = [1.0, 0.5] }\nvelocity = [1.0, 0.0]\n";
    let one_step = strip(half)
        .replace("end = 0.2", "end = 0.005")
        .replace("interval = 0.05", "interval = 0.005");
    let mut last = Snapshot::default();
    let effort = frames(&scene(&one_step), &mut |frame| last = frame).expect("runs");
    assert_eq!(effort.steps, 1);
    let beside = last.reference_positions.chunks(2).zip(last.velocities.chunks(2));
    let beside = beside.filter(|(x, _)| x[0] > 1.0).map(|(_, v)| v[0]);
    let fastest = beside.fold(0.0, f64::max);
    assert!(fastest > 0.1, "{fastest}");
}

#[test]
fn a_region_without_particles_is_an_error_with_its_field() {
    let text = strip(TURNED).replace(
        "lower = [1.75, 0.0], upper = [2.0, 0.5]",
        "lower = [2.1, 0.0], upper = [2.5, 0.5]",
    );
    let scene = scene(&text);
    let error = frames(&scene, &mut |_| ()).expect_err("an empty region");
    assert!(error.to_string().contains("kinematic[1].region"), "{error}");
}

#[test]
fn frames_in_memory_are_those_of_the_files() {
    let scene = scene(&strip(TURNED));
    let directory = tempfile::tempdir().expect("a directory");
    mpm_scenes::simulate(&scene, directory.path(), &mut ()).expect("runs");
    for (number, frame) in all_frames(&scene).iter().enumerate() {
        let file = directory.path().join(format!("particles_{number:06}.vtu"));
        assert_eq!(std::fs::read(file).expect("written"), mpm_scenes::output::vtu(frame));
    }
}

/// All nodes around it are held by a region that moves.
const CARRIED: &str = r#"
[[held]]
shape = { kind = "box", lower = [-0.5, -0.5], upper = [2.5, 1.0] }
velocity = [1.0, -0.5]
rotation = { centre = [0.2, 0.1], rate = [4.0] }
"#;

#[test]
fn held_nodes_that_move_and_turn_carry_a_body_exactly() {
    let scene = scene(&strip(CARRIED));
    let population = Population::<2>::fill(&scene).expect("fills");
    let motion = HeldRegion::<2>::of(&scene).expect("one region")[0].motion;
    for frame in all_frames(&scene) {
        let (sin, cos) = (4.0 * frame.time).sin_cos();
        for (p, start) in population.positions.iter().enumerate() {
            let x = frame.vector(&frame.positions, p).expect("a particle");
            let expected = motion.position(start, frame.time);
            assert!(
                (x[0] - expected[0]).abs() < 1e-13 && (x[1] - expected[1]).abs() < 1e-13,
                "{x:?} {expected:?}"
            );
            let gradient = &frame.deformation_gradients[4 * p..4 * p + 4];
            for (found, turn) in gradient.iter().zip([cos, -sin, sin, cos]) {
                assert!((found - turn).abs() < 1e-12, "{gradient:?}");
            }
        }
    }
}

#[test]
fn held_nodes_are_let_go_after_their_time() {
    let text = strip(CARRIED)
        .replace("rotation = { centre = [0.2, 0.1], rate = [4.0] }", "until = 0.1")
        .replace("dimension = 2", "dimension = 2\ngravity = [0.0, -10.0]");
    let scene = scene(&text);
    let population = Population::<2>::fill(&scene).expect("fills");
    for frame in all_frames(&scene) {
        // Symplectic Euler: n steps of free fall after the first 20.
        let n = ((frame.time - 0.1) / 0.005).round().max(0.0);
        let fallen = 10.0 * 0.005 * 0.005 * n * (n + 1.0) / 2.0;
        for (p, start) in population.positions.iter().enumerate() {
            let x = frame.vector(&frame.positions, p).expect("a particle");
            let expected = [start[0] + frame.time, start[1] - 0.5 * frame.time - fallen];
            assert!(
                (x[0] - expected[0]).abs() < 1e-12 && (x[1] - expected[1]).abs() < 1e-12,
                "{x:?} {expected:?}"
            );
        }
    }
}

#[test]
fn motions_of_held_nodes_that_make_no_sense_are_errors_with_their_field() {
    for (from, to, said) in [
        ("rate = [4.0]", "rate = [4.0, 1.0]", "held[0].rotation.rate"),
        ("centre = [0.2, 0.1]", "centre = [0.2]", "held[0].rotation.centre"),
        ("velocity = [1.0, -0.5]", "velocity = [1.0]", "held[0].velocity"),
        ("velocity = [1.0, -0.5]", "until = -1.0", "held[0].until"),
        ("velocity = [1.0, -0.5]", "till = 1.0", "unknown field `till`"),
    ] {
        let error = Scene::parse(&strip(CARRIED).replace(from, to), "carried.toml".as_ref()).expect_err(to);
        assert!(error.to_string().contains(said), "{error}");
    }
}
