//! Searches for pieces that no proposal has met: scouts set out from where the density most exceeds what is covered.

use mpm_tensor::{Matrix, SymmetricEigen, vector};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::ascent::ascend;
use crate::density::Density;
use crate::flanks::{flanks, rings};
use crate::fold::Fold;
use crate::lanes::packed;
use crate::mixture::Mixture;
use crate::peaks::{NEIGHBOURS, by_prominence};
use crate::sample::{moments, root};
use crate::scout::about;
use crate::student::Kernel;
use crate::summit::Summit;
use crate::weights::tempered;

/// Widths of the wide law over the spread of what is known, and their shares.
const WIDTHS: [(f64, f64); 2] = [(1.25, 0.2), (3.0, 0.2)];

/// The same for a round kernel, over the largest spread along any direction.
const ROUND: (f64, f64) = (1.1, 0.15);

/// Widths over that of the frame, and shares: in a law as wide as the frame narrow pieces within it are met, in a wider one only wide pieces, which scouts climb from afar.
const WIDTHS_OF_FRAME: [(f64, f64); 3] = [(1.0, 0.315), (4.0, 0.09), (16.0, 0.045)];

/// What the wide law is taken to cover, over what it would by its share: tails that are heavier than a kernel's surprise nobody.
const FLOOR: f64 = 1e-3;

/// p/(Z q) beyond which a point is worth a scout, and a summit is new.
const SURPRISING: f64 = 2.0;
const UNCOVERED: f64 = 5.0;

/// Least mass of a piece that is worth a proposal: by Laplace's approximation, and then by the weights about it, as far as it was not known.
pub(super) const LIGHTEST: f64 = 5e-3;

/// Widest standard deviation at a summit, over the largest spread of what is known: a flat top has no curvature to say how wide it is.
const WIDEST: f64 = 0.5;

/// Scouts end after so many that found nothing new: from surprises, from peaks, and from flanks.
const IDLE: usize = 24;
const IDLE_FROM_PEAKS: usize = 8;
const IDLE_FROM_FLANKS: usize = 8;

/// Places at which scores are asked where they point to, over the points drawn at a time, and share of them in rings about the kernels.
const OF_SCORES: f64 = 0.15;
const IN_RINGS: f64 = 0.3;

/// p/(Z q) below which a point is not of what is covered: q has heavier tails than most targets.
const FOREIGN: f64 = 0.2;

/// Draws `count` points at a time of a wide law into the folds and sends scouts from them, as long as these find something and `evaluations` last.
/// How many it has drawn, and kernels about the summits that no proposal covered, if there are any, none of them fitted.
///
/// What is drawn costs one density each, and is weighed like every other point: in few dimensions that meets a narrow piece more cheaply than ways uphill from
/// everywhere do.
pub(super) fn search<const D: usize>(
    folds: &mut [Fold<D>; 2],
    density: &mut Density<'_, D>,
    count: usize,
    evaluations: u64,
    rng: &mut ChaCha8Rng,
) -> (u64, Option<Mixture<D>>) {
    let until = density.evaluations().saturating_add(evaluations);
    let Some(mut covered) = Covered::by(folds) else {
        return (0, None);
    };
    let (mut drawn, mut found) = (0, Vec::<Summit<D>>::new());
    while density.evaluations() + count as u64 <= until {
        let Some(Known { law, factor, spread }) = known(folds, &found) else {
            break;
        };
        if covered.set_floor(&law).is_none() {
            break;
        }
        let (mut points, mut logs) = (Vec::new(), Vec::new());
        for fold in folds.iter_mut() {
            let first = fold.positions.len();
            fold.draw(density, law.clone(), count / 2, rng.random());
            points.extend_from_slice(&fold.positions[first..]);
            logs.extend_from_slice(&fold.log_densities[first..]);
        }
        drawn += points.len() as u64;
        let whitener = factor.lower_triangular_inverse().unwrap_or(Matrix::IDENTITY);
        let mut new = covered.climb_from_surprises(density, &points, &logs, WIDEST * spread);
        let foreign = covered.foreign(&points, &logs);
        let ranked = by_prominence(&points, &logs, &whitener, |index| foreign[index]);
        new.extend(covered.climb_from_peaks(density, &points, &ranked, WIDEST * spread));
        let foreign = covered.foreign(&points, &logs);
        let prominent = ranked.iter().filter(|(index, _)| foreign[*index]);
        let prominent: Vec<[f64; D]> = prominent.map(|&(index, _)| points[index]).collect();
        let scored = (OF_SCORES * count as f64) as usize;
        new.extend(covered.climb_from_flanks(density, &prominent, (scored, rng.random()), WIDEST * spread));
        if new.is_empty() {
            break;
        }
        found.extend(new);
    }
    (drawn, Mixture::new(about(&found)).map(|found| found.with_core(0)))
}

/// What the folds and new summits say.
struct Known<const D: usize> {
    /// As wide as all of it, and wider.
    law: Mixture<D>,
    /// Root of its covariance.
    factor: Matrix<D>,
    /// Largest spread along any direction.
    spread: f64,
}

fn known<const D: usize>(folds: &[Fold<D>; 2], found: &[Summit<D>]) -> Option<Known<D>> {
    let [one, other] = folds
        .each_ref()
        .map(|fold| moments(&fold.positions, &tempered(&fold.log_weights(), 1.0)));
    let centre = std::array::from_fn(|a| 0.5 * (one.0[a] + other.0[a]));
    let mut covariance = (one.1 + other.1) * 0.5;
    for summit in found {
        let apart = vector::subtract(&summit.point, &centre);
        covariance += Matrix::outer(&apart, &apart) * (1.0 / (1.0 + found.len() as f64));
    }
    let largest = SymmetricEigen::new(&covariance)?.values.into_iter().fold(0.0, f64::max);
    let (factor, spread) = (root(&covariance), largest.sqrt());
    let kernel = |factor, share| Kernel { centre, factor, share };
    let mut kernels = WIDTHS.map(|(width, share)| kernel(factor * width, share)).to_vec();
    kernels.push(kernel(Matrix::IDENTITY * (ROUND.0 * spread), ROUND.1));
    kernels.extend(WIDTHS_OF_FRAME.map(|(width, share)| Kernel {
        centre: [0.0; D],
        factor: Matrix::IDENTITY * width,
        share,
    }));
    // No kernel of it is fitted.
    Some(Known {
        law: Mixture::new(kernels)?.with_core(0),
        factor,
        spread,
    })
}

/// Kernels with their shares times a factor.
fn scaled<const D: usize>(kernels: &[Kernel<D>], factor: f64) -> impl Iterator<Item = Kernel<D>> {
    kernels.iter().map(move |kernel| Kernel {
        share: factor * kernel.share,
        ..*kernel
    })
}

/// A model Z Σ share · t of the target from the fitted kernels and from those about new summits, and a floor: shares do not sum to one.
struct Covered<const D: usize> {
    log_evidence: f64,
    kernels: Vec<Kernel<D>>,
    floor: Vec<Kernel<D>>,
    mixture: Mixture<D>,
    log_total: f64,
}

impl<const D: usize> Covered<D> {
    /// What the last proposals of the folds cover.
    fn by(folds: &[Fold<D>; 2]) -> Option<Self> {
        let cores: Vec<Mixture<D>> = folds.iter().filter_map(Fold::core).collect();
        let kernels: Vec<Kernel<D>> = cores.iter().flat_map(|core| scaled(core.kernels(), 0.5)).collect();
        Some(Self {
            log_evidence: 0.5 * (folds[0].log_evidence().0 + folds[1].log_evidence().0),
            mixture: Mixture::new(kernels.clone())?,
            log_total: 0.0,
            floor: Vec::new(),
            kernels,
        })
    }

    fn set_floor(&mut self, law: &Mixture<D>) -> Option<()> {
        self.floor = scaled(law.kernels(), FLOOR).collect();
        self.update()
    }

    fn update(&mut self) -> Option<()> {
        let all: Vec<Kernel<D>> = self.kernels.iter().chain(&self.floor).copied().collect();
        self.log_total = all.iter().map(|kernel| kernel.share).sum::<f64>().ln();
        self.mixture = Mixture::new(all)?;
        Some(())
    }

    /// log p/(Z q) at points where log p is known.
    fn surprises(&self, points: &[[f64; D]], logs: &[f64]) -> Vec<f64> {
        let densities = self.mixture.densities(&packed(points));
        let expected = |q: &f64| self.log_evidence + self.log_total + q.max(f64::MIN_POSITIVE).ln();
        let pairs = logs.iter().zip(densities.as_flattened());
        pairs.map(|(log, q)| log - expected(q)).collect()
    }

    /// Which points of finite density are not of what is covered.
    fn foreign(&self, points: &[[f64; D]], logs: &[f64]) -> Vec<bool> {
        let surprises = self.surprises(points, logs);
        let pairs = surprises.iter().zip(logs);
        pairs
            .map(|(surprise, log)| log.is_finite() && *surprise < FOREIGN.ln())
            .collect()
    }

    /// Sends scouts from the most surprising points, and covers what they find.
    fn climb_from_surprises(
        &mut self,
        density: &mut Density<'_, D>,
        points: &[[f64; D]],
        logs: &[f64],
        widest: f64,
    ) -> Vec<Summit<D>> {
        let mut found = Vec::new();
        let mut surprises = self.surprises(points, logs);
        let mut idle = 0;
        while idle < IDLE {
            let most = (0..points.len()).max_by(|&a, &b| surprises[a].total_cmp(&surprises[b]));
            let Some(start) = most.filter(|&index| surprises[index] > SURPRISING.ln()) else {
                break;
            };
            surprises[start] = f64::NEG_INFINITY;
            idle += 1;
            let is_known = |place: &[f64; D], log: f64| self.surprises(&[*place], &[log])[0] < SURPRISING.ln();
            let reached = ascend(density, &points[start], is_known);
            let Some(summit) = reached.and_then(|summit| self.cover(density, summit, widest)) else {
                continue;
            };
            for (old, new) in surprises.iter_mut().zip(self.surprises(points, logs)) {
                *old = old.min(new);
            }
            found.push(summit);
            idle = 0;
        }
        found
    }

    /// Sends scouts from foreign points that are higher than all about them, the first of those `ranked`, and covers what they find: far out the flank of a narrow piece is lower than the tails of
    /// what is covered, and higher than what is about it.
    fn climb_from_peaks(
        &mut self,
        density: &mut Density<'_, D>,
        points: &[[f64; D]],
        ranked: &[(usize, usize)],
        widest: f64,
    ) -> Vec<Summit<D>> {
        let peaks = ranked.iter().take_while(|(_, lower)| *lower >= NEIGHBOURS);
        let starts = peaks.map(|&(index, _)| &points[index]);
        self.climb(density, starts, IDLE_FROM_PEAKS, widest)
    }

    /// Sends scouts from where the score points to none of the kernels, and covers what they find: another piece outweighs their tails there, however low its own is. One score tells what a way
    /// uphill takes several of. Asked are `most` scores, at the most prominent foreign points and in rings about the kernels.
    fn climb_from_flanks(
        &mut self,
        density: &mut Density<'_, D>,
        prominent: &[[f64; D]],
        (most, seed): (usize, u64),
        widest: f64,
    ) -> Vec<Summit<D>> {
        let of_drawn = most - (IN_RINGS * most as f64) as usize;
        let mut places = prominent[..of_drawn.min(prominent.len())].to_vec();
        places.extend(rings(&self.mixture, most - places.len(), seed));
        let scores = density.scores(&places);
        let starts = flanks(&self.kernels, &places, &scores);
        self.climb(
            density,
            starts.iter().map(|&start| &places[start]),
            IDLE_FROM_FLANKS,
            widest,
        )
    }

    /// Sends scouts, as far as the way uphill does not meet what is covered, until so many have found nothing new, and covers what they find.
    fn climb<'a>(
        &mut self,
        density: &mut Density<'_, D>,
        starts: impl Iterator<Item = &'a [f64; D]>,
        most_idle: usize,
        widest: f64,
    ) -> Vec<Summit<D>> {
        let (mut found, mut idle) = (Vec::new(), 0);
        for start in starts {
            let is_known = |place: &[f64; D], log: f64| {
                (FOREIGN.ln()..SURPRISING.ln()).contains(&self.surprises(&[*place], &[log])[0])
            };
            let reached = ascend(density, start, is_known);
            match reached.and_then(|summit| self.cover(density, summit, widest)) {
                Some(summit) => {
                    found.push(summit);
                    idle = 0;
                }
                None => idle += 1,
            }
            if idle == most_idle {
                break;
            }
        }
        found
    }

    /// Covers a summit, if it is not covered and heavy enough.
    fn cover(&mut self, density: &mut Density<'_, D>, summit: Summit<D>, widest: f64) -> Option<Summit<D>> {
        let summit = summit.no_wider_than(widest)?.measured(density)?;
        let log_mass = summit.log_mass() - self.log_evidence;
        let surprise = self.surprises(&[summit.point], &[summit.log_density])[0];
        if surprise < UNCOVERED.ln() || log_mass < LIGHTEST.ln() {
            return None;
        }
        self.kernels.extend(scaled(&about(&[summit]), log_mass.exp()));
        self.update()?;
        Some(summit)
    }
}
