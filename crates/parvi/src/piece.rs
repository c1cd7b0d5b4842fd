//! One of several pieces of a target, seen as a target of its own.

use mpm_tensor::vector;
use parvi_targets::Target;

use crate::survey::Site;

/// The piece p_k = p r_k of a target p, where r_k = mass_k N_k / Σ_j mass_j N_j is the share of site k in the mixture of all sites' Gaussians. The pieces
/// add up to p exactly, whatever the Gaussians are; where p is a mixture of these, its pieces are the Gaussians.
///
/// log p_k = log p + log r_k, score_k = s + g_k − Σ_j r_j g_j with g_j = ∇ log N_j.
pub(crate) struct Piece<'a, const D: usize> {
    pub target: &'a dyn Target<D>,
    pub sites: &'a [Site<D>],
    /// k.
    pub own: usize,
}

impl<const D: usize> Piece<'_, D> {
    /// log r_k and its gradient. Sum and mean gradient of the mixture are kept relative to the largest member so far.
    fn share(&self, x: &[f64; D]) -> (f64, [f64; D]) {
        let (mut largest, mut sum, mut slope) = (f64::NEG_INFINITY, 0.0, [0.0; D]);
        let mut own = (f64::NEG_INFINITY, [0.0; D]);
        for (k, site) in self.sites.iter().enumerate() {
            let z = site.frame.to_reference(x);
            let log = site.mass.ln() - 0.5 * vector::norm_squared(&z) - site.frame.log_determinant();
            let gradient = site.frame.push_forward_score(&z.map(|c| -c));
            if k == self.own {
                own = (log, gradient);
            }
            if log > largest {
                let scale = (largest - log).exp();
                sum *= scale;
                slope = vector::scale(&slope, scale);
                largest = log;
            }
            let weight = (log - largest).exp();
            sum += weight;
            vector::accumulate(&mut slope, weight, &gradient);
        }
        let (log, gradient) = own;
        (
            log - largest - sum.ln(),
            vector::add_scaled(&gradient, -1.0 / sum, &slope),
        )
    }
}

impl<const D: usize> Target<D> for Piece<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.log_density(x) + self.share(x).0
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        vector::add(&self.target.score(x), &self.share(x).1)
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        self.target.scores(xs, out);
        for (x, score) in xs.iter().zip(out) {
            *score = vector::add(score, &self.share(x).1);
        }
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        self.target.log_densities(xs, out);
        for (x, log_density) in xs.iter().zip(out) {
            *log_density += self.share(x).0;
        }
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;
    use parvi_targets::{CatalogueTarget, Frame, GaussianMixture, StudentT};

    use super::*;
    use crate::start::quasi_random_normal;

    fn sites(target: &GaussianMixture<2>) -> Vec<Site<2>> {
        let site = |mode: &parvi_targets::Mode<2>| {
            let covariance = Matrix::IDENTITY * (mode.width * mode.width);
            Site::new(Frame::new(mode.centre, covariance).unwrap(), mode.mass)
        };
        target.modes().iter().map(site).collect()
    }

    #[test]
    fn pieces_of_a_mixture_are_its_members() {
        let target = GaussianMixture::<2>::two_unequal(0.5).unwrap();
        let sites = sites(&target);
        for own in 0..2 {
            let piece = Piece {
                target: &target,
                sites: &sites,
                own,
            };
            for z in quasi_random_normal::<2>(50, 3).unwrap() {
                let x = sites[own].frame.to_target(&z.map(|c| 2.0 * c));
                let wanted = sites[own].frame.push_forward_score(&z.map(|c| -2.0 * c));
                assert!(vector::distance(&piece.score(&x), &wanted) < 1e-9);
            }
        }
    }

    #[test]
    fn pieces_add_up_and_their_scores_are_gradients() {
        let target = StudentT::<2>::new(5.0).unwrap();
        let mixture = GaussianMixture::<2>::three_far().unwrap();
        let sites = sites(&mixture);
        for x in quasi_random_normal::<2>(20, 5).unwrap() {
            let piece = |own| Piece {
                target: &target,
                sites: &sites,
                own,
            };
            let sum: f64 = (0..3).map(|own| piece(own).log_density(&x).exp()).sum();
            assert!((sum / target.log_density(&x).exp() - 1.0).abs() < 1e-12);
            for own in 0..3 {
                let (piece, score) = (piece(own), piece(own).score(&x));
                let (mut batch, mut logs) = ([[0.0; 2]], [0.0]);
                piece.scores(&[x], &mut batch);
                piece.log_densities(&[x], &mut logs);
                assert_eq!((batch[0], logs[0]), (score, piece.log_density(&x)));
                for axis in 0..2 {
                    let at = |step: f64| {
                        let mut x = x;
                        x[axis] += step;
                        piece.log_density(&x)
                    };
                    let difference = (at(1e-5) - at(-1e-5)) / 2e-5;
                    assert!((score[axis] - difference).abs() < 1e-5 * (1.0 + difference.abs()));
                }
            }
        }
    }
}
