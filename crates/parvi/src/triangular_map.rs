//! A lower triangular map from N(0, I) to a bent density, each coordinate a Gaussian given those before it.

#[cfg(test)]
mod tests;

use mpm_tensor::{Cholesky, Matrix, vector};

/// Up to this magnitude log scales are linear, beyond it they level off.
const LINEAR_LOG_SCALE: f64 = 8.0;

/// What they gain beyond it at most.
const LOG_SCALE_MARGIN: f64 = 4.0;

/// The map z ↦ x with, for i = 1 … D in a given order π of the axes,
///
/// y_i = m_i(y_<i) + exp(l_i(y_<i)) z_i,   x_π(i) = c_π(i) + σ_π(i) y_i,
///
/// m_i a polynomial of degree 2 and l_i = κ(a_i + Σ_{j<i} b_ij y_j). κ is the identity up to ±8 and 8 + 4 tanh((u − 8)/4) beyond, twice
/// continuously differentiable, so that no scale overflows. A Knothe–Rosenblatt rearrangement (Y. Marzouk, T. Moselhy, M. Parno,
/// A. Spantini, *Sampling via measure transport*, 2016, §2.3) with conditional location and scale; exact for Gaussians,
/// bananas, funnels and Rosenbrock chains whose axes are among the orders tried.
///
/// Parameters lie one coordinate after the other: coefficients of m_i on 1, y_1 … y_{i−1}, y_1², y_2 y_1, y_2², …, then those of l_i.
#[derive(Clone, Debug)]
pub(crate) struct TriangularMap<const D: usize> {
    centre: [f64; D],
    scales: [f64; D],
    order: [usize; D],
    parameters: Vec<f64>,
}

/// Where a point z goes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Image<const D: usize> {
    /// In the target's coordinates.
    pub x: [f64; D],
    y: [f64; D],
    log_scales: [f64; D],
    /// κ′.
    slopes: [f64; D],
}

impl<const D: usize> Image<D> {
    /// y_i.
    pub fn y(&self, i: usize) -> f64 {
        self.y[i]
    }
}

/// Coefficients of m_i, `before` = i − 1.
pub(crate) fn location_count(before: usize) -> usize {
    (before + 1) * (before + 2) / 2
}

/// 1, the y before, and, for the location, their products.
pub(crate) fn features(before: &[f64], quadratic: bool) -> impl Iterator<Item = f64> {
    let products = move |(j, &a): (usize, &f64)| before[..=j].iter().map(move |&b| a * b);
    let products = before.iter().enumerate().filter(move |_| quadratic).flat_map(products);
    std::iter::once(1.0).chain(before.iter().copied()).chain(products)
}

/// κ and κ′.
fn soft_clamp(raw: f64) -> (f64, f64) {
    let beyond = (raw.abs() - LINEAR_LOG_SCALE) / LOG_SCALE_MARGIN;
    if beyond <= 0.0 {
        return (raw, 1.0);
    }
    let bent = beyond.tanh();
    let value = LINEAR_LOG_SCALE + LOG_SCALE_MARGIN * bent;
    (value.copysign(raw), 1.0 - bent * bent)
}

impl<const D: usize> TriangularMap<D> {
    /// The map of N(`centre`, `covariance`), an affine one, in this order; `None` if the covariance is singular to rounding.
    pub fn gaussian(centre: &[f64; D], covariance: &Matrix<D>, order: [usize; D]) -> Option<Self> {
        let scales: [f64; D] = std::array::from_fn(|axis| covariance.0[axis][axis].sqrt());
        let correlation: Matrix<D> = Matrix::from_fn(|i, j| {
            let (a, b) = (order[i], order[j]);
            covariance.0[a][b] / (scales[a] * scales[b])
        });
        let lower = *Cholesky::new(&correlation).ok()?.lower();
        let mut map = Self {
            centre: *centre,
            scales,
            order,
            parameters: vec![0.0; Self::offset(D)],
        };
        for i in 0..D {
            // y_i = Σ_j b_j y_j + L_ii z_i with b L_< = L_i<.
            let mut slopes = [0.0; D];
            for j in (0..i).rev() {
                let later: f64 = (j + 1..i).map(|k| slopes[k] * lower.0[k][j]).sum();
                slopes[j] = (lower.0[i][j] - later) / lower.0[j][j];
            }
            let (location, scale) = map.block_mut(i);
            location[1..=i].copy_from_slice(&slopes[..i]);
            scale[0] = lower.0[i][i].ln();
        }
        Some(map)
    }

    /// Where the parameters of coordinate i begin.
    pub fn offset(i: usize) -> usize {
        i * (i + 1) * (i + 2) / 6 + i * (i + 1) / 2
    }

    /// All parameters.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The map with parameters moved by `fraction` of `step`.
    pub fn moved(&self, fraction: f64, step: &[f64]) -> Self {
        let mut map = self.clone();
        for (parameter, change) in map.parameters.iter_mut().zip(step) {
            *parameter += fraction * change;
        }
        map
    }

    /// The map with other coefficients of m_i and l_i.
    pub fn with_block(&self, i: usize, location: &[f64], scale: &[f64]) -> Self {
        let mut map = self.clone();
        let (old_location, old_scale) = map.block_mut(i);
        old_location.copy_from_slice(location);
        old_scale.copy_from_slice(scale);
        map
    }

    /// Coefficients of m_i and l_i.
    fn block(&self, i: usize) -> (&[f64], &[f64]) {
        self.parameters[Self::offset(i)..Self::offset(i + 1)].split_at(location_count(i))
    }

    fn block_mut(&mut self, i: usize) -> (&mut [f64], &mut [f64]) {
        self.parameters[Self::offset(i)..Self::offset(i + 1)].split_at_mut(location_count(i))
    }

    /// (m_i, l_i, κ′) where `before` = y_<i.
    fn conditional(&self, before: &[f64]) -> (f64, f64, f64) {
        let (location, scale) = self.block(before.len());
        let (affine, mut products) = location.split_at(before.len() + 1);
        let (mut mean, mut raw) = (affine[0], scale[0]);
        for (j, &y) in before.iter().enumerate() {
            let (row, rest) = products.split_at(j + 1);
            let inner: f64 = row.iter().zip(before).map(|(c, other)| c * other).sum();
            mean += (affine[j + 1] + inner) * y;
            raw += scale[j + 1] * y;
            products = rest;
        }
        let (log_scale, slope) = soft_clamp(raw);
        (mean, log_scale, slope)
    }

    /// Where z goes.
    pub fn image(&self, z: &[f64; D]) -> Image<D> {
        let mut image = Image {
            x: self.centre,
            y: [0.0; D],
            log_scales: [0.0; D],
            slopes: [0.0; D],
        };
        for i in 0..D {
            let (mean, log_scale, slope) = self.conditional(&image.y[..i]);
            (image.log_scales[i], image.slopes[i]) = (log_scale, slope);
            image.y[i] = mean + log_scale.exp() * z[i];
            image.x[self.order[i]] += self.scales[self.order[i]] * image.y[i];
        }
        image
    }

    /// The z that goes to x, and log det ∂x/∂z there.
    pub fn inverse(&self, x: &[f64; D]) -> ([f64; D], f64) {
        let y: [f64; D] = std::array::from_fn(|i| {
            let axis = self.order[i];
            (x[axis] - self.centre[axis]) / self.scales[axis]
        });
        let (mut z, mut log_determinant) = ([0.0; D], self.log_scale_of_axes());
        for i in 0..D {
            let (mean, log_scale, _) = self.conditional(&y[..i]);
            z[i] = (y[i] - mean) * (-log_scale).exp();
            log_determinant += log_scale;
        }
        (z, log_determinant)
    }

    /// log of the density of x(z), z ~ N(0, I), at x, up to the constant −½ D log 2π.
    pub fn log_density(&self, x: &[f64; D]) -> f64 {
        let (z, log_determinant) = self.inverse(x);
        -0.5 * vector::norm_squared(&z) - log_determinant
    }

    /// log det ∂x/∂z = Σ l_i + Σ log σ_i.
    pub fn log_determinant(&self, image: &Image<D>) -> f64 {
        self.log_scale_of_axes() + image.log_scales.iter().sum::<f64>()
    }

    fn log_scale_of_axes(&self) -> f64 {
        self.scales.iter().map(|scale| scale.ln()).sum()
    }

    /// ∇_z [log p(x(z)) + log det ∂x/∂z] from `score` = ∇_x log p, by one sweep backwards: the total derivative by y_i is
    ///
    /// a_i = σ_π(i) s_π(i) + Σ_{j>i} (a_j ∂y_j/∂y_i + ∂l_j/∂y_i),   ∇_{z_i} = a_i e^{l_i}.
    pub fn pull_back_score(&self, z: &[f64; D], image: &Image<D>, score: &[f64; D]) -> [f64; D] {
        let mut total: [f64; D] = std::array::from_fn(|i| self.scales[self.order[i]] * score[self.order[i]]);
        for i in (0..D).rev() {
            let pull = total[i];
            total[i] *= image.log_scales[i].exp();
            let widening = (total[i] * z[i] + 1.0) * image.slopes[i];
            let (location, scale) = self.block(i);
            let (affine, mut products) = location.split_at(i + 1);
            for j in 0..i {
                total[j] += pull * affine[j + 1] + widening * scale[j + 1];
                let (row, rest) = products.split_at(j + 1);
                for (k, c) in row.iter().enumerate() {
                    total[j] += pull * c * image.y[k];
                    total[k] += pull * c * image.y[j];
                }
                products = rest;
            }
        }
        total
    }

    /// (e^{−l_i}, κ′, y_<i): what a parameter of coordinate i changes directly, in units of z_i. A change δm_i is worth e^{−l_i} δm_i, a
    /// change δu of κ's argument z_i κ′ δu.
    pub fn sensitivity<'a>(&self, i: usize, image: &'a Image<D>) -> (f64, f64, &'a [f64]) {
        ((-image.log_scales[i]).exp(), image.slopes[i], &image.y[..i])
    }

    /// Σ_i KL of the Gaussian of y_i given y_<i from that of `other`, at an image of this map; both maps have the same axes.
    pub fn conditional_divergence(&self, image: &Image<D>, other: &Self) -> f64 {
        let of = |i: usize| {
            let (mean, log_scale, _) = self.conditional(&image.y[..i]);
            let (other_mean, other_log_scale, _) = other.conditional(&image.y[..i]);
            let widening = log_scale - other_log_scale;
            let shift = (mean - other_mean) * (-other_log_scale).exp();
            0.5 * (shift * shift + (2.0 * widening).exp_m1()) - widening
        };
        (0..D).map(of).sum()
    }
}
