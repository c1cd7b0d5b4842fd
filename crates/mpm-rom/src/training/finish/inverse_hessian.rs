//! The approximate inverse of the Hessian that a quasi-Newton method builds from its steps.

use rayon::prelude::*;

/// H ≈ (∇²L)⁻¹, dense and symmetric.
///
/// A step s with the change y of the gradient makes of it the self-scaled update of Broyden, Fletcher, Goldfarb and Shanno (M. Al-Baali 1998),
///
/// H ← (H − (s hᵀ + h sᵀ) / b + (a / b²) s sᵀ) / τ + s sᵀ / b, h = H y, a = y·h, b = s·y > 0, τ = min(1, b / (s·H⁻¹ s)).
///
/// Rows are changed when the next product passes them, so that a step costs one pass through memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InverseHessian {
    size: usize,
    rows: Vec<f64>,
    pending: Option<Update>,
}

/// An update that the rows have not seen: H ← scale H + u sᵀ + s uᵀ.
#[derive(Clone, Debug, PartialEq)]
struct Update {
    scale: f64,
    step: Vec<f64>,
    other: Vec<f64>,
}

impl Update {
    /// Entry (i, j) after the update.
    fn of(&self, i: usize, j: usize, entry: f64) -> f64 {
        self.scale * entry + (self.step[i] * self.other[j] + self.other[i] * self.step[j])
    }
}

impl InverseHessian {
    /// A diagonal matrix.
    pub fn diagonal(entries: &[f64]) -> Self {
        let size = entries.len();
        let mut rows = vec![0.0; size * size];
        for (k, &entry) in entries.iter().enumerate() {
            rows[k * size + k] = entry;
        }
        Self {
            size,
            rows,
            pending: None,
        }
    }

    /// The matrix with these rows on and below the diagonal, one after another.
    pub fn from_lower(size: usize, lower: &[f64]) -> Self {
        let mut rows = vec![0.0; size * size];
        let mut start = 0;
        for i in 0..size {
            for j in 0..=i {
                rows[i * size + j] = lower[start + j];
                rows[j * size + i] = lower[start + j];
            }
            start += i + 1;
        }
        Self {
            size,
            rows,
            pending: None,
        }
    }

    /// Its rows on and below the diagonal.
    pub fn lower(&self) -> Vec<f64> {
        let rows = self.rows.chunks_exact(self.size.max(1)).enumerate();
        let entries = rows.flat_map(|(i, row)| row[..=i].iter().enumerate().map(move |(j, &entry)| (i, j, entry)));
        match &self.pending {
            None => entries.map(|(_, _, entry)| entry).collect(),
            Some(update) => entries.map(|(i, j, entry)| update.of(i, j, entry)).collect(),
        }
    }

    /// H x.
    pub fn apply(&mut self, x: &[f64]) -> Vec<f64> {
        let pending = self.pending.take();
        let rows = self.rows.par_chunks_exact_mut(self.size.max(1)).enumerate();
        rows.map(|(i, row)| match &pending {
            None => dot(row, x),
            Some(update) => {
                let (s, u) = (update.step[i], update.other[i]);
                for ((entry, step), other) in row.iter_mut().zip(&update.step).zip(&update.other) {
                    *entry = update.scale * *entry + (s * other + u * step);
                }
                dot(row, x)
            }
        })
        .collect()
    }

    /// The update after a step s along −H g of length `length`. Given H g and H g₊ before the update, returns H g₊ after it. Without b > 0 nothing
    /// changes.
    pub fn update(&mut self, length: f64, before: &Point<'_>, after: &Point<'_>) -> Vec<f64> {
        let step: Vec<f64> = before.product.iter().map(|d| -length * d).collect();
        let change = difference(after.gradient, before.gradient);
        let h = difference(after.product, before.product);
        let (a, b) = (dot(&change, &h), dot(&step, &change));
        // s·H⁻¹ s = −length s·g.
        let curvature = -length * dot(&step, before.gradient);
        if !(b > 0.0 && a > 0.0 && curvature > 0.0) {
            return after.product.to_vec();
        }
        let scale = 1.0 / (b / curvature).min(1.0);
        let (both, own) = (-scale / b, scale * a / (b * b) + 1.0 / b);
        let other: Vec<f64> = h.iter().zip(&step).map(|(h, s)| both * h + 0.5 * own * s).collect();
        let (along, across) = (dot(&step, after.gradient), dot(&other, after.gradient));
        let parts = after.product.iter().zip(&step).zip(&other);
        let product = parts.map(|((p, s), u)| scale * p + s * across + u * along).collect();
        self.pending = Some(Update { scale, step, other });
        product
    }
}

/// A gradient g and H g.
pub(crate) struct Point<'a> {
    pub gradient: &'a [f64],
    pub product: &'a [f64],
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Σ aᵢ bᵢ, eight sums side by side.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a, a_rest), (b, b_rest)) = (a.as_chunks::<8>(), b.as_chunks::<8>());
    let mut sums = [0.0; 8];
    for (a, b) in a.iter().zip(b) {
        for k in 0..8 {
            sums[k] += a[k] * b[k];
        }
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
