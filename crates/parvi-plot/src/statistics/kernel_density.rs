//! Gaussian kernel density estimates of weighted points in one dimension, and grids for two.

use std::f64::consts::PI;

use super::{StatisticsError, bandwidth};

/// Beyond this many standard deviations the kernel is taken as zero (it is below 4e-6 of its height there).
pub(super) const REACH: f64 = 5.0;

/// Large samples are gathered on nodes this many to a kernel width, which widens the kernel by less than 0.1 %.
const BINS_PER_WIDTH: f64 = 12.0;

/// The density Σ_p w_p N(x; x_p, h²) / Σ_p w_p at each of `locations`, which must ascend, with the width h of [`bandwidth`].
///
/// # Errors
/// As [`bandwidth`].
pub fn kernel_density(values: &[f64], weights: Option<&[f64]>, locations: &[f64]) -> Result<Vec<f64>, StatisticsError> {
    let width = bandwidth(values, weights)?;
    Ok(density_of_width(values, weights, width, locations))
}

/// The same with another width.
fn density_of_width(values: &[f64], weights: Option<&[f64]>, width: f64, locations: &[f64]) -> Vec<f64> {
    let total = weights.map_or(values.len() as f64, |weights| weights.iter().sum());
    let mut density = vec![0.0; locations.len()];
    let height = 1.0 / (total * width * (2.0 * PI).sqrt());
    let binned = binned(values, weights, width / BINS_PER_WIDTH);
    let (values, weights) = match &binned {
        Some((nodes, masses)) => (nodes.as_slice(), Some(masses.as_slice())),
        None => (values, weights),
    };
    for (index, value) in values.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[index]) * height;
        let first = locations.partition_point(|&x| x < value - REACH * width);
        for (x, sum) in locations[first..].iter().zip(&mut density[first..]) {
            let distance = (x - value) / width;
            if distance > REACH {
                break;
            }
            *sum += weight * (-0.5 * distance * distance).exp();
        }
    }
    density
}

/// The sample's weight shared linearly between neighbouring nodes `spacing` apart; `None` for samples so small or so far
/// spread that this saves nothing.
fn binned(values: &[f64], weights: Option<&[f64]>, spacing: f64) -> Option<(Vec<f64>, Vec<f64>)> {
    let low = values.iter().copied().fold(f64::INFINITY, f64::min);
    let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let nodes = (high - low) / spacing + 2.0;
    if values.len() < 10_000 || nodes.is_nan() || nodes > 0.2 * values.len() as f64 {
        return None;
    }
    let mut masses = vec![0.0; nodes as usize + 1];
    for (index, value) in values.iter().enumerate() {
        let weight = weights.map_or(1.0, |weights| weights[index]);
        let position = (value - low) / spacing;
        let right = position - position.floor();
        masses[position as usize] += weight * (1.0 - right);
        masses[position as usize + 1] += weight * right;
    }
    let nodes = (0..masses.len()).map(|index| low + index as f64 * spacing);
    Some((nodes.collect(), masses))
}

/// Density values on a rectangular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct DensityGrid {
    /// The ascending abscissas of the columns.
    pub x: Vec<f64>,
    /// The ascending ordinates of the rows.
    pub y: Vec<f64>,
    /// `values[row * x.len() + column]`, up to a common factor.
    pub values: Vec<f64>,
}

impl DensityGrid {
    /// The grid of `density(x, y)` at `columns` × `rows` equidistant points of a rectangle.
    pub fn evaluate(
        x_range: (f64, f64),
        y_range: (f64, f64),
        (columns, rows): (usize, usize),
        density: impl Fn(f64, f64) -> f64,
    ) -> DensityGrid {
        let x = equidistant(x_range, columns);
        let y = equidistant(y_range, rows);
        let values = y
            .iter()
            .flat_map(|&y| x.iter().map(move |&x| (x, y)))
            .map(|(x, y)| density(x, y))
            .collect();
        DensityGrid { x, y, values }
    }

    /// From logarithms to values, the largest 1; what is not a number counts as zero.
    pub fn exponentiate(&mut self) {
        let finite = self.values.iter().copied().filter(|value| value.is_finite());
        let most = finite.fold(f64::NEG_INFINITY, f64::max);
        for value in &mut self.values {
            *value = if value.is_finite() { (*value - most).exp() } else { 0.0 };
        }
    }

    /// Whether the integral over every second node differs by no more than this share.
    pub fn settles(&self, tolerance: f64) -> bool {
        let (columns, rows) = (self.x.len(), self.y.len());
        let sum = |step: usize| {
            let nodes = |row: usize| (0..columns).step_by(step).map(move |column| row * columns + column);
            let values = (0..rows).step_by(step).flat_map(nodes).map(|node| self.values[node]);
            let cell = step * if rows > 1 { step } else { 1 };
            values.sum::<f64>() * cell as f64
        };
        let (all, half) = (sum(1), sum(2));
        all > 0.0 && (half / all - 1.0).abs() < tolerance
    }

    /// The density of one coordinate at the nodes of its axis, by the trapezoidal rule over the other one and then itself; the ends of
    /// the grid, where nothing is, count whole. `None` for fewer than two nodes.
    pub fn marginal(&self, axis: usize) -> Option<(Vec<f64>, Vec<f64>)> {
        let (columns, rows) = (self.x.len(), self.y.len());
        let nodes = if axis == 0 { &self.x } else { &self.y };
        let sum = |index: usize| -> f64 {
            if axis == 0 {
                (0..rows).map(|row| self.values[row * columns + index]).sum()
            } else {
                self.values[index * columns..(index + 1) * columns].iter().sum()
            }
        };
        let sums: Vec<f64> = (0..nodes.len()).map(sum).collect();
        let spacing = nodes.get(1)? - nodes.first()?;
        let total = sums.iter().sum::<f64>() * spacing;
        let density = sums.into_iter().map(|value| value / total).collect();
        Some((nodes.clone(), density))
    }
}

/// `count` equidistant points from one end of `range` to the other.
pub fn equidistant(range: (f64, f64), count: usize) -> Vec<f64> {
    let intervals = count.saturating_sub(1).max(1) as f64;
    (0..count)
        .map(|index| range.0 + (range.1 - range.0) * index as f64 / intervals)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use statrs::distribution::{Continuous, ContinuousCDF, Normal};

    fn normal_points(count: usize) -> Vec<f64> {
        let normal = Normal::new(0.0, 1.0).unwrap();
        (0..count)
            .map(|i| normal.inverse_cdf((i as f64 + 0.5) / count as f64))
            .collect()
    }

    #[test]
    fn the_estimate_of_a_gaussian_is_a_gaussian_of_total_mass_one() {
        let locations = equidistant((-6.0, 6.0), 241);
        let density = kernel_density(&normal_points(2000), None, &locations).unwrap();
        let mass: f64 = density.iter().sum::<f64>() * 0.05;
        assert!((mass - 1.0).abs() < 1e-4, "{mass}");
        let normal = Normal::new(0.0, 1.0).unwrap();
        for (x, value) in locations.iter().zip(&density) {
            assert!((value - normal.pdf(*x)).abs() < 0.02);
        }
    }

    #[test]
    fn a_fixed_width_gives_the_kernel_itself() {
        let density = density_of_width(&[1.0], None, 0.5, &[0.5, 1.0]);
        let kernel = Normal::new(1.0, 0.5).unwrap();
        assert!((density[0] - kernel.pdf(0.5)).abs() < 1e-14);
        assert!((density[1] - kernel.pdf(1.0)).abs() < 1e-14);
    }

    #[test]
    fn binning_changes_a_large_sample_by_less_than_a_thousandth() {
        let points = normal_points(20_000);
        let locations = equidistant((-3.0, 3.0), 31);
        let density = density_of_width(&points, None, 0.1, &locations);
        // The normal density convolved with the kernel.
        let exact = Normal::new(0.0, 1.01f64.sqrt()).unwrap();
        for (x, value) in locations.iter().zip(&density) {
            assert!((value / exact.pdf(*x) - 1.0).abs() < 5e-3, "{x}: {value}");
        }
        let direct: f64 = points
            .iter()
            .map(|point| Normal::new(*point, 0.1).unwrap().pdf(0.0) / 20_000.0)
            .sum();
        assert!((density[15] / direct - 1.0).abs() < 1e-3);
    }

    #[test]
    fn weights_shift_the_mass() {
        let density = density_of_width(&[-1.0, 1.0], Some(&[1.0, 3.0]), 0.1, &[-1.0, 1.0]);
        assert!((density[1] / density[0] - 3.0).abs() < 1e-12);
    }

    #[test]
    fn degenerate_samples_are_errors() {
        assert!(kernel_density(&[], None, &[0.0]).is_err());
        assert_eq!(
            kernel_density(&[1.0], Some(&[0.0]), &[0.0]),
            Err(StatisticsError::NoWeight)
        );
    }
}
