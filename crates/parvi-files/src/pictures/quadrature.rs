//! Densities on grids: marginals and joint densities by quadrature, contours.

use parvi_plot::statistics::DensityGrid;
use parvi_plot::{Curve, PairDensity};
use parvi_targets::CatalogueTarget;

use super::within::Within;

/// Nodes per axis of a quadrature, tried one after the other; odd, so that every second one is a grid of its own.
const NODES: [usize; 2] = [201, 801];
/// How far the integrals over all and over every second node may differ.
const TOLERANCE: f64 = 1e-3;
/// How much of its mean density a marginal may have at an end of its axis: what has more goes on beyond the box, as a posterior that is far from the normal law at its mode.
const LEFT_AT_ENDS: f64 = 0.01;
/// The domain of a quadrature over the box that holds nearly all of the mass.
const WIDER: f64 = 1.5;

/// Densities by quadrature.
pub struct Densities {
    /// One per coordinate.
    pub marginals: Vec<Option<Curve>>,
    /// The joint density in the plane.
    pub pairs: Vec<PairDensity>,
}

/// Marginals, and for d = 2 the joint density, on the first grid that settles, where they fall off towards its ends; over the box around a mesh where there is one, outside of which the density is 0.
pub fn quadrature<const D: usize>(target: &dyn CatalogueTarget<D>, mesh: Option<&Within<D>>) -> Option<Densities> {
    if D > 2 {
        return None;
    }
    let range = |axis: usize| {
        if let Some(mesh) = mesh {
            return mesh.range(axis);
        }
        let [low, high] = target.domain().get(axis).copied().unwrap_or([0.0, 1.0]);
        let (middle, half) = (0.5 * (low + high), 0.5 * WIDER * (high - low));
        (middle - half, middle + half)
    };
    let mut grids = NODES.iter().map(|&nodes| {
        let rows = if D == 1 { 1 } else { nodes };
        density(target, [range(0), range(1)], (nodes, rows), |x| {
            mesh.is_none_or(|mesh| mesh.holds(x))
        })
    });
    let grid = grids.find(|grid| grid.settles(TOLERANCE))?;
    let marginal = |axis: usize| grid.marginal(axis).map(|(x, y)| Curve { x, y });
    let marginals: Vec<_> = (0..D).map(marginal).collect();
    let falls_off = |curve: &Curve| {
        let mean = curve.y.iter().sum::<f64>() / curve.y.len() as f64;
        let ends = curve.y.first().into_iter().chain(curve.y.last());
        ends.copied().fold(0.0, f64::max) < LEFT_AT_ENDS * mean
    };
    if mesh.is_none() && !marginals.iter().flatten().all(falls_off) {
        return None;
    }
    Some(Densities {
        marginals,
        pairs: if D == 2 { vec![in_the_plane(grid)] } else { Vec::new() },
    })
}

/// The joint density of a target in the plane over its domain, on so many nodes along each axis.
pub fn over_domain<const D: usize>(target: &dyn CatalogueTarget<D>, nodes: usize) -> Densities {
    let domain = target.domain();
    let range = |axis: usize| domain.get(axis).map_or((-1.0, 1.0), |[low, high]| (*low, *high));
    let grid = density(target, [range(0), range(1)], (nodes, nodes), |_| true);
    Densities {
        marginals: Vec::new(),
        pairs: vec![in_the_plane(grid)],
    }
}

fn in_the_plane(grid: DensityGrid) -> PairDensity {
    PairDensity {
        horizontal: 0,
        vertical: 1,
        grid,
    }
}

/// A density on a grid over the first two coordinates, its largest value 1 and 0 where a point is not inside.
fn density<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    [x, y]: [(f64, f64); 2],
    nodes: (usize, usize),
    inside: impl Fn(&[f64; D]) -> bool,
) -> DensityGrid {
    let mut grid = DensityGrid::evaluate(x, y, nodes, |x, y| {
        let mut point = [0.0; D];
        for (coordinate, value) in point.iter_mut().zip([x, y]) {
            *coordinate = value;
        }
        if inside(&point) {
            target.log_density(&point)
        } else {
            f64::NEG_INFINITY
        }
    });
    grid.exponentiate();
    grid
}

#[cfg(test)]
mod tests {
    use parvi_targets::{Gaussian, LogisticRegression, RegressionData, Ring};
    use statrs::distribution::{Continuous, Normal};

    use super::*;

    #[test]
    fn quadrature_gives_the_marginals_of_a_gaussian() {
        let target = Gaussian::<2>::autoregressive(0.8).unwrap();
        let Densities { marginals, pairs } = quadrature(&target, None).expect("a quadrature that settles");
        let normal = Normal::new(0.0, 1.0).unwrap();
        for curve in marginals {
            let curve = curve.unwrap();
            for (x, y) in curve.x.iter().zip(curve.y) {
                assert!((y - normal.pdf(*x)).abs() < 1e-4, "{x}: {y}");
            }
        }
        assert_eq!(pairs.len(), 1);
        let line = quadrature(&Gaussian::<1>::standard(), None).expect("another one");
        assert_eq!((line.marginals.len(), line.pairs.len()), (1, 0));
        assert!(quadrature(&Gaussian::<3>::standard(), None).is_none());
    }

    /// Under a wide prior the posterior of separated responses is nothing like the normal law at its mode, which the box is made of.
    #[test]
    fn a_density_that_goes_on_beyond_the_box_is_not_integrated() {
        let rows: Vec<(bool, Vec<f64>)> = (-20..20).map(|i| (i >= 0, vec![f64::from(i) + 0.5])).collect();
        let of_prior = |deviation: f64| {
            let data = RegressionData::new("separated", &["x"], &rows).unwrap();
            LogisticRegression::<2>::with_prior("logistic", data, deviation).unwrap()
        };
        assert!(quadrature(&of_prior(1e4), None).is_none());
        assert!(quadrature(&of_prior(1.0), None).is_some());
    }

    #[test]
    fn a_density_that_no_grid_resolves_is_not_integrated() {
        assert!(quadrature(&Ring::new(2.0, 1e-4).unwrap(), None).is_none());
        assert!(quadrature(&Ring::new(2.0, 0.2).unwrap(), None).is_some());
    }
}
