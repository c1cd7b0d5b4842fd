//! How wide the Gaussian kernel of a density estimate should be.

use std::f64::consts::PI;

use super::{StatisticsError, check_weighted, weighted_quantile};

/// The standard deviation of a Gaussian kernel for `values` with `weights` (equal if `None`): the plug-in estimate of Botev, Grotowski & Kroese (Ann. Statist. 38, 2010, Algorithm 1), which does
/// not assume that the density resembles a Gaussian and so keeps separated modes apart. Of several solutions it is the largest below Silverman's rule 0.9 min(σ, IQR / 1.34) n^(−1/5), as smaller ones resolve the noise; where there is none, it is that rule. With
/// weights, the sample size n is the effective one, (Σw)² / Σw².
///
/// # Errors
/// [`StatisticsError::NoSpread`] if all values with a positive weight are equal, otherwise what is wrong with the values or weights.
pub fn bandwidth(values: &[f64], weights: Option<&[f64]>) -> Result<f64, StatisticsError> {
    let total = check_weighted("values", values, weights)?;
    // In units of a power of two, so that squares neither overflow nor vanish and no digit changes.
    let largest = values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let unit = largest.log2().floor().max(-1022.0).exp2();
    let values: &[f64] = &values.iter().map(|value| value / unit).collect::<Vec<_>>();
    let weight = |index: usize| weights.map_or(1.0, |weights| weights[index]) / total;
    let mean: f64 = (0..values.len()).map(|i| weight(i) * values[i]).sum();
    let variance: f64 = (0..values.len()).map(|i| weight(i) * (values[i] - mean).powi(2)).sum();
    let concentration: f64 = (0..values.len()).map(|i| weight(i).powi(2)).sum();
    let size = 1.0 / concentration;
    let deviation = variance.sqrt();
    if deviation <= 1e-12 * mean.abs() {
        return Err(StatisticsError::NoSpread {
            what: "values",
            value: unit * mean,
        });
    }
    let levels = weighted_quantile(values, weights, &[0.001, 0.25, 0.75, 0.999])?;
    let spread = (levels[2] - levels[1]) / 1.34;
    let scale = if spread > 0.0 { spread.min(deviation) } else { deviation };
    let silverman = 0.9 * scale * size.powf(-0.2);
    let core = (levels[0], levels[3]);
    Ok(unit * sheather_jones(values, weights, size, core, silverman).unwrap_or(silverman))
}

/// The number of bins of the histogram that the plug-in estimate works on.
const BINS: usize = 1024;

/// The improved Sheather–Jones width: the root t* of t = ξ γ⁽⁵⁾(t), where γ chains the plug-in estimates of ‖f⁽ˢ⁾‖² from
/// s = 7 down to 2, computed from the discrete cosine transform of a histogram. The core between two outer quantiles
/// decides, so that single far points do not coarsen the histogram. The largest root below `widest`; `None` without one.
fn sheather_jones(values: &[f64], weights: Option<&[f64]>, size: f64, core: (f64, f64), widest: f64) -> Option<f64> {
    let range = 2.0 * (core.1 - core.0);
    if !(range > 0.0 && range.is_finite()) {
        return None;
    }
    let low = core.0 - 0.25 * range;
    let mut histogram = vec![0.0; BINS];
    for (index, value) in values.iter().enumerate() {
        let position = (value - low) / range * BINS as f64;
        if position >= 0.0 && position < BINS as f64 {
            histogram[position as usize] += weights.map_or(1.0, |weights| weights[index]);
        }
    }
    let total: f64 = histogram.iter().sum();
    // (a_k / 2)² of the type-2 transform a_k = 2 Σ_j q_j cos(πk(j + ½)/n), k = 1, 2, …
    let cosines: Vec<f64> = (0..4 * BINS)
        .map(|m| (PI * m as f64 / (2 * BINS) as f64).cos())
        .collect();
    let energies: Vec<f64> = (1..BINS)
        .map(|k| {
            let sum: f64 = histogram
                .iter()
                .enumerate()
                .filter(|(_, mass)| **mass != 0.0)
                .map(|(j, mass)| mass * cosines[k * (2 * j + 1) % (4 * BINS)])
                .sum();
            (sum / total).powi(2)
        })
        .collect();
    // ‖f⁽ˢ⁾‖² at kernel time t.
    let roughness = |order: i32, time: f64| -> f64 {
        let sum: f64 = energies
            .iter()
            .enumerate()
            .map(|(index, energy)| (((index + 1) * (index + 1)) as f64, energy))
            .take_while(|(square, _)| square * PI * PI * time < 700.0)
            .map(|(square, energy)| square.powi(order) * energy * (-square * PI * PI * time).exp())
            .sum();
        2.0 * PI.powi(2 * order) * sum
    };
    let excess = |time: f64| -> f64 {
        let mut roughness_estimate = roughness(7, time);
        for order in (2..=6).rev() {
            let odd_product: f64 = (1..=order).map(|i| f64::from(2 * i - 1)).product();
            let factor = (1.0 + 0.5f64.powf(f64::from(order) + 0.5)) / 3.0;
            let plug_in = (2.0 * factor * odd_product / (2.0 * PI).sqrt() / size / roughness_estimate)
                .powf(2.0 / f64::from(3 + 2 * order));
            roughness_estimate = roughness(order, plug_in);
        }
        time - (2.0 * size * PI.sqrt() * roughness_estimate).powf(-0.4)
    };
    // The largest root: from the widest kernel downwards until the sign changes, then bisection.
    let mut above = (widest / range).powi(2).min(0.1);
    if excess(above).partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
        return None;
    }
    let mut below = above;
    while excess(below) >= 0.0 {
        above = below;
        below /= 1.5;
        if below < 1e-9 {
            return None;
        }
    }
    for _ in 0..30 {
        let middle = (below * above).sqrt();
        if excess(middle) < 0.0 {
            below = middle;
        } else {
            above = middle;
        }
    }
    let width = above.sqrt() * range;
    (width.is_finite() && width > 0.0).then_some(width)
}
