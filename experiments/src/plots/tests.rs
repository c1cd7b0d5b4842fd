//! Every figure from realistic, degenerate and hostile data: well-formed, complete, finite, reproducible.

use super::*;
use crate::statistics::{DensityGrid, StatisticsError, equidistant};

/// A deterministic sequence of d roughly normal coordinates: sums of additive recurrences.
fn points(count: usize, dimension: usize) -> Vec<Vec<f64>> {
    (0..count)
        .map(|row| {
            (0..dimension)
                .map(|axis| {
                    let term = |k: usize| {
                        let step = (2.0 + (4 * axis + k) as f64).sqrt();
                        (0.37 * axis as f64 + step * (row + 1) as f64).fract()
                    };
                    (0..4).map(term).sum::<f64>() - 2.0
                })
                .collect()
        })
        .collect()
}

/// Checks that the document is well-formed XML as far as this writer can go wrong: tags balance, attributes are quoted,
/// no bare ampersand, nothing that is not a number.
fn assert_well_formed(svg: &str) {
    let mut open: Vec<&str> = Vec::new();
    let mut rest = svg;
    while let Some(start) = rest.find('<') {
        assert!(!rest[..start].contains('>'), "bare > in {}", &rest[..start]);
        let end = start + rest[start..].find('>').expect("an unclosed tag");
        let tag = &rest[start + 1..end];
        assert!(!tag.contains('<'), "< within a tag: {tag}");
        assert_eq!(tag.matches('"').count() % 2, 0, "quotes: {tag}");
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
        } else if !tag.ends_with('/') {
            open.push(tag.split(' ').next().unwrap_or(tag));
        }
        rest = &rest[end + 1..];
    }
    assert!(open.is_empty(), "unclosed: {open:?}");
    for (position, _) in svg.match_indices('&') {
        let entity = &svg[position..];
        assert!(
            ["&amp;", "&lt;", "&gt;", "&quot;"]
                .iter()
                .any(|known| entity.starts_with(known)),
            "bare ampersand"
        );
    }
    assert!(!svg.contains("NaN") && !svg.contains("\"inf") && !svg.contains(" inf"));
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
}

fn histogram_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    histogram(&HistogramPlot {
        title: "Marginals",
        particles: cloud,
        labels: &[],
        reference,
        reference_label: "",
    })
}

fn corner_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    corner(&CornerPlot {
        title: "Corner",
        particles: cloud,
        labels: &[],
        reference,
        reference_label: "reference",
    })
}

fn cloud_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    super::cloud(&CloudPlot {
        title: "Cloud",
        particles: cloud,
        particles_label: "",
        labels: &[],
        reference,
        reference_label: "",
        equal_units: true,
    })
}

#[test]
fn every_dimension_has_its_figures() {
    let reference = points(3000, 8);
    for dimension in 1..=8 {
        let cut = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
            rows.iter().map(|row| row[..dimension].to_vec()).collect()
        };
        let (particles, draws) = (points(300, dimension), cut(&reference));
        let cloud = PointCloud::equal(&particles);
        let reference = Reference::Draws(PointCloud::equal(&draws));
        let svg = histogram_of(cloud, reference).unwrap();
        assert_well_formed(&svg);
        assert!(svg.contains("density") && svg.contains("kernel density"));
        assert_eq!(svg, histogram_of(cloud, reference).unwrap());
        if dimension <= 6 {
            let svg = corner_of(cloud, reference).unwrap();
            assert_well_formed(&svg);
            assert_eq!(svg.contains("50, 90, 99 %"), dimension > 1);
            assert_eq!(svg, corner_of(cloud, reference).unwrap());
        } else {
            assert_eq!(
                corner_of(cloud, reference),
                Err(PlotError::Dimension {
                    dimension,
                    smallest: 1,
                    largest: 6
                })
            );
        }
    }
}

#[test]
fn a_corner_plot_of_two_thousand_particles_in_five_dimensions_stays_below_a_megabyte() {
    let (particles, draws) = (points(2000, 5), points(20_000, 5));
    let reference = Reference::Draws(PointCloud::equal(&draws));
    let svg = corner_of(PointCloud::equal(&particles), reference).unwrap();
    assert!(svg.len() < 1_000_000, "{}", svg.len());
}

#[test]
fn exact_densities_are_drawn_with_weights_and_labels() {
    let particles = points(400, 2);
    let weights: Vec<f64> = (0..400).map(|row| (row % 7) as f64).collect();
    let x = equidistant((-2.0, 2.0), 50);
    let y = x.iter().map(|x| (-1.5 * x * x).exp()).collect();
    let marginals = [Some(Curve { x, y }), None];
    let pairs = [PairDensity {
        horizontal: 0,
        vertical: 1,
        grid: DensityGrid::evaluate((-2.0, 2.0), (-2.0, 2.0), (40, 30), |x, y| {
            (-1.5 * (x * x + y * y)).exp()
        }),
    }];
    let reference = Reference::Exact {
        marginals: &marginals,
        pairs: &pairs,
    };
    let labels = ["arsenic (100 µg/l)".to_string(), "a < b & c".to_string()];
    let cloud = PointCloud {
        points: &particles,
        weights: Some(&weights),
    };
    let svg = corner(&CornerPlot {
        title: "\"Wells\" <small>",
        particles: cloud,
        labels: &labels,
        reference,
        reference_label: "posterior",
    })
    .unwrap();
    assert_well_formed(&svg);
    for text in [
        "arsenic",
        "a &lt; b &amp; c",
        "posterior; contours",
        "&quot;Wells&quot;",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    assert_well_formed(&cloud_of(cloud, reference).unwrap());
}

#[test]
fn degenerate_clouds_are_drawn() {
    let constant = vec![vec![1.5, -2.0]; 20];
    let single = vec![vec![0.0, 0.0]];
    let line: Vec<Vec<f64>> = (0..50)
        .map(|i| vec![f64::from(i), 2.0 * f64::from(i)])
        .collect();
    let two_values: Vec<Vec<f64>> = (0..50).map(|i| vec![f64::from(i % 2), 1e9]).collect();
    let huge = vec![vec![1e299, -1e299], vec![-1e299, 1e299], vec![0.0, 1e-300]];
    for points in [&constant, &single, &line, &two_values, &huge] {
        let cloud = PointCloud::equal(points);
        for reference in [Reference::None, Reference::Draws(cloud)] {
            assert_well_formed(&histogram_of(cloud, reference).unwrap());
            assert_well_formed(&corner_of(cloud, reference).unwrap());
            assert_well_formed(&cloud_of(cloud, reference).unwrap());
        }
    }
}

#[test]
fn particles_outside_the_axes_and_left_out_are_counted() {
    let mut particles = points(5000, 2);
    particles[7] = vec![500.0, 0.0];
    let svg = cloud_of(PointCloud::equal(&particles), Reference::None).unwrap();
    assert!(svg.contains("1 of 5000 particles lie outside the axes."));
    assert!(svg.contains("One of every 2 particles is drawn."));
}

#[test]
fn bad_clouds_are_errors() {
    let none: Vec<Vec<f64>> = Vec::new();
    let no_coordinates = vec![vec![]];
    let ragged = vec![vec![1.0, 2.0], vec![1.0]];
    let broken = vec![vec![1.0, 2.0], vec![1.0, f64::NAN]];
    let good = vec![vec![1.0, 2.0], vec![2.0, 1.0]];
    let of = |points: &[Vec<f64>]| histogram_of(PointCloud::equal(points), Reference::None);
    assert!(matches!(of(&none), Err(PlotError::Empty { .. })));
    assert!(matches!(
        of(&no_coordinates),
        Err(PlotError::Dimension { dimension: 0, .. })
    ));
    assert!(matches!(
        of(&ragged),
        Err(PlotError::Size {
            expected: 2,
            found: 1,
            ..
        })
    ));
    assert!(matches!(
        of(&broken),
        Err(PlotError::NotFinite {
            row: 1,
            axis: 1,
            ..
        })
    ));
    let weighted = |weights: &[f64]| {
        let cloud = PointCloud {
            points: &good,
            weights: Some(weights),
        };
        corner_of(cloud, Reference::None)
    };
    assert_eq!(
        weighted(&[0.0, 0.0]),
        Err(PlotError::Statistics(StatisticsError::NoWeight))
    );
    assert!(weighted(&[1.0]).is_err() && weighted(&[1.0, -1.0]).is_err());
    assert!(weighted(&[1.0, f64::INFINITY]).is_err());
    let other = points(10, 3);
    let reference = Reference::Draws(PointCloud::equal(&other));
    assert!(corner_of(PointCloud::equal(&good), reference).is_err());
}

#[test]
fn traces_break_where_values_end() {
    let step: Vec<f64> = (0..5000).map(f64::from).collect();
    let mut value: Vec<f64> = step.iter().map(|s| (-0.01 * s).exp() + 1e-3).collect();
    value[4000..].fill(f64::NAN);
    let series = |label: &str| TraceSeries {
        label: label.to_string(),
        step: step.clone(),
        value: value.clone(),
    };
    let plot = TracePlot {
        title: "Run".to_string(),
        x_label: "step".to_string(),
        panels: vec![
            TracePanel {
                y_label: "residual".to_string(),
                series: vec![series("mpm"), series("svgd")],
                levels: vec![ReferenceLevel {
                    value: 1.0,
                    label: "i.i.d.".to_string(),
                }],
                ..TracePanel::default()
            },
            TracePanel {
                y_label: "energy (nats)".to_string(),
                ..TracePanel::default()
            },
        ],
    };
    let svg = trace(&plot).unwrap();
    assert_well_formed(&svg);
    for text in ["step", "residual", "energy (nats)", "mpm", "svgd", "i.i.d."] {
        assert!(svg.contains(text), "{text}");
    }
    assert!(svg.len() < 60_000, "long traces are thinned: {}", svg.len());
    assert!(matches!(
        trace(&TracePlot::default()),
        Err(PlotError::Empty { .. })
    ));
}

#[test]
fn scalings_state_their_exponents() {
    let x: Vec<f64> = (2..6).map(|e| 10f64.powi(e)).collect();
    let y: Vec<f64> = x.iter().map(|x| 1e-8 * x.powf(1.5)).collect();
    let mut plot = ScalingPlot {
        x_label: "particles M".to_string(),
        y_label: "time per step (s)".to_string(),
        x_symbol: "M".to_string(),
        series: vec![
            ScalingSeries {
                label: "d = 2".to_string(),
                x: x.clone(),
                y,
            },
            ScalingSeries {
                label: "single".to_string(),
                x: vec![100.0],
                y: vec![1.0],
            },
        ],
        ..ScalingPlot::default()
    };
    plot.guides.push(ScalingGuide {
        label: "dense grid".to_string(),
        curve: Curve {
            y: x.iter().map(|x| 1e-6 * x).collect(),
            x,
        },
    });
    let svg = scaling(&plot).unwrap();
    assert_well_formed(&svg);
    assert!(svg.contains("d = 2: b = 1.500 ± 0.000") && svg.contains("dense grid"));
    assert!(svg.contains(">single<"));
    plot.series[0].y[0] = -1.0;
    assert_well_formed(&scaling(&plot).unwrap());
    plot.series[0].y.pop();
    assert!(matches!(scaling(&plot), Err(PlotError::Size { .. })));
    assert!(matches!(
        scaling(&ScalingPlot::default()),
        Err(PlotError::Empty { .. })
    ));
}

#[test]
fn failed_runs_are_counted_below_the_figure() {
    let curve = |method: &str, errors: [f64; 3]| TimeErrorCurve {
        method: method.to_string(),
        points: vec![TimeErrorPoint {
            cost: vec![1.0, 1.1, 0.9],
            error: errors.to_vec(),
        }],
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
    let mut plot = TimeErrorPlot {
        x_label: "wall time (s)".to_string(),
        y_label: "energy distance squared".to_string(),
        iid_label: "i.i.d. draws".to_string(),
        panels: vec![panel("ring"), panel("banana")],
        ..TimeErrorPlot::default()
    };
    let svg = time_error(&plot).unwrap();
    assert_well_formed(&svg);
    for text in [
        "ring",
        "banana",
        "i.i.d. draws",
        "paper-pic on ring (2 of 3)",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    plot.panels[0].curves[0].points[0].cost.pop();
    assert!(matches!(time_error(&plot), Err(PlotError::Size { .. })));
    assert!(matches!(
        time_error(&TimeErrorPlot::default()),
        Err(PlotError::Empty { .. })
    ));
}

#[test]
fn lines_with_bars_on_any_axis() {
    for y_axis in [AxisKind::Automatic, AxisKind::Linear, AxisKind::Logarithmic] {
        let plot = LinePlot {
            x_label: "spacing h".to_string(),
            y_label: "covariance error".to_string(),
            y_axis,
            series: vec![LineSeries {
                label: "d = 1".to_string(),
                x: vec![0.2, 0.5, 1.0],
                y: vec![1e-2, 1e-5, 1e-11],
                bars: vec![(1e-3, 2e-2), (0.0, 1e-4), (f64::NAN, f64::INFINITY)],
            }],
            ..LinePlot::default()
        };
        let svg = line(&plot).unwrap();
        assert_well_formed(&svg);
        assert!(svg.contains("spacing h") && svg.contains("covariance error"));
    }
    let mut plot = LinePlot::default();
    plot.series.push(LineSeries {
        x: vec![1.0],
        y: vec![f64::NAN],
        ..LineSeries::default()
    });
    assert!(matches!(line(&plot), Err(PlotError::Empty { .. })));
    plot.series[0].y = vec![3.0];
    assert_well_formed(&line(&plot).unwrap());
    plot.series[0].bars = vec![(0.0, 1.0); 2];
    assert!(matches!(line(&plot), Err(PlotError::Size { .. })));
}

mod hostile {
    use super::*;
    use proptest::prelude::*;

    fn any_value() -> impl Strategy<Value = f64> {
        prop_oneof![
            any::<f64>(),
            -10.0..10.0f64,
            Just(0.0),
            Just(1.0),
            Just(f64::MIN_POSITIVE),
        ]
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn no_data_makes_a_figure_panic(
            values in proptest::collection::vec((any_value(), any_value(), any_value()), 0..12)
        ) {
            let points: Vec<Vec<f64>> = values.iter().map(|v| vec![v.0, v.1]).collect();
            let weights: Vec<f64> = values.iter().map(|v| v.2.abs()).collect();
            let cloud = PointCloud { points: &points, weights: Some(&weights) };
            let (x, y): (Vec<f64>, Vec<f64>) = values.iter().map(|v| (v.0, v.1)).unzip();
            let bars = values.iter().map(|v| (v.1, v.2)).collect();
            let series = LineSeries { label: "s".into(), x: x.clone(), y: y.clone(), bars };
            let scaling_series = ScalingSeries { label: "s".into(), x, y };
            let figures = [
                histogram_of(cloud, Reference::None),
                corner_of(cloud, Reference::Draws(PointCloud::equal(&points))),
                cloud_of(PointCloud::equal(&points), Reference::Draws(cloud)),
                line(&LinePlot { series: vec![series], ..LinePlot::default() }),
                scaling(&ScalingPlot { series: vec![scaling_series], ..ScalingPlot::default() }),
            ];
            for svg in figures.into_iter().flatten() {
                assert_well_formed(&svg);
            }
        }
    }
}
