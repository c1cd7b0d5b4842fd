//! A run on its way as plain numbers.

use mpm_core::{Masses, MpmError, Particles};
use mpm_materials::Memory;
use mpm_tensor::Matrix;
use serde::{Deserialize, Serialize};

use crate::law::LawState;
use crate::run::budget;

/// All that a run needs to go on. Scene, bodies and forces are built again.
#[derive(Default, Serialize, Deserialize)]
pub(in crate::run) struct Saved {
    /// The program's version and the scene's text.
    pub identity: String,
    /// Steps taken.
    pub step: u64,
    /// Time reached.
    pub time: f64,
    /// The last Δt that no event had cut short.
    pub free_step: f64,
    /// Rows of the series.
    pub rows: usize,
    /// Fingerprint of the mesh's file, where there is one; checkpoints of earlier versions have none.
    #[serde(default)]
    pub mesh_contents: Option<u64>,
    /// The energy budget, where there is one.
    #[serde(default)]
    pub budget: Option<budget::Saved>,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    masses: Vec<f64>,
    affine: Vec<f64>,
    deformation_gradients: Vec<f64>,
    velocity_gradients: Vec<f64>,
    reference_volumes: Vec<f64>,
    laws: Vec<u32>,
    memories: Vec<[f64; 2]>,
    identities: Vec<u32>,
}

impl Saved {
    /// The particles in their present order, and nothing else.
    pub fn of<const D: usize>(particles: &Particles<D, LawState>) -> Self {
        Self {
            positions: particles.positions.as_flattened().to_vec(),
            velocities: particles.velocities.as_flattened().to_vec(),
            masses: (0..particles.len()).map(|p| particles.masses.get(p)).collect(),
            affine: numbers(&particles.affine),
            deformation_gradients: numbers(&particles.deformation_gradients),
            velocity_gradients: numbers(&particles.velocity_gradients),
            reference_volumes: particles.reference_volumes.clone(),
            laws: particles.states.iter().map(|state| state.law).collect(),
            memories: particles.states.iter().map(|state| state.memory.0).collect(),
            identities: particles.identities().to_vec(),
            ..Self::default()
        }
    }

    /// The particles again, to the bit.
    ///
    /// # Errors
    /// [`MpmError`] for lists that do not fit together.
    pub fn particles<const D: usize>(self) -> Result<Particles<D, LawState>, MpmError> {
        let particles = Particles::in_order(
            self.positions.as_chunks().0.to_vec(),
            self.velocities.as_chunks().0.to_vec(),
            Masses::Each(self.masses),
            matrices(&self.affine),
            self.identities,
        )?;
        let states = self.laws.iter().zip(&self.memories);
        let states = states.map(|(&law, &memory)| LawState {
            law,
            memory: Memory(memory),
        });
        let mut particles = particles.with_states(self.reference_volumes, states.collect());
        particles.deformation_gradients = matrices(&self.deformation_gradients);
        particles.velocity_gradients = matrices(&self.velocity_gradients);
        Ok(particles)
    }
}

fn numbers<const D: usize>(matrices: &[Matrix<D>]) -> Vec<f64> {
    matrices.iter().flat_map(|matrix| matrix.0).flatten().collect()
}

fn matrices<const D: usize>(numbers: &[f64]) -> Vec<Matrix<D>> {
    let rows: &[[f64; D]] = numbers.as_chunks().0;
    rows.as_chunks::<D>().0.iter().map(|&rows| Matrix(rows)).collect()
}
