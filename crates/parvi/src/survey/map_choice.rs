//! Whether a triangular map describes the whole target, and which.

use mpm_tensor::vector;
use parvi_targets::{Frame, Target};

use super::axis_orders::axis_orders;
use super::conditional_fit::conditional_fit;
use super::density::{Density, Valued};
use super::explore::Scouted;
use super::gaussian_fit::{GaussianFit, balanced_nodes};
use super::map_fit::{Mapped, descend};
use crate::SampleError;
use crate::triangular_map::TriangularMap;

/// Pairs of nodes of the fit, and as many of the trial, per dimension.
const NODE_PAIRS: usize = 16;

/// Nodes at which the orders of the axes are told apart.
const ORDER_NODES: usize = 8;

/// A Gaussian with no larger Fisher divergence serves, and no map is looked for.
const SERVES: f64 = 0.3;

/// A map with no larger Fisher divergence is taken.
const FITS: f64 = 0.1;

/// log p/q at a summit exceeds its mean over the map's density by no more than this …
const LARGEST_EXCESS: f64 = 3.0;

/// … and this share of ½ |z|², which it would be at another mode of the same height.
const EXCESS_SHARE: f64 = 0.25;

/// The map, if in its coordinates the target is nearly N(0, I) where it is not around the fit at the highest summit, and if it leaves out
/// no summit; with the evaluations that this took. `frame` is that of the coordinates in which `scouted` is.
pub(super) fn choose<const D: usize>(
    target: &dyn Target<D>,
    frame: &Frame<D>,
    scouted: &Scouted<D>,
    seed: u64,
) -> Result<(Option<TriangularMap<D>>, u64), SampleError> {
    let identity = Frame::identity();
    let mut density = Density::new(target, &identity);
    let nodes = balanced_nodes::<D>(NODE_PAIRS * D, seed.wrapping_add(3))?;
    let fresh = balanced_nodes::<D>(NODE_PAIRS * D, seed.wrapping_add(4))?;
    let in_target = |summit: &Valued<D>| Valued {
        point: frame.to_target(&summit.point),
        ..*summit
    };
    let summits: Vec<Valued<D>> = scouted.summits.iter().map(in_target).collect();
    let fit = GaussianFit {
        mean: frame.to_target(&scouted.fit.mean),
        root: *frame.factor() * scouted.fit.root,
    };
    let gaussian = |order| {
        let covariance = (fit.root * fit.root.transpose()).symmetric_part();
        TriangularMap::gaussian(&fit.mean, &covariance, order)
    };
    let affine = gaussian(std::array::from_fn(|i| i)).and_then(|map| Mapped::new(&mut density, map, &fresh));
    if affine.is_none_or(|affine| affine.fisher_divergence() <= SERVES) {
        return Ok((None, density.evaluations));
    }
    let mut best: Option<Mapped<D>> = None;
    for order in axis_orders(&mut density, &fit, &nodes[..ORDER_NODES]) {
        let Some(start) = gaussian(order).and_then(|map| conditional_fit(&mut density, &map, &nodes)) else {
            continue;
        };
        let Some(mapped) = Mapped::new(&mut density, start, &nodes) else {
            continue;
        };
        let fits = mapped.fisher_divergence() <= FITS;
        if fits
            || best
                .as_ref()
                .is_none_or(|best| mapped.lower_bound() > best.lower_bound())
        {
            best = Some(mapped);
        }
        if fits {
            break;
        }
    }
    let map = best
        .map(|start| descend(&mut density, start, &nodes).map)
        .and_then(|map| Mapped::new(&mut density, map, &fresh))
        .filter(|mapped| mapped.fisher_divergence() <= FITS && covers(mapped, &summits))
        .map(|mapped| mapped.map);
    Ok((map, density.evaluations))
}

/// Whether the map's density leaves out no summit: log p/q there is no larger than elsewhere. Summits lower than all images are let be,
/// scouts that got stuck on their way.
fn covers<const D: usize>(mapped: &Mapped<D>, summits: &[Valued<D>]) -> bool {
    let lowest = mapped.log_densities.iter().copied().fold(f64::INFINITY, f64::min);
    let level = mapped.lower_bound();
    summits
        .iter()
        .filter(|summit| summit.log_density >= lowest)
        .all(|summit| {
            let (z, log_determinant) = mapped.map.inverse(&summit.point);
            let depth = 0.5 * vector::norm_squared(&z);
            summit.log_density + depth + log_determinant <= level + LARGEST_EXCESS + EXCESS_SHARE * depth
        })
}

#[cfg(test)]
mod tests {
    use parvi_targets::{CatalogueTarget, Cross, Funnel, Ring, Rosenbrock};

    use super::*;
    use crate::start::quasi_random_normal;
    use crate::survey::explore::scout;

    fn chosen<const D: usize>(target: &dyn CatalogueTarget<D>) -> (Option<TriangularMap<D>>, u64) {
        let frame = target.frame();
        let positions = quasi_random_normal::<D>(100, 1).unwrap();
        let scouted = scout(&mut Density::new(target, &frame), &positions, 7)
            .unwrap()
            .unwrap();
        choose(target, &frame, &scouted, 7).unwrap()
    }

    /// Coordinates of a target in reverse.
    struct Reversed<T>(T);

    fn reversed<const D: usize>(x: &[f64; D]) -> [f64; D] {
        std::array::from_fn(|i| x[D - 1 - i])
    }

    impl<const D: usize, T: Target<D>> Target<D> for Reversed<T> {
        fn log_density(&self, x: &[f64; D]) -> f64 {
            self.0.log_density(&reversed(x))
        }

        fn score(&self, x: &[f64; D]) -> [f64; D] {
            reversed(&self.0.score(&reversed(x)))
        }
    }

    impl<const D: usize, T: CatalogueTarget<D>> CatalogueTarget<D> for Reversed<T> {
        fn name(&self) -> &str {
            self.0.name()
        }

        fn frame(&self) -> Frame<D> {
            Frame::identity()
        }

        fn domain(&self) -> [[f64; 2]; D] {
            reversed(&self.0.domain().map(|[a, _]| a)).map(|a| [a, -a])
        }
    }

    /// log p/q is constant: the map has the density of the target, wherever it is looked at.
    fn is_exact<const D: usize>(target: &dyn CatalogueTarget<D>) {
        let (map, evaluations) = chosen(target);
        let map = map.unwrap();
        assert!(evaluations < 5000, "{evaluations}");
        for z in quasi_random_normal::<D>(50, 3).unwrap() {
            let x = map.image(&z).x;
            let ratio = target.log_density(&x) - map.log_density(&x);
            let at_centre = map.image(&[0.0; D]).x;
            let wanted = target.log_density(&at_centre) - map.log_density(&at_centre);
            assert!((ratio - wanted).abs() < 0.1, "{}: {ratio} {wanted}", target.name());
        }
    }

    #[test]
    fn funnels_and_rosenbrock_chains_are_found_exactly_in_any_order() {
        is_exact(&Funnel::<4>::new(1.5).unwrap());
        is_exact(&Rosenbrock::<4>::new(1.0, 0.3).unwrap());
        is_exact(&Reversed(Funnel::<4>::new(1.5).unwrap()));
        is_exact(&Reversed(Rosenbrock::<4>::new(1.0, 0.3).unwrap()));
    }

    #[test]
    fn what_a_map_cannot_describe_gets_none() {
        assert!(chosen(&Ring::new(2.0, 0.2).unwrap()).0.is_none());
        assert!(chosen(&Cross::<4>::new(2.0, 0.2).unwrap()).0.is_none());
    }
}
