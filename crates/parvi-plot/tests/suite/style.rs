//! Colours and markers of methods.

use parvi_plot::style::{crossed_styles, styles};

#[test]
fn a_method_keeps_its_style_whatever_the_company() {
    let alone = styles(&["mpm"]);
    let together = styles(&["svgd", "mpm", "lattice", "quadratic"]);
    assert_eq!(alone[0], together[1]);
}

#[test]
fn no_two_series_look_alike() {
    let names: Vec<String> = (0..20).map(|i| format!("s{i}")).collect();
    let mut all: Vec<&str> = names.iter().map(String::as_str).collect();
    all.extend(["mpm", "svgd", "iid", "sobol", "paper-pic", "paper-apic", "nuts", "ais"]);
    let styles = styles(&all);
    for (index, style) in styles.iter().enumerate() {
        assert!(!styles[..index].contains(style), "{}: {style:?}", all[index]);
    }
}

#[test]
fn crossed_settings_share_the_colour_or_the_marker_of_a_number() {
    let styles = crossed_styles(&[[0.0, 1.0], [0.0, 2.0], [3.0, 1.0]]);
    assert!(styles[0].color == styles[1].color && styles[0].marker != styles[1].marker);
    assert!(styles[0].color != styles[2].color && styles[0].marker == styles[2].marker);
}
