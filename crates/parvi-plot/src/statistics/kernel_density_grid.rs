//! Gaussian kernel density estimates of weighted points in two dimensions.

use std::f64::consts::{LN_2, PI};

use super::kernel_density::{DensityGrid, REACH, equidistant};
use super::{StatisticsError, bandwidth, check_weighted};

/// The two-dimensional density of weighted points (x_p, y_p) on `size` × `size` equidistant points of a rectangle.
///
/// The kernel follows the correlation of the points: with the Cholesky factor L of their covariance it is N(0, λ² L H Lᵀ),
/// H = diag(h₁², h₂²), where h_k is the one-dimensional Sheather–Jones width of the k-th whitened coordinate, times n^(1/30) to
/// pass from the one-dimensional rate n^(−1/5) to the two-dimensional n^(−1/6). In the tails it widens (after Abramson, Ann.
/// Statist. 10, 1982) by λ = (g / f)^¼ within 1…4, f the estimate with λ = 1 and g its geometric mean over the points.
/// Points are spread bilinearly on the grid first, so the cost depends on the grid and not on the number of points, and the
/// widths are at least 0.7 grid spacings.
///
/// # Errors
/// What is wrong with values or weights, [`StatisticsError::NoSpread`] where a coordinate is constant or one is a linear
/// function of the other, [`StatisticsError::Interval`] for an empty rectangle.
pub fn kernel_density_grid(
    x: &[f64],
    y: &[f64],
    weights: Option<&[f64]>,
    (x_range, y_range): ((f64, f64), (f64, f64)),
    size: usize,
) -> Result<DensityGrid, StatisticsError> {
    let total = check_weighted("x", x, weights)?;
    check_weighted("y", y, weights)?;
    if x.len() != y.len() {
        return Err(StatisticsError::Length {
            what: "y",
            expected: x.len(),
            found: y.len(),
        });
    }
    for (low, high) in [x_range, y_range] {
        if !(low < high && (high - low).is_finite()) {
            return Err(StatisticsError::Interval { low, high });
        }
    }
    let size = size.max(2);
    let spacing = [
        (x_range.1 - x_range.0) / (size - 1) as f64,
        (y_range.1 - y_range.0) / (size - 1) as f64,
    ];
    let kernel = whitened_kernel(x, y, weights, spacing)?;
    let masses = spread_masses(x, y, weights, [x_range.0, y_range.0], spacing, size);

    let pilot = kernel.smooth(&masses, spacing, size, |_| 0);
    let inside: f64 = masses.iter().sum();
    let logarithm: f64 = masses
        .iter()
        .zip(&pilot)
        .filter(|(mass, _)| **mass > 0.0)
        .map(|(mass, density)| mass / inside * density.ln())
        .sum();
    // λ = 2^(class / 2).
    let class = |node: usize| {
        let ratio = logarithm - pilot[node].ln();
        (0.5 * ratio / LN_2).round().clamp(0.0, 4.0) as usize
    };
    let mut values = kernel.smooth(&masses, spacing, size, class);
    for value in &mut values {
        *value /= total;
    }
    Ok(DensityGrid {
        x: equidistant(x_range, size),
        y: equidistant(y_range, size),
        values,
    })
}

/// The points' masses, each spread bilinearly over the four grid nodes around it; points outside the grid are left out.
fn spread_masses(
    x: &[f64],
    y: &[f64],
    weights: Option<&[f64]>,
    origin: [f64; 2],
    spacing: [f64; 2],
    size: usize,
) -> Vec<f64> {
    let mut masses = vec![0.0; size * size];
    let last = (size - 1) as f64;
    for index in 0..x.len() {
        let across = (x[index] - origin[0]) / spacing[0];
        let down = (y[index] - origin[1]) / spacing[1];
        if !((0.0..=last).contains(&across) && (0.0..=last).contains(&down)) {
            continue;
        }
        let mass = weights.map_or(1.0, |weights| weights[index]);
        let (column, row) = ((across as usize).min(size - 2), (down as usize).min(size - 2));
        let (right, below) = (across - column as f64, down - row as f64);
        let node = row * size + column;
        masses[node] += mass * (1.0 - right) * (1.0 - below);
        masses[node + 1] += mass * right * (1.0 - below);
        masses[node + size] += mass * (1.0 - right) * below;
        masses[node + size + 1] += mass * right * below;
    }
    masses
}

/// Grid offsets (rows, columns) and the kernel's values there.
type Stencil = Vec<(isize, isize, f64)>;

/// A bivariate Gaussian kernel with covariance L H Lᵀ, L lower triangular.
struct Kernel {
    lower: [f64; 3],
    widths: [f64; 2],
}

impl Kernel {
    /// The masses on the nodes of a grid, each spread by the kernel widened by 2^(class / 2) for its node's class 0…4.
    fn smooth(&self, masses: &[f64], spacing: [f64; 2], size: usize, class: impl Fn(usize) -> usize) -> Vec<f64> {
        let mut stencils: Vec<Option<Stencil>> = vec![None; 5];
        let mut values = vec![0.0; masses.len()];
        for (node, mass) in masses.iter().enumerate().filter(|(_, mass)| **mass > 0.0) {
            let (row, column) = ((node / size) as isize, (node % size) as isize);
            let class = class(node).min(4);
            let stencil =
                stencils[class].get_or_insert_with(|| self.stencil(spacing, size, 2f64.powf(0.5 * class as f64)));
            for &(down, across, weight) in stencil.iter() {
                let (to_row, to_column) = (row + down, column + across);
                let inside = 0..size as isize;
                if inside.contains(&to_row) && inside.contains(&to_column) {
                    values[to_row as usize * size + to_column as usize] += mass * weight;
                }
            }
        }
        values
    }

    /// The kernel's values at grid offsets (rows, columns) within its reach, widened by `factor`.
    fn stencil(&self, spacing: [f64; 2], size: usize, factor: f64) -> Stencil {
        let [l11, l21, l22] = self.lower;
        let [h1, h2] = self.widths.map(|width| width * factor);
        let reach_x = REACH * l11 * h1;
        let reach_y = REACH * (l21 * h1).hypot(l22 * h2);
        let limit = size as f64;
        let across = (reach_x / spacing[0]).min(limit) as isize;
        let down = (reach_y / spacing[1]).min(limit) as isize;
        let height = 1.0 / (2.0 * PI * l11 * l22 * h1 * h2);
        let mut stencil = Vec::new();
        for row in -down..=down {
            for column in -across..=across {
                let first = column as f64 * spacing[0] / l11;
                let second = (row as f64 * spacing[1] - l21 * first) / l22;
                let square = (first / h1).powi(2) + (second / h2).powi(2);
                if square <= REACH * REACH {
                    stencil.push((row, column, height * (-0.5 * square).exp()));
                }
            }
        }
        stencil
    }
}

/// The kernel for these points; see [`kernel_density_grid`].
fn whitened_kernel(
    x: &[f64],
    y: &[f64],
    weights: Option<&[f64]>,
    spacing: [f64; 2],
) -> Result<Kernel, StatisticsError> {
    let total = weights.map_or(x.len() as f64, |weights| weights.iter().sum());
    let weight = |index: usize| weights.map_or(1.0, |weights| weights[index]) / total;
    let moment = |f: &dyn Fn(usize) -> f64| (0..x.len()).map(|i| weight(i) * f(i)).sum::<f64>();
    let (mean_x, mean_y) = (moment(&|i| x[i]), moment(&|i| y[i]));
    let variance_x = moment(&|i| (x[i] - mean_x).powi(2));
    let variance_y = moment(&|i| (y[i] - mean_y).powi(2));
    let covariance = moment(&|i| (x[i] - mean_x) * (y[i] - mean_y));
    let no_spread = |what, value| StatisticsError::NoSpread { what, value };
    let l11 = variance_x.sqrt();
    if !l11.is_finite() || l11 <= 1e-12 * mean_x.abs() || l11 < 1e-250 {
        return Err(no_spread("x", mean_x));
    }
    let l21 = covariance / l11;
    let remaining = variance_y - l21 * l21;
    if remaining.is_nan() || remaining <= 1e-12 * variance_y || remaining.sqrt() < 1e-250 {
        return Err(no_spread("y", mean_y));
    }
    let l22 = remaining.sqrt();
    let first: Vec<f64> = x.iter().map(|x| (x - mean_x) / l11).collect();
    let second: Vec<f64> = y
        .iter()
        .zip(&first)
        .map(|(y, first)| (y - mean_y - l21 * first) / l22)
        .collect();
    let size = 1.0 / moment(&|i| weight(i));
    let rate = size.powf(1.0 / 30.0);
    let floor_x = 0.7 * spacing[0] / l11;
    let floor_y = 0.7 * spacing[1] / l22;
    let h1 = bandwidth(&first, weights)? * rate;
    let h2 = bandwidth(&second, weights)? * rate;
    Ok(Kernel {
        lower: [l11, l21, l22],
        widths: [h1.max(floor_x), h2.max(floor_y)],
    })
}
