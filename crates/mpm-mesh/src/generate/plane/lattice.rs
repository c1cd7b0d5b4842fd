//! The points of a lattice of equilateral triangles that lie inside an outline.

use super::EdgeTarget;
use super::outline::{Outline, squared_distance_to_segment};
use crate::adjacency::Lists;

/// Points keep this many target lengths from the boundary. Ours: at h √3 / 2 triangles with the boundary's edges are
/// equilateral, and gaps up to that plus this are what relaxation can close.
const DISTANCE: f64 = 0.6;

/// The points by rows along the angle of the target.
pub fn points_inside(outline: &Outline, target: &EdgeTarget) -> Vec<[f64; 2]> {
    let h = target.length;
    let (sine, cosine) = target.angle.sin_cos();
    let origin = outline.points[0];
    let to_lattice = |p: [f64; 2]| {
        let [x, y] = [p[0] - origin[0], p[1] - origin[1]];
        [cosine * x + sine * y, cosine * y - sine * x]
    };
    let segments: Vec<_> = outline.segments().map(|ends| ends.map(to_lattice)).collect();
    let near = NearSegments::new(&segments, h);
    let height = 0.75f64.sqrt() * h;
    let mut points = Vec::new();
    for (row, mut crossings) in rows(&segments, height) {
        crossings.sort_by(f64::total_cmp);
        let shift = if row.rem_euclid(2) == 0 { 0.0 } else { 0.5 * h };
        for inside in crossings.chunks_exact(2) {
            let (first, last) = (((inside[0] - shift) / h).ceil(), ((inside[1] - shift) / h).floor());
            let places = (first as i64..=last as i64).map(|k| [k as f64 * h + shift, row as f64 * height]);
            points.extend(places.filter(|point| !near.is_near(point, DISTANCE * h)));
        }
    }
    let from_lattice = |[x, y]: [f64; 2]| [origin[0] + cosine * x - sine * y, origin[1] + sine * x + cosine * y];
    points.into_iter().map(from_lattice).collect()
}

/// For every row y = row · height where the segments cross it, in no order; an end on the row counts with the segment above it.
fn rows(segments: &[[[f64; 2]; 2]], height: f64) -> Vec<(i64, Vec<f64>)> {
    let row = |y: f64| (y / height).ceil() as i64;
    let heights = || segments.iter().flatten().map(|end| row(end[1]));
    let (Some(first), Some(last)) = (heights().min(), heights().max()) else {
        return Vec::new();
    };
    let mut rows: Vec<_> = (first..last).map(|row| (row, Vec::new())).collect();
    for [a, b] in segments {
        let (low, high) = if a[1] < b[1] { (a, b) } else { (b, a) };
        for number in row(low[1])..row(high[1]) {
            let share = (number as f64 * height - low[1]) / (high[1] - low[1]);
            rows[(number - first) as usize]
                .1
                .push(low[0] + share * (high[0] - low[0]));
        }
    }
    rows
}

/// Segments by the square of a grid that they pass through.
pub(super) struct NearSegments<'a> {
    segments: &'a [[[f64; 2]; 2]],
    lower: [f64; 2],
    width: f64,
    counts: [usize; 2],
    bins: Lists,
}

impl<'a> NearSegments<'a> {
    /// A grid of squares of the given width; queries may not reach further.
    pub fn new(segments: &'a [[[f64; 2]; 2]], width: f64) -> Self {
        let ends = || segments.iter().flatten();
        let lower: [f64; 2] = [0, 1].map(|axis| ends().fold(f64::INFINITY, |low, end| low.min(end[axis])));
        let upper: [f64; 2] = [0, 1].map(|axis| ends().fold(f64::NEG_INFINITY, |high, end| high.max(end[axis])));
        let mut near = Self {
            segments,
            lower,
            width,
            counts: [0, 1].map(|axis| ((upper[axis] - lower[axis]) / width) as usize + 1),
            bins: Lists::default(),
        };
        let count = near.counts[0] * near.counts[1];
        let bins: Vec<(usize, u32)> = (0u32..)
            .zip(segments)
            .flat_map(|(number, &[a, b])| {
                let (low, high) = ([0, 1].map(|k| a[k].min(b[k])), [0, 1].map(|k| a[k].max(b[k])));
                near.between(low, high)
                    .map(move |bin| (bin, number))
                    .collect::<Vec<_>>()
            })
            .collect();
        near.bins = Lists::from_pairs(count, bins.into_iter());
        near
    }

    /// The bins that meet a box.
    fn between(&self, low: [f64; 2], high: [f64; 2]) -> impl Iterator<Item = usize> {
        let place = |x: f64, axis: usize| {
            let place = ((x - self.lower[axis]) / self.width).max(0.0) as usize;
            place.min(self.counts[axis] - 1)
        };
        let columns = self.counts[0];
        let (first, last) = (place(low[0], 0), place(high[0], 0));
        (place(low[1], 1)..=place(high[1], 1)).flat_map(move |row| (first..=last).map(move |k| row * columns + k))
    }

    /// Whether a segment is nearer than `limit` ≤ the grid's width.
    pub fn is_near(&self, point: &[f64; 2], limit: f64) -> bool {
        let mut bins = self.between(point.map(|x| x - limit), point.map(|x| x + limit));
        bins.any(|bin| {
            let mut segments = self.bins.get(bin).iter().map(|&k| &self.segments[k as usize]);
            segments.any(|[a, b]| squared_distance_to_segment(point, a, b) < limit * limit)
        })
    }
}
