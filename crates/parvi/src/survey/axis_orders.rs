//! In which orders the coordinates of a triangular map may follow each other.

use mpm_tensor::vector;

use super::density::Density;
use super::gaussian_fit::GaussianFit;

/// Orders to be tried, without repetition: drivers first as far as scores tell, as given, and reversed.
///
/// Given the others a coordinate that drives none of them is Gaussian: its score is linear in it. So coordinates are sorted by the share
/// of |s_i(x + σ_i e_i) + s_i(x − σ_i e_i) − 2 s_i(x)| in |s_i(x + σ_i e_i) − s_i(x − σ_i e_i)| over points x of the fit, largest first.
/// `fit` and `nodes` as for the density's coordinates.
pub(super) fn axis_orders<const D: usize>(
    density: &mut Density<'_, D>,
    fit: &GaussianFit<D>,
    nodes: &[[f64; D]],
) -> Vec<[usize; D]> {
    let given: [usize; D] = std::array::from_fn(|i| i);
    let reversed: [usize; D] = std::array::from_fn(|i| D - 1 - i);
    let mut orders = Vec::with_capacity(3);
    if let Some(bends) = bends(density, fit, nodes) {
        let mut sorted = given;
        sorted.sort_by(|&a, &b| bends[b].total_cmp(&bends[a]));
        orders.push(sorted);
    }
    for order in [given, reversed] {
        if !orders.contains(&order) {
            orders.push(order);
        }
    }
    orders
}

/// How far each coordinate's score is from linear in it; `None` where the target is not finite.
fn bends<const D: usize>(density: &mut Density<'_, D>, fit: &GaussianFit<D>, nodes: &[[f64; D]]) -> Option<[f64; D]> {
    // The spread of a coordinate given the others: 1 over the root of the precision.
    let precision = (fit.root * fit.root.transpose()).inverse()?;
    let centres: Vec<[f64; D]> = nodes
        .iter()
        .map(|u| vector::add(&fit.mean, &fit.root.apply(u)))
        .collect();
    let here = density.values(&centres)?;
    let mut bends = [0.0; D];
    for axis in 0..D {
        let mut step = [0.0; D];
        step[axis] = precision.0[axis][axis].sqrt().recip();
        let mut moved = |sign: f64| {
            let points: Vec<[f64; D]> = centres.iter().map(|x| vector::add_scaled(x, sign, &step)).collect();
            density.values(&points)
        };
        let (ahead, behind) = (moved(1.0)?, moved(-1.0)?);
        let (mut curved, mut straight) = (0.0, 0.0);
        for ((there, back), centre) in ahead.iter().zip(&behind).zip(&here) {
            let (a, b) = (there.score[axis], back.score[axis]);
            curved += (a + b - 2.0 * centre.score[axis]).abs();
            straight += (a - b).abs();
        }
        bends[axis] = curved / straight.max(f64::MIN_POSITIVE);
    }
    Some(bends)
}
