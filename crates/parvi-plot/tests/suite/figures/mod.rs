//! Every figure from realistic, degenerate and hostile data: well-formed, complete, finite, reproducible.

mod charts;
mod hostile;
mod labels;

use parvi_plot::statistics::{DensityGrid, StatisticsError, equidistant};
use parvi_plot::*;

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

fn plot<'a>(cloud: PointCloud<'a>, reference: Reference<'a>) -> DensityPlot<'a> {
    DensityPlot {
        title: "Particles",
        particles: cloud,
        labels: &[],
        reference,
        reference_label: "",
    }
}

fn histogram_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    histogram(&plot(cloud, reference))
}

fn corner_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    corner(&plot(cloud, reference))
}

fn cloud_of(cloud: PointCloud<'_>, reference: Reference<'_>) -> Result<String, PlotError> {
    parvi_plot::cloud(&plot(cloud, reference))
}

#[test]
fn every_dimension_has_its_figures() {
    let reference = points(1000, 8);
    for dimension in 1..=8 {
        let cut = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> { rows.iter().map(|row| row[..dimension].to_vec()).collect() };
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
            if dimension < 4 {
                assert_eq!(svg, corner_of(cloud, reference).unwrap());
            }
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
    let svg = corner(&DensityPlot {
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
    let line: Vec<Vec<f64>> = (0..50).map(|i| vec![f64::from(i), 2.0 * f64::from(i)]).collect();
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

/// The bars are those of the values in another unit.
#[test]
fn histograms_have_bars_at_any_scale() {
    let bars = |unit: f64| {
        let scaled: Vec<Vec<f64>> = points(300, 1).iter().map(|x| vec![unit * x[0]]).collect();
        let svg = histogram_of(PointCloud::equal(&scaled), Reference::None).unwrap();
        assert_well_formed(&svg);
        let heights = svg
            .lines()
            .filter(|line| line.contains("<rect") && line.contains("fill-opacity"));
        let of = |line: &str| {
            line.split_once(" height=\"")
                .map(|(_, rest)| rest.split('"').next().map(str::to_owned))
        };
        heights.map(of).collect::<Vec<_>>()
    };
    let plain = bars(1.0);
    assert!(plain.len() > 8);
    for exponent in [-970, -700, 700, 970, 990] {
        assert_eq!(bars(2f64.powi(exponent)), plain, "{exponent}");
    }
}

#[test]
fn particles_outside_the_axes_and_left_out_are_counted() {
    let mut particles = points(5000, 2);
    particles[7] = vec![500.0, 0.0];
    let svg = cloud_of(PointCloud::equal(&particles), Reference::None).unwrap();
    assert!(svg.contains("1 of 5000 particles lies outside the axes."));
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
    assert!(matches!(of(&broken), Err(PlotError::NotFinite { row: 1, axis: 1, .. })));
    let message = of(&broken).expect_err("a gap").to_string();
    assert!(message.starts_with("point 1: x2 = "), "{message}");
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
