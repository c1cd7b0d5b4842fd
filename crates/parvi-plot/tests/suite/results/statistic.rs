//! Statistics by their names.

use parvi_plot::page::MISSING;
use parvi_plot::results::{Row, Rows};

use super::rows;

fn cells(rows: &Rows<'_>, statistics: &str) -> Vec<String> {
    statistics.split(" | ").map(|statistic| rows.cell(statistic)).collect()
}

#[test]
fn statistics_have_names() {
    let rows = rows();
    let here = rows.iter().collect::<Rows<'_>>().with("method", "mpm");
    assert_eq!(
        cells(&here, "rows | median error | least error"),
        ["4", "1.00", "0.500"]
    );
    assert_eq!(
        cells(&here, "largest error | worst error | first size | error | text error"),
        ["4.00", "`e`", "64", "0.500", "0.5"]
    );
    assert_eq!(cells(&here, "median of all error | quantile 1 error"), ["2.50", "4.00"]);
    assert_eq!(
        cells(&here, "middle error | last size | last mode"),
        ["1.00", "64", MISSING]
    );
    assert_eq!(here.with("case", "c").cell("percent error"), "100.0");
    assert_eq!(cells(&here.with("case", "d"), "median of all error"), ["∞"]);
    assert_eq!(
        cells(&Rows::default(), "median error | median of all error | mode error"),
        [MISSING; 3]
    );
    assert_eq!(
        cells(
            &here,
            "fixed 1 error | signed 2 error | scientific 0 size | fixed 2 method | fixed x error"
        ),
        ["0.5", "+0.50", "6e1", MISSING, MISSING]
    );
    assert_eq!(
        cells(
            &here,
            "part where error | part where size = 16 where error > 2 | part where size = 99 where error"
        ),
        ["3/4", "2/3", MISSING]
    );
    let grows = [16_usize, 64].map(|size| Row::default().with("size", size).with("error", (size * size) as f64));
    assert_eq!(
        grows.iter().collect::<Rows<'_>>().cell("exponent of size in error"),
        "2.00"
    );
}

#[test]
fn statistics_of_rows_that_fulfil_conditions() {
    let rows = rows();
    let rows: Rows<'_> = rows.iter().collect();
    for (statistic, expected) in [
        ("rows where method = mpm", "4"),
        ("rows where error", "4"),
        ("rows where method ≠ mpm", "1"),
        ("rows where error ≤ 1", "2"),
        ("each case where no error", "d"),
        ("rows where error > 1", "3"),
        ("rows where size ≥ 64", "1"),
        ("median error where method = mpm where size = 16", "2.50"),
        ("share where method = mpm where error where error ≤ 1", "67 %"),
        ("share where method = svgd where error", MISSING),
        ("middle error", "2.00"),
        ("rows where error ≤ size", "4"),
        ("rows where error > method", "5"),
        ("rows where error about 1", "0"),
    ] {
        assert_eq!(rows.cell(statistic), expected, "{statistic}");
    }
}
