//! Random states of a material.
#![allow(dead_code)]

pub use mpm_materials::conformance::{derivative_of, stiffness_of};
use mpm_tensor::{Matrix, Polar, vector};
use proptest::prelude::*;

/// Blocks 0 to 2 of 16 numbers make deformation and rotations, the third and fourth directions, those from 5 on steps.
const NUMBERS: usize = 16 * (FIRST_STEP + STEPS);
const FIRST_STEP: usize = 5;

/// The number of steps of a walk.
pub const STEPS: usize = 8;

/// A random state: moduli, deformation, rotation and two directions, for any D ≤ 4.
#[derive(Clone, Debug)]
pub struct Sample {
    pub young_modulus: f64,
    pub poisson_ratio: f64,
    pub reference_density: f64,
    pub numbers: Vec<f64>,
}

pub fn sample() -> impl Strategy<Value = Sample> {
    let numbers = prop::collection::vec(-1.0..1.0, NUMBERS);
    (0.1..10.0, -0.2..0.45, 0.2..5.0, numbers).prop_map(|(young_modulus, poisson_ratio, reference_density, numbers)| {
        Sample {
            young_modulus,
            poisson_ratio,
            reference_density,
            numbers,
        }
    })
}

impl Sample {
    pub fn block<const D: usize>(&self, index: usize) -> Matrix<D> {
        Matrix::from_fn(|i, j| self.numbers[16 * index + D * i + j])
    }

    /// A stretch with principal values in [0.4, 1.6] after a rotation.
    pub fn deformation<const D: usize>(&self) -> Matrix<D> {
        let perturbation = self.block::<D>(0).symmetric_part() * (0.6 / D as f64);
        rotation(&self.block(1)) * (Matrix::IDENTITY + perturbation)
    }

    /// The increment Δt L of a step of a walk.
    pub fn increment<const D: usize>(&self, step: usize) -> Matrix<D> {
        self.block::<D>(FIRST_STEP + step) * (0.2 / D as f64)
    }

    pub fn direction<const D: usize>(&self, index: usize) -> [f64; D] {
        let v: [f64; D] = std::array::from_fn(|i| self.numbers[32 + D * index + i] + 1e-3);
        vector::scale(&v, 1.0 / vector::norm(&v))
    }
}

pub fn rotation<const D: usize>(matrix: &Matrix<D>) -> Matrix<D> {
    Polar::new(matrix).expect("finite entries").rotation
}

/// ρ₀ c² is the stiffness at rest, to `tolerance`.
pub fn is_exact_at_rest<const D: usize>(
    name: &str,
    modulus_of_speed: f64,
    stiffness: f64,
    tolerance: f64,
) -> Result<(), TestCaseError> {
    let error = modulus_of_speed - stiffness;
    prop_assert!(error.abs() < tolerance, "{name}, D = {D}: off by {error:e} at rest");
    Ok(())
}
