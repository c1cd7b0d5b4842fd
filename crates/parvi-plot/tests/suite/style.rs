//! Colours and markers of methods.

use parvi_plot::style::styles;

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
