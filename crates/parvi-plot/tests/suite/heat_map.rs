//! Cells of heat maps.

use parvi_plot::{cell_of, logarithmic_edges};

#[test]
fn cells_cover_the_range() {
    let edges = logarithmic_edges([0.1, 10.0], 6);
    assert_eq!(edges.len(), 7);
    assert_eq!(cell_of(&edges, 0.1), Some(0));
    assert_eq!(cell_of(&edges, 10.0), Some(5));
    assert_eq!(cell_of(&edges, 1.01), Some(3));
    assert_eq!(cell_of(&edges, 11.0), None);
    assert_eq!(cell_of(&edges, f64::NAN), None);
    assert_eq!(cell_of(&[], 1.0), None);
}

#[test]
fn what_is_no_range_has_no_cells() {
    for (ends, cells) in [
        ([1.0, 10.0], 0),
        ([0.0, 10.0], 2),
        ([-1.0, 10.0], 2),
        ([1.0, f64::NAN], 2),
        ([1.0, f64::INFINITY], 2),
        ([10.0, 1.0], 2),
    ] {
        assert_eq!(logarithmic_edges(ends, cells), [0.0; 0], "{ends:?}, {cells}");
    }
}
