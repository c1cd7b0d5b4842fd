//! Arbitrary data.

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
        let dot_series = DotSeries { label: "s".into(), style: style::sequence_style(0), values: x.clone() };
        let dot_rows = y.iter().map(|y| ("r".into(), *y)).collect();
        let shares = y.iter().skip(1).map(|y| Some(*y)).collect();
        let heat_panel = HeatPanel { title: "t".into(), shares };
        let heat = HeatMapPlot { x: CellAxis { edges: x.clone(), ..Default::default() }, y: CellAxis { edges: vec![1.0, 2.0], ..Default::default() }, panels: vec![heat_panel], ..Default::default() };
        let scaling_series = LineSeries { label: "s".into(), x, y, bars: Vec::new() };
        let panel = MultiplesPanel { series: vec![series], ..MultiplesPanel::default() };
        let figures = [
            histogram_of(cloud, Reference::None),
            corner_of(cloud, Reference::Draws(PointCloud::equal(&points))),
            cloud_of(PointCloud::equal(&points), Reference::Draws(cloud)),
            multiples(&MultiplesPlot { panels: vec![panel], ..MultiplesPlot::default() }),
            dots(&DotPlot { rows: dot_rows, series: vec![dot_series], ..DotPlot::default() }),
            heat_map(&heat),
            scaling(&ScalingPlot { panel: MultiplesPanel::new("", [scaling_series]), ..ScalingPlot::default() }),
        ];
        for svg in figures.into_iter().flatten() {
            assert_well_formed(&svg);
        }
    }
}
