//! Smooth fields from scattered values at points.

use mpm_tensor::vector::{accumulate, dot, scale, subtract};
use mpm_tensor::{Matrix, SymmetricEigen};

use crate::{CellSearch, Located};

/// A patch is as good as flat where its points spread along one direction less than this share of what they do along another, in squares: the mean is taken.
const FLAT: f64 = 1e-3;

/// Patch recovery (Zienkiewicz & Zhu 1992, doi 10.1002/nme.1620330702): at each vertex the value there of the polynomial of degree one that fits
/// the `values` at all points in the cells around it best in the sense of Σ_p `weights`_p |·|², and Σ_n b_n of these at every point.
///
/// A linear field comes back as it was, in cells whose vertices have D + 1 points around them that spread in all directions, along none less than a thirtieth of what they do along another; other
/// vertices have the mean. Values at points
/// outside of the mesh stay and count nowhere. Weights are positive, as volumes are. Of the three lists the shortest counts.
pub fn recovered<const D: usize>(
    search: &CellSearch<D>,
    points: &[[f64; D]],
    weights: &[f64],
    values: &[Matrix<D>],
) -> Vec<Matrix<D>> {
    let mesh = search.mesh();
    let mut patches = vec![Patch::EMPTY; mesh.vertices().len()];
    let located: Vec<Option<Located<D>>> = points.iter().map(|x| search.locate(x, None)).collect();
    for (((x, &weight), value), place) in points.iter().zip(weights).zip(values).zip(&located) {
        for &vertex in place.iter().flat_map(|place| mesh.cell(place.cell as usize)) {
            let offset = subtract(x, &mesh.vertices()[vertex as usize]);
            patches[vertex as usize].add(&offset, weight, value);
        }
    }
    let at_vertices: Vec<Matrix<D>> = patches.iter().map(Patch::at_vertex).collect();
    let at_points = values.iter().zip(&located).map(|(value, place)| {
        let Some(place) = place else { return *value };
        let first = 1.0 - place.barycentric.iter().sum::<f64>();
        let shares = std::iter::once(&first).chain(&place.barycentric);
        let mut sum = Matrix::ZERO;
        for (&share, &vertex) in shares.zip(mesh.cell(place.cell as usize)) {
            sum += at_vertices[vertex as usize] * share;
        }
        sum
    });
    at_points.collect()
}

/// Sums over the points around a vertex, with offsets r from it.
#[derive(Clone, Copy)]
struct Patch<const D: usize> {
    /// Σ w.
    weight: f64,
    /// Σ w r.
    first: [f64; D],
    /// Σ w r rᵀ.
    second: Matrix<D>,
    /// Σ w v.
    value: Matrix<D>,
    /// Σ w v r_a.
    moments: [Matrix<D>; D],
}

impl<const D: usize> Patch<D> {
    const EMPTY: Self = Self {
        weight: 0.0,
        first: [0.0; D],
        second: Matrix::ZERO,
        value: Matrix::ZERO,
        moments: [Matrix::ZERO; D],
    };

    fn add(&mut self, offset: &[f64; D], weight: f64, value: &Matrix<D>) {
        self.weight += weight;
        accumulate(&mut self.first, weight, offset);
        self.second += Matrix::outer(offset, offset) * weight;
        self.value += *value * weight;
        for a in 0..D {
            self.moments[a] += *value * (weight * offset[a]);
        }
    }

    /// v̄ − Σ_a g_a Σ w v (r − c)_a at r = 0, with c = Σ w r / Σ w and g = (Σ w (r − c)(r − c)ᵀ)⁻¹ c; v̄ where the points are as good as in a plane.
    fn at_vertex(&self) -> Matrix<D> {
        let mean = self.value * (1.0 / self.weight);
        let centre = scale(&self.first, 1.0 / self.weight);
        let spread = self.second - Matrix::outer(&self.first, &centre);
        let Some(eigen) = SymmetricEigen::new(&spread) else {
            return mean;
        };
        let largest = eigen.values.iter().fold(0.0, |most: f64, &value| most.max(value));
        if !eigen.values.iter().all(|&value| value > FLAT * largest) {
            return mean;
        }
        let inverse = eigen.map(|value| 1.0 / value);
        let slope = inverse.apply(&centre);
        let mut value = mean + self.value * dot(&slope, &centre);
        for a in 0..D {
            value -= self.moments[a] * slope[a];
        }
        value
    }
}
