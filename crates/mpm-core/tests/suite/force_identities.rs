//! Nodal forces of the calibrated gas under a Gaussian score, at every step:
//! Σ_i f_i = −Σ⁻¹(x̄ − μ) and Σ_i f_i x_iᵀ = I − Σ⁻¹ E[(x − μ) xᵀ], E the mean over the particles.

use mpm_core::conformance::AnyBasis;
use mpm_core::{Mpm, Particles, Pic, SplineGrid, UniformBasis};
use mpm_kernels::{Deposit, Quadratic};
use mpm_materials::IsothermalGas;
use mpm_tensor::Matrix;

use crate::scenes::{Make, Pull, free, gaussian_cloud, generator, normal};

struct Gaussian<const D: usize> {
    mean: [f64; D],
    precision: Matrix<D>,
}

impl<const D: usize> Gaussian<D> {
    /// A correlated one with a random mean.
    fn random(seed: u64) -> Self {
        let mut random = generator(seed);
        let rows: [[f64; D]; D] = std::array::from_fn(|_| normal(&mut random));
        let covariance = Matrix(rows) * Matrix(rows).transpose() * 0.3 + Matrix::IDENTITY * 0.5;
        Self {
            mean: normal(&mut random),
            precision: covariance.inverse().unwrap(),
        }
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.precision.apply(&std::array::from_fn(|a| self.mean[a] - x[a]))
    }
}

fn identities_hold<const D: usize>(
    basis: &mut dyn AnyBasis<D>,
    positions: &[[f64; D]],
    gaussian: &Gaussian<D>,
    what: &str,
) {
    let sorted = basis.rebuild(positions).unwrap();
    let mass = 1.0 / positions.len() as f64;
    let forces = basis.scatter(&sorted, &|_, x| {
        let value = Deposit {
            scalar: mass,
            vector: gaussian.score(x).map(|s| mass * s),
        };
        (value, mass)
    });
    let mut nodes = Vec::new();
    basis.node_positions(&mut nodes);

    let (mut sum, mut moment) = ([0.0; D], Matrix::ZERO);
    for (Deposit { vector: force, .. }, node) in forces.iter().zip(&nodes) {
        for a in 0..D {
            sum[a] += force[a];
        }
        moment += Matrix::outer(force, node);
    }
    let mut mean = [0.0; D];
    let mut spread = Matrix::ZERO; // E[(x − μ) xᵀ]
    for x in positions {
        let centred: [f64; D] = std::array::from_fn(|a| x[a] - gaussian.mean[a]);
        for a in 0..D {
            mean[a] += mass * x[a];
        }
        spread += Matrix::outer(&centred, x) * mass;
    }
    let expected_sum = gaussian.score(&mean);
    let expected_moment = Matrix::IDENTITY - gaussian.precision * spread;
    for a in 0..D {
        assert!(
            (sum[a] - expected_sum[a]).abs() < 1e-12,
            "{what}: {sum:?} for {expected_sum:?}"
        );
    }
    let error = (moment - expected_moment).frobenius_norm();
    assert!(error < 1e-12, "{what}: moments off by {error}");
}

/// The particles move under a quadratic grid; the identities are checked on the basis at hand, at two origins.
fn hold_at_every_step<const D: usize>(name: &str, make: Make<D>) {
    let gaussian = Gaussian::<D>::random(D as u64);
    let count = [300, 300, 200, 100][D - 1];
    let h = [0.3, 0.5, 0.8, 1.2][D - 1];
    let grid = SplineGrid::<Quadratic, 3, D>::new([0.0; D], h).unwrap();
    let particles = Particles::at_rest(gaussian_cloud(count, 77), 1.0);
    let mut mpm = Mpm::new(
        particles,
        grid,
        Pic,
        IsothermalGas::CALIBRATED,
        Pull::at_particles(|x| gaussian.score(x)),
    );
    let mut control = free(0.4 * h);
    (control.displacement, control.friction) = (0.5, 1.5);
    for step in 0..12 {
        let shift = [0.618 * f64::from(step) * h; D];
        mpm.basis.place(shift, h).unwrap();
        mpm.step(&control).unwrap();
        for (origin, spacing) in [([0.0; D], h), (shift, 1.3 * h)] {
            let mut basis = make(origin, spacing);
            let what = format!("{name}, D = {D}, step {step}, origin {origin:?}");
            identities_hold(&mut *basis, &mpm.particles.positions, &gaussian, &what);
        }
    }
}

#[test]
fn nodal_forces_know_the_mean_and_the_covariance() {
    any_basis!(hold_at_every_step, 1);
    any_basis!(hold_at_every_step, 2);
    any_basis!(hold_at_every_step, 3);
    any_basis!(hold_at_every_step, 4);
}
