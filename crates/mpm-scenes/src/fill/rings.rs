use std::f64::consts::PI;

use super::{Filling, MOST_POINTS, counts};
use crate::SceneFault;
use crate::shape::{Bounds, Shape};

/// Rings of particles in a disk or an annulus, about `step` wide and with particles about as far apart; V⁰ is the same for all and adds up to the
/// area of the shape.
///
/// Ring k holds n_k = round(2π r_k / step) particles and reaches from r_{k−1} to r_k with π (r_k² − r_{k−1}²) = n_k V⁰; they sit
/// at the radius that halves its area. Neighbouring rings are turned against each other by the golden ratio. Edges have no stairs, at which free
/// surfaces lose the second order (docs/results/mechanics).
///
/// # Errors
/// [`SceneFault::Value`] for other dimensions than 2 and other shapes, [`SceneFault::TooManyPoints`] for a step too short to be counted.
pub fn rings<const D: usize>(
    body: &str,
    shape: &dyn Shape<D>,
    step: f64,
    room: &Bounds<D>,
) -> Result<Filling<D>, SceneFault> {
    let other = |what: &str| {
        SceneFault::value(
            format!("bodies.{body}.fill"),
            "rings",
            format!("another filling for {what}"),
        )
    };
    let bounds = shape.bounds().finite_within(room);
    let sides = bounds.sides();
    let centre: [f64; D] = std::array::from_fn(|a| 0.5 * (bounds.lower[a] + bounds.upper[a]));
    counts(body, &sides, &[step; D], MOST_POINTS)?;
    let far = centre.iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
    let rounding = |length: f64| 1e-9 * length + 8.0 * f64::EPSILON * far;
    let outer = match sides.get(..2) {
        Some(&[width, height]) if D == 2 && (width - height).abs() <= rounding(width) => 0.5 * width,
        _ => return Err(other("what is no disk or annulus")),
    };
    let inner = shape.distance(&centre).max(0.0);
    if outer.is_nan() || outer <= inner {
        return Err(other("an empty shape"));
    }
    let on_edge = |radius: f64, direction: u32| {
        let (sin, cos) = (PI * f64::from(direction) / 8.0).sin_cos();
        let x = std::array::from_fn(|a| centre[a] + radius * [cos, sin].get(a).unwrap_or(&0.0));
        shape.distance(&x).abs() <= rounding(outer)
    };
    let edges = [outer, inner].into_iter().filter(|&radius| radius > 0.0);
    if !edges
        .into_iter()
        .all(|radius| (0..16).all(|direction| on_edge(radius, direction)))
    {
        return Err(other("what is no disk or annulus"));
    }
    let thickness = outer - inner;
    let number = (thickness / step).round().max(1.0) as u32;
    let sizes: Vec<f64> = (0..number)
        .map(|k| 2.0 * PI * (inner + (f64::from(k) + 0.5) * thickness / f64::from(number)))
        .map(|length| (length / step).round().max(1.0))
        .collect();
    let volume = PI * (outer * outer - inner * inner) / sizes.iter().sum::<f64>();
    let mut positions = Vec::new();
    let mut square = inner * inner;
    for (k, &size) in sizes.iter().enumerate() {
        let area = size * volume / PI;
        let radius = (square + 0.5 * area).sqrt();
        square += area;
        for j in 0..size as u32 {
            let angle = 2.0 * PI * ((f64::from(j) + 0.5) / size + k as f64 * GOLDEN);
            let offset = [radius * angle.cos(), radius * angle.sin()];
            positions.push(std::array::from_fn(|a| centre[a] + offset.get(a).unwrap_or(&0.0)));
        }
    }
    Ok(Filling::of_equal(positions, volume))
}

/// The fractional part of the golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
