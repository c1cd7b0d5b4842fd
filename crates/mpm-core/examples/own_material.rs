//! A material of one's own: an elastic bar that is held at a wall, and its period beside the exact one.
//!
//!     cargo run --release -p mpm-core --example own_material

// F, E, S and P are the symbols of the field.
#![allow(clippy::print_stdout, non_snake_case)]

use mpm_core::{Apic, Boundaries, Contact, Continuum, Mpm, NoBodyForce, Particles, Plane, SplineGrid, StepControl};
use mpm_kernels::Quadratic;
use mpm_materials::{Material, conformance};
use mpm_tensor::Matrix;

/// St. Venant and Kirchhoff's law: ψ = λ/2 (tr E)² + μ E : E with Green's strain E = (Fᵀ F − I)/2, S = λ tr E I + 2 μ E, P = F S.
struct SaintVenantKirchhoff {
    lambda: f64,
    mu: f64,
}

impl SaintVenantKirchhoff {
    /// No number of what is turned inside out, which E alone cannot tell: the step then names the particle.
    fn strain<const D: usize>(F: &Matrix<D>) -> Matrix<D> {
        if F.determinant() > 0.0 {
            (F.transpose() * *F - Matrix::IDENTITY) * 0.5
        } else {
            Matrix([[f64::NAN; D]; D])
        }
    }
}

impl<const D: usize> Material<D> for SaintVenantKirchhoff {
    fn energy_density(&self, F: &Matrix<D>) -> f64 {
        let E = Self::strain(F);
        0.5 * self.lambda * E.trace().powi(2) + self.mu * E.contract(&E)
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<D>) -> Matrix<D> {
        let E = Self::strain(F);
        *F * (Matrix::IDENTITY * (self.lambda * E.trace()) + E * (2.0 * self.mu))
    }

    fn kirchhoff_stress(&self, F: &Matrix<D>) -> Matrix<D> {
        self.first_piola_kirchhoff(F) * F.transpose()
    }

    /// ρ₀ c² ≤ (λ + 2 μ) tr(B)² + |τ| with B = F Fᵀ, since a·B n is at most its trace.
    fn wave_speed(&self, F: &Matrix<D>, reference_density: f64) -> f64 {
        let stress: f64 = self.kirchhoff_stress(F).frobenius_norm();
        let stretch = (*F * F.transpose()).trace();
        (((self.lambda + 2.0 * self.mu) * stretch * stretch + stress) / reference_density).sqrt()
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (length, width, spacing, young_modulus) = (10.0, 1.0, 0.25, 100.0);
    let material = SaintVenantKirchhoff {
        lambda: 0.0,
        mu: young_modulus / 2.0,
    };
    // What the step relies on, before it does.
    let bent = Matrix([[1.05, 0.1], [-0.02, 0.98]]);
    conformance::stress_is_the_derivative_of_energy(&material, &bent, young_modulus, "own");
    conformance::wave_speed_bounds_stiffness(&material, &bent, 1.0, young_modulus, "own");
    conformance::undefined_is_not_finite::<2>(&material, "own");

    // Four particles in a cell, which begin to move as the first mode does.
    let apart = spacing / 2.0;
    let (columns, rows) = ((length / apart) as u32, (width / apart) as u32);
    let place = |k: u32| [f64::from(k % columns) + 0.5, f64::from(k / columns) + 0.5].map(|c| apart * c);
    let positions: Vec<[f64; 2]> = (0..columns * rows).map(place).collect();
    let volumes = vec![apart * apart; positions.len()];
    let mut particles = Particles::at_rest(positions.clone(), length * width).with_elastic_state(volumes);
    for (velocity, x) in particles.velocities.iter_mut().zip(&positions) {
        velocity[0] = 0.01 * (0.5 * std::f64::consts::PI * x[0] / length).sin();
    }
    let wall = Plane {
        point: [0.0; 2],
        normal: [1.0, 0.0],
        contact: Contact::Stick,
        velocity: [0.0; 2],
    };
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0, 0.0], spacing)?;
    let mut bar = Mpm::new(particles, grid, Apic, Continuum { law: material }, NoBodyForce)
        .with_boundary(Boundaries::new(vec![wall], vec![]));
    let control = StepControl {
        time_step: 1.0,
        courant: 0.2,
        displacement: f64::INFINITY,
        friction: 0.0,
    };

    // Half a period lies between two changes of the sign of the momentum.
    let mut turns = Vec::new();
    let mut before = (0.0, 1.0);
    while turns.len() < 11 {
        bar.step(&control)?;
        let momentum: f64 = bar.particles.velocities.iter().map(|v| v[0]).sum();
        if momentum * before.1 < 0.0 {
            turns.push(before.0 + (bar.time - before.0) * before.1 / (before.1 - momentum));
        }
        before = (bar.time, momentum);
    }
    let period = (turns[10] - turns[0]) / 5.0;
    let exact = 4.0 * length / young_modulus.sqrt();
    println!(
        "period {period:.4}, exact {exact:.4}: {:.2} % off",
        100.0 * (period / exact - 1.0)
    );
    Ok(())
}
