//! A block of Neo-Hookean material on an unstructured mesh, which turns and is stretched.

use mpm_core::{Apic, Continuum, Medium, Mpm, NoBodyForce, Particles};
use mpm_materials::{ElasticModuli, NeoHookean};
use mpm_mesh::generate::{EdgeTarget, cuboid, rectangle};
use mpm_mesh::{MeshBasis, SimplexMesh};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

/// A block on a mesh.
pub type MeshBlock<const D: usize> = Mpm<D, MeshBasis<D>, Apic, Continuum<NeoHookean>, NoBodyForce>;

/// Half the edge of the block: when it has turned, its corners are still inside the mesh.
const HALF: f64 = 0.32;

/// The unit square in triangles with edges of about `length`.
pub fn square(length: f64) -> SimplexMesh<2> {
    rectangle([0.0; 2], [1.0; 2], &EdgeTarget { length, angle: 0.0 }).expect("a square")
}

/// The unit cube in tetrahedra with edges of about `length`.
pub fn cube(length: f64) -> SimplexMesh<3> {
    cuboid([0.0; 3], [1.0; 3], length).expect("a cube")
}

/// `per_cell` particles in every cell whose centre is at most 0.32 from the middle along each axis, uniformly in the cell at random. E = 10⁵, ν = 0.3,
/// ρ₀ = 1000 (so that c = 11.6); the velocity is a rotation that reaches 0.15 c at the middle of a face, and a stretching of a fifth of it.
pub fn block<const D: usize>(mesh: &SimplexMesh<D>, per_cell: usize) -> MeshBlock<D> {
    let medium = Continuum {
        law: NeoHookean::new(ElasticModuli::new(1e5, 0.3).expect("in range")),
    };
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let (mut positions, mut volumes) = (Vec::new(), Vec::new());
    for (number, cell) in mesh.cells().enumerate() {
        let mean = |shares: &[f64]| -> [f64; D] {
            let total: f64 = shares.iter().sum();
            let along = |a: usize| {
                cell.iter()
                    .zip(shares)
                    .map(|(&v, s)| s * mesh.vertices()[v as usize][a])
                    .sum::<f64>()
            };
            std::array::from_fn(|a| along(a) / total)
        };
        if mean(&vec![1.0; D + 1]).iter().all(|c| (c - 0.5).abs() < HALF) {
            for _ in 0..per_cell {
                let shares: Vec<f64> = (0..=D).map(|_| -(1.0 - random.random::<f64>()).ln()).collect();
                positions.push(mean(&shares));
                volumes.push(mesh.volume(number) / per_cell as f64);
            }
        }
    }
    let (count, total) = (positions.len(), volumes.iter().sum::<f64>());
    let mut particles =
        Particles::at_rest(positions, 1000.0 * total).with_elastic_state(vec![total / count as f64; count]);
    let rate = 0.15 * medium.wave_speed(&particles).expect("at rest") / HALF;
    for (x, v) in particles.positions.iter().zip(&mut particles.velocities) {
        let r = x.map(|c| c - 0.5);
        *v = r.map(|c| 0.1 * rate * c);
        if D > 1 {
            (v[0], v[1]) = (rate * (0.2 * r[0] - r[1]), rate * (r[0] - 0.2 * r[1]));
        }
    }
    Mpm::new(
        particles,
        MeshBasis::new(mesh).expect("a mesh"),
        Apic,
        medium,
        NoBodyForce,
    )
}
