//! Conformance of a basis, part: gradients.

use std::collections::HashMap;

use mpm_core::Basis;

use crate::scenes::{norm, stencil};

/// Bases whose gradient is no derivative by definition: the diffuse gradient of moving least squares.
const DIFFUSE: [&str; 0] = [];

/// ∇w against central differences, where w has no kink within the step: hats have one at the points put on nodes.
pub fn gradients_are_derivatives<const D: usize, B: Basis<D>>(
    name: &str,
    basis: &B,
    positions: &[[f64; D]],
    what: &str,
) {
    if DIFFUSE.contains(&name) {
        return;
    }
    let h = basis.spacing();
    let step = 1e-5 * h;
    // Weights by node, the node told by its position.
    let weights = |x: &[f64; D]| -> HashMap<[i64; D], f64> {
        let key = |offset: [f64; D]| {
            std::array::from_fn(|a| ((x[a] + offset[a] - positions[0][a]) / h * 64.0).round() as i64)
        };
        stencil(basis, x).into_iter().map(|s| (key(s.3), s.1)).collect()
    };
    let sample = positions.iter().filter(|x| norm(x) < 1e3 * h).take(20);
    let (mut compared, mut kinks) = (0, 0);
    for x in sample {
        let here = weights(x);
        let gradients: Vec<[f64; D]> = stencil(basis, x).iter().map(|s| s.2).collect();
        let keys: Vec<[i64; D]> = stencil(basis, x)
            .iter()
            .map(|s| std::array::from_fn(|a| ((x[a] + s.3[a] - positions[0][a]) / h * 64.0).round() as i64))
            .collect();
        for a in 0..D {
            let shifted = |sign: f64| {
                let mut y = *x;
                y[a] += sign * step;
                weights(&y)
            };
            let (before, after) = (shifted(-1.0), shifted(1.0));
            let at = |w: &HashMap<[i64; D], f64>, key| w.get(key).copied().unwrap_or(0.0);
            for (key, gradient) in keys.iter().zip(&gradients) {
                let (w0, w1, w2) = (at(&before, key), at(&here, key), at(&after, key));
                if (w2 - 2.0 * w1 + w0).abs() > 1e-3 * step / h {
                    kinks += 1;
                    continue;
                }
                compared += 1;
                let difference = (w2 - w0) / (2.0 * step);
                assert!(
                    (gradient[a] - difference).abs() < 1e-6 / h,
                    "{what}: gradient {} for {difference}",
                    gradient[a]
                );
            }
        }
    }
    assert!(5 * kinks < compared, "{what}: {kinks} kinks, {compared} comparisons");
}
