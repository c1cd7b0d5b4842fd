//! Lines through rows.

use parvi_plot::MultiplesPanel;
use parvi_plot::results::Rows;

use super::rows;

#[test]
fn lines_go_through_medians_or_through_every_row() {
    let rows = rows();
    let here = rows.iter().collect::<Rows<'_>>().with("method", "mpm");
    let curve = here.curve("mpm", "size", "error");
    assert_eq!((curve.x, curve.y), (vec![16.0, 64.0], vec![2.5, 0.5]));
    assert_eq!(curve.bars, [(1.0, 4.0), (0.5, 0.5)]);
    assert_eq!(here.line("mpm", "size", "error").x, [64.0, 16.0, 16.0]);
    assert_eq!(here.medians("mpm", "size", "error").y, [4.0, 0.5]);
    let curves = here.curves(("n = ", "size"), [16_usize, 99], "size", "error");
    let ends = curves.iter().map(|line| (line.label.as_str(), line.y.clone()));
    assert!(ends.eq([("n = 16", vec![2.5]), ("n = 99", Vec::new())]));
    let path = here.path("mpm", "case", "size", "error");
    assert_eq!(path.x, [64.0, 16.0, 16.0, 16.0]);
    assert!(path.y[2].is_nan() && path.y[3] == 4.0);
    let orders = here.orders("size", [16_usize], "error", Some(4));
    assert_eq!(
        (orders[0].label.as_str(), &orders[0].x[..], &orders[0].y[..]),
        ("16", &[12.5, 37.5][..], &[1.0, 4.0][..])
    );
    let panels = here.panels(("n = ", "size"), [64.0], |rows| {
        MultiplesPanel::new("", [rows.line("", "size", "error")])
    });
    assert_eq!(
        (panels[0].title.as_str(), &panels[0].series[0].y[..]),
        ("n = 64", &[0.5][..])
    );
}

#[test]
fn pairs_come_by_the_values_of_a_third_column() {
    let rows = rows();
    let here = rows.iter().collect::<Rows<'_>>().with("method", "mpm");
    let pairs = here.pairs_by("size", "size", "error");
    assert_eq!(pairs[1], [(64.0, 0.5)]);
    assert_eq!((pairs.len(), pairs[0].len(), pairs[0][0]), (2, 3, (16.0, 1.0)));
}

#[test]
fn table_lines_are_of_two_columns_or_of_cells() {
    let rows = rows();
    let rows: Rows<'_> = rows.iter().collect();
    let lines = rows.lines_by(("method", ["mpm", "iid"]), ("size", [16_usize, 64]));
    let counts: Vec<usize> = lines.iter().map(|line| line.rows.len()).collect();
    assert_eq!(counts, [3, 1, 1, 0]);
    let cells = rows.lines_in_cells("error", [0.1, 10.0], 2);
    let counts: Vec<usize> = cells.iter().map(|line| line.rows.len()).collect();
    assert_eq!(counts, [1, 3]);
}
