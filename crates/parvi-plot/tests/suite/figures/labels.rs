//! Labels that have no room, lines that share a colour, and axes that are linear for a zero.

use super::*;

#[test]
fn labels_that_have_no_room_are_cut_and_titles_of_their_elements() {
    let long = "error of the centre of mass of the bar, in the direction of the x-axis, ".repeat(6);
    let word = "x".repeat(400);
    let panel = |title: &str| MultiplesPanel {
        title: title.to_owned(),
        ..MultiplesPanel::over(
            &long,
            AxisKind::Linear,
            [LineSeries::through(&word, [(0.0, 1e-7), (1.0, 3e-7)])],
        )
    };
    let plot = MultiplesPlot::logarithmic(&word, "").over_linear();
    let svg = multiples(&plot.with_panels([long.as_str(), &word, "short"].map(panel))).unwrap();
    assert_well_formed(&svg);
    assert!(svg.contains(&format!("<title>{word}</title>")) && svg.contains("…</text>"));
    let shown: Vec<&str> = svg
        .split("</title>")
        .skip(2)
        .filter_map(|part| part.split('<').next())
        .collect();
    assert!(shown.iter().all(|text| text.chars().count() < 120), "{shown:?}");
    assert!(svg.contains("(×10⁻⁷)"), "the power of an axis stays");
    let series = DotSeries {
        label: "s".into(),
        style: style::sequence_style(0),
        values: vec![1.0],
    };
    let plot = DotPlot {
        rows: vec![(word.clone(), f64::NAN)],
        series: vec![series],
        ..DotPlot::default()
    };
    assert!(dots(&plot).unwrap().contains(&format!("<title>{word}</title>xx")));
}

#[test]
fn lines_of_one_colour_have_dashes_of_their_own() {
    let lines = (0..17).map(|k| LineSeries::through(format!("line {k}"), [(0.0, f64::from(k)), (1.0, 2.0)]));
    let plot = MultiplesPlot::traces("", "time", [MultiplesPanel::over("y", AxisKind::Linear, lines)]);
    let svg = multiples(&plot).unwrap();
    for dash in ["\"9 3\"", "\"6 2 1.2 2\""] {
        assert!(svg.contains(dash), "{dash}");
    }
}

#[test]
fn an_axis_that_is_linear_for_a_zero_says_so() {
    let svg = |least: f64| {
        let plot = MultiplesPlot {
            y: Axis::new("error", AxisKind::Automatic),
            panels: vec![MultiplesPanel::new(
                "",
                [LineSeries::through("a", [(1.0, least), (2.0, 0.01), (3.0, 1.0)])],
            )],
            ..MultiplesPlot::default()
        };
        multiples(&plot).unwrap()
    };
    let note = "The axis of “error” is linear";
    assert!(svg(0.0).contains(note) && !svg(1e-3).contains(note) && !svg(-1.0).contains(note));
}
