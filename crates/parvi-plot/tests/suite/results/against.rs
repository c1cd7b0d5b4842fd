//! Methods against each other.

use parvi_plot::results::{Contest, Row, Rows};

#[test]
fn alike_rows_are_held_against_each_other() {
    let row = |seed: usize, error: Option<f64>| Row::default().with("seed", seed).with("error", error);
    let own = [
        row(1, Some(1.0)),
        row(2, Some(1.05)),
        row(3, None),
        row(4, Some(1.0)),
        row(5, None),
        row(9, None),
    ];
    let others = [
        row(1, Some(2.0)),
        row(2, Some(1.0)),
        row(3, None),
        row(4, None),
        row(5, Some(1.0)),
    ];
    let contest = own.iter().collect::<Rows<'_>>();
    let contest = contest.against(&others.iter().collect(), ("error", &["seed"]), 1.1);
    let expected = Contest {
        better: 2,
        ties: 1,
        worse: 1,
        neither: 1,
    };
    assert_eq!((contest, contest.pairs()), (expected, 5));
}
