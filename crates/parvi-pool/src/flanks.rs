//! Places at which the score points to nothing that is known.

use mpm_tensor::{Matrix, vector};

use crate::mixture::Mixture;
use crate::student::Kernel;

/// How far from the centre of a kernel the line along a score may pass: in its standard deviations, and over the distance from the centre in these, since neither are kernels
/// exactly as wide as what they stand for nor is that a normal law.
const PAST: f64 = 4.0;
const ASKEW: f64 = 0.2;

/// Radii of the rings, in standard deviations of a kernel.
const RADII: [f64; 2] = [4.0, 40.0];

/// The places at which the score points to none of the kernels, those where it is farthest from that first.
///
/// Where log p falls along the ellipses of a kernel with the root L, Lᵀ ∇log p is parallel to L⁻¹ (c − x), whatever its tails are.
pub(super) fn flanks<const D: usize>(kernels: &[Kernel<D>], places: &[[f64; D]], scores: &[[f64; D]]) -> Vec<usize> {
    let whiteners: Vec<Option<Matrix<D>>> = kernels
        .iter()
        .map(|kernel| kernel.factor.lower_triangular_inverse())
        .collect();
    let aside = |(x, score): (&[f64; D], &[f64; D])| {
        let of = |(kernel, whitener): (&Kernel<D>, &Option<Matrix<D>>)| {
            let towards = whitener.as_ref()?.apply(&vector::subtract(&kernel.centre, x));
            let pull = kernel.factor.transpose().apply(score);
            let (square, along) = (vector::norm_squared(&towards), vector::dot(&towards, &pull));
            let along = along.max(0.0) / vector::norm(&pull);
            Some((square - along * along).max(0.0).sqrt() / (PAST + ASKEW * square.sqrt()))
        };
        kernels
            .iter()
            .zip(&whiteners)
            .filter_map(of)
            .fold(f64::INFINITY, f64::min)
    };
    let aside = mpm_parallel::map(places.iter().zip(scores), &aside);
    // A score that is none, or zero, leads nowhere.
    let leads = |&index: &usize| aside[index] > 1.0 && vector::norm_squared(&scores[index]) > 0.0;
    let mut flanks: Vec<usize> = (0..places.len()).filter(leads).collect();
    flanks.sort_by(|&a, &b| aside[b].total_cmp(&aside[a]).then(a.cmp(&b)));
    flanks
}

/// Places about the kernels, as many about each as it has a share, evenly by the logarithm of the distance.
pub(super) fn rings<const D: usize>(mixture: &Mixture<D>, count: usize, seed: u64) -> Vec<[f64; D]> {
    let [least, most] = RADII;
    mixture.about(count, seed, |u| least * (most / least).powf(u))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kernel(centre: [f64; 3], width: f64) -> Kernel<3> {
        Kernel {
            centre,
            factor: Matrix([[width, 0.0, 0.0], [0.5 * width, width, 0.0], [0.0, 0.0, 3.0 * width]]),
            share: 0.5,
        }
    }

    #[test]
    fn scores_of_what_is_known_point_there_and_others_do_not() {
        let known = [kernel([0.0; 3], 1.0), kernel([9.0, 0.0, 0.0], 0.5)];
        let other = kernel([0.0, -20.0, 4.0], 0.7);
        let mixture = Mixture::new(known.to_vec()).unwrap();
        let score = |kernel: &Kernel<3>, x: &[f64; 3]| {
            let whitener = kernel.factor.lower_triangular_inverse().unwrap();
            let z = whitener.apply(&vector::subtract(&kernel.centre, x));
            whitener.transpose().apply(&z)
        };
        let places = rings(&mixture, 200, 3);
        for kernel in &known {
            let scores: Vec<_> = places.iter().map(|x| score(kernel, x)).collect();
            assert_eq!(flanks(&known, &places, &scores), []);
        }
        let scores: Vec<_> = places.iter().map(|x| score(&other, x)).collect();
        let found = flanks(&known, &places, &scores);
        assert!(found.len() > places.len() / 2, "{}", found.len());
        assert_eq!(flanks(&known, &places[..2], &[[0.0; 3], [f64::NAN; 3]]), []);
    }
}
