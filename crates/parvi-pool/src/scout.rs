//! Scouts: the first proposal, from summits and the curvature there.

use mpm_tensor::{Matrix, vector};

use crate::ascent::{Summit, ascend};
use crate::density::Density;
use crate::mixture::{Kernel, Mixture};
use crate::sample::root;

/// Scouts that set out together; they are the last ones if none of them finds a summit that is not known.
const TOGETHER: usize = 8;

/// Scouts that set out first; where they meet at one summit, no others follow.
const FIRST: usize = 4;

/// Share of the wide law where they do not.
const WIDE: f64 = 0.5;

/// Widths of the kernels at a summit, over the normal approximation there, and their shares where the scouts met; the wide law has the rest.
const STRETCHES: [(f64, f64); 3] = [(1.1, 0.45), (3.0, 0.25), (10.0, 0.1)];

/// Log masses below the largest by more than this are left out.
const LIGHTEST: f64 = 20.0;

/// What the scouts say.
pub(super) struct Scouted<const D: usize> {
    /// The first proposal.
    pub proposal: Mixture<D>,
    /// Whether all of them met at one summit.
    pub agree: bool,
}

/// Before anything is known: one kernel as wide as the frame, one four and one sixteen times as wide.
fn wide<const D: usize>() -> Vec<Kernel<D>> {
    [(1.0, 0.3), (4.0, 0.5), (16.0, 0.2)]
        .map(|(width, share): (f64, f64)| Kernel {
            centre: [0.0; D],
            factor: Matrix::IDENTITY * width,
            share,
        })
        .to_vec()
}

/// Scouts from the centre of the frame and from points of the wide law, as long as they find summits and have not spent `evaluations`; and the wide law
/// together with kernels at the summits, half of whose shares are equal and half follow Laplace's masses p(x) (2π)^{D/2} / √det H.
pub(super) fn scout<const D: usize>(density: &mut Density<'_, D>, evaluations: u64, seed: u64) -> Option<Scouted<D>> {
    let law = Mixture::new(wide())?;
    let most = (evaluations as usize / (D + 2)).max(TOGETHER);
    let mut starts = law.draws(most, seed);
    if let Some(first) = starts.first_mut() {
        *first = [0.0; D];
    }
    let first = FIRST.min(starts.len());
    let mut summits: Vec<Summit<D>> = Vec::new();
    let (before, mut rounds) = (density.evaluations(), 0);
    for starts in starts[..first].chunks(FIRST).chain(starts[first..].chunks(TOGETHER)) {
        let known = summits.len();
        for start in starts {
            let found = ascend(density, start).filter(|found| !summits.iter().any(|summit| summit.is_near(found)));
            summits.extend(found);
        }
        rounds += 1;
        if summits.len() == known
            || rounds == 1 && known + 1 == summits.len()
            || density.evaluations() > before + evaluations
        {
            break;
        }
    }
    let agree = summits.len() == 1;
    let log_masses: Vec<f64> = summits
        .iter()
        .map(|s| s.log_density - 0.5 * s.log_determinant)
        .collect();
    let top = log_masses.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let heavy: Vec<(Summit<D>, f64)> = summits
        .into_iter()
        .zip(log_masses)
        .filter(|(_, log)| *log > top - LIGHTEST)
        .map(|(summit, log)| (summit, (log - top).exp()))
        .collect();
    let total: f64 = heavy.iter().map(|(_, mass)| mass).sum();
    let narrow = if agree { 1.0 } else { (1.0 - WIDE) / STRETCHES.iter().map(|(_, share)| share).sum::<f64>() };
    let (mut kernels, mut rest) = (Vec::new(), 1.0);
    for (stretch, share) in STRETCHES.iter().filter(|_| !heavy.is_empty()) {
        let share = narrow * share;
        rest -= share;
        kernels.extend(heavy.iter().map(|(summit, mass)| Kernel {
            centre: summit.point,
            factor: root(&summit.covariance) * *stretch,
            share: share * 0.5 * (mass / total + 1.0 / heavy.len() as f64),
        }));
    }
    kernels.extend(wide().into_iter().map(|kernel| Kernel {
        share: rest * kernel.share,
        ..kernel
    }));
    Some(Scouted {
        proposal: Mixture::new(kernels)?,
        agree,
    })
}

impl<const D: usize> Summit<D> {
    /// Whether another summit is within a standard deviation of this one, and as high.
    fn is_near(&self, other: &Self) -> bool {
        let apart = vector::subtract(&other.point, &self.point);
        vector::dot(&apart, &self.precision.apply(&apart)) < 1.0 && (self.log_density - other.log_density).abs() < 1.0
    }
}
