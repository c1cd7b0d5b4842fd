//! What is around the bodies of a scene may come to them later, but has to come.

use mpm_scenes::{Scene, frames};

use super::scenes::{BLOCK, RUBBER_ON_MESH, scene};

/// What is said of the block's scene with more in it, which is run in memory up to its first frame.
fn said(scene: &Scene) -> Option<String> {
    frames(scene, &mut |_| {}).err().map(|error| error.to_string())
}

fn block(added: &str) -> Option<String> {
    said(&scene(&(BLOCK.replace("end = 0.2", "end = 0.01") + added)))
}

#[test]
fn an_obstacle_that_arrives_is_accepted_and_one_that_stays_away_is_not() {
    let hammer = |speed: f64, moves: bool| {
        block(&format!(
            "\n[[obstacles]]\nshape = {{ kind = \"sphere\", centre = [2.0, 2.8], radius = 0.5 }}\ncontact = \"separate\"\nvelocity = [0.0, {speed:?}]\nmoves = {moves}\n"
        ))
    };
    assert_eq!(hammer(-6.0, true), None);
    for (speed, moves) in [(-4.0, true), (6.0, true), (-6.0, false)] {
        let message = hammer(speed, moves).expect("it does not arrive");
        assert!(message.contains("obstacles[1].shape"), "{message}");
    }
}

/// A cell is 0.25 wide, and the end is at 0.01.
#[test]
fn a_wall_stays_where_it_is_and_is_not_left_behind() {
    let lid = |velocity: [f64; 2]| {
        block(&format!(
            "\n[[walls]]\naxis = \"y\"\nside = \"upper\"\ncondition = \"prescribed\"\nvelocity = {velocity:?}\n"
        ))
    };
    assert_eq!(lid([3.0, 1.0]), None);
    let message = lid([3.0, 30.0]).expect("it goes three tenths");
    assert!(message.contains("walls[1].velocity = [3.0, 30.0]"), "{message}");
}

#[test]
fn a_held_region_that_arrives_or_turns_is_accepted() {
    let held = |motion: &str| {
        block(&format!(
            "\n[[held]]\nshape = {{ kind = \"sphere\", centre = [2.0, 2.8], radius = 0.5 }}\n{motion}\n"
        ))
    };
    assert_eq!(held("velocity = [0.0, -6.0]"), None);
    assert_eq!(held("rotation = { centre = [2.0, 1.0], rate = [1.0] }"), None);
    assert!(held("velocity = [0.0, -6.0]\nuntil = 0.001").is_some());
}

/// Two regions at a body, of which one would say nothing about the nodes in both.
#[test]
fn two_motions_of_the_same_nodes_are_refused() {
    let held = |centre: [f64; 2], velocity: [f64; 2]| {
        format!(
            "\n[[held]]\nshape = {{ kind = \"sphere\", centre = {centre:?}, radius = 0.3 }}\nvelocity = {velocity:?}\n"
        )
    };
    let first = held([0.75, 0.5], [0.0, 0.0]);
    let two = |centre, velocity| block(&format!("{first}{}", held(centre, velocity)));
    let message = two([1.0, 0.5], [0.0, 1.0]).expect("they have nodes in common");
    let expected = "held[0] and held[1] move in two ways and hold the same nodes";
    assert!(message.contains(expected), "{message}");
    assert_eq!(two([1.0, 0.5], [0.0, 0.0]), None);
    assert_eq!(two([1.5, 0.5], [0.0, 1.0]), None);
    // No particle is near the nodes that a lid and a side have in common.
    let half_space = |point: [f64; 2], normal: [f64; 2], motion: &str| {
        format!("\n[[held]]\nshape = {{ kind = \"half-space\", point = {point:?}, normal = {normal:?} }}\n{motion}\n")
    };
    let side = half_space([0.1, 0.0], [1.0, 0.0], "");
    let lid = half_space([0.0, 1.9], [0.0, -1.0], "velocity = [0.0, -0.1]");
    assert_eq!(block(&(side + &lid)), None);
}

/// A normal has no length that it must have.
#[test]
fn a_normal_of_any_length_is_one() {
    for length in ["1e300", "3.0", "1e-300"] {
        let wall = format!("\n[[walls]]\npoint = [0.0, 0.0]\nnormal = [{length}, 0.0]\ncondition = \"slip\"\n");
        assert_eq!(block(&wall), None, "{length}");
    }
}

/// A plate through the nodes of one column is found, wherever it stands; one between two columns holds none.
#[test]
fn nodes_in_thin_plates_are_found() {
    for column in 0..16 {
        let plate = |x: f64| {
            block(&format!(
                "\n[[obstacles]]\nshape = {{ kind = \"box\", lower = [{:?}, 1.6], upper = [{:?}, 1.9] }}\ncontact = \"slip\"\n",
                x - 1e-3,
                x + 1e-3
            ))
        };
        let x = 0.25 * f64::from(column);
        assert_eq!(plate(x), None, "{x}");
        assert!(plate(x + 0.125).is_some(), "{x}");
    }
}

/// A body that touches an obstacle begins beside it.
#[test]
fn a_body_may_touch_an_obstacle() {
    let table = |lower: f64| {
        block(&format!(
            "\n[[obstacles]]\nshape = {{ kind = \"box\", lower = [{lower:?}, 0.25], upper = [2.0, 0.8] }}\ncontact = \"slip\"\n"
        ))
    };
    assert_eq!(table(1.5), None);
    let message = table(1.4).expect("inside");
    assert!(message.contains("bodies.block: particle") && message.contains("begins inside obstacles[1].shape"));
}

/// A barrier that a body cannot reach on a mesh.
#[test]
fn a_barrier_far_from_a_mesh_is_refused() {
    let barrier = |x: f64| {
        let shape = format!("shapes = [{{ kind = \"half-space\", point = [{x:?}, 0.0], normal = [1.0, 0.0] }}]");
        said(&scene(&RUBBER_ON_MESH.replace("against = \"mesh\"", &shape)))
    };
    assert_eq!(barrier(0.1), None);
    let message = barrier(-3.0).expect("far");
    assert!(
        message.contains("barrier.shapes[0]") && message.contains("the mesh and its layer"),
        "{message}"
    );
}
