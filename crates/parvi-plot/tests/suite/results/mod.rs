//! Rows of results, and what is said of many.

mod against;
mod lines;
mod rows;
mod statistic;

use parvi_plot::results::Row;

pub fn rows() -> Vec<Row> {
    let row = |case: &str, method: &str, size: usize, error: Option<f64>| {
        let row = Row::of(case).with("method", method).with("size", size);
        row.with("error", error)
    };
    vec![
        row("a", "mpm", 64, Some(0.5)),
        row("b", "iid", 16, Some(2.0)),
        row("c", "mpm", 16, Some(1.0)),
        row("d", "mpm", 16, None),
        row("e", "mpm", 16, Some(4.0)),
    ]
}
