//! a(X) = X − g̃(X, x̂₀) from a table.

use mpm_tensor::{Matrix, vector};

/// Nodes of a table, at most: 96 MB in three dimensions.
const MOST_NODES: usize = 4_000_000;

/// Nodes beside the four around a point.
const STENCIL: usize = 4;

/// a(X) at the nodes of a lattice, and between them by cubic convolution (R. G. Keys 1981, *Cubic convolution interpolation for digital image processing*, IEEE Trans. ASSP 29, Eq. 15 with a = −1/2), axis by axis:
/// interpolating and C¹, a to third and ∇a to second order in the spacing.
///
/// Points of space meet other material points in every step, so that a(X) and ∇a(X) are needed at other X each time; of nine columns of the network these are four.
#[derive(Clone, Debug)]
pub struct AtRestTable<const D: usize> {
    origin: [f64; D],
    spacing: f64,
    counts: [usize; D],
    /// a at the nodes, the last axis running fastest.
    offsets: Vec<[f64; D]>,
}

impl<const D: usize> AtRestTable<D> {
    /// A table of the box around these points, and of `margin` beyond it; `offsets` gives a at the nodes. `None` for no points, or a box of too many nodes.
    pub(super) fn around(
        points: &[[f64; D]],
        margin: f64,
        spacing: f64,
        offsets: impl FnOnce(&[[f64; D]]) -> Vec<[f64; D]>,
    ) -> Option<Self> {
        let (mut lower, mut upper) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for x in points {
            for a in 0..D {
                lower[a] = lower[a].min(x[a]);
                upper[a] = upper[a].max(x[a]);
            }
        }
        // One node more on either side than the margin needs, for the stencil.
        let origin = lower.map(|c| c - margin - spacing);
        let mut counts = [0; D];
        let mut nodes = 1_usize;
        for a in 0..D {
            let cells = (upper[a] + margin - origin[a]) / spacing;
            if !(0.0..1e6).contains(&cells) {
                return None;
            }
            counts[a] = cells as usize + 3;
            nodes = nodes.checked_mul(counts[a]).filter(|nodes| *nodes <= MOST_NODES)?;
        }
        let place = |node: usize| {
            let mut rest = node;
            let mut x = origin;
            for a in (0..D).rev() {
                x[a] += spacing * (rest % counts[a]) as f64;
                rest /= counts[a];
            }
            x
        };
        let places: Vec<[f64; D]> = (0..nodes).map(place).collect();
        Some(Self {
            origin,
            spacing,
            counts,
            offsets: offsets(&places),
        })
    }

    /// a(X) and ∇a(X); `None` outside the table.
    pub fn at(&self, reference: &[f64; D]) -> Option<([f64; D], Matrix<D>)> {
        let (mut first, mut weights) = (0, [([0.0; STENCIL], [0.0; STENCIL]); D]);
        for a in 0..D {
            let place = (reference[a] - self.origin[a]) / self.spacing;
            let cell = place.floor();
            if !(cell >= 1.0 && cell + 2.0 < self.counts[a] as f64) {
                return None;
            }
            first = first * self.counts[a] + cell as usize - 1;
            weights[a] = convolution(place - cell, 1.0 / self.spacing);
        }
        let mut stride = [1; D];
        for a in (1..D).rev() {
            stride[a - 1] = stride[a] * self.counts[a];
        }
        let (mut value, mut gradient) = ([0.0; D], Matrix::ZERO);
        let (across, last) = (D - 1, &weights[D - 1]);
        // Lines of nodes along the last axis, which lie side by side.
        for line in 0..STENCIL.pow(across as u32) {
            let (mut node, mut weight, mut slopes) = (first, 1.0, [1.0; D]);
            for a in 0..across {
                let k = line / STENCIL.pow(a as u32) % STENCIL;
                node += k * stride[a];
                weight *= weights[a].0[k];
                for (b, slope) in slopes.iter_mut().enumerate() {
                    *slope *= if a == b { weights[a].1[k] } else { weights[a].0[k] };
                }
            }
            let (mut there, mut along) = ([0.0; D], [0.0; D]);
            for (k, offset) in self.offsets[node..node + STENCIL].iter().enumerate() {
                vector::accumulate(&mut there, last.0[k], offset);
                vector::accumulate(&mut along, last.1[k], offset);
            }
            vector::accumulate(&mut value, weight, &there);
            for c in 0..D {
                for b in 0..across {
                    gradient.0[c][b] += slopes[b] * there[c];
                }
                gradient.0[c][across] += weight * along[c];
            }
        }
        Some((value, gradient))
    }
}

/// Keys' weights of the nodes −1, 0, 1, 2 at s ∈ [0, 1), and their derivatives times `factor`.
fn convolution(s: f64, factor: f64) -> ([f64; STENCIL], [f64; STENCIL]) {
    let weights = [
        s * (-0.5 + s * (1.0 - 0.5 * s)),
        1.0 + s * s * (-2.5 + 1.5 * s),
        s * (0.5 + s * (2.0 - 1.5 * s)),
        s * s * (-0.5 + 0.5 * s),
    ];
    let slopes = [
        -0.5 + s * (2.0 - 1.5 * s),
        s * (-5.0 + 4.5 * s),
        0.5 + s * (4.0 - 4.5 * s),
        s * (-1.0 + 1.5 * s),
    ];
    (weights, slopes.map(|slope| factor * slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// a and ∇a of a smooth field.
    fn field(x: &[f64; 3]) -> ([f64; 3], Matrix<3>) {
        let [p, q, r] = *x;
        let value = [(p + 2.0 * q).sin(), (q * r).cos(), (p - r).exp()];
        let gradient = [
            [(p + 2.0 * q).cos(), 2.0 * (p + 2.0 * q).cos(), 0.0],
            [0.0, -r * (q * r).sin(), -q * (q * r).sin()],
            [(p - r).exp(), 0.0, -(p - r).exp()],
        ];
        (value, Matrix(gradient))
    }

    fn errors(spacing: f64) -> (f64, f64) {
        let corners = [[-1.0, -1.0, -1.0], [1.0, 1.0, 1.0]];
        let table = AtRestTable::around(&corners, 0.0, spacing, |nodes| {
            nodes.iter().map(|x| field(x).0).collect()
        });
        let table = table.expect("small");
        let (mut value, mut gradient) = (0.0_f64, 0.0_f64);
        for n in 0..4000 {
            let x = [7.1, 11.3, 13.7].map(|c| (c * f64::from(n)).sin());
            let (found, along) = table.at(&x).expect("inside");
            let (expected, slope) = field(&x);
            value = value.max(vector::distance(&found, &expected));
            gradient = gradient.max((along - slope).frobenius_norm());
        }
        (value, gradient)
    }

    #[test]
    fn values_have_third_and_gradients_second_order() {
        let ((coarse, coarse_slope), (fine, fine_slope)) = (errors(0.1), errors(0.05));
        assert!(
            coarse / fine > 7.0 && coarse_slope / fine_slope > 3.5,
            "{coarse} {fine} {coarse_slope} {fine_slope}"
        );
        assert!(fine < 1e-4 && fine_slope < 1e-2, "{fine} {fine_slope}");
    }

    #[test]
    fn nodes_are_met_and_points_outside_are_none() {
        let table = AtRestTable::around(&[[0.0, 0.0], [1.0, 0.5]], 0.1, 0.1, |nodes| nodes.to_vec()).expect("small");
        let (found, along) = table.at(&[0.37, 0.21]).expect("inside");
        assert!(vector::distance(&found, &[0.37, 0.21]) < 1e-15 && (along - Matrix::IDENTITY).frobenius_norm() < 1e-13);
        assert!(table.at(&[-0.1, 0.6]).is_some() && table.at(&[1.1, -0.1]).is_some());
        for outside in [[-0.31, 0.0], [0.0, 0.81], [f64::NAN, 0.0]] {
            assert!(table.at(&outside).is_none(), "{outside:?}");
        }
        assert!(AtRestTable::<2>::around(&[], 0.1, 0.1, |nodes| nodes.to_vec()).is_none());
        assert!(AtRestTable::around(&[[0.0; 3], [1.0; 3]], 0.1, 1e-3, |nodes| nodes.to_vec()).is_none());
    }
}
