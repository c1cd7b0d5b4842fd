//! Reference moments and draws of targets that have none in closed form: quasi-Monte-Carlo importance sampling.

use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::error::{positive, within};
use crate::student_t::student_t_from_cube;
use crate::weighted_draws::WeightedDraws;
use crate::{CatalogueTarget, Frame, Moments, SobolSequence, TargetError};

/// Points of one piece of work.
const TOGETHER: usize = 1 << 10;

/// Points of the pilot run that moves the proposal from the target's frame to the target's own mean and covariance.
const PILOT_POINTS: usize = 1 << 13;

/// How much work a reference takes, and its proposal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceOptions {
    /// Points in total, over all scramblings; a power of two keeps the points' balance. Default 2¹⁸.
    pub points: usize,
    /// Independent scramblings, whose spread gives the standard errors. Default 8.
    pub scramblings: usize,
    /// Seed of the scramblings. Default 0.
    pub seed: u64,
    /// ν of the proposal, a multivariate Student t distribution. Default 8.
    pub degrees_of_freedom: f64,
    /// The proposal's scale in units of the target's frame. Default 1.1.
    pub inflation: f64,
}

impl Default for ReferenceOptions {
    fn default() -> Self {
        Self {
            points: 1 << 18,
            scramblings: 8,
            seed: 0,
            degrees_of_freedom: 8.0,
            inflation: 1.1,
        }
    }
}

/// Moments with the error they are known to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReferenceMoments<const D: usize> {
    /// Mean and covariance, from all points together.
    pub moments: Moments<D>,
    /// Standard error of each mean; zero for moments in closed form.
    pub mean_error: [f64; D],
    /// Standard error of each standard deviation; zero for moments in closed form.
    pub standard_deviation_error: [f64; D],
    /// (Σ w)² / Σ w², the number of equal weights that the weights are worth; infinite for moments in closed form.
    pub effective_sample_size: f64,
}

/// A weighted sample of a target: points of a Student t proposal from scrambled Sobol' points, with weights p/q.
///
/// The proposal stands in the target's frame (for a regression its Laplace approximation). A pilot run replaces frame
/// and proposal by the mean and covariance it estimates, if its effective sample size allows. Weights are normalised, so
/// the density's constant is not needed. Works for unimodal targets that a Student t distribution covers; the effective
/// sample size tells. A target with exact draws and no map from the unit cube stands for itself: as many of them, of equal weight.
#[derive(Clone, Debug)]
pub struct ImportanceSample<const D: usize> {
    draws: WeightedDraws<D>,
    per_scrambling: usize,
}

impl<const D: usize> ImportanceSample<D> {
    /// Draws and weighs the points.
    ///
    /// # Errors
    /// [`TargetError::OutOfRange`] for fewer than 2 scramblings, fewer than 16 points per scrambling, or a proposal
    /// outside of ν > 0, inflation > 0; [`TargetError::ReferenceFailed`] where a log density is NaN or +∞, or where every
    /// point has density zero.
    pub fn new(target: &dyn CatalogueTarget<D>, options: &ReferenceOptions) -> Result<Self, TargetError> {
        (Compiled::of().sample)(target, options)
    }

    /// [`new`](Self::new), generated where it is called.
    fn drawn(target: &dyn CatalogueTarget<D>, options: &ReferenceOptions) -> Result<Self, TargetError> {
        positive("degrees of freedom of the proposal", options.degrees_of_freedom)?;
        positive("inflation of the proposal", options.inflation)?;
        within(
            "scramblings",
            options.scramblings as f64,
            options.scramblings >= 2,
            "2 or more",
        )?;
        let per_scrambling = options.points / options.scramblings;
        let (field, size) = ("points per scrambling", per_scrambling as f64);
        within(field, size, per_scrambling >= 16, "16 or more")?;
        within(field, size, u32::try_from(per_scrambling).is_ok(), "fewer than 2^32")?;

        let mut seeds = ChaCha8Rng::seed_from_u64(options.seed);
        if let (Some(exact), None) = (target.exact_draws(), target.unit_cube_transport()) {
            let count = options.scramblings * per_scrambling;
            let draws = WeightedDraws {
                points: (0..count).map(|_| exact.draw(&mut seeds)).collect(),
                weights: vec![(count as f64).recip(); count],
            };
            return Ok(Self { draws, per_scrambling });
        }
        let mut frame = target.frame();
        let pilot_count = PILOT_POINTS.min(options.points);
        let pilot = weighed(target, &frame, options, &[seeds.random()], pilot_count)?;
        if pilot.effective_sample_size() >= (50 * D) as f64 {
            let moments = pilot.moments();
            frame = Frame::new(moments.mean, moments.covariance).unwrap_or(frame);
        }
        let seeds: Vec<u64> = (0..options.scramblings).map(|_| seeds.random()).collect();
        let draws = weighed(target, &frame, options, &seeds, per_scrambling);
        // What a target has said that failed meanwhile is nothing.
        match target.fault() {
            Some(fault) => Err(fault),
            None => Ok(Self {
                draws: draws?,
                per_scrambling,
            }),
        }
    }

    /// Mean, covariance and their standard errors over the scramblings.
    pub fn moments(&self) -> ReferenceMoments<D> {
        (Compiled::of().moments)(self)
    }

    /// [`moments`](Self::moments), generated where it is called.
    fn moments_of(&self) -> ReferenceMoments<D> {
        let parts: Vec<Moments<D>> = self
            .draws
            .points
            .chunks(self.per_scrambling)
            .zip(self.draws.weights.chunks(self.per_scrambling))
            .map(|(points, weights)| crate::weighted_draws::moments_of(points, weights))
            .collect();
        let error = |of: &dyn Fn(&Moments<D>) -> f64| {
            let count = parts.len() as f64;
            let mean = parts.iter().map(of).sum::<f64>() / count;
            let square: f64 = parts.iter().map(|part| (of(part) - mean).powi(2)).sum();
            (square / (count * (count - 1.0))).sqrt()
        };
        ReferenceMoments {
            moments: self.draws.moments(),
            mean_error: std::array::from_fn(|axis| error(&|part| part.mean[axis])),
            standard_deviation_error: std::array::from_fn(|axis| error(&|part| part.covariance.0[axis][axis].sqrt())),
            effective_sample_size: self.draws.effective_sample_size(),
        }
    }

    /// The points and their weights.
    pub fn draws(&self) -> &WeightedDraws<D> {
        &self.draws
    }

    /// The points and their weights.
    pub fn into_draws(self) -> WeightedDraws<D> {
        self.draws
    }
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    sample: Sample<D>,
    moments: fn(&ImportanceSample<D>) -> ReferenceMoments<D>,
}

type Sample<const D: usize> =
    fn(&dyn CatalogueTarget<D>, &ReferenceOptions) -> Result<ImportanceSample<D>, TargetError>;

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        sample: ImportanceSample::drawn,
        moments: ImportanceSample::moments_of,
    };
}

mpm_parallel::compiled_ahead!(Compiled);

/// The moments of a target: in closed form where it has them, else by importance sampling.
///
/// # Errors
/// As [`ImportanceSample::new`].
pub fn reference_moments<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    options: &ReferenceOptions,
) -> Result<ReferenceMoments<D>, TargetError> {
    match target.moments() {
        Some(moments) => Ok(ReferenceMoments {
            moments,
            mean_error: [0.0; D],
            standard_deviation_error: [0.0; D],
            effective_sample_size: f64::INFINITY,
        }),
        None => Ok(ImportanceSample::new(target, options)?.moments()),
    }
}

/// `count` draws of equal weight, seeded by the options' seed: exact and independent where the target has exact draws,
/// else resampled from an importance sample (then points may repeat; keep `count` well below the effective sample size).
///
/// # Errors
/// As [`ImportanceSample::new`].
pub fn reference_draws<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    count: usize,
    options: &ReferenceOptions,
) -> Result<Vec<[f64; D]>, TargetError> {
    match target.exact_draws() {
        Some(exact) => {
            let mut rng = ChaCha8Rng::seed_from_u64(options.seed);
            Ok((0..count).map(|_| exact.draw(&mut rng)).collect())
        }
        None => Ok(ImportanceSample::new(target, options)?
            .draws()
            .resampled(count, options.seed)),
    }
}

/// `count` points of the proposal for every seed, with weights that sum to one over all.
fn weighed<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    frame: &Frame<D>,
    options: &ReferenceOptions,
    seeds: &[u64],
    count: usize,
) -> Result<WeightedDraws<D>, TargetError> {
    let failed = |reason: String| TargetError::ReferenceFailed {
        target: target.name().to_owned(),
        reason,
    };
    let nu = options.degrees_of_freedom;
    let (mut points, mut proposal) = (Vec::new(), Vec::new());
    for &seed in seeds {
        let sequence = SobolSequence::scrambled(D + 1, seed)?;
        let part = mpm_parallel::collect(count, TOGETHER, &|index| {
            let mut u = vec![0.0; D + 1];
            sequence.write(index as u32, &mut u);
            let z: [f64; D] = student_t_from_cube(nu, &u);
            let square: f64 = z.iter().map(|z| z * z).sum();
            let x = frame.to_target(&z.map(|z| options.inflation * z));
            (x, -0.5 * (nu + D as f64) * (square / nu).ln_1p())
        });
        points.extend(part.iter().map(|(x, _)| *x));
        proposal.extend(part.iter().map(|(_, log_density)| *log_density));
    }
    let mut weights = vec![0.0; points.len()];
    target.log_densities(&points, &mut weights);
    let mut largest = f64::NEG_INFINITY;
    for ((weight, log_proposal), x) in weights.iter_mut().zip(&proposal).zip(&points) {
        if weight.is_nan() || *weight == f64::INFINITY {
            return Err(failed(format!("the log density at {x:?} is {weight}")));
        }
        *weight -= log_proposal;
        largest = largest.max(*weight);
    }
    if largest == f64::NEG_INFINITY {
        return Err(failed(format!(
            "the density is zero at every point ({} in all)",
            points.len()
        )));
    }
    weights
        .iter_mut()
        .for_each(|weight| *weight = (*weight - largest).exp());
    let total: f64 = weights.iter().sum();
    weights.iter_mut().for_each(|weight| *weight /= total);
    Ok(WeightedDraws { points, weights })
}
