//! Every bad scene gets an error with file, field and value.

use std::path::Path;

use mpm_scenes::{Population, Scene, SceneFault};

use super::refusal::assert_refused;
use super::scenes::{BAR, BLOCK};

const STRIP: &str = include_str!("../data/strip.toml");

#[test]
fn errors_name_the_file_the_field_and_the_value() {
    assert_refused(BLOCK, "block.toml", include_str!("../data/block_refused.toml"));
}

#[test]
fn one_axis_is_counted_as_one() {
    let text = BAR.replace("axis = \"x\"", "axis = \"y\"");
    let message = Scene::parse(&text, Path::new("bar.toml"))
        .expect_err("no y")
        .to_string();
    let expected = "walls[0].axis = \"y\": must be an axis of the scene, whose dimension is 1";
    assert!(message.contains(expected), "{message}");
}

#[test]
fn momentum_is_kept_by_closed_systems_alone() {
    let strip = format!("{STRIP}\n[validation]\nreference = \"conservation\"\n");
    let read = |text: &str| Scene::parse(text, Path::new("strip.toml"));
    read(&strip).expect("a closed system");
    let open = [
        "\n[[walls]]\naxis = \"y\"\nside = \"lower\"\ncondition = \"slip\"\n",
        "\n[[loads]]\nkind = \"point-force\"\nregion = { kind = \"sphere\", centre = [2.0, 0.5], radius = 0.2 }\nforce = [0.0, -1.0]\n",
        "\n[[kinematic]]\nregion = { kind = \"sphere\", centre = [2.0, 0.5], radius = 0.2 }\n",
    ];
    let damped = strip.replace("end = 0.2", "end = 0.2, damping = 0.1");
    for text in open.map(|table| format!("{strip}{table}")).iter().chain([&damped]) {
        let message = read(text).expect_err("momentum is not kept").to_string();
        let expected = "validation.reference = \"conservation\": must be one for this scene";
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn walls_in_one_plane_may_say_the_same_and_those_in_two_what_they_like() {
    let wall = |text: &str| BLOCK.replace("[[obstacles]]", &format!("[[walls]]\n{text}\n\n[[obstacles]]"));
    let lower = "axis = \"y\"\nside = \"lower\"\ncondition = \"friction\"\nfriction = 0.3";
    let upper = "axis = \"y\"\nside = \"upper\"\nposition = -0.5\ncondition = \"slip\"";
    let above = "axis = \"y\"\nside = \"lower\"\nposition = -0.25\ncondition = \"slip\"";
    for text in [lower, upper, above] {
        let parsed = Scene::parse(&wall(text), Path::new("block.toml"));
        assert!(parsed.is_ok(), "{text}: {:?}", parsed.err());
    }
}

#[test]
fn a_particle_on_a_wall_is_not_behind_it() {
    let fill = |position: f64| {
        let text = BLOCK.replace(
            "side = \"lower\"",
            &format!("side = \"lower\"\nposition = {position:?}"),
        );
        let scene = Scene::parse(&text, Path::new("block.toml")).expect("sound");
        Population::<2>::fill(&scene)
    };
    let heights = fill(0.0).expect("above the wall").positions.into_iter().map(|x| x[1]);
    let lowest = heights.fold(f64::INFINITY, f64::min);
    assert!(fill(lowest).is_ok());
    let above = fill(lowest + 1e-6);
    assert!(matches!(
        above,
        Err(SceneFault::BehindWall {
            particle: 0,
            wall: 0,
            ..
        })
    ));
}

#[test]
fn a_file_that_is_not_there_is_an_error_with_its_name() {
    let message = Scene::read("no/such/scene.toml")
        .expect_err("there is none")
        .to_string();
    assert!(message.starts_with("no/such/scene.toml: cannot be read"), "{message}");
}
