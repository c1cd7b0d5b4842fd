//! Combinations of changes.

use mpm_scenes::variation::{Axis, combinations};
use serde::Deserialize;

fn axes(text: &str) -> Vec<Axis> {
    #[derive(Deserialize)]
    struct Document {
        axes: Vec<Axis>,
    }
    toml::from_str::<Document>(text).unwrap().axes
}

#[test]
fn axes_multiply_and_label() {
    let axes = axes(
        r#"axes = [
            { key = "grid.basis", values = ["linear", "cubic"] },
            { choices = [{ label = "FLIP", set = { "transfer" = { kind = "flip" } }, drop = ["mesh"] }, { set = { "transfer.kind" = "apic" } }] },
            { key = "time.end", values = [1, 2], worst = true },
            { key = "bodies.0.shape.upper", values = [[1.0, 2.0], [1.0, 4.0]] },
        ]"#,
    );
    let all = combinations(&axes, &["bodies.0.shape.upper.1".to_owned()]).unwrap();
    assert_eq!(all.len(), 16);
    let labels: Vec<&str> = all.iter().step_by(4).map(|one| one.label.as_str()).collect();
    assert_eq!(labels, ["linear, FLIP", "linear", "cubic, FLIP", "cubic"]);
    assert_eq!(all[5].name, "linear, kind = apic, end = 1, upper = [1.0, 4.0]");
    assert_eq!(all[5].set.len(), 4);
    assert_eq!(
        (all[0].drop.as_slice(), all[5].drop.len()),
        (&["mesh".to_owned()][..], 0)
    );
}

#[test]
fn numbers_that_are_not_x_carry_their_names() {
    let axes = axes("axes = [{ key = \"a.speed.0\", values = [0.1] }, { key = \"b\", label = \"v\", values = [2.5] }]");
    assert_eq!(
        combinations(&axes, &["grid.spacing".to_owned()]).unwrap()[0].label,
        "speed = 0.1, v = 2.5"
    );
}

/// A whole mesh that is named is a series; without a name it is a place on the axis of its size.
#[test]
fn a_choice_that_is_named_keeps_its_name_unless_it_is_x_itself() {
    let x = ["mesh.size".to_owned()];
    let label = |choice: &str| {
        let axes = axes(&format!("axes = [{{ choices = [{choice}] }}]"));
        combinations(&axes, &x).unwrap()[0].label.clone()
    };
    assert_eq!(label("{ label = \"fine\", set = { mesh = { size = 0.1 } } }"), "fine");
    assert_eq!(label("{ set = { mesh = { size = 0.1 } } }"), "");
    assert_eq!(label("{ label = \"fine\", set = { \"mesh.size\" = 0.1 } }"), "");
}

#[test]
fn half_an_axis_is_refused() {
    for (text, part) in [
        ("axes = [{ key = \"a\", values = [] }]", "empty"),
        ("axes = [{ values = [1] }]", "axes.0 needs either"),
        (
            "axes = [{ key = \"a\", values = [1], choices = [{ set = {} }] }]",
            "needs either",
        ),
    ] {
        let message = combinations(&axes(text), &["x".to_owned()]).unwrap_err();
        assert!(message.contains(part), "{message}");
    }
}
