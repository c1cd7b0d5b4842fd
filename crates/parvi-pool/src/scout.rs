//! Scouts: the first proposal, from summits and the curvature there.

use mpm_tensor::{Matrix, vector};

use crate::ascent::ascend;
use crate::density::Density;
use crate::mixture::Mixture;
use crate::sample::{moments, root};
use crate::student::Kernel;
use crate::summit::Summit;

/// Scouts end after so many that found nothing new, and so many for every summit known: one of n summits that are reached alike is then overlooked with probability e⁻⁸.
const FEWEST: usize = 16;
const IDLE: usize = 8;

/// Share of the evaluations that scouts may take which they do take where there are several summits: in many dimensions a piece may lie in a direction that few of them set out in.
const SEVERAL: f64 = 0.1;

/// Where at least so many summits are known of which this share bends, they are places on ridges, of which there is no end: scouts then take no more than so large a
/// share, for rounds go along ridges more cheaply.
const FEWEST_BENT: usize = 6;
const BENT: f64 = 1.0 / 3.0;
const ALONG_RIDGES: f64 = 0.25;

/// Distances from a summit, in standard deviations of the normal approximation there, at which scouts set out.
const RINGS: [f64; 3] = [5.0, 12.0, 30.0];

/// Distances from the middle of all summits, in units of their spread, at which scouts set out.
const SHELLS: [f64; 2] = [1.0, 0.6];

/// Widths of the kernels at a summit, over the normal approximation there, and their shares.
const STRETCHES: [(f64, f64); 3] = [(1.1, 0.55), (3.0, 0.3), (10.0, 0.15)];

/// Share of the kernels at a summit that is the only one, and of all others where there are several.
const NARROW: f64 = 0.8;
const WIDE: f64 = 0.5;

/// Width of the kernel that stands for all summits, over their spread.
const APART: f64 = 1.5;

/// Summits whose log mass is below the largest by more than this get no kernel, and no scouts set out from them.
const LIGHTEST: f64 = 20.0;

/// What the scouts say.
pub(super) struct Scouted<const D: usize> {
    /// The first proposal.
    pub proposal: Mixture<D>,
    /// Whether all of them met at one summit.
    pub agree: bool,
}

/// Before anything is known: one kernel as wide as the frame, one four and one sixteen times as wide.
pub(super) fn wide<const D: usize>() -> Vec<Kernel<D>> {
    [(1.0, 0.3), (4.0, 0.5), (16.0, 0.2)]
        .map(|(width, share): (f64, f64)| Kernel {
            centre: [0.0; D],
            factor: Matrix::IDENTITY * width,
            share,
        })
        .to_vec()
}

/// Scouts, and the first proposal: the wide law, kernels at the summits, and one as wide as the summits lie apart.
pub(super) fn scout<const D: usize>(density: &mut Density<'_, D>, evaluations: u64, seed: u64) -> Option<Scouted<D>> {
    let summits = summits(density, evaluations, seed)?;
    let agree = summits.len() == 1;
    let mut kernels = about(&summits);
    let narrow = match (summits.len(), agree) {
        (0, _) => 0.0,
        (_, true) => NARROW,
        (_, false) => 1.0 - WIDE,
    };
    kernels.iter_mut().for_each(|kernel| kernel.share *= narrow);
    let mut far = wide();
    if summits.len() > 1 {
        far.push(spread(summits.iter()));
    }
    let total: f64 = far.iter().map(|kernel| kernel.share).sum();
    kernels.extend(far.into_iter().map(|kernel| Kernel {
        share: (1.0 - narrow) * kernel.share / total,
        ..kernel
    }));
    Some(Scouted {
        proposal: Mixture::new(kernels)?,
        agree,
    })
}

/// Where scouts came to rest: from the centre of the frame, from points of the wide law and from rings about the summits that are known, as long as they
/// find others and have not spent `evaluations`.
fn summits<const D: usize>(density: &mut Density<'_, D>, evaluations: u64, seed: u64) -> Option<Vec<Summit<D>>> {
    let law = Mixture::new(wide())?;
    let mut summits: Vec<Summit<D>> = Vec::new();
    let (before, mut idle) = (density.evaluations(), 0);
    let draw = law.drawn(seed)?;
    // One by one: most scouts end long before the evaluations do, of which there may be any number.
    let most = evaluations as usize / (D + 2) + FEWEST;
    for scout in 0..most.min(u32::MAX as usize) {
        let drawn = draw(scout as u32);
        let known = summits.len();
        let heavy = heavy(&summits);
        let start = match scout % 3 {
            _ if scout == 0 => [0.0; D],
            1 if !heavy.is_empty() => ringed(heavy[scout / 3 % heavy.len()], &drawn, RINGS[scout / 3 % RINGS.len()]),
            2 if heavy.len() > 1 => apart(&heavy, &drawn, SHELLS[scout / 3 % SHELLS.len()]),
            _ => drawn,
        };
        let is_known = |place: &[f64; D], log: f64| summits.iter().any(|summit| summit.explains(place, log));
        let found =
            ascend(density, &start, is_known).filter(|found| !summits.iter().any(|summit| summit.is_near(found)));
        summits.extend(found.and_then(|found| found.measured(density)));
        idle = if summits.len() > known { 0 } else { idle + 1 };
        let spent = (density.evaluations() - before) as f64 / evaluations as f64;
        let settled = summits.len() == 1 || spent > SEVERAL;
        let most = if are_on_ridges(&summits) { ALONG_RIDGES } else { 1.0 };
        if settled && idle >= FEWEST.max(IDLE * summits.len()) || spent > most {
            break;
        }
    }
    Some(summits)
}

/// Whether the summits are places on ridges rather than pieces.
fn are_on_ridges<const D: usize>(summits: &[Summit<D>]) -> bool {
    let bent = summits.iter().filter(|summit| summit.bends).count();
    summits.len() >= FEWEST_BENT && bent as f64 >= BENT * summits.len() as f64
}

/// The normal law of the summits' places, wider.
fn spread<'a, const D: usize>(summits: impl Iterator<Item = &'a Summit<D>>) -> Kernel<D> {
    let points: Vec<[f64; D]> = summits.map(|summit| summit.point).collect();
    let (mean, covariance) = moments(&points, &vec![1.0; points.len()]);
    Kernel {
        centre: mean,
        factor: root(&covariance) * APART,
        share: 1.0,
    }
}

/// A place where the summits' spread, stretched to so many times the length of a normal law's draws, has `drawn` in the direction.
fn apart<const D: usize>(summits: &[&Summit<D>], drawn: &[f64; D], shell: f64) -> [f64; D] {
    let Kernel { centre, factor, .. } = spread(summits.iter().copied());
    let direction = vector::scale(
        drawn,
        shell * (D as f64).sqrt() / vector::norm(drawn).max(f64::MIN_POSITIVE),
    );
    vector::add(&centre, &factor.apply(&direction))
}

fn heaviest<const D: usize>(summits: &[Summit<D>]) -> f64 {
    summits.iter().map(Summit::log_mass).fold(f64::NEG_INFINITY, f64::max)
}

/// Those that are not far lighter than the heaviest.
fn heavy<const D: usize>(summits: &[Summit<D>]) -> Vec<&Summit<D>> {
    let least = heaviest(summits) - LIGHTEST;
    summits.iter().filter(|summit| summit.log_mass() > least).collect()
}

/// Kernels at summits, half of whose shares are equal and half follow Laplace's masses p(x) (2π)^{D/2} / √det H.
pub(super) fn about<const D: usize>(summits: &[Summit<D>]) -> Vec<Kernel<D>> {
    let heavy = heavy(summits);
    let top = heaviest(summits);
    let total: f64 = heavy.iter().map(|summit| (summit.log_mass() - top).exp()).sum();
    let kernel = |summit: &Summit<D>, (stretch, share): (f64, f64)| Kernel {
        centre: summit.point,
        factor: root(&summit.covariance) * stretch,
        share: share * 0.5 * ((summit.log_mass() - top).exp() / total + 1.0 / heavy.len() as f64),
    };
    heavy
        .iter()
        .flat_map(|summit| STRETCHES.map(|stretch| kernel(summit, stretch)))
        .collect()
}

/// A place in the direction of `towards`, so many standard deviations from a summit.
fn ringed<const D: usize>(summit: &Summit<D>, towards: &[f64; D], ring: f64) -> [f64; D] {
    let direction = vector::scale(towards, ring / vector::norm(towards).max(f64::MIN_POSITIVE));
    vector::add(&summit.point, &root(&summit.covariance).apply(&direction))
}
