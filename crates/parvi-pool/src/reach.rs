//! Reaching out: where second moments lie beyond what proposals cover, kernels in shells that are twice as far out each.

use std::f64::consts::LN_2;
use std::ops::Range;

use mpm_tensor::{Matrix, vector};
use rand::RngExt;
use rand::rngs::ChaCha8Rng;

use crate::density::Density;
use crate::fold::{Fold, joined};
use crate::options::Plan;
use crate::propose::{best_form, proposal};
use crate::sample::{Sample, moments, root};
use crate::student::Kernel;
use crate::weights::{effective_size, runs, systematic, tempered, tempering};

/// Mass within the first radius, and draws by which that is found.
const WITHIN: f64 = 0.9;
const DRAWN: usize = 1000;

/// Points of a fold that are led outwards to see whether there is anything, and to fit kernels to what there is.
const LOOKS: usize = 48;
const LEADS: f64 = 200.0;

/// Shells at most, the last a thousand times as far out as the first; the share of the second moments from which on one is worth looking beyond, and that of the last over that of the first above
/// which there may be no second moments.
const MOST_SHELLS: usize = 10;
const LEAST: f64 = 0.005;
const ENDLESS: f64 = 0.25;

/// Share of what is wanted of a shell that is drawn if it lacks, and draws at least.
const NEED: f64 = 0.5;
const FEWEST: f64 = 32.0;

/// Effective size, per dimension, of what is led outwards, and to which its weights are tempered.
const SMALLEST: f64 = 5.0;

/// Points for both folds far out, of as large an effective size as is their share of the second moments, and the kernels that drew them, with that share; none where next to nothing is
/// there, enough is known of it, or second moments do not end.
///
/// With the radius r in standard deviations, the shell S_k = {2^k R ≤ r < 2^(k+1) R} is the image of S_(k−1) under y ↦ x = m + 2 (y − m), so that
///
/// ∫_{S_k} r² p dx = 2^(D+2) ∫_{S_(k−1)} r² p(x(y)) dy:
///
/// points of a shell that stand for r² p, led outwards and weighed by 2^(D+2) p(x)/p(y), stand for r² p in the next one.
pub(super) fn reach<const D: usize>(
    folds: &mut [Fold<D>; 2],
    density: &mut Density<'_, D>,
    plan: &Plan,
    rng: &mut ChaCha8Rng,
) -> Vec<Kernel<D>> {
    let Some(core) = Core::of(folds) else {
        return Vec::new();
    };
    let mut kernels: Vec<Kernel<D>> = Vec::new();
    for shell in 1..=MOST_SHELLS {
        let known = folds.each_ref().map(|fold| core.known(fold));
        if known
            .iter()
            .any(|known| known.size(core.shell(shell - 1)) < SMALLEST * D as f64)
        {
            break;
        }
        let mut led = |shells: Range<usize>, count: usize| {
            [1, 0].map(|side| core.led(&folds[side], &known[side], shells.clone(), count, density, rng.random()))
        };
        let mut share = |shells| led(shells, LOOKS).iter().map(|led| 0.5 * led.share).sum::<f64>();
        let share_here = share(shell - 1..shell);
        if share_here < LEAST || shell == 1 && share(0..MOST_SHELLS) > ENDLESS * share_here {
            break;
        }
        let wanted = 0.5 * plan.goal * share_here;
        let needs = known.each_ref().map(|known| wanted - known.size(core.shell(shell)));
        let need = needs[0].max(needs[1]);
        if need < NEED * wanted {
            continue;
        }
        let leads = need.clamp(LOOKS as f64, LEADS) as usize;
        let led = led(shell - 1..shell, leads);
        for ((fold, led), need) in folds.iter_mut().zip(led).zip(needs) {
            let left = density.source.limit.saturating_sub(density.evaluations());
            let count = need.max(FEWEST).min(0.25 * left as f64) as usize;
            let form = best_form(&led.sample, None, false, rng);
            let Some(proposal) = proposal(&led.sample, form, rng).filter(|_| count > 0) else {
                continue;
            };
            kernels.extend(proposal.shared(0.5 * led.share));
            // No control variate: it stands for little of the mass.
            fold.draw(density, proposal.with_core(0), count, rng.random());
        }
    }
    kernels
}

/// What most of the mass is within.
struct Core<const D: usize> {
    mean: [f64; D],
    whitener: Matrix<D>,
    radius: f64,
}

/// Of the points of a fold, radii r and weights w r².
struct Known {
    radii: Vec<f64>,
    squares: Vec<f64>,
}

/// What was led into a shell, and the share of the second moments that it stands for.
struct Led<const D: usize> {
    sample: Sample<D>,
    share: f64,
}

impl Known {
    /// The weights of points in a shell, 0 for the others.
    fn within(&self, shell: &Range<f64>) -> Vec<f64> {
        let pairs = self.squares.iter().zip(&self.radii);
        pairs
            .map(|(square, r)| if shell.contains(r) { *square } else { 0.0 })
            .collect()
    }

    /// Their effective size.
    fn size(&self, shell: Range<f64>) -> f64 {
        effective_size(&self.within(&shell))
    }
}

impl<const D: usize> Core<D> {
    fn of(folds: &[Fold<D>; 2]) -> Option<Self> {
        let (points, _, logs) = joined(&[&folds[0], &folds[1]]);
        let weights = tempered(&logs, 1.0);
        let (mean, covariance) = moments(&points, &weights);
        let mut core = Self {
            mean,
            whitener: root(&covariance).lower_triangular_inverse()?,
            radius: 0.0,
        };
        let drawn = systematic(&weights, DRAWN, 0.5).into_iter();
        let mut radii: Vec<f64> = drawn.map(|i| core.radius_of(&points[i])).collect();
        radii.sort_by(f64::total_cmp);
        core.radius = *radii.get((WITHIN * DRAWN as f64) as usize)?;
        (core.radius > 0.0 && core.radius.is_finite()).then_some(core)
    }

    /// Distance from the middle in standard deviations.
    fn radius_of(&self, x: &[f64; D]) -> f64 {
        vector::norm(&self.whitener.apply(&vector::subtract(x, &self.mean)))
    }

    /// The radii of a shell.
    fn shell(&self, number: usize) -> Range<f64> {
        let inner = self.radius * f64::powi(2.0, number as i32);
        inner..2.0 * inner
    }

    fn known(&self, fold: &Fold<D>) -> Known {
        let radii: Vec<f64> = fold.positions.iter().map(|x| self.radius_of(x)).collect();
        let weights = tempered(&fold.log_weights(), 1.0);
        Known {
            squares: weights.iter().zip(&radii).map(|(w, r)| w * r * r).collect(),
            radii,
        }
    }

    /// What `count` points of a fold in the first of these shells say of the last one.
    fn led(
        &self,
        fold: &Fold<D>,
        known: &Known,
        shells: Range<usize>,
        count: usize,
        density: &mut Density<'_, D>,
        offset: f64,
    ) -> Led<D> {
        let doublings = (shells.end - shells.start) as i32;
        let before = known.within(&self.shell(shells.start));
        let share_before = before.iter().sum::<f64>() / known.squares.iter().sum::<f64>();
        let chosen = runs(systematic(&before, count, offset));
        let out = |&(i, _): &(usize, f64)| {
            let y = &fold.positions[i];
            vector::add_scaled(&self.mean, f64::powi(2.0, doublings), &vector::subtract(y, &self.mean))
        };
        let points: Vec<[f64; D]> = chosen.iter().map(out).collect();
        let values = density.log_densities(&points);
        // log 2^(k (D+2)) p(x)/p(y).
        let growth = f64::from(doublings) * (D + 2) as f64 * LN_2;
        let ratios: Vec<f64> = chosen
            .iter()
            .zip(&values)
            .map(|(&(i, _), value)| growth + value - fold.log_densities[i])
            .collect();
        let logs: Vec<f64> = chosen
            .iter()
            .zip(&ratios)
            .map(|((_, times), ratio)| times.ln() + ratio)
            .collect();
        let share = share_before * logs.iter().map(|log| log.exp()).sum::<f64>() / count as f64;
        let size = effective_size(&chosen.iter().map(|(_, times)| *times).collect::<Vec<_>>());
        let gamma = tempering(&logs, (SMALLEST * D as f64).min(0.5 * size));
        // Between what was led there and r² p.
        let between = chosen.iter().zip(&values).zip(&ratios);
        let between =
            between.map(|((&(i, _), value), ratio)| 2.0 * known.radii[i].ln() + value - (1.0 - gamma) * ratio);
        Led {
            sample: Sample {
                logs: between.collect(),
                weights: tempered(&logs, gamma),
                precisions: vec![Some(Matrix::ZERO); points.len()],
                points,
            },
            share: if share.is_finite() { share } else { 0.0 },
        }
    }
}
