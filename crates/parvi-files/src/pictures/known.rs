//! What is known of a target beside its particles: exact marginals and joint densities, or those of a weighted pool.

use std::path::Path;

use parvi_plot::{PointCloud, Reference};
use parvi_targets::CatalogueTarget;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;

use super::quadrature::{Densities, over_domain, quadrature};
use super::within::Within;
use crate::Particles;

/// Exact draws behind densities, at most.
const DRAWS: usize = 20_000;
/// Fewer of these make no density.
const FEWEST_DRAWS: usize = 1_000;
/// Proposals for draws within a mesh, at most.
const PROPOSALS: usize = 400_000;
/// Share of the weight that the lightest points of a pool may take with them: they are many, and not to be seen.
const LEFT_OUT: f64 = 1e-5;

/// The density that particles are compared with.
pub enum Known {
    /// Exact draws.
    Draws(Vec<Vec<f64>>),
    /// Densities by quadrature.
    Quadrature(Densities),
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
            Self::Quadrature(Densities { marginals, pairs }) => Reference::Exact { marginals, pairs },
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
            quadrature(target, Some(&mesh)).map(Known::Quadrature).or_else(drawn)
        });
        (known, "or too few of them are within the mesh")
    } else {
        let integrated = if has_box { quadrature(target, None) } else { None };
        let integrated = integrated.map(Known::Quadrature);
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

/// The joint density of a target in the plane over its domain, on so many nodes along each axis.
pub fn contours<const D: usize>(target: &dyn CatalogueTarget<D>, nodes: usize) -> Known {
    Known::Quadrature(over_domain(target, nodes))
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

#[cfg(test)]
mod tests {
    #[cfg(feature = "mesh")]
    use parvi_targets::Gaussian;

    use super::*;

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
        let Known::Quadrature(Densities { marginals, pairs }) = look::<2>(&target, Some(&file)) else {
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
}
