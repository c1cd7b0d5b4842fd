//! Time per particle of one calibrated step (isothermal gas in a Gaussian well, PIC), rebuild and sorting included.

use std::f64::consts::PI;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use mpm_core::{BodyForce, ForceLocation, Mpm, MpmError, Particles, Pic, SplineGrid, StepControl};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use mpm_materials::IsothermalGas;
use parvi::{BasisChoice, defaults};
use rand::{SeedableRng, rngs::ChaCha8Rng};
use rand_distr::{Distribution, StandardNormal};

/// g = −x: the score of N(0, I).
struct Well;

impl<const D: usize> BodyForce<D> for Well {
    fn location(&self) -> ForceLocation {
        ForceLocation::Particles
    }
    fn at_particles(&mut self, xs: &[[f64; D]], out: &mut [[f64; D]]) -> Result<(), MpmError> {
        for (x, g) in xs.iter().zip(out) {
            *g = x.map(|c| -c);
        }
        Ok(())
    }
}

/// Spacing at which N(0, I) has about `per_node` particles per active node, where that is finer than the sampler's own.
fn spacing<const D: usize>(particles: usize, per_node: f64) -> f64 {
    // Volume of the ball of radius 3, divided among M / per_node nodes.
    let d = D as f64;
    let ball = [2.0, PI, 4.1888, 4.9348, 5.2638, 5.1677, 4.7248, 4.0587][D - 1];
    (ball * 3f64.powf(d) * per_node / particles as f64).powf(1.0 / d)
}

fn bench_step<S: Spline<W>, const W: usize, const D: usize>(c: &mut Criterion, particles: usize, fine: bool) {
    let mut rng = ChaCha8Rng::seed_from_u64(1);
    let positions: Vec<[f64; D]> = (0..particles)
        .map(|_| std::array::from_fn(|_| StandardNormal.sample(&mut rng)))
        .collect();
    let (h, resolution) = if fine {
        (spacing::<D>(particles, 8.0), "8 particles per node")
    } else {
        (
            defaults::spacing::<D>(BasisChoice::Quadratic, particles),
            "default spacing",
        )
    };
    let mut mpm = Mpm::new(
        Particles::at_rest(positions, 1.0),
        SplineGrid::<S, W, D>::new([0.0; D], h).unwrap(),
        Pic,
        IsothermalGas::new(1.0).unwrap(),
        Well,
    );
    let control = StepControl {
        time_step: 0.5 * h,
        courant: f64::INFINITY,
        displacement: 0.5,
        friction: 1.0,
    };
    let mut step = 0u32;
    let mut group = c.benchmark_group("calibrated step");
    group.sample_size(20);
    group.throughput(Throughput::Elements(particles as u64));
    group.bench_function(
        BenchmarkId::new(format!("{}, d = {D}, {resolution}", S::NAME), particles),
        |b| {
            b.iter(|| {
                step += 1;
                let shift = (f64::from(step) * 0.618_033_988_749_894_9).fract() * h;
                mpm.basis.place([shift; D], h).unwrap();
                mpm.step(&control).unwrap()
            });
        },
    );
    group.finish();
}

fn benches(c: &mut Criterion) {
    bench_step::<Quadratic, 3, 1>(c, 100_000, false);
    bench_step::<Quadratic, 3, 2>(c, 100_000, false);
    bench_step::<Quadratic, 3, 2>(c, 100_000, true);
    bench_step::<Quadratic, 3, 3>(c, 100_000, false);
    bench_step::<Quadratic, 3, 3>(c, 100_000, true);
    bench_step::<Quadratic, 3, 4>(c, 20_000, false);
    bench_step::<Quadratic, 3, 6>(c, 10_000, false);
    bench_step::<Linear, 2, 3>(c, 100_000, false);
    bench_step::<Cubic, 4, 3>(c, 100_000, false);
}

criterion_group!(step, benches);
criterion_main!(step);
