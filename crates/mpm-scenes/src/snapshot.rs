//! All particles at one instant, in the order of creation.

/// The state of all particles at one instant, as plain numbers for files and comparisons; entry k of every list belongs to the
/// particle created as number k.
///
/// Vectors have `dimension` entries per particle, tensors `dimension`², row by row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Snapshot {
    /// Number of axes D.
    pub dimension: usize,
    /// The instant t.
    pub time: f64,
    /// Reference positions X_p: where the particle was at t = 0.
    pub reference_positions: Vec<f64>,
    /// Positions x_p.
    pub positions: Vec<f64>,
    /// Velocities v_p.
    pub velocities: Vec<f64>,
    /// Cauchy stresses σ_p = τ_p / J_p.
    pub stresses: Vec<f64>,
    /// Cauchy stresses along each axis that fewer than three dimensions leave out, where nothing strains; 0 where the law does not know it. Empty in three dimensions.
    pub stresses_across: Vec<f64>,
    /// Deformation gradients F_p.
    pub deformation_gradients: Vec<f64>,
    /// Volume ratios J_p: det F_p, and what plastic flow of the law has of the volume.
    pub volume_ratios: Vec<f64>,
    /// Masses m_p.
    pub masses: Vec<f64>,
    /// Reference volumes V⁰_p.
    pub reference_volumes: Vec<f64>,
    /// Numbers of the bodies, in the order of the scene.
    pub bodies: Vec<u32>,
    /// Numbers of the materials, in the order of their names.
    pub materials: Vec<u32>,
    /// One number for every particle, by name: what the laws remember, as in `plastic_strain` (zero for particles of other laws), and with a barrier the normal `contact_force`.
    pub scalars: Vec<(String, Vec<f64>)>,
}

impl Snapshot {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.masses.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.masses.is_empty()
    }

    /// The D entries of a particle in a list of vectors.
    pub fn vector<'a>(&self, list: &'a [f64], particle: usize) -> Option<&'a [f64]> {
        list.get(particle * self.dimension..(particle + 1) * self.dimension)
    }

    /// The D² entries of a particle in a list of tensors.
    pub fn tensor<'a>(&self, list: &'a [f64], particle: usize) -> Option<&'a [f64]> {
        let size = self.dimension * self.dimension;
        list.get(particle * size..(particle + 1) * size)
    }
}
