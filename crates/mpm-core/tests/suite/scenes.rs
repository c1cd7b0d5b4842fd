//! Clouds, forces and controls that the themes share, and the list of bases.

use mpm_core::conformance::AnyBasis;
use mpm_core::{
    BodyForce, ContactPotential, Continuum, DeformsLast, ForceLocation, Friction, MpmError, Sites, StepControl,
};
use mpm_materials::{ElasticModuli, Material, NeoHookean};
use mpm_tensor::Matrix;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};
use rand_distr::{Distribution, StandardNormal};

/// Call `$check::<D, _>(name, make)` for every basis, `make(origin, spacing)` giving an empty one. A further basis is one
/// line here.
macro_rules! every_basis {
    ($check:ident, $dimension:literal) => {{
        use mpm_core::{ProductGrid, SimplexLattice, SplineDegree, SplineGrid, UniformBasis};
        use mpm_kernels::{Cubic, Gimp, Linear, Quadratic};
        $check::<$dimension, _>("linear", |o, h| SplineGrid::<Linear, 2, $dimension>::new(o, h).unwrap());
        $check::<$dimension, _>("quadratic", |o, h| {
            SplineGrid::<Quadratic, 3, $dimension>::new(o, h).unwrap()
        });
        $check::<$dimension, _>("GIMP", |o, h| {
            SplineGrid::<Gimp, 3, $dimension>::new(o, h)
                .unwrap()
                .with_kernel(Gimp::new(2))
        });
        $check::<$dimension, _>("turned lattice", |o, h| {
            let mut lattice = SimplexLattice::<$dimension>::permutohedral(o, h).unwrap();
            lattice.turn(&$crate::scenes::reflection());
            lattice
        });
        $check::<$dimension, _>("Kuhn lattice", |o, h| SimplexLattice::<$dimension>::kuhn(o, h).unwrap());
        $check::<$dimension, _>("cubic", |o, h| SplineGrid::<Cubic, 4, $dimension>::new(o, h).unwrap());
        $check::<$dimension, _>("quadratic by a loop", |o, h| {
            ProductGrid::<$dimension>::new(SplineDegree::Quadratic, o, h).unwrap()
        });
    }};
}

/// As [`every_basis`], with a `make` of which only the dimension is known: `$check::<D>(name, make)`.
macro_rules! any_basis {
    ($check:ident, $dimension:literal) => {{
        fn boxed<const D: usize, B: mpm_core::Basis<D> + 'static>(name: &str, make: impl Fn([f64; D], f64) -> B) {
            $check::<D>(name, &|origin, h| Box::new(make(origin, h)));
        }
        every_basis!(boxed, $dimension);
    }};
}

/// An empty basis at an origin, with a spacing.
pub type Make<'a, const D: usize> = &'a dyn Fn([f64; D], f64) -> Box<dyn AnyBasis<D>>;

pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

pub fn normal<const D: usize>(generator: &mut ChaCha8Rng) -> [f64; D] {
    std::array::from_fn(|_| StandardNormal.sample(generator))
}

/// An orthogonal matrix without zeros: I − 2 v vᵀ / |v|².
pub fn reflection<const D: usize>() -> Matrix<D> {
    let v: [f64; D] = std::array::from_fn(|a| 1.0 + 0.3 * a as f64);
    Matrix::IDENTITY - Matrix::outer(&v, &v) * (2.0 / dot(&v, &v))
}

/// Draws from N(0, I).
pub fn gaussian_cloud<const D: usize>(count: usize, seed: u64) -> Vec<[f64; D]> {
    let mut generator = generator(seed);
    (0..count).map(|_| normal(&mut generator)).collect()
}

/// Draws from the cube [0, `edge`)ᴰ.
pub fn uniform_cloud<const D: usize>(count: usize, edge: f64, seed: u64) -> Vec<[f64; D]> {
    let mut generator = generator(seed);
    let mut point = || std::array::from_fn(|_| edge * generator.random::<f64>());
    (0..count).map(|_| point()).collect()
}

/// A step of the given length with no other limit and no friction.
pub fn free(time_step: f64) -> StepControl {
    StepControl {
        time_step,
        courant: f64::INFINITY,
        displacement: f64::INFINITY,
        friction: 0.0,
    }
}

/// The elastic law that the themes share; behind a reference, so that the step is compiled once for all laws.
pub type AnyOrder<const D: usize> = Continuum<&'static dyn Material<D>>;

/// The same in the one order of a step that themes other than that order need: half of the passes to compile.
pub type Solid<const D: usize> = DeformsLast<AnyOrder<D>>;

/// A solid of the given law.
pub fn solid<const D: usize>(law: impl Material<D> + 'static) -> Solid<D> {
    DeformsLast(Continuum {
        law: Box::leak(Box::new(law)),
    })
}

/// A Neo-Hookean solid of Young's modulus `young` and Poisson's ratio 0.3.
pub fn neo_hookean<const D: usize>(young: f64) -> Solid<D> {
    solid(NeoHookean::new(ElasticModuli::new(young, 0.3).unwrap()))
}

/// A body force, of which only the dimension is known; one type for all scenes, so that a step is compiled once for all of them.
pub struct Pull<'a, const D: usize>(Box<dyn BodyForce<D> + 'a>);

impl<'a, const D: usize> Pull<'a, D> {
    pub fn by(force: impl BodyForce<D> + 'a) -> Self {
        Self(Box::new(force))
    }

    pub fn none() -> Self {
        Self::by(Field {
            location: ForceLocation::Nowhere,
            value: Box::new(|_, _| unreachable!("there is no force")),
        })
    }

    /// A force per unit mass at the particles.
    pub fn at_particles(value: impl Fn(&[f64; D]) -> [f64; D] + Sync + 'a) -> Self {
        Self::by(Field {
            location: ForceLocation::Particles,
            value: Box::new(move |x, _| value(x)),
        })
    }

    /// A force at the nodes, from position and mass.
    pub fn at_nodes(value: impl Fn(&[f64; D], f64) -> [f64; D] + Sync + 'a) -> Self {
        Self::by(Field {
            location: ForceLocation::Nodes,
            value: Box::new(value),
        })
    }

    /// The score of N(0, I) at the particles.
    pub fn well() -> Self {
        Self::at_particles(|x| x.map(|c| -c))
    }
}

impl<const D: usize> BodyForce<D> for Pull<'_, D> {
    fn location(&self) -> ForceLocation {
        self.0.location()
    }

    fn at_particles(&mut self, sites: &Sites<D>, accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.0.at_particles(sites, accelerations)
    }

    fn at_nodes(
        &mut self,
        positions: &[[f64; D]],
        masses: &dyn Fn(usize) -> f64,
        forces: &mut [[f64; D]],
    ) -> Result<(), MpmError> {
        self.0.at_nodes(positions, masses, forces)
    }

    fn contact(&self) -> Option<&dyn ContactPotential<D>> {
        self.0.contact()
    }

    fn friction(&self) -> Option<Friction<'_, D>> {
        self.0.friction()
    }
}

/// A strip of height 1, `across` rows of `along` points, all as far apart as the rows.
pub fn strip(along: usize, across: usize) -> Vec<[f64; 2]> {
    let place = |k: usize| (k as f64 + 0.5) / across as f64;
    (0..along * across)
        .map(|k| [place(k % along), place(k / along)])
        .collect()
}

/// A force by a function of position and mass.
struct Field<'a, const D: usize> {
    location: ForceLocation,
    value: Box<ForceField<'a, D>>,
}

/// The function.
type ForceField<'a, const D: usize> = dyn Fn(&[f64; D], f64) -> [f64; D] + Sync + 'a;

impl<const D: usize> BodyForce<D> for Field<'_, D> {
    fn location(&self) -> ForceLocation {
        self.location
    }

    fn at_particles(&mut self, sites: &Sites<D>, accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        for (x, acceleration) in sites.positions.iter().zip(accelerations) {
            *acceleration = (self.value)(x, 1.0);
        }
        Ok(())
    }

    fn at_nodes(
        &mut self,
        positions: &[[f64; D]],
        masses: &dyn Fn(usize) -> f64,
        forces: &mut [[f64; D]],
    ) -> Result<(), MpmError> {
        for (node, (x, force)) in positions.iter().zip(forces).enumerate() {
            *force = (self.value)(x, masses(node));
        }
        Ok(())
    }
}

/// One node as a particle sees it: place in the stencil, weight, gradient, offset.
pub type Seen<const D: usize> = (usize, f64, [f64; D], [f64; D]);

/// The whole stencil of a particle, by its place in the schedule.
pub fn stencil<const D: usize>(basis: &dyn AnyBasis<D>, particle: usize, x: &[f64; D]) -> Vec<Seen<D>> {
    let mut seen = Vec::new();
    basis.for_each_node(particle, x, &mut |index, entry| {
        seen.push((index, entry.weight, entry.gradient, entry.offset))
    });
    seen
}

pub fn dot<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    (0..D).map(|i| a[i] * b[i]).sum()
}

pub fn norm<const D: usize>(a: &[f64; D]) -> f64 {
    dot(a, a).sqrt()
}

pub fn distance<const D: usize>(a: &[f64; D], b: &[f64; D]) -> f64 {
    norm::<D>(&std::array::from_fn(|i| a[i] - b[i]))
}

/// Bits of all entries, for comparisons that forgive nothing.
pub fn bits<const D: usize>(vectors: &[[f64; D]]) -> Vec<u64> {
    vectors.iter().flatten().map(|c| c.to_bits()).collect()
}

/// As [`bits`], for matrices.
pub fn matrix_bits<const D: usize>(matrices: &[Matrix<D>]) -> Vec<u64> {
    matrices.iter().flat_map(|m| bits(&m.0)).collect()
}
