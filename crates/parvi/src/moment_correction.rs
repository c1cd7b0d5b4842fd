//! The affine Stein correction: the last, global move that makes the first Stein moments exact.

use mpm_core::MpmError;
use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::MomentCorrection;
use parvi_body::FramedScore;

/// Moves beyond this size (in frame units, or relative) are not a correction any more and are left undone.
const LIMIT: f64 = 0.25;

/// A full step that leaves more than this share of the defect was no Newton step: the target is far from Gaussian.
const CONTRACTION: f64 = 0.5;

/// Evaluate the scores and move the particles by affine maps until E\[s\] = 0 and E\[s (x − x̄)ᵀ\] = −I hold for them, as far as that goes.
///
/// Stein's identity with the test functions 1 and x, which no grid of finite extent contains (docs/theory.md, Eq. 12). One
/// Newton step x ← x̄ + b + A (x − x̄): with the covariance C of the particles and the mean curvature
/// Q = −sym(E\[s (x − x̄)ᵀ\] C⁻¹), b = Q⁻¹ E\[s\], and A is the symmetric map that takes C to Q⁻¹. For a Gaussian target one step
/// gives mean and covariance exactly. [`MomentCorrection::Mean`] moves by b alone, and once; else up to two steps are taken. Where a full step does not at least halve the defect, a
/// secant step along the same direction is tried instead; no step is kept that enlarges the defect.
///
/// `scores` are overwritten with those at the final positions; at most three evaluations per particle for the mean, five for
/// both. A move to where a score is not finite is not made, nor one by the mean alone that scores do not know better than to `known`, a squared error.
pub(crate) fn correct_moments<const D: usize>(
    correction: MomentCorrection,
    known: f64,
    positions: &mut [[f64; D]],
    score: &mut FramedScore<'_, D>,
    scores: &mut Vec<[f64; D]>,
) -> Result<(), MpmError> {
    score.evaluate(positions, scores)?;
    let steps = match correction {
        MomentCorrection::Off => return Ok(()),
        MomentCorrection::Mean => 1,
        MomentCorrection::Affine => 2,
    };
    let moments_of = |positions: &[_], scores: &[_]| SteinMoments::of(correction, positions, scores);
    let mut trial = positions.to_vec();
    let mut trial_scores = scores.clone();
    for _ in 0..steps {
        let before = moments_of(positions, scores);
        let Some(full) = before.newton_step().filter(|step| step.size() <= LIMIT) else {
            return Ok(());
        };
        if correction == MomentCorrection::Mean && before.squared_error_of_mean(positions, scores) >= known {
            return Ok(());
        }
        full.apply(positions, &mut trial);
        if score.evaluate(&trial, &mut trial_scores).is_err() {
            return Ok(());
        }
        let after = moments_of(&trial, &trial_scores);
        let contracts = after.defect() <= CONTRACTION * before.defect();
        if !contracts {
            full.shortened(before.secant(&after)).apply(positions, &mut trial);
            if score.evaluate(&trial, &mut trial_scores).is_err()
                || moments_of(&trial, &trial_scores).defect() >= before.defect()
            {
                return Ok(());
            }
        }
        positions.copy_from_slice(&trial);
        std::mem::swap(scores, &mut trial_scores);
        if !contracts {
            return Ok(());
        }
    }
    Ok(())
}

/// Moves particles by the symmetric affine map about their mean that makes their covariance I, as far as that is known, unless it is singular or the move too large.
///
/// In the coordinates of a pool I is the covariance of the target, of which weights know the variance along a unit vector up to an error; points of least energy distance
/// are narrower. Along each principal axis the excess e of their variance is taken away by the share e²/(e² + its squared error).
pub(crate) fn standardise<const D: usize>(positions: &mut [[f64; D]], squared_error: impl Fn(&[f64; D]) -> f64) {
    let (mean, covariance) = mean_and_covariance(positions);
    let Some(SymmetricEigen { values, vectors }) = SymmetricEigen::new(&covariance) else {
        return;
    };
    let stretch_along = |k: usize| {
        let excess = values[k] - 1.0;
        let error = squared_error(&std::array::from_fn(|axis| vectors.0[axis][k]));
        let share = excess * excess / (excess * excess + error).max(f64::MIN_POSITIVE);
        (1.0 - share * excess / values[k]).sqrt()
    };
    let stretches = SymmetricEigen {
        values: std::array::from_fn(stretch_along),
        vectors,
    };
    let step = AffineStep {
        mean,
        shift: [0.0; D],
        stretch: stretches.map(|stretch| stretch),
    };
    if step.size() <= LIMIT {
        let before = positions.to_vec();
        step.apply(&before, positions);
    }
}

/// x ← x̄ + b + A (x − x̄).
struct AffineStep<const D: usize> {
    mean: [f64; D],
    shift: [f64; D],
    stretch: Matrix<D>,
}

impl<const D: usize> AffineStep<D> {
    /// max(|b|, ‖A − I‖); NaN counts as infinite.
    fn size(&self) -> f64 {
        let stretch = (self.stretch - Matrix::IDENTITY).frobenius_norm();
        let shift = vector::norm(&self.shift);
        if shift.is_nan() || stretch.is_nan() {
            f64::INFINITY
        } else {
            shift.max(stretch)
        }
    }

    /// The same move, `share` of the way.
    fn shortened(&self, share: f64) -> Self {
        Self {
            mean: self.mean,
            shift: vector::scale(&self.shift, share),
            stretch: Matrix::IDENTITY + (self.stretch - Matrix::IDENTITY) * share,
        }
    }

    fn apply(&self, from: &[[f64; D]], to: &mut [[f64; D]]) {
        for (x, moved) in from.iter().zip(to) {
            let stretched = self.stretch.apply(&vector::subtract(x, &self.mean));
            *moved = std::array::from_fn(|a| self.mean[a] + self.shift[a] + stretched[a]);
        }
    }
}

fn mean_and_covariance<const D: usize>(positions: &[[f64; D]]) -> ([f64; D], Matrix<D>) {
    let share = 1.0 / positions.len() as f64;
    let mut mean = [0.0; D];
    for x in positions {
        vector::accumulate(&mut mean, share, x);
    }
    let mut covariance = Matrix::ZERO;
    for x in positions {
        let x = vector::subtract(x, &mean);
        covariance += Matrix::outer(&vector::scale(&x, share), &x);
    }
    (mean, covariance)
}

/// Sample moments of positions and scores.
struct SteinMoments<const D: usize> {
    correction: MomentCorrection,
    mean: [f64; D],
    covariance: Matrix<D>,
    mean_score: [f64; D],
    /// −E\[s (x − x̄)ᵀ\].
    stein: Matrix<D>,
}

impl<const D: usize> SteinMoments<D> {
    fn of(correction: MomentCorrection, positions: &[[f64; D]], scores: &[[f64; D]]) -> Self {
        let share = 1.0 / positions.len() as f64;
        let (mean, covariance) = mean_and_covariance(positions);
        let (mut mean_score, mut stein) = ([0.0; D], Matrix::<D>::ZERO);
        for (x, s) in positions.iter().zip(scores) {
            vector::accumulate(&mut mean_score, share, s);
            stein -= Matrix::outer(&vector::scale(s, share), &vector::subtract(x, &mean));
        }
        Self {
            correction,
            mean,
            covariance,
            mean_score,
            stein,
        }
    }

    /// |E\[s\]|² + ‖I + E\[s (x − x̄)ᵀ\]‖², the second term only where the covariance is corrected.
    fn defect(&self) -> f64 {
        self.defect_product(self)
    }

    /// The scalar product whose square is the defect.
    fn defect_product(&self, other: &Self) -> f64 {
        let of_means = vector::dot(&self.mean_score, &other.mean_score);
        if self.correction == MomentCorrection::Mean {
            return of_means;
        }
        let (ours, theirs) = (Matrix::IDENTITY - self.stein, Matrix::IDENTITY - other.stein);
        of_means + ours.contract(&theirs)
    }

    /// Share of a step from here to `after` at which the defect, taken as linear along it, is least; in [0, 1].
    fn secant(&self, after: &Self) -> f64 {
        let product = self.defect_product(after);
        let change = self.defect() - 2.0 * product + after.defect();
        let share = (self.defect() - product) / change;
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }

    /// Q⁻¹; NaN where a mean curvature is not positive.
    fn inverse_curvature(&self) -> Option<Matrix<D>> {
        let inverse_covariance = SymmetricEigen::new(&self.covariance)?.map(f64::recip);
        let curvature = (self.stein * inverse_covariance).symmetric_part();
        let inverse = |value: f64| if value > 0.0 { value.recip() } else { f64::NAN };
        Some(SymmetricEigen::new(&curvature)?.map(inverse))
    }

    /// E|Q⁻¹ (s − E\[s\]) + x − x̄|²/M: the squared error of b for as many independent draws. It is zero for a normal law, whose scores are linear.
    fn squared_error_of_mean(&self, positions: &[[f64; D]], scores: &[[f64; D]]) -> f64 {
        let Some(inverse_curvature) = self.inverse_curvature() else {
            return f64::INFINITY;
        };
        let square = |(x, s): (&[f64; D], &[f64; D])| {
            let step = inverse_curvature.apply(&vector::subtract(s, &self.mean_score));
            vector::norm_squared(&vector::add(&step, &vector::subtract(x, &self.mean)))
        };
        positions.iter().zip(scores).map(square).sum::<f64>() / (positions.len() as f64).powi(2)
    }

    fn newton_step(&self) -> Option<AffineStep<D>> {
        let of_covariance = SymmetricEigen::new(&self.covariance)?;
        let root = of_covariance.map(f64::sqrt);
        let inverse_root = of_covariance.map(|value| value.sqrt().recip());
        let inverse_curvature = self.inverse_curvature()?;
        let stretch = if self.correction == MomentCorrection::Mean {
            Matrix::IDENTITY
        } else {
            let middle = SymmetricEigen::new(&(root * inverse_curvature * root).symmetric_part())?.map(f64::sqrt);
            inverse_root * middle * inverse_root
        };
        Some(AffineStep {
            mean: self.mean,
            shift: inverse_curvature.apply(&self.mean_score),
            stretch,
        })
    }
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Banana, Frame, Gaussian, Target};

    use super::*;
    use crate::Run;

    fn corrected<const D: usize>(
        correction: MomentCorrection,
        target: &dyn Target<D>,
        positions: &[[f64; D]],
    ) -> (Vec<[f64; D]>, f64, f64) {
        let frame = Frame::identity();
        let mut score = FramedScore::new(target, &frame);
        let mut scores = vec![[0.0; D]; positions.len()];
        score.evaluate(positions, &mut scores).unwrap();
        let before = SteinMoments::of(correction, positions, &scores).defect();
        let mut moved = positions.to_vec();
        correct_moments(correction, f64::INFINITY, &mut moved, &mut score, &mut scores).unwrap();
        let after = SteinMoments::of(correction, &moved, &scores).defect();
        let mut fresh = vec![[0.0; D]; positions.len()];
        score.evaluate(&moved, &mut fresh).unwrap();
        assert_eq!(scores, fresh, "scores are those at the final positions");
        (moved, before, after)
    }

    #[test]
    fn gaussian_moments_become_exact() {
        let covariance = Matrix([[1.05, 0.06, 0.0], [0.06, 0.95, -0.04], [0.0, -0.04, 1.02]]);
        let mean = [0.03, -0.05, 0.02];
        let target = Gaussian::new(mean, covariance).unwrap();
        let start = Run::new(2000, 3).start_positions::<3>().unwrap();
        let (moved, _, after) = corrected(MomentCorrection::Affine, &target, &start);
        assert!(after < 1e-24, "{after}");
        let moments = SteinMoments::of(MomentCorrection::Affine, &moved, &moved);
        assert!((moments.covariance - covariance).frobenius_norm() < 1e-12);
        assert!(vector::distance(&moments.mean, &mean) < 1e-12);
    }

    #[test]
    fn standardised_particles_keep_their_mean_and_have_the_covariance_that_is_known() {
        let start: Vec<[f64; 3]> = Run::new(300, 5).start_positions().unwrap();
        let narrow: Vec<_> = start
            .iter()
            .map(|x| [0.9 * x[0] + 2.0, x[1] + 0.1 * x[0], x[2]])
            .collect();
        let (mean, covariance) = mean_and_covariance(&narrow);
        for (error, share) in [(0.0, 1.0), (f64::INFINITY, 0.0)] {
            let mut moved = narrow.clone();
            standardise(&mut moved, |_| error);
            let wanted = covariance + (Matrix::IDENTITY - covariance) * share;
            let (mean_after, found) = mean_and_covariance(&moved);
            assert!((found - wanted).frobenius_norm() < 1e-12, "{found:?}");
            assert!(vector::distance(&mean_after, &mean) < 1e-12);
        }
        // Too far from that, or without a spread.
        for others in [
            narrow.iter().map(|x| vector::scale(x, 3.0)).collect(),
            vec![[1.0; 3]; 4],
        ] {
            let mut moved = others.clone();
            standardise(&mut moved, |_| 0.0);
            assert_eq!(moved, others);
        }
    }

    #[test]
    fn never_enlarges_the_defect() {
        let target = Banana::new(1.0, 0.5).unwrap();
        for seed in 0..20 {
            let start: Vec<[f64; 2]> = Run::new(300, seed).start_positions::<2>().unwrap();
            let on_the_banana: Vec<_> = start.iter().map(|z| [z[0], z[0] * z[0] - 1.0 + 0.5 * z[1]]).collect();
            for correction in [MomentCorrection::Mean, MomentCorrection::Affine] {
                let (_, before, after) = corrected(correction, &target, &on_the_banana);
                assert!(after <= before, "{before} -> {after}");
            }
        }
    }

    /// e^(−√2 |x|) on each axis.
    struct Edged;

    impl Target<2> for Edged {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            -2.0_f64.sqrt() * (x[0].abs() + x[1].abs())
        }

        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            x.map(|x| -2.0_f64.sqrt() * x.signum())
        }
    }

    #[test]
    fn a_mean_that_is_known_better_otherwise_is_left_as_it_is() {
        let start: Vec<[f64; 2]> = Run::new(400, 2).start_positions::<2>().unwrap();
        let start: Vec<_> = start.iter().map(|x| [x[0] + 0.05, x[1]]).collect();
        let shift = |target: &dyn Target<2>, known: f64| {
            let frame = Frame::identity();
            let mut score = FramedScore::new(target, &frame);
            let (mut moved, mut scores) = (start.clone(), vec![[0.0; 2]; start.len()]);
            correct_moments(MomentCorrection::Mean, known, &mut moved, &mut score, &mut scores).unwrap();
            (moved, score.evaluations)
        };
        let (centred, _) = shift(&Gaussian::standard(), 1e-12);
        assert!(vector::norm(&mean_and_covariance(&centred).0) < 1e-12);
        // Of s = −√2 sign(x) under a normal law a variance of π/2 − 1 on each axis is not linear in x.
        assert_eq!(shift(&Edged, 1.0 / 400.0), (start.clone(), 400));
        assert_ne!(shift(&Edged, 1.3 / 400.0).0, start);
    }

    #[test]
    fn a_move_that_is_no_correction_is_left_undone() {
        let target = Gaussian::<2>::standard();
        let far: Vec<[f64; 2]> = Run::new(50, 1).start_positions::<2>().unwrap();
        let far: Vec<_> = far.iter().map(|x| [x[0] + 5.0, x[1]]).collect();
        assert_eq!(corrected(MomentCorrection::Affine, &target, &far).0, far);
    }
}
