//! Power laws fitted by least squares in logarithms.

use statrs::distribution::{ContinuousCDF, StudentsT};

use super::StatisticsError;

/// A fitted exponent with the half-width of its 95 % confidence interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Exponent {
    /// The estimate b.
    pub value: f64,
    /// t₀.₉₇₅ · standard error, from Student's t with n − p − 1 degrees of freedom for p exponents; `None` when the data
    /// determine the fit without any to spare.
    pub half_width: Option<f64>,
}

/// A power law y = c x₁^b₁ … x_p^b_p fitted to data.
#[derive(Debug, Clone, PartialEq)]
pub struct PowerLaw {
    /// The factor c.
    pub prefactor: f64,
    /// The exponents b, one per predictor.
    pub exponents: Vec<Exponent>,
    /// The coefficient of determination of the regression in logarithms; 1 when log y does not vary.
    pub r_squared: f64,
    /// The number of observations.
    pub count: usize,
}

impl PowerLaw {
    /// The law's value at the predictors `x`; predictors without an exponent are ignored.
    pub fn value(&self, x: &[f64]) -> f64 {
        let logarithm: f64 = self
            .exponents
            .iter()
            .zip(x)
            .map(|(exponent, x)| exponent.value * x.ln())
            .sum();
        (self.prefactor.ln() + logarithm).exp()
    }
}

/// Fits y = c x^b: least squares of log y = a + b log x, all observations weighted equally.
///
/// # Errors
/// See [`fit_power_law_of`].
pub fn fit_power_law(x: &[f64], y: &[f64]) -> Result<PowerLaw, StatisticsError> {
    fit_power_law_of(&[x], y)
}

/// Fits y = c Π_j x_j^{b_j}, e.g. time = c M^{b₁} d^{b₂}, by least squares of the logarithms; `predictors[j][i]` belongs to `y[i]`.
///
/// The logarithms are centred, the normal equations S b = g with S_jk = Σ_i u_ij u_ik and g_j = Σ_i u_ij v_i solved by
/// Gauss–Jordan elimination, and the standard error of b_j is (s² (S⁻¹)_jj)^½ with s² = RSS / (n − p − 1).
///
/// # Errors
/// [`StatisticsError::Empty`], [`StatisticsError::Length`], [`StatisticsError::NotPositive`] (also for values that are not
/// finite) and [`StatisticsError::Undetermined`] where predictors are constant or collinear, or observations too few.
pub fn fit_power_law_of(predictors: &[&[f64]], y: &[f64]) -> Result<PowerLaw, StatisticsError> {
    if y.is_empty() || predictors.is_empty() {
        return Err(StatisticsError::Empty { what: "y or x" });
    }
    let response = centred_logarithms("y", y)?;
    let mut columns = Vec::with_capacity(predictors.len());
    for predictor in predictors {
        if predictor.len() != y.len() {
            return Err(StatisticsError::Length {
                what: "x",
                expected: y.len(),
                found: predictor.len(),
            });
        }
        columns.push(centred_logarithms("x", predictor)?);
    }
    let (count, size) = (y.len(), columns.len());
    let undetermined = StatisticsError::Undetermined {
        observations: count,
        unknowns: size + 1,
    };
    if count < size + 1 {
        return Err(undetermined);
    }
    let scatter: Vec<Vec<f64>> = columns
        .iter()
        .map(|left| columns.iter().map(|right| dot(&left.1, &right.1)).collect())
        .collect();
    let inverse = invert(scatter).ok_or(undetermined)?;
    let gradient: Vec<f64> = columns.iter().map(|c| dot(&c.1, &response.1)).collect();
    let slopes: Vec<f64> = inverse.iter().map(|row| dot(row, &gradient)).collect();

    let residual_sum: f64 = (0..count)
        .map(|i| {
            let fitted: f64 = (0..size).map(|j| slopes[j] * columns[j].1[i]).sum();
            (response.1[i] - fitted).powi(2)
        })
        .sum();
    let total_sum = dot(&response.1, &response.1);
    let freedom = count - size - 1;
    let quantile = StudentsT::new(0.0, 1.0, freedom as f64)
        .ok()
        .map(|distribution| distribution.inverse_cdf(0.975));
    let exponents = (0..size)
        .map(|j| Exponent {
            value: slopes[j],
            half_width: quantile.map(|t| t * (residual_sum / freedom as f64 * inverse[j][j]).max(0.0).sqrt()),
        })
        .collect();
    let intercept = response.0
        - columns
            .iter()
            .zip(&slopes)
            .map(|(column, slope)| slope * column.0)
            .sum::<f64>();
    Ok(PowerLaw {
        prefactor: intercept.exp(),
        exponents,
        r_squared: if total_sum > 0.0 {
            1.0 - residual_sum / total_sum
        } else {
            1.0
        },
        count,
    })
}

/// The mean of the logarithms and their deviations from it.
fn centred_logarithms(what: &'static str, values: &[f64]) -> Result<(f64, Vec<f64>), StatisticsError> {
    if let Some(index) = values.iter().position(|&v| !(v.is_finite() && v > 0.0)) {
        return Err(StatisticsError::NotPositive {
            what,
            index,
            value: values[index],
        });
    }
    let logarithms: Vec<f64> = values.iter().map(|value| value.ln()).collect();
    let mean = logarithms.iter().sum::<f64>() / logarithms.len() as f64;
    Ok((mean, logarithms.iter().map(|l| l - mean).collect()))
}

fn dot(left: &[f64], right: &[f64]) -> f64 {
    left.iter().zip(right).map(|(l, r)| l * r).sum()
}

/// The inverse of a small symmetric positive definite matrix, scaled to unit diagonal first so that singularity is judged
/// by correlation; `None` where 1 − R² of a column against the others falls below 1e-10.
fn invert(mut matrix: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    let size = matrix.len();
    let scales: Vec<f64> = (0..size).map(|j| matrix[j][j].sqrt()).collect();
    if scales.iter().any(|&scale| scale < 1e-9) {
        return None;
    }
    for (row, scale) in matrix.iter_mut().zip(&scales) {
        for (entry, other) in row.iter_mut().zip(&scales) {
            *entry /= scale * other;
        }
    }
    let mut inverse: Vec<Vec<f64>> = (0..size)
        .map(|i| (0..size).map(|j| f64::from(u8::from(i == j))).collect())
        .collect();
    for pivot in 0..size {
        let divisor = matrix[pivot][pivot];
        if divisor < 1e-10 {
            return None;
        }
        for column in 0..size {
            matrix[pivot][column] /= divisor;
            inverse[pivot][column] /= divisor;
        }
        for row in (0..size).filter(|&row| row != pivot) {
            let factor = matrix[row][pivot];
            for column in 0..size {
                matrix[row][column] -= factor * matrix[pivot][column];
                inverse[row][column] -= factor * inverse[pivot][column];
            }
        }
    }
    for (row, scale) in inverse.iter_mut().zip(&scales) {
        for (entry, other) in row.iter_mut().zip(&scales) {
            *entry /= scale * other;
        }
    }
    Some(inverse)
}
