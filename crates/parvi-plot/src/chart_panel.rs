//! The content of one panel of a chart.

use super::line_series::LineSeries;
use super::panel::{AxesParts, Panel};
use super::series::{ChartPanel, ChartSeries};
use super::style::{GUIDE, LINE_WIDTH};
use super::svg::{Drawing, Stroke};

/// Draws one panel: grid, levels, lines, bars, markers, axes and title; the first series lies on top of the others.
pub(super) fn draw_panel(drawing: &mut Drawing, axes: &Panel, panel: &ChartPanel, parts: &AxesParts<'_>) {
    let area = axes.area;
    axes.draw_grid(drawing, &parts.x_ticks, &parts.y_ticks);
    drawing.clipped(area, |drawing| {
        for level in &panel.levels {
            if let Some(y) = axes.y_at(level.value) {
                let stroke = Stroke::dashed(GUIDE, 1.1);
                drawing.line((area.x, y), (area.right(), y), stroke);
            }
        }
        for series in panel.series.iter().rev() {
            if let Some(dash) = series.dash {
                let stroke = Stroke {
                    color: series.style.color,
                    width: LINE_WIDTH,
                    dash,
                };
                drawing.paths(&line_segments(axes, &series.line), stroke);
            }
        }
    });
    for series in panel.series.iter().rev() {
        draw_bars(drawing, axes, series);
    }
    for series in panel.series.iter().rev().filter(|series| series.markers) {
        for (x, y) in series.line.points() {
            if let Some(at) = axes.point(x, y) {
                drawing.marker(at, series.style);
            }
        }
    }
    axes.draw_axes(drawing, parts);
    axes.draw_title(drawing, &panel.title);
}

/// The series' line, interrupted where values cannot be drawn. Of many points within half a point of the page's width, only
/// the first, lowest, highest and last are kept, which looks the same.
fn line_segments(axes: &Panel, line: &LineSeries) -> Vec<Vec<(f64, f64)>> {
    let mut segments = vec![Vec::new()];
    for (x, y) in line.points() {
        match (axes.point(x, y), segments.last_mut()) {
            (Some(point), Some(segment)) => segment.push(point),
            (None, Some(segment)) if !segment.is_empty() => segments.push(Vec::new()),
            _ => {}
        }
    }
    segments.retain(|segment| segment.len() > 1);
    segments.iter().map(|segment| thinned(segment)).collect()
}

fn thinned(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    let column = |point: &(f64, f64)| (2.0 * point.0).floor();
    points
        .chunk_by(|left, right| column(left) == column(right))
        .flat_map(|group| {
            let by_height = |l: &usize, r: &usize| group[*l].1.total_cmp(&group[*r].1);
            let mut kept = vec![0, group.len() - 1];
            kept.extend((0..group.len()).min_by(by_height));
            kept.extend((0..group.len()).max_by(by_height));
            kept.sort_unstable();
            kept.dedup();
            kept.into_iter().map(|index| group[index])
        })
        .collect()
}

/// Vertical error bars; an end that a logarithmic axis cannot show reaches the edge of the panel.
fn draw_bars(drawing: &mut Drawing, axes: &Panel, series: &ChartSeries) {
    let area = axes.area;
    let mut segments = Vec::new();
    for ((x, y), (low, high)) in series.line.points().zip(&series.line.bars) {
        if axes.point(x, y).is_none() || low.is_nan() || high.is_nan() {
            continue;
        }
        let Some(x) = axes.x_at(x) else { continue };
        let bottom = axes.y_at(*low).unwrap_or(area.bottom()).min(area.bottom());
        let top = axes.y_at(*high).unwrap_or(area.y).max(area.y);
        segments.push([(x, bottom), (x, top)]);
        if axes.y_at(*low).is_some() {
            segments.push([(x - 2.0, bottom), (x + 2.0, bottom)]);
        }
        if axes.y_at(*high).is_some() {
            segments.push([(x - 2.0, top), (x + 2.0, top)]);
        }
    }
    drawing.lines(&segments, Stroke::solid(series.style.color, 0.9));
}
