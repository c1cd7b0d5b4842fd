//! Choices of rows.

use parvi_plot::results::Rows;

use super::rows;

#[test]
fn rows_are_told_apart_in_the_order_in_which_they_come() {
    let rows = rows();
    let rows: Rows<'_> = rows.iter().collect();
    assert_eq!(rows.words("method"), ["mpm", "iid"]);
    let sizes: Vec<usize> = rows.by("size").iter().map(|(_, here)| here.len()).collect();
    assert_eq!(sizes, [1, 4]);
    assert_eq!(rows.with("method", "mpm").with("size", 16_usize).len(), 3);
    assert_eq!(rows.places("size"), [16.0, 64.0]);
}

#[test]
fn the_best_has_the_least_measure() {
    let rows = rows();
    let rows: Rows<'_> = rows.iter().collect();
    let best = rows.best("size", [16_usize, 64, 99], |rows| rows.median("error"));
    assert_eq!(best.map(|(size, rows)| (size, rows.len())), Some((64, 1)));
}

#[test]
fn sorted_rows_are_those_that_hold_something() {
    let rows = rows();
    let rows: Rows<'_> = rows.iter().collect();
    let sizes = |(word, here): (String, Rows<'_>)| (word, here.len());
    let methods: Vec<(String, usize)> = rows.sorted("method").into_iter().map(sizes).collect();
    assert_eq!(methods, [("iid".to_owned(), 1), ("mpm".to_owned(), 4)]);
    assert_eq!(rows.sorted("error").len(), 4);
}
