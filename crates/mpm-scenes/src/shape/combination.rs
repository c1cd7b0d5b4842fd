//! Unions, intersections and differences.

use super::{Bounds, Shape};

/// Points in any of the shapes: d = min d_k.
#[derive(Debug)]
pub struct Union<const D: usize>(pub Vec<Box<dyn Shape<D>>>);

/// Points in all of the shapes: d = max d_k.
#[derive(Debug)]
pub struct Intersection<const D: usize>(pub Vec<Box<dyn Shape<D>>>);

/// Points of one shape that are in none of the others: d = max(d_from, −d_k).
#[derive(Debug)]
pub struct Difference<const D: usize> {
    /// The shape.
    pub from: Box<dyn Shape<D>>,
    /// What is cut off it.
    pub remove: Vec<Box<dyn Shape<D>>>,
}

fn by_distance<'a, const D: usize>(
    shapes: &'a [Box<dyn Shape<D>>],
    x: &[f64; D],
) -> impl Iterator<Item = (f64, &'a dyn Shape<D>)> {
    shapes.iter().map(|shape| (shape.distance(x), &**shape))
}

impl<const D: usize> Shape<D> for Union<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        by_distance(&self.0, x).fold(f64::INFINITY, |least, (d, _)| least.min(d))
    }

    fn bounds(&self) -> Bounds<D> {
        let all = self.0.iter().map(|shape| shape.bounds());
        all.reduce(|a, b| a.hull(&b)).unwrap_or(Bounds::EVERYWHERE)
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        let nearest = by_distance(&self.0, x).min_by(|a, b| a.0.total_cmp(&b.0));
        nearest.map_or([0.0; D], |(_, shape)| shape.normal(x))
    }
}

impl<const D: usize> Shape<D> for Intersection<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        by_distance(&self.0, x).fold(f64::NEG_INFINITY, |most, (d, _)| most.max(d))
    }

    fn bounds(&self) -> Bounds<D> {
        self.0
            .iter()
            .fold(Bounds::EVERYWHERE, |all, shape| all.overlap(&shape.bounds()))
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        let farthest = by_distance(&self.0, x).max_by(|a, b| a.0.total_cmp(&b.0));
        farthest.map_or([0.0; D], |(_, shape)| shape.normal(x))
    }
}

impl<const D: usize> Shape<D> for Difference<D> {
    fn distance(&self, x: &[f64; D]) -> f64 {
        by_distance(&self.remove, x).fold(self.from.distance(x), |most, (d, _)| most.max(-d))
    }

    fn bounds(&self) -> Bounds<D> {
        self.from.bounds()
    }

    fn normal(&self, x: &[f64; D]) -> [f64; D] {
        let removed = by_distance(&self.remove, x).min_by(|a, b| a.0.total_cmp(&b.0));
        match removed {
            Some((distance, shape)) if -distance > self.from.distance(x) => shape.normal(x).map(|c| -c),
            _ => self.from.normal(x),
        }
    }
}
