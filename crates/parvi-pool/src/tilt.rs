//! What proposals are fitted to: the target, with more of it far out.

use mpm_tensor::{Matrix, vector};

use crate::sample::{moments, root};

/// Exponent where second moments hang on few points.
const HANGING: f64 = 1.0;

/// Others in the order in which they are tried.
const EXPONENTS: [f64; 4] = [0.5, 0.375, 0.25, 0.125];

/// Mean r under the tilted law at most.
const WIDEST: f64 = 1.5;

/// The factor r^e, r = (1 + |z|²/D)/2 at z in the coordinates in which a sample has mean zero and covariance I.
///
/// Of a proposal q the variance of what is weighed by p/q is that of [`Measure::variance`](crate::Measure::variance), E_q[(p/q)² r] ≥ (E_p √r)², and equal to it for q ∝ p √r (Cauchy and Schwarz): hence e = ½.
/// A fit to p alone has too few points where a bent ridge ends, and second moments are low by what lies there. Where tails are so heavy that the tilted law's mean r, E[r^{1+e}] / E[r^e], is above 1.5,
/// e is less: kernels cannot follow them (and [`reach`](crate::reach) does). On a line e = 0: control variates take away nearly all variance there, the more the nearer q is to p.
/// Where a pool was met whose second moments [hang on few points](crate::Objection::Hanging), e = 1: of f ≥ 0 the error is least for q ∝ p f.
pub(super) struct Tilt<const D: usize> {
    mean: [f64; D],
    whitener: Matrix<D>,
    exponent: f64,
}

impl<const D: usize> Tilt<D> {
    /// For a target that these weighted points stand for, whose second moments may be known to hang on few.
    pub fn of(points: &[[f64; D]], weights: &[f64], hanging: bool) -> Self {
        let (mean, covariance) = moments(points, weights);
        let whitener = root(&covariance).lower_triangular_inverse();
        let mut tilt = Self {
            mean,
            whitener: whitener.unwrap_or(Matrix::ZERO),
            exponent: if hanging { HANGING } else { 0.0 },
        };
        if D > 1 && !hanging {
            let reaches: Vec<f64> = points.iter().map(|x| tilt.reach(x)).collect();
            let sum = |power: f64| -> f64 {
                let pairs = reaches.iter().zip(weights).filter(|(_, w)| **w > 0.0);
                pairs.map(|(r, w)| w * r.powf(power)).sum()
            };
            let bounded = EXPONENTS.into_iter().find(|e| sum(1.0 + e) <= WIDEST * sum(*e));
            tilt.exponent = bounded.unwrap_or(0.0);
        }
        tilt
    }

    /// r.
    fn reach(&self, x: &[f64; D]) -> f64 {
        let z = self.whitener.apply(&vector::subtract(x, &self.mean));
        0.5 + 0.5 * vector::norm_squared(&z) / D as f64
    }

    /// e log r.
    pub fn log(&self, x: &[f64; D]) -> f64 {
        self.exponent * self.reach(x).ln()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parvi_targets::{ExactDraws, Gaussian, StudentT};
    use rand::SeedableRng;
    use rand::rngs::ChaCha8Rng;

    fn exponent<const D: usize>(law: &dyn ExactDraws<D>) -> f64 {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        let points: Vec<[f64; D]> = (0..5000).map(|_| law.draw(&mut rng)).collect();
        let of = |hanging| Tilt::of(&points, &vec![1.0; points.len()], hanging).exponent;
        assert_eq!(of(true), 1.0);
        of(false)
    }

    #[test]
    fn light_tails_are_tilted_by_the_root_and_heavy_ones_less() {
        assert_eq!(exponent(&Gaussian::<2>::standard()), 0.5);
        assert_eq!(exponent(&Gaussian::<6>::standard()), 0.5);
        assert_eq!(exponent(&Gaussian::<1>::standard()), 0.0);
        let heavy = [3.0, 2.0].map(|freedom| exponent(&StudentT::<2>::new(freedom).unwrap()));
        assert!(heavy[1] < heavy[0] && heavy[0] < 0.5, "{heavy:?}");
    }

    #[test]
    fn points_that_coincide_are_not_tilted() {
        let tilt = Tilt::of(&[[1.0, 2.0]; 3], &[1.0; 3], false);
        assert!(tilt.log(&[1.0, 2.0]).is_finite());
        let tilt = Tilt::<2>::of(&[], &[], true);
        assert!(tilt.log(&[0.0; 2]).is_finite());
    }
}
