//! Domains with a name.

use std::f64::consts::{PI, TAU};

use mpm_tensor::vector::distance;

use super::{EdgeTarget, SizeField, outlines};
use crate::SimplexMesh;
use crate::generate::GenerationError;

/// A mesh of a simple polygon; see [`outlines`].
///
/// # Errors
/// As [`outlines`].
pub fn polygon(corners: &[[f64; 2]], target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    outlines(&[corners.to_vec()], target)
}

/// The corners of the rectangle between two of them.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless `lower` is less than `upper` along both axes.
pub fn rectangle_outline(lower: [f64; 2], upper: [f64; 2]) -> Result<Vec<[f64; 2]>, GenerationError> {
    GenerationError::check_positive("width", upper[0] - lower[0])?;
    GenerationError::check_positive("height", upper[1] - lower[1])?;
    Ok(vec![lower, [upper[0], lower[1]], upper, [lower[0], upper[1]]])
}

/// A mesh of the rectangle between two corners; see [`outlines`].
///
/// # Errors
/// As [`rectangle_outline`] and [`outlines`].
pub fn rectangle(lower: [f64; 2], upper: [f64; 2], target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    polygon(&rectangle_outline(lower, upper)?, target)
}

/// The regular polygon inscribed in a circle whose sides are nearest to `length`, of at least six.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless radius and length are positive.
pub fn disk_outline(centre: [f64; 2], radius: f64, length: f64) -> Result<Vec<[f64; 2]>, GenerationError> {
    GenerationError::check_positive("radius", radius)?;
    GenerationError::check_positive("length", length)?;
    let sides = (TAU * radius / length).round().max(6.0);
    GenerationError::check_count(length, sides)?;
    let corner = |k: usize| {
        let (sine, cosine) = (TAU * k as f64 / sides).sin_cos();
        [centre[0] + radius * cosine, centre[1] + radius * sine]
    };
    Ok((0..sides as usize).map(corner).collect())
}

/// A polygon inscribed in a circle whose sides follow a size field: of the same ∫ ds / h along the arc, as near to 1 as whole numbers allow, of at least six.
///
/// # Errors
/// [`GenerationError`] unless the radius is positive, or for more sides than can be numbered.
pub fn circle_outline(centre: [f64; 2], radius: f64, size: &SizeField) -> Result<Vec<[f64; 2]>, GenerationError> {
    GenerationError::check_positive("radius", radius)?;
    let at = |turn: f64| {
        let (sine, cosine) = (TAU * turn).sin_cos();
        [centre[0] + radius * cosine, centre[1] + radius * sine]
    };
    let arc = (TAU * radius / size.least()).max(1.0);
    GenerationError::check_count(size.least(), arc)?;
    let steps = (STEPS_PER_SIDE * arc).ceil();
    let mut sums = vec![0.0];
    for step in 0..steps as usize {
        let sides = TAU * radius / steps / size.at(&at((step as f64 + 0.5) / steps));
        sums.push(sums[step] + sides);
    }
    let total = sums[sums.len() - 1];
    let sides = total.round().max(6.0);
    let corner = |k: usize| {
        let goal = total * k as f64 / sides;
        let next = sums.partition_point(|&sum| sum <= goal).clamp(1, sums.len() - 1);
        let within = (goal - sums[next - 1]) / (sums[next] - sums[next - 1]);
        at(((next - 1) as f64 + within) / steps)
    };
    Ok((0..sides as usize).map(corner).collect())
}

/// Parts of a side in which the size field is summed.
const STEPS_PER_SIDE: f64 = 16.0;

/// A mesh of the polygon of [`disk_outline`]; see [`outlines`].
///
/// # Errors
/// As [`disk_outline`] and [`outlines`].
pub fn disk(centre: [f64; 2], radius: f64, target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    polygon(&disk_outline(centre, radius, target.length)?, target)
}

/// The outline of the wavy channel of Cao et al. (2024), §3.4: floor ≤ y ≤ height with floor ≤ 0 < height, of width 2, with the left wall at
/// x = sin(π y / 5) sin(π y / 20) for 0 < y ≤ 20 and x = 0 elsewhere, the right one at x + 2 (Eq. 36). The walls are polygons with corners at equal
/// distances of about `length` along the curve.
///
/// # Errors
/// [`GenerationError::InvalidParameter`] unless floor, height and length are in their ranges and finite.
pub fn wavy_channel_outline([floor, height]: [f64; 2], length: f64) -> Result<Vec<[f64; 2]>, GenerationError> {
    GenerationError::check_positive("height", height)?;
    GenerationError::check_positive("length", length)?;
    if !(floor.is_finite() && floor <= 0.0) {
        return Err(GenerationError::InvalidParameter {
            name: "floor",
            value: floor,
            requirement: "0 or below, and finite",
        });
    }
    // Two triangles per vertex, on an area of 2 · (height − floor).
    GenerationError::check_count(length, 4.0 * (height - floor) / length.powi(2))?;
    let left = wall([floor, height], length);
    let right = left.iter().rev().map(|&[x, y]| [x + 2.0, y]);
    Ok(left.iter().copied().chain(right).collect())
}

/// A mesh of the channel of [`wavy_channel_outline`]; see [`outlines`].
///
/// # Errors
/// As [`wavy_channel_outline`] and [`outlines`].
pub fn wavy_channel(ends: [f64; 2], target: &EdgeTarget) -> Result<SimplexMesh<2>, GenerationError> {
    polygon(&wavy_channel_outline(ends, target.length)?, target)
}

/// Points on the left wall from floor to height, about `length` apart along it.
fn wall([floor, height]: [f64; 2], length: f64) -> Vec<[f64; 2]> {
    let x = |y: f64| {
        if y > 0.0 && y <= 20.0 {
            (PI * y / 5.0).sin() * (PI * y / 20.0).sin()
        } else {
            0.0
        }
    };
    // The curve in steps small against its wave length and the cells; lengths along it are sums of theirs.
    let top = height.min(20.0);
    let steps = (top / length.min(1.0) * 64.0).ceil();
    let mut lengths = vec![0.0];
    let point = |k: usize| [x(top * k as f64 / steps), top * k as f64 / steps];
    for k in 0..steps as usize {
        lengths.push(lengths[k] + distance(&point(k), &point(k + 1)));
    }
    let curved = lengths[lengths.len() - 1];
    let total = curved + (height - top) - floor;
    let parts = (total / length).round().max(1.0);
    let corners = (0..=parts as usize).map(|part| {
        let place = total * part as f64 / parts + floor;
        if place <= 0.0 {
            return [0.0, place];
        }
        if place >= curved {
            let y = (top + (place - curved)).min(height);
            return [x(y), y];
        }
        let next = lengths.partition_point(|&along| along <= place);
        let share = (place - lengths[next - 1]) / (lengths[next] - lengths[next - 1]);
        let y = top * ((next - 1) as f64 + share) / steps;
        [x(y), y]
    });
    corners.collect()
}
