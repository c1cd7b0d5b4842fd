//! What is known of a target beside its particles: exact marginals and joint densities, or those of a weighted pool.

use std::path::Path;

use parvi_plot::statistics::DensityGrid;
use parvi_plot::{Curve, PairDensity, PointCloud, Reference};
use parvi_targets::CatalogueTarget;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::within::Within;
use crate::Particles;

/// Exact draws behind densities, at most.
const DRAWS: usize = 20_000;
/// Fewer of these make no density.
const FEWEST_DRAWS: usize = 1_000;
/// Proposals for draws within a mesh, at most.
const PROPOSALS: usize = 400_000;
/// Nodes per axis of a quadrature, tried one after the other; odd, so that every second one is a grid of its own.
const NODES: [usize; 2] = [201, 801];
/// How far the integrals over all and over every second node may differ.
const TOLERANCE: f64 = 1e-3;
/// How much of its mean density a marginal may have at an end of its axis: what has more goes on beyond the box, as a posterior that is far from the normal law at its mode.
const LEFT_AT_ENDS: f64 = 0.01;
/// Share of the weight that the lightest points of a pool may take with them: they are many, and not to be seen.
const LEFT_OUT: f64 = 1e-5;
/// The domain of a quadrature over the box that holds nearly all of the mass.
const WIDER: f64 = 1.5;

/// The density that particles are compared with.
pub enum Known {
    /// Exact draws.
    Draws(Vec<Vec<f64>>),
    /// Densities by quadrature.
    Quadrature {
        /// One per coordinate.
        marginals: Vec<Option<Curve>>,
        /// The joint density in the plane.
        pairs: Vec<PairDensity>,
    },
    /// What the run itself has evaluated, weighed: points and weights.
    Pool(Vec<Vec<f64>>, Vec<f64>),
    /// Nothing, and why.
    Nothing(String),
}

impl Known {
    /// As a figure takes it, with the draws of the first coordinates that it shows.
    pub fn reference<'a>(&'a self, draws: &'a [Vec<f64>]) -> Reference<'a> {
        match self {
            Self::Draws(_) => Reference::Draws(PointCloud::equal(draws)),
            Self::Pool(_, weights) => Reference::Draws(PointCloud::weighted(draws, Some(weights))),
            Self::Quadrature { marginals, pairs } => Reference::Exact { marginals, pairs },
            Self::Nothing(_) => Reference::None,
        }
    }

    /// The draws, if there are any.
    pub fn draws(&self) -> &[Vec<f64>] {
        match self {
            Self::Draws(draws) | Self::Pool(draws, _) => draws,
            _ => &[],
        }
    }

    /// A run's pool in the place of nothing.
    pub fn or_pool(self, pool: Option<&Particles>) -> Self {
        match (self, pool.and_then(|pool| Some((pool, pool.weights()?)))) {
            (Self::Nothing(_), Some((pool, weights))) => heavy(pool.to_rows(), weights),
            (known, _) => known,
        }
    }

    /// The text in a legend; empty for "target".
    pub fn label(&self) -> &'static str {
        match self {
            Self::Draws(_) => "target (exact draws)",
            Self::Pool(..) => "weighted pool",
            _ => "",
        }
    }
}

/// Looks for it: by quadrature for d = 1, 2, else from exact draws, which also serve where the quadrature does not settle. The mesh of a file that the density is kept to bounds both: outside there is none.
pub fn look<const D: usize>(target: &dyn CatalogueTarget<D>, mesh: Option<&Path>) -> Known {
    let too_much = format!("and d = {D} is too much for a quadrature");
    let unsettled = "and a quadrature does not settle";
    let elsewhere = "and no box is known that holds it";
    let has_box = target.domain().as_flattened().iter().all(|bound| bound.is_finite());
    let (known, fault) = if let Some(path) = mesh {
        let known = Within::<D>::of_file(path).and_then(|mesh| {
            let drawn = || draws(target, |x| mesh.holds(x)).map(Known::Draws);
            quadrature(target, Some(&mesh)).or_else(drawn)
        });
        (known, "or too few of them are within the mesh")
    } else {
        let integrated = if has_box { quadrature(target, None) } else { None };
        let known = integrated.or_else(|| draws(target, |_| true).map(Known::Draws));
        let fault = match (D, has_box) {
            (3.., _) => &too_much,
            (_, true) => unsettled,
            (_, false) => elsewhere,
        };
        (known, fault)
    };
    known.unwrap_or_else(|| Known::Nothing(format!("the target has no exact draws, {fault}")))
}

/// A pool without its lightest points.
fn heavy(points: Vec<Vec<f64>>, weights: &[f64]) -> Known {
    let mut sorted = weights.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let total: f64 = sorted.iter().sum();
    let mut sum = 0.0;
    let least = sorted.into_iter().find(|weight| {
        sum += weight;
        sum > LEFT_OUT * total
    });
    let own = points.into_iter().zip(weights.iter().copied());
    let (points, weights) = own
        .filter(|(_, weight)| least.is_some_and(|least| *weight >= least))
        .unzip();
    Known::Pool(points, weights)
}

/// Exact draws that are `inside`.
fn draws<const D: usize>(target: &dyn CatalogueTarget<D>, inside: impl Fn(&[f64; D]) -> bool) -> Option<Vec<Vec<f64>>> {
    let source = target.exact_draws()?;
    let mut generator = ChaCha8Rng::seed_from_u64(0);
    let all = std::iter::repeat_with(|| source.draw(&mut generator)).take(PROPOSALS);
    let kept = all.filter(|x| x.iter().all(|c| c.is_finite()) && inside(x));
    let draws: Vec<Vec<f64>> = kept.take(DRAWS).map(|x| x.to_vec()).collect();
    (draws.len() >= FEWEST_DRAWS).then_some(draws)
}

/// Marginals, and for d = 2 the joint density, on the first grid that settles, where they fall off towards its ends; over the box around a mesh where there is one, outside of which the density is 0.
fn quadrature<const D: usize>(target: &dyn CatalogueTarget<D>, mesh: Option<&Within<D>>) -> Option<Known> {
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
    Some(Known::Quadrature {
        marginals,
        pairs: if D == 2 { vec![in_the_plane(grid)] } else { Vec::new() },
    })
}

/// The joint density of a target in the plane over its domain, on so many nodes along each axis.
pub fn contours<const D: usize>(target: &dyn CatalogueTarget<D>, nodes: usize) -> Known {
    let domain = target.domain();
    let range = |axis: usize| domain.get(axis).map_or((-1.0, 1.0), |[low, high]| (*low, *high));
    let grid = density(target, [range(0), range(1)], (nodes, nodes), |_| true);
    Known::Quadrature {
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
        let Some(Known::Quadrature { marginals, pairs }) = quadrature(&target, None) else {
            panic!("a quadrature that settles");
        };
        let normal = Normal::new(0.0, 1.0).unwrap();
        for curve in marginals {
            let curve = curve.unwrap();
            for (x, y) in curve.x.iter().zip(curve.y) {
                assert!((y - normal.pdf(*x)).abs() < 1e-4, "{x}: {y}");
            }
        }
        assert_eq!(pairs.len(), 1);
        let line = quadrature(&Gaussian::<1>::standard(), None);
        assert!(
            matches!(line, Some(Known::Quadrature { marginals, pairs }) if marginals.len() == 1 && pairs.is_empty())
        );
        assert!(quadrature(&Gaussian::<3>::standard(), None).is_none());
    }

    /// Outside of a disk there is nothing, and marginals are those of what is left of the Gaussian.
    #[cfg(feature = "mesh")]
    #[test]
    fn a_mesh_bounds_the_density() {
        use mpm_mesh::generate::{EdgeTarget, disk};
        use mpm_mesh::{MshFormat, write_msh};

        let directory = tempfile::tempdir().unwrap();
        let file = directory.path().join("disk.msh");
        let disk = disk(
            [0.0; 2],
            2.0,
            &EdgeTarget {
                length: 0.2,
                angle: 0.0,
            },
        )
        .unwrap();
        std::fs::write(&file, write_msh(&disk, MshFormat::Text41)).unwrap();
        let mesh = Within::<2>::of_file(&file).unwrap();
        let target = Gaussian::<2>::standard();
        let Known::Quadrature { marginals, pairs } = look::<2>(&target, Some(&file)) else {
            panic!("a quadrature that settles");
        };
        let grid = &pairs[0].grid;
        let mut outside = 0;
        for (j, &y) in grid.y.iter().enumerate() {
            for (i, &x) in grid.x.iter().enumerate() {
                let value = grid.values[j * grid.x.len() + i];
                let inside = mesh.holds(&[x, y]);
                assert_eq!(value > 0.0, inside, "{x}, {y}");
                outside += usize::from(!inside);
            }
        }
        assert!(outside > 1000);
        let curve = marginals[0].as_ref().unwrap();
        let edge = curve.x.iter().zip(&curve.y).next().unwrap();
        assert!(*edge.1 < 0.05, "{edge:?}");
    }

    #[test]
    fn a_pool_stands_in_for_nothing_and_its_light_points_are_left_out() {
        let points: Vec<[f64; 1]> = (0..10_i8).map(|i| [f64::from(i)]).collect();
        let weights: Vec<f64> = (0..10).map(|i| if i < 4 { 1e-7 } else { 1.0 }).collect();
        let pool = Particles::new(&points, Some(&weights));
        let nothing = || Known::Nothing(String::new());
        assert!(matches!(nothing().or_pool(None), Known::Nothing(_)));
        let Known::Pool(points, weights) = nothing().or_pool(Some(&pool)) else {
            panic!("the pool");
        };
        assert_eq!((points.len(), &weights[..]), (6, &[1.0; 6][..]));
        assert_eq!(points[0], [4.0]);
        let draws = Known::Draws(Vec::new()).or_pool(Some(&pool));
        assert_eq!(draws.label(), "target (exact draws)");
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
