//! The approximate inverse of the Hessian that a quasi-Newton method builds from its steps.

use rayon::prelude::*;

/// H ≈ (∇²L)⁻¹, dense and symmetric.
///
/// A step s with the change y of the gradient makes of it the update of Broyden, Fletcher, Goldfarb and Shanno (J. Nocedal, S. Wright 2006, Eq. 6.17),
///
/// H ← H − (s hᵀ + h sᵀ) / b + (a + b) / b² s sᵀ, h = H y, a = y·h, b = s·y > 0.
///
/// Rows are changed when the next product passes them, so that a step costs one pass through memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct InverseHessian {
    size: usize,
    rows: Vec<f64>,
    pending: Option<Update>,
}

/// An update that the rows have not seen: H ← H + u sᵀ + s uᵀ with u = −h / b + (a + b) / (2 b²) s.
#[derive(Clone, Debug, PartialEq)]
struct Update {
    step: Vec<f64>,
    other: Vec<f64>,
}

impl Update {
    /// Entry (i, j) after the update.
    fn of(&self, i: usize, j: usize, entry: f64) -> f64 {
        entry + (self.step[i] * self.other[j] + self.other[i] * self.step[j])
    }
}

impl InverseHessian {
    /// The symmetric matrix with these rows.
    pub fn new(size: usize, rows: Vec<f64>) -> Self {
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
        Self::new(size, rows)
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
                    *entry += s * other + u * step;
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
        if !(b > 0.0 && a > 0.0) {
            return after.product.to_vec();
        }
        let own = 0.5 * (a + b) / (b * b);
        let other: Vec<f64> = h.iter().zip(&step).map(|(h, s)| own * s - h / b).collect();
        let (along, across) = (dot(&step, after.gradient), dot(&other, after.gradient));
        let parts = after.product.iter().zip(&step).zip(&other);
        let product = parts.map(|((p, s), u)| p + s * across + u * along).collect();
        self.pending = Some(Update { step, other });
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
