//! Walks along ridges to where no proposal has been: a long thin piece is otherwise found a kernel's length per round.

use mpm_tensor::{Matrix, SymmetricEigen, vector};

use crate::ascent::local;
use crate::density::Density;
use crate::fold::Fold;
use crate::lanes::{LANES, packed};
use crate::neighbours::local_covariances;
use crate::sample::{Sample, root};

/// Walks of one proposal, each in both directions, out of so many places that weigh most, and hops of one walk at most.
const WALKS: usize = 4;
const PLACES: usize = 200;
const HOPS: usize = 24;

/// Length of a hop over the local standard deviation along the ridge.
const HOP: f64 = 2.0;

/// Corrections across the ridge after a hop.
const CORRECTIONS: usize = 2;

/// Step of the differences of scores over the hop.
const DIFFERENCE: f64 = 1e-4;

/// A place is uncovered where p/q is so many times its mean.
const UNCOVERED: f64 = 10.0;

/// Neighbours per dimension that say where the ridge goes.
const NEIGHBOURS: usize = 4;

/// Least cosine of the angle between a ridge before a hop and after it.
const STRAIGHT: f64 = 0.3;

/// Points on ridges of log p, no lower than `lowest`, that the proposals of the fold have not covered: from the points that weigh most, hops along the widest axis
/// of their neighbours and then of −∇² log p, each corrected by Newton steps across (predictor and corrector: E. Allgower, K. Georg, *Numerical continuation methods*, 1990).
pub(super) fn outposts<const D: usize>(
    fold: &Fold<D>,
    sample: &Sample<D>,
    lowest: f64,
    evaluations: u64,
    density: &mut Density<'_, D>,
) -> Sample<D> {
    let until = density.evaluations().saturating_add(evaluations);
    let logs = fold.log_weights();
    let (log_evidence, _) = fold.log_evidence();
    let threshold = log_evidence + (UNCOVERED / logs.len() as f64).ln();
    let mut heavy: Vec<usize> = (0..logs.len())
        .filter(|&i| logs[i] > threshold && fold.log_densities[i] >= lowest)
        .collect();
    heavy.sort_by(|&a, &b| logs[b].total_cmp(&logs[a]).then(a.cmp(&b)));
    heavy.truncate(PLACES);
    let factor = root(&sample.moments().1);
    let whitener = factor.lower_triangular_inverse().unwrap_or(Matrix::IDENTITY);
    let mut walker = Walker {
        fold,
        density,
        lowest,
        threshold,
        until,
        factor,
        found: Sample::default(),
    };
    let mut starts: Vec<[f64; D]> = Vec::new();
    for i in heavy {
        if starts.len() >= WALKS {
            break;
        }
        let covariance = local_covariances(sample, &[fold.positions[i]], NEIGHBOURS * D)[0];
        let local = (whitener * covariance * whitener.transpose()).symmetric_part();
        let Some(eigen) = SymmetricEigen::new(&local) else {
            continue;
        };
        let widest = (0..D)
            .max_by(|&a, &b| eigen.values[a].total_cmp(&eigen.values[b]))
            .unwrap_or(0);
        let hop = HOP * eigen.values[widest].max(0.0).sqrt();
        let start = whitener.apply(&fold.positions[i]);
        if starts
            .iter()
            .any(|other| vector::distance_squared(other, &start) < hop * hop)
        {
            continue;
        }
        starts.push(start);
        let along: [f64; D] = std::array::from_fn(|row| eigen.vectors.0[row][widest]);
        for sign in [1.0, -1.0] {
            walker.walk(start, vector::scale(&along, sign), hop);
        }
    }
    walker.found
}

/// Who walks, in coordinates in which the sample's covariance is I.
struct Walker<'a, 'b, const D: usize> {
    fold: &'a Fold<D>,
    density: &'a mut Density<'b, D>,
    lowest: f64,
    threshold: f64,
    /// Evaluations at which walks end.
    until: u64,
    factor: Matrix<D>,
    found: Sample<D>,
}

impl<const D: usize> Walker<'_, '_, D> {
    /// From a place in a direction, as long as there is something that no proposal has covered.
    fn walk(&mut self, start: [f64; D], direction: [f64; D], hop: f64) {
        let (mut place, mut direction) = (start, direction);
        for _ in 0..HOPS {
            if self.density.evaluations() >= self.until {
                return;
            }
            let mut next = vector::add_scaled(&place, hop, &direction);
            let mut ridge = direction;
            for _ in 0..CORRECTIONS {
                let Some((step, widest)) = self.across(&next, &direction, hop) else {
                    return;
                };
                next = vector::add(&next, &step);
                ridge = widest;
            }
            let x = self.factor.apply(&next);
            let log = self.density.log_densities(&[x])[0];
            if log < self.lowest || self.is_covered(&x, log) {
                return;
            }
            self.found.points.push(x);
            self.found.weights.push(1.0);
            self.found.logs.push(log);
            self.found.precisions.push(Some(Matrix::ZERO));
            let cosine = vector::dot(&ridge, &direction);
            if cosine.abs() < STRAIGHT {
                return;
            }
            (place, direction) = (next, vector::scale(&ridge, cosine.signum()));
        }
    }

    /// The Newton step across `direction`, no longer than a hop, and the axis of the least curvature.
    fn across(&mut self, z: &[f64; D], direction: &[f64; D], hop: f64) -> Option<([f64; D], [f64; D])> {
        let (score, curvature) = local(self.density, z, &self.factor, DIFFERENCE * hop);
        let eigen = SymmetricEigen::new(&curvature)?;
        let least = (0..D).min_by(|&a, &b| eigen.values[a].total_cmp(&eigen.values[b]))?;
        let ridge = std::array::from_fn(|row| eigen.vectors.0[row][least]);
        let projector = Matrix::IDENTITY + Matrix::outer(direction, direction) * -1.0;
        let across = SymmetricEigen::new(&(projector * curvature * projector).symmetric_part())?;
        let step = across
            .map(|q| 1.0 / q.abs().max(1.0 / (hop * hop)))
            .apply(&projector.apply(&score));
        let step = projector.apply(&step);
        let step = vector::scale(&step, (hop / vector::norm(&step).max(f64::MIN_POSITIVE)).min(1.0));
        vector::is_finite(&step).then_some((step, ridge))
    }

    /// Whether the proposals of the fold reach this point, at which log p is `log`.
    fn is_covered(&self, x: &[f64; D], log: f64) -> bool {
        let mut sum = vec![[0.0; LANES]; 1];
        self.fold.add_density(&packed(&[*x]), 1.0, &mut sum);
        log - sum[0][0].max(f64::MIN_POSITIVE).ln() < self.threshold
    }
}
