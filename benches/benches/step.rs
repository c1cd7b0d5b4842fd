//! Time per particle of one calibrated step (isothermal gas in a Gaussian well, PIC): shift, rebuild and sorting included.
//!
//! One thread unless `RAYON_NUM_THREADS` says otherwise.

mod support;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
use mpm_core::{
    BodyForce, ForceLocation, Mpm, MpmError, Particles, Pic, SimplexLattice, Sites, SplineGrid, StepControl,
    UniformBasis,
};
use mpm_kernels::{Cubic, Linear, Quadratic};
use mpm_materials::IsothermalGas;
use parvi::{BasisChoice, defaults};
use rand::{SeedableRng, rngs::ChaCha8Rng};
use rand_distr::{Distribution, StandardNormal};
use rayon::prelude::*;

/// g = −x: the score of N(0, I).
struct Well;

impl<const D: usize> BodyForce<D> for Well {
    fn location(&self) -> ForceLocation {
        ForceLocation::Particles
    }
    fn at_particles(&mut self, sites: &Sites<D>, out: &mut [[f64; D]]) -> Result<(), MpmError> {
        let chunk = 4096;
        (sites.positions.par_chunks(chunk), out.par_chunks_mut(chunk))
            .into_par_iter()
            .for_each(|(xs, out)| {
                for (x, g) in xs.iter().zip(out) {
                    *g = x.map(|c| -c);
                }
            });
        Ok(())
    }
}

/// A basis with nodes h apart, at the spacing the sampler gives `particles` particles times `factor`.
fn bench_step<B: UniformBasis<D>, const D: usize>(
    c: &mut Criterion,
    choice: BasisChoice,
    new: impl FnOnce([f64; D], f64) -> Result<B, MpmError>,
    particles: usize,
    factor: f64,
) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let positions: Vec<[f64; D]> = (0..particles)
        .map(|_| std::array::from_fn(|_| StandardNormal.sample(&mut rng)))
        .collect();
    let h = factor * defaults::spacing::<D>(choice, particles);
    let mut mpm = Mpm::new(
        Particles::at_rest(positions, 1.0),
        new([0.0; D], h).unwrap(),
        Pic,
        IsothermalGas::CALIBRATED,
        Well,
    );
    let control = StepControl {
        time_step: defaults::time_step(h),
        courant: f64::INFINITY,
        displacement: 0.5,
        friction: defaults::FRICTION,
    };
    let mut step = 0u32;
    let mut group = c.benchmark_group("calibrated step");
    group.sample_size(20);
    group.throughput(Throughput::Elements(particles as u64));
    let name = format!("{choice:?}, d = {D}, {factor} default spacings");
    group.bench_function(BenchmarkId::new(name, particles), |b| {
        b.iter(|| {
            step += 1;
            let shift = (f64::from(step) * 0.618_033_988_749_894_9).fract() * h;
            mpm.basis.place([shift; D], h).unwrap();
            mpm.step(&control).unwrap()
        });
    });
    group.finish();
}

/// At the default spacing, which averages over many particles per node, and at half of it.
fn bench_lattice<const D: usize>(c: &mut Criterion) {
    for (particles, factor) in [(100_000, 1.0), (100_000, 0.5), (1_000_000, 1.0)] {
        bench_step(
            c,
            BasisChoice::Lattice,
            SimplexLattice::<D>::permutohedral,
            particles,
            factor,
        );
    }
}

fn benches(c: &mut Criterion) {
    bench_lattice::<1>(c);
    bench_lattice::<2>(c);
    bench_lattice::<3>(c);
    bench_lattice::<4>(c);
    bench_lattice::<6>(c);
    bench_lattice::<8>(c);
    bench_step(c, BasisChoice::Linear, SplineGrid::<Linear, 2, 3>::new, 100_000, 1.0);
    bench_step(
        c,
        BasisChoice::Quadratic,
        SplineGrid::<Quadratic, 3, 2>::new,
        100_000,
        1.0,
    );
    bench_step(
        c,
        BasisChoice::Quadratic,
        SplineGrid::<Quadratic, 3, 3>::new,
        100_000,
        1.0,
    );
    bench_step(
        c,
        BasisChoice::Quadratic,
        SplineGrid::<Quadratic, 3, 4>::new,
        20_000,
        1.0,
    );
    bench_step(c, BasisChoice::Cubic, SplineGrid::<Cubic, 4, 3>::new, 100_000, 1.0);
}

fn main() {
    support::one_thread_unless_told();
    step();
    Criterion::default().configure_from_args().final_summary();
}

criterion_group!(step, benches);
