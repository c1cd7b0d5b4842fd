//! The displacement of a run between its particles.

use std::collections::HashMap;

use mpm_tensor::{Cholesky, Matrix, vector};

/// Functions of a quadratic polynomial in three dimensions.
const COUNT: usize = 10;

/// Particles around a place, with weights: a field there is Σ w_q u_q.
pub type Stencil = Vec<(usize, f64)>;

/// Weights of the weighted least squares fit of a quadratic polynomial around each of `places`, at the place itself, over the particles at `points` within `reach`: they
/// give quadratic fields exactly. Weights of the fit are (1 − r² / reach²)²; coordinates beyond `dimension` are zeros. An error is a place without enough particles.
pub fn stencils(
    points: &[[f64; 3]],
    places: &[[f64; 3]],
    reach: f64,
    dimension: usize,
) -> Result<Vec<Stencil>, [f64; 3]> {
    let bin = |x: &[f64; 3]| x.map(|c| (c / reach).floor() as i64);
    let mut bins: HashMap<[i64; 3], Vec<usize>> = HashMap::new();
    for (q, x) in points.iter().enumerate() {
        bins.entry(bin(x)).or_default().push(q);
    }
    let around = (0..27).map(|k| [k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1]);
    let around: Vec<[i64; 3]> = around.collect();
    let stencil = |place: &[f64; 3]| {
        let home = bin(place);
        let near = around
            .iter()
            .filter_map(|shift| bins.get(&[0, 1, 2].map(|a| home[a] + shift[a])))
            .flatten();
        let near: Vec<(usize, f64, [f64; COUNT])> = near
            .filter_map(|&q| {
                let offset = vector::scale(&vector::subtract(&points[q], place), 1.0 / reach);
                let weight = 1.0 - vector::norm_squared(&offset);
                (weight > 0.0).then(|| (q, weight * weight, basis(&offset)))
            })
            .collect();
        // Functions of coordinates that do not exist are 0 everywhere; their coefficients are fixed.
        let mut normal = Matrix::<COUNT>::diagonal(&absent(dimension));
        for (_, weight, basis) in &near {
            normal += Matrix::outer(basis, basis) * *weight;
        }
        let mut first = [0.0; COUNT];
        first[0] = 1.0;
        let row = Cholesky::new(&normal).ok()?.solve(&first);
        let weights = near
            .iter()
            .map(|(q, weight, basis)| (*q, weight * vector::dot(&row, basis)));
        let weights: Stencil = weights.collect();
        let sum: f64 = weights.iter().map(|(_, weight)| weight).sum();
        ((sum - 1.0).abs() < 1e-6).then_some(weights)
    };
    places.iter().map(|place| stencil(place).ok_or(*place)).collect()
}

/// 1, x, y, z, x², y², z², xy, xz, yz.
fn basis([x, y, z]: &[f64; 3]) -> [f64; COUNT] {
    [1.0, *x, *y, *z, x * x, y * y, z * z, x * y, x * z, y * z]
}

/// 1 for each function of coordinates beyond the dimension, else 0.
fn absent(dimension: usize) -> [f64; COUNT] {
    let last = [0, 1, 2, 3, 1, 2, 3, 2, 3, 3];
    last.map(|axis| f64::from(u8::from(axis > dimension)))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An irregular lattice.
    fn points(dimension: usize) -> Vec<[f64; 3]> {
        let place = |k: usize| [k % 7, k / 7 % 7, k / 49].map(|c| c as f64 + 0.2 * ((3 * k + c) as f64).sin());
        let all = (0..7usize.pow(dimension as u32)).map(place);
        all.map(|x| [0, 1, 2].map(|a| if a < dimension { x[a] } else { 0.0 }))
            .collect()
    }

    #[test]
    fn quadratic_fields_are_met_exactly() {
        let field = |x: &[f64; 3]| 2.0 - x[0] + 0.5 * x[1] * x[0] - x[1] * x[1] + 3.0 * x[2] * x[0] + x[2] * x[2];
        for dimension in [1, 2, 3] {
            let points = points(dimension);
            let places = [[0.1, 0.3, 0.2], [2.5, 3.1, 4.4], [5.9, 5.9, 5.7]];
            let places = places.map(|x| [0, 1, 2].map(|a| if a < dimension { x[a] } else { 0.0 }));
            for (place, stencil) in places.iter().zip(stencils(&points, &places, 2.5, dimension).unwrap()) {
                let value: f64 = stencil.iter().map(|&(q, weight)| weight * field(&points[q])).sum();
                assert!((value - field(place)).abs() < 1e-9, "{dimension}: {value}");
            }
        }
    }

    #[test]
    fn a_place_apart_is_named() {
        assert_eq!(stencils(&points(2), &[[40.0, 0.0, 0.0]], 2.5, 2), Err([40.0, 0.0, 0.0]));
    }
}
