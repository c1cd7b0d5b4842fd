//! Traces, scalings, error curves and lines.

use super::*;

/// Asserts that there is nothing to draw.
fn assert_empty(drawing: Result<String, PlotError>) {
    assert!(matches!(drawing, Err(PlotError::Empty { .. })), "{drawing:?}");
}

#[test]
fn traces_break_where_values_end() {
    let step: Vec<f64> = (0..5000).map(f64::from).collect();
    let mut value: Vec<f64> = step.iter().map(|s| (-0.01 * s).exp() + 1e-3).collect();
    value[4000..].fill(f64::NAN);
    let series = |label: &str| LineSeries::through(label, step.iter().copied().zip(value.iter().copied()));
    let panels = [
        MultiplesPanel::over("residual", AxisKind::Automatic, ["mpm", "svgd"].map(series)).with_level(1.0, "i.i.d."),
        MultiplesPanel::over("energy (nats)", AxisKind::Automatic, []),
    ];
    let svg = multiples(&MultiplesPlot::traces("Run", "step", panels)).unwrap();
    assert_well_formed(&svg);
    for text in ["step", "residual", "energy (nats)", "mpm", "svgd", "i.i.d."] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(svg.len() < 60_000, "long traces are thinned: {}", svg.len());
    let alone = MultiplesPanel::over("residual", AxisKind::Automatic, [series("mpm")]);
    let svg = multiples(&MultiplesPlot::traces("Run", "step", [alone])).unwrap();
    assert!(!svg.contains("mpm"), "one line needs no legend");
}

#[test]
fn scalings_state_their_exponents() {
    let x: Vec<f64> = (2..6).map(|e| 10f64.powi(e)).collect();
    let y: Vec<f64> = x.iter().map(|x| 1e-8 * x.powf(1.5)).collect();
    let most = 1e3 * y[3];
    let settings = vec![
        LineSeries::through("d = 2", x.into_iter().zip(y)),
        LineSeries::through("single", [(100.0, 1e-6)]),
    ];
    let plot = ScalingPlot::over(("particles M", "M"), "time per step (s)", settings, 0.0);
    let mut plot = plot.beside_powers([("dense grid".to_owned(), 4)], 1e3);
    let guide = &plot.panel.guides[0].line;
    assert!(guide.x[0] == 100.0 && guide.y.iter().all(|y| *y <= most * (1.0 + 1e-9)));
    assert!(
        guide.y[20] > 0.999 * most,
        "as far as a thousand times the measurements"
    );
    let svg = scaling(&plot).unwrap();
    assert_well_formed(&svg);
    assert!(svg.contains("d = 2: b = 1.500 ± 0.000") && svg.contains("dense grid"));
    assert!(svg.contains(">single<"));
    plot.panel.series[0].y[0] = -1.0;
    assert_well_formed(&scaling(&plot).unwrap());
    plot.panel.series[0].y.pop();
    assert!(matches!(scaling(&plot), Err(PlotError::Size { .. })));
    assert_empty(scaling(&ScalingPlot::default()));
}

#[test]
fn failed_runs_are_counted_below_the_figure() {
    let curve = |method: &str, errors: [f64; 3]| TimeErrorCurve {
        method: method.to_string(),
        settings: vec![[1.0, 1.1, 0.9].into_iter().zip(errors).collect()],
    };
    let panel = |target: &str| TimeErrorPanel {
        target: target.to_string(),
        curves: vec![
            curve("mpm", [1e-3, 2e-3, 0.0]),
            curve("paper-pic", [f64::NAN, 0.3, f64::INFINITY]),
            curve("paper-apic", [f64::NAN; 3]),
        ],
        iid_level: Some(2e-3),
    };
    let plot = time_error(
        "wall time (s)",
        "energy distance squared",
        ["ring", "banana"].map(panel),
    );
    let svg = multiples(&plot).unwrap();
    assert_well_formed(&svg);
    for text in ["ring", "banana", "independent draws", "paper-pic on ring (2 of 3)"] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(matches!(
        multiples(&time_error("", "", [])),
        Err(PlotError::Empty { .. })
    ));
}

#[test]
fn lines_with_bars_on_any_axis() {
    let plot = |y_axis: AxisKind, series: LineSeries| MultiplesPlot {
        x: Axis::new("spacing h", AxisKind::Automatic),
        y: Axis::new("covariance error", y_axis),
        panels: vec![MultiplesPanel {
            series: vec![series],
            ..MultiplesPanel::default()
        }],
        ..MultiplesPlot::default()
    };
    for y_axis in [AxisKind::Automatic, AxisKind::Linear, AxisKind::Logarithmic] {
        let series = LineSeries {
            label: "d = 1".to_string(),
            x: vec![0.2, 0.5, 1.0],
            y: vec![1e-2, 1e-5, 1e-11],
            bars: vec![(1e-3, 2e-2), (0.0, 1e-4), (f64::NAN, f64::INFINITY)],
        };
        let svg = multiples(&plot(y_axis, series)).unwrap();
        assert_well_formed(&svg);
        assert!(svg.contains("spacing h") && svg.contains("covariance error"));
    }
    let mut single = LineSeries {
        x: vec![1.0],
        y: vec![f64::NAN],
        ..LineSeries::default()
    };
    let drawn = |series: &LineSeries| multiples(&plot(AxisKind::Automatic, series.clone()));
    assert_empty(drawn(&single));
    single.y = vec![3.0];
    assert_well_formed(&drawn(&single).unwrap());
    single.bars = vec![(0.0, 1.0); 2];
    assert!(matches!(drawn(&single), Err(PlotError::Size { .. })));
}

#[test]
fn small_multiples_share_styles_and_legend() {
    let series = |label: &str| LineSeries {
        label: label.to_string(),
        x: vec![128.0, 512.0, 2048.0],
        y: vec![0.1, 0.03, 0.01],
        bars: vec![(0.09, 0.11), (0.02, 0.04), (0.0, 0.02)],
    };
    let guide = |label: &str, dotted: bool| GuideCurve {
        line: LineSeries::through(label, [(128.0, 0.1), (2048.0, 0.025)]),
        dotted,
    };
    let panel = |title: &str, names: &[&str]| MultiplesPanel {
        title: title.to_string(),
        series: names.iter().map(|name| series(name)).collect(),
        guides: vec![guide("slope −½", false), guide("best slope", true)],
        levels: vec![ReferenceLevel::new(0.05, "level")],
        ..MultiplesPanel::default()
    };
    let mut plot = MultiplesPlot {
        panels: vec![panel("d = 1", &["mpm", "first"]), panel("d = 2", &["second", "first"])],
        notes: vec!["Medians over the seeds.".to_string()],
        ..MultiplesPlot::logarithmic("number of particles M", "energy distance ED")
    };
    let svg = multiples(&plot).unwrap();
    assert_well_formed(&svg);
    for text in [
        "d = 1",
        "d = 2",
        "mpm",
        "second",
        "slope −½",
        "best slope",
        "level",
        "Medians",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    assert_eq!(svg.matches(">first<").count(), 1, "one entry in the legend");
    plot.panels[0].guides[0].line.x.pop();
    assert!(matches!(multiples(&plot), Err(PlotError::Size { .. })));
    assert_empty(multiples(&MultiplesPlot::default()));
    let only = |x: f64, y: f64| MultiplesPanel::new("", [LineSeries::through("line", [(x, y)])]);
    for (x, y) in [(-1.0, 1.0), (1.0, 0.0), (1.0, f64::NAN)] {
        assert_empty(multiples(
            &MultiplesPlot::logarithmic("x", "y").with_panels([only(x, y)]),
        ));
    }
    let seen = MultiplesPlot::logarithmic("x", "y").with_panels([only(1.0, 0.0), only(1.0, 1.0)]);
    assert!(multiples(&seen).is_ok());
}

#[test]
fn dots_have_a_row_per_setting() {
    let style = style::sequence_style;
    let series = |label: &str, index: usize, values: &[f64]| DotSeries {
        label: label.to_string(),
        style: style(index),
        values: values.to_vec(),
    };
    let mut plot = DotPlot {
        x_label: "ED^{2}".to_string(),
        rows: vec![("ring".to_string(), 0.3), ("banana & co".to_string(), f64::NAN)],
        series: vec![series("near", 0, &[0.1, 20.0]), series("far", 1, &[-1.0, f64::NAN])],
        bound_label: "bound".to_string(),
        notes: vec!["A note.".to_string()],
    };
    let svg = dots(&plot).unwrap();
    assert_well_formed(&svg);
    for text in ["ring", "banana &amp; co", "near", "far", "bound", "A note."] {
        assert!(svg.contains(text), "{text}");
    }
    // Two drawn values and two swatches in the legend.
    assert_eq!(svg.matches("<circle").count(), 3);
    plot.rows[0].1 = f64::NAN;
    assert!(!dots(&plot).unwrap().contains(">bound<"));
    plot.series[0].values.pop();
    assert!(matches!(dots(&plot), Err(PlotError::Size { .. })));
    plot.series.remove(0);
    assert_empty(dots(&plot));
}

#[test]
fn dots_have_series_by_name() {
    let plot = DotPlot::bounded("error", [("ring".to_owned(), 1.0)], "bound");
    let named = ["start", "end"].map(|name| (name.to_owned(), vec![0.5]));
    let svg = dots(&plot.with_series(named.into())).unwrap();
    assert!(
        ["ring", "bound", ">start<", ">end<"]
            .iter()
            .all(|text| svg.contains(text))
    );
}

#[test]
fn heat_maps_state_the_share_of_every_cell() {
    let panel = |shares: [Option<f64>; 4]| HeatPanel {
        title: "guards off".to_string(),
        shares: shares.to_vec(),
    };
    let mut plot = HeatMapPlot {
        x: CellAxis::logarithmic("time step", [0.1, 10.0], 2),
        y: CellAxis::logarithmic("spacing", [0.01, 1.0], 2),
        panels: vec![panel([Some(0.0), Some(0.37), None, Some(f64::NAN)]); 3],
        ..HeatMapPlot::default()
    };
    let svg = heat_map(&plot).unwrap();
    assert_well_formed(&svg);
    assert_eq!((svg.matches(">37<").count(), svg.matches(">0<").count()), (3, 3));
    for text in ["guards off", "time step", "spacing", "75 %", "no data"] {
        assert!(svg.contains(text), "{text}");
    }
    plot.panels[0].shares.pop();
    assert!(matches!(heat_map(&plot), Err(PlotError::Size { .. })));
    plot.panels = vec![panel([None; 4])];
    assert_empty(heat_map(&plot));
    assert_empty(heat_map(&HeatMapPlot::default()));
}

#[test]
fn snapshots_colour_particles_by_class() {
    let panel = |title: &str, values: Vec<f64>| SnapshotPanel {
        title: title.to_owned(),
        positions: vec![[0.5, 0.5], [1.5, 0.5], [9.0, 9.0]],
        values,
    };
    let mut plot = SnapshotsPlot {
        title: "slope".to_owned(),
        value_label: "strain".to_owned(),
        extent: [[0.0, 0.0], [4.0, 2.0]],
        spacing: 0.5,
        bounds: vec![1.0, 2.0],
        columns: 1,
        panels: vec![panel("start", vec![0.0, 1.5, 3.0]), panel("end", vec![5.0; 3])],
        ..SnapshotsPlot::default()
    };
    let svg = snapshots(&plot).unwrap();
    assert_well_formed(&svg);
    for text in ["strain &lt; 1", "1 to 2", "≥ 2", ">start<", ">end<"] {
        assert!(svg.contains(text), "{text}");
    }
    plot.panels[0].values.pop();
    assert!(matches!(snapshots(&plot), Err(PlotError::Size { .. })));
    plot.panels.clear();
    assert_empty(snapshots(&plot));
}

#[test]
fn a_snapshot_leaves_out_what_has_no_class_and_refuses_an_extent_that_has_no_area() {
    let of = |positions: Vec<[f64; 2]>, values: Vec<f64>, extent| {
        snapshots(&SnapshotsPlot {
            extent,
            spacing: 0.5,
            bounds: vec![1.0],
            columns: 1,
            panels: vec![SnapshotPanel {
                title: String::new(),
                positions,
                values,
            }],
            ..SnapshotsPlot::default()
        })
    };
    let area = [[0.0, 0.0], [4.0, 2.0]];
    let alone = of(vec![[0.5, 0.5]], vec![3.0], area).unwrap();
    assert_eq!(
        of(vec![[0.5, 0.5], [1.5, 0.5]], vec![3.0, f64::NAN], area).unwrap(),
        alone
    );
    assert_empty(of(vec![[0.5, 0.5]], vec![f64::NAN], area));
    for extent in [
        [[0.0, 0.0], [0.0, 2.0]],
        [[0.0, 0.0], [f64::NAN, 2.0]],
        [[4.0, 0.0], [0.0, 2.0]],
    ] {
        assert_empty(of(vec![[0.5, 0.5]], vec![3.0], extent));
    }
}

#[test]
fn a_strip_has_a_panel_for_each_moment_on_common_axes() {
    let moments: Vec<Vec<Vec<f64>>> = (0..6)
        .map(|k| {
            let moved = |row: Vec<f64>| row.iter().map(|c| c + 0.5 * f64::from(k)).collect();
            points(100, 2).into_iter().map(moved).collect()
        })
        .collect();
    let titles: Vec<String> = (0..6).map(|k| format!("step {k}")).collect();
    let panels: Vec<StripPanel<'_>> = moments
        .iter()
        .zip(&titles)
        .map(|(points, title)| StripPanel {
            title,
            particles: PointCloud::equal(points),
        })
        .collect();
    let draws = points(2000, 2);
    let strip_of = |panels| {
        strip(&StripPlot {
            title: "Strip",
            panels,
            labels: &[],
            reference: Reference::Draws(PointCloud::equal(&draws)),
            reference_label: "",
        })
    };
    for count in 1..=6 {
        let svg = strip_of(&panels[..count]).unwrap();
        assert_well_formed(&svg);
        assert!((0..count).all(|k| svg.contains(&format!("step {k}<"))));
        assert!(svg.contains("50, 90, 99 %"));
    }
    assert!(matches!(strip_of(&[]), Err(PlotError::Empty { .. })));
    let flat = vec![vec![1.0]; 3];
    let panel = StripPanel {
        title: "",
        particles: PointCloud::equal(&flat),
    };
    assert!(matches!(strip_of(&[panel]), Err(PlotError::Dimension { .. })));
}

#[test]
fn a_curve_that_lies_on_another_has_gaps() {
    let line = |label: &str, factor: f64| LineSeries::through(label, (0..20).map(|n| (n as f64, factor * n as f64)));
    let dashed = |lines: Vec<LineSeries>| {
        let panel = MultiplesPanel::over("y", AxisKind::Linear, lines);
        let svg = multiples(&MultiplesPlot::traces("", "x", [panel])).unwrap();
        svg.matches("stroke-dasharray").count()
    };
    let [one, same, other] = [("a", 1.0), ("b", 1.001), ("c", 2.0)].map(|(label, factor)| line(label, factor));
    assert_eq!(dashed(vec![one.clone(), other.clone()]), 0);
    assert!(dashed(vec![one.clone(), same.clone(), other]) > 0);
}
