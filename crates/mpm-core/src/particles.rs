//! Particles as structure of arrays; a field that a scene does not use is an empty vector.

use mpm_tensor::{Matrix, vector};

use crate::MpmError;
use crate::error::within;
use crate::largest::larger_or_nan;

/// Particle masses, ≥ 0.
#[derive(Clone, Debug, PartialEq)]
pub enum Masses {
    /// All the same; nothing is stored per particle.
    Equal(f64),
    /// One each.
    Each(Vec<f64>),
}

impl Masses {
    /// Mass m_p; not a number for a particle that has none.
    #[inline(always)]
    pub fn get(&self, particle: usize) -> f64 {
        match self {
            Self::Equal(mass) => *mass,
            Self::Each(masses) => masses.get(particle).copied().unwrap_or(f64::NAN),
        }
    }
}

/// State of M particles. Positions and velocities always exist; the other fields only where a scene needs them. `S` are the
/// internal variables of a material with memory.
#[derive(Clone, Debug)]
pub struct Particles<const D: usize, S = ()> {
    /// x_p.
    pub positions: Vec<[f64; D]>,
    /// v_p.
    pub velocities: Vec<[f64; D]>,
    /// m_p.
    pub masses: Masses,
    /// B_p, the affine velocity moment of APIC; empty without APIC.
    pub affine: Vec<Matrix<D>>,
    /// F_p; empty for media without elasticity.
    pub deformation_gradients: Vec<Matrix<D>>,
    /// V⁰_p, reference volume; empty for media without elasticity.
    pub reference_volumes: Vec<f64>,
    /// Internal variables of the material; empty for media without elasticity.
    pub states: Vec<S>,
    /// L_p = ∇v at the particle; empty unless the stress depends on it.
    pub velocity_gradients: Vec<Matrix<D>>,
    /// Number of the particle in the order of creation.
    identities: Vec<u32>,
    scratch: Scratch<D, S>,
}

/// Buffers for the reordering, kept between steps.
#[derive(Clone, Debug)]
struct Scratch<const D: usize, S> {
    vectors: Vec<[f64; D]>,
    matrices: Vec<Matrix<D>>,
    scalars: Vec<f64>,
    indices: Vec<u32>,
    states: Vec<S>,
}

impl<const D: usize, S> Default for Scratch<D, S> {
    fn default() -> Self {
        Self {
            vectors: Vec::new(),
            matrices: Vec::new(),
            scalars: Vec::new(),
            indices: Vec::new(),
            states: Vec::new(),
        }
    }
}

impl<const D: usize> Particles<D> {
    /// Particles at rest with equal masses that sum to `total_mass`.
    pub fn at_rest(positions: Vec<[f64; D]>, total_mass: f64) -> Self {
        let count = positions.len();
        Self {
            velocities: vec![[0.0; D]; count],
            masses: Masses::Equal(total_mass / count.max(1) as f64),
            affine: Vec::new(),
            deformation_gradients: Vec::new(),
            reference_volumes: Vec::new(),
            states: Vec::new(),
            velocity_gradients: Vec::new(),
            identities: (0..count as u32).collect(),
            scratch: Scratch::default(),
            positions,
        }
    }

    /// Particles in any order: entry k of every field is of the particle that was created as number `identities[k]`.
    ///
    /// # Errors
    /// [`MpmError::FieldLength`] unless all fields (but an empty `affine`) have one entry per particle;
    /// [`MpmError::InvalidParameter`] for an identity that is out of range or given twice.
    pub fn in_order(
        positions: Vec<[f64; D]>,
        velocities: Vec<[f64; D]>,
        masses: Masses,
        affine: Vec<Matrix<D>>,
        identities: Vec<u32>,
    ) -> Result<Self, MpmError> {
        let mut seen = vec![false; identities.len()];
        for &identity in &identities {
            match seen.get_mut(identity as usize) {
                Some(seen) if !*seen => *seen = true,
                _ => {
                    return Err(MpmError::InvalidParameter {
                        field: "identities",
                        value: f64::from(identity),
                        expected: "each number below that of the particles once",
                    });
                }
            }
        }
        let particles = Self {
            positions,
            velocities,
            masses,
            affine,
            deformation_gradients: Vec::new(),
            reference_volumes: Vec::new(),
            states: Vec::new(),
            velocity_gradients: Vec::new(),
            identities,
            scratch: Scratch::default(),
        };
        particles.check_lengths(false, false, false)?;
        Ok(particles)
    }

    /// Add the field F_p = I and the reference volumes V⁰_p, one per particle in the present order, for a material without
    /// memory.
    pub fn with_elastic_state(mut self, reference_volumes: Vec<f64>) -> Self {
        self.deformation_gradients = vec![Matrix::IDENTITY; self.len()];
        self.reference_volumes = reference_volumes;
        self.states = vec![(); self.len()];
        self
    }

    /// As [`with_elastic_state`](Self::with_elastic_state), for a material with the internal variables `states`, one per particle in the
    /// present order.
    pub fn with_states<S>(self, reference_volumes: Vec<f64>, states: Vec<S>) -> Particles<D, S> {
        Particles {
            deformation_gradients: vec![Matrix::IDENTITY; self.len()],
            reference_volumes,
            states,
            ..self.remembering()
        }
    }

    /// The same particles for a program whose other media have internal variables of type `S`; of these there are none.
    pub fn remembering<S>(self) -> Particles<D, S> {
        Particles {
            states: Vec::new(),
            scratch: Scratch::default(),
            positions: self.positions,
            velocities: self.velocities,
            masses: self.masses,
            affine: self.affine,
            deformation_gradients: self.deformation_gradients,
            reference_volumes: self.reference_volumes,
            velocity_gradients: self.velocity_gradients,
            identities: self.identities,
        }
    }
}

impl<const D: usize, S: Copy + Send + Sync> Particles<D, S> {
    /// Whether every field has one entry per particle; fields that a scene does not use may be empty.
    pub(crate) fn check_lengths(&self, affine: bool, deforms: bool, rates: bool) -> Result<(), MpmError> {
        let expected = self.identities.len();
        let masses = match &self.masses {
            Masses::Equal(_) => expected,
            Masses::Each(masses) => masses.len(),
        };
        let fields = [
            ("positions", self.positions.len(), true),
            ("velocities", self.velocities.len(), true),
            ("masses", masses, true),
            ("affine", self.affine.len(), affine),
            ("deformation_gradients", self.deformation_gradients.len(), deforms),
            ("reference_volumes", self.reference_volumes.len(), deforms),
            ("states", self.states.len(), deforms),
            ("velocity_gradients", self.velocity_gradients.len(), rates),
        ];
        for (field, length, used) in fields {
            if length != expected && (used || length > 0) {
                return Err(MpmError::FieldLength {
                    field,
                    length,
                    expected,
                });
            }
        }
        Ok(())
    }

    /// Whether no mass is below 0; what one that is no number does is found at the nodes.
    pub(crate) fn check_masses(&self) -> Result<(), MpmError> {
        let masses = match &self.masses {
            Masses::Equal(mass) => std::slice::from_ref(mass),
            Masses::Each(masses) => masses,
        };
        let negative = masses.iter().find(|mass| **mass < 0.0);
        negative.map_or(Ok(()), |&mass| within("masses", mass, false, "at least 0"))
    }

    /// Number of particles M.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// Numbers of the particles in the order of creation, in the present order.
    pub fn identities(&self) -> &[u32] {
        &self.identities
    }

    /// Number, in the order of creation, of the particle that stands at `index` < [`len`](Self::len).
    pub fn identity(&self, index: usize) -> usize {
        self.identities[index] as usize
    }

    /// An error that speaks of the particle by its number in the order of creation.
    pub(crate) fn name(&self, error: MpmError) -> MpmError {
        let created = |index: usize| self.identities.get(index).map_or(index, |&identity| identity as usize);
        match error {
            MpmError::PositionOutOfRange {
                particle,
                position,
                spacing,
            } => MpmError::PositionOutOfRange {
                particle: created(particle),
                position,
                spacing,
            },
            MpmError::OutsideDomain {
                particle,
                position,
                lower,
                upper,
            } => MpmError::OutsideDomain {
                particle: created(particle),
                position,
                lower,
                upper,
            },
            MpmError::OutsideMesh { particle, position } => MpmError::OutsideMesh {
                particle: created(particle),
                position,
            },
            MpmError::Penetration { particle, distance } => MpmError::Penetration {
                particle: created(particle),
                distance,
            },
            MpmError::Deformation { particle, source } => MpmError::Deformation {
                particle: created(particle),
                source,
            },
            MpmError::WaveSpeed {
                particle,
                wave_speed,
                mass,
                reference_volume,
            } => MpmError::WaveSpeed {
                particle: created(particle),
                wave_speed,
                mass,
                reference_volume,
            },
            MpmError::BodyForceNotFinite { index, position, value } => MpmError::BodyForceNotFinite {
                index: created(index),
                position,
                value,
            },
            other => other,
        }
    }

    /// A field in the order of creation. A field that does not exist stays empty.
    pub fn in_creation_order<T: Copy>(&self, field: &[T]) -> Vec<T> {
        let mut sorted = field.to_vec();
        for (&value, &identity) in field.iter().zip(&self.identities) {
            if let Some(entry) = sorted.get_mut(identity as usize) {
                *entry = value;
            }
        }
        sorted
    }

    /// Put particle `order[k]` at place k, for every field that exists.
    pub(crate) fn reorder(&mut self, order: &[u32]) {
        let s = &mut self.scratch;
        permute(&mut self.positions, &mut s.vectors, order);
        permute(&mut self.velocities, &mut s.vectors, order);
        permute(&mut self.affine, &mut s.matrices, order);
        permute(&mut self.deformation_gradients, &mut s.matrices, order);
        permute(&mut self.velocity_gradients, &mut s.matrices, order);
        permute(&mut self.reference_volumes, &mut s.scalars, order);
        permute(&mut self.states, &mut s.states, order);
        permute(&mut self.identities, &mut s.indices, order);
        if let Masses::Each(masses) = &mut self.masses {
            permute(masses, &mut s.scalars, order);
        }
    }

    /// Largest speed max_p |v_p|; NaN if a velocity is.
    pub fn largest_speed(&self) -> f64 {
        let square = |v: &[f64; D]| v.iter().map(|c| c * c).sum::<f64>();
        let largest = |piece: &[[f64; D]]| piece.iter().map(square).fold(0.0, larger_or_nan);
        let pieces = mpm_parallel::map(self.velocities.chunks(SPEED_LENGTH), &largest);
        pieces.into_iter().fold(0.0, larger_or_nan).sqrt()
    }

    /// ½ Σ m_p |v_p|², without the affine part of the velocity.
    pub fn kinetic_energy(&self) -> f64 {
        let square = |v: &[f64; D]| v.iter().map(|c| c * c).sum::<f64>();
        let each = self.velocities.iter().enumerate();
        0.5 * each.map(|(p, v)| self.masses.get(p) * square(v)).sum::<f64>()
    }

    /// Σ m_p v_p.
    pub fn momentum(&self) -> [f64; D] {
        let mut sum = [0.0; D];
        for (p, v) in self.velocities.iter().enumerate() {
            vector::accumulate(&mut sum, self.masses.get(p), v);
        }
        sum
    }

    /// Σ m_p (x_a v_b − x_b v_a + B_ba − B_ab) about the origin; the affine part where there is one (Jiang et al. 2015, §5.3.1).
    ///
    /// # Panics
    ///
    /// Where a or b is not below D and there are particles, as an index of an array does.
    pub fn angular_momentum(&self, (a, b): (usize, usize)) -> f64 {
        let each = self.positions.iter().zip(&self.velocities).enumerate();
        each.map(|(p, (x, v))| {
            let affine = self.affine.get(p).map_or(0.0, |matrix| matrix.0[b][a] - matrix.0[a][b]);
            self.masses.get(p) * (x[a] * v[b] - x[b] * v[a] + affine)
        })
        .sum()
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        let vector = size_of::<[f64; D]>();
        let matrix = size_of::<Matrix<D>>();
        let scalars = self.reference_volumes.capacity()
            + self.scratch.scalars.capacity()
            + match &self.masses {
                Masses::Equal(_) => 0,
                Masses::Each(masses) => masses.capacity(),
            };
        vector * (self.positions.capacity() + self.velocities.capacity() + self.scratch.vectors.capacity())
            + matrix
                * (self.affine.capacity()
                    + self.deformation_gradients.capacity()
                    + self.velocity_gradients.capacity()
                    + self.scratch.matrices.capacity())
            + size_of::<S>() * (self.states.len() + self.scratch.states.len())
            + 8 * scalars
            + 4 * (self.identities.capacity() + self.scratch.indices.capacity())
    }
}

/// Entries of one piece of work.
const PERMUTE_LENGTH: usize = 1 << 13;
const SPEED_LENGTH: usize = 1 << 12;

fn permute<T: Copy + Send + Sync>(field: &mut Vec<T>, scratch: &mut Vec<T>, order: &[u32]) {
    let Some(&any) = field.first() else {
        return;
    };
    scratch.resize(order.len(), any);
    let from = field.as_slice();
    let pieces = scratch.chunks_mut(PERMUTE_LENGTH).zip(order.chunks(PERMUTE_LENGTH));
    mpm_parallel::each(pieces, &|(to, order): (&mut [T], &[u32])| {
        for (to, &index) in to.iter_mut().zip(order) {
            *to = from[index as usize];
        }
    });
    std::mem::swap(field, scratch);
}
