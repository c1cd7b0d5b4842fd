//! Meshes that tests run over.

use mpm_mesh::SimplexMesh;

/// A mesh with what is known of it.
pub struct Sample<const D: usize> {
    pub name: &'static str,
    pub mesh: SimplexMesh<D>,
    /// Exact volume.
    pub volume: f64,
    /// Vertices − edges + triangles − tetrahedra.
    pub euler: i64,
}

pub fn sample<const D: usize>(name: &'static str, mesh: SimplexMesh<D>, volume: f64, euler: i64) -> Sample<D> {
    Sample {
        name,
        mesh,
        volume,
        euler,
    }
}

/// The reference simplex.
pub fn unit<const D: usize>() -> SimplexMesh<D> {
    let vertices = (0..=D).map(|k| std::array::from_fn(|axis| f64::from(u8::from(axis + 1 == k))));
    SimplexMesh::new(vertices.collect(), (0..=D as u32).collect()).expect("a cell")
}

/// Two triangles of a unit square.
pub fn square() -> SimplexMesh<2> {
    let vertices = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    SimplexMesh::new(vertices, vec![0, 1, 2, 0, 2, 3]).expect("a square")
}

/// A square ring of eight triangles around a square hole: the outer side 3, the inner 1.
pub fn frame() -> SimplexMesh<2> {
    let corner = |size: f64| [[-size, -size], [size, -size], [size, size], [-size, size]];
    let vertices = [corner(1.5), corner(0.5)].concat();
    let cells = (0..4u32).flat_map(|k| {
        let next = (k + 1) % 4;
        [k, next, 4 + k, next, 4 + next, 4 + k]
    });
    SimplexMesh::new(vertices, cells.collect()).expect("a frame")
}

pub fn one_dimensional() -> Vec<Sample<1>> {
    let chain = SimplexMesh::new(vec![[0.0], [3.0], [1.0]], vec![0, 2, 2, 1]).expect("a chain");
    vec![sample("unit", unit(), 1.0, 1), sample("chain", chain, 3.0, 1)]
}

pub fn two_dimensional() -> Vec<Sample<2>> {
    vec![
        sample("unit", unit(), 0.5, 1),
        sample("square", square(), 1.0, 1),
        sample("frame", frame(), 8.0, 0),
    ]
}

pub fn three_dimensional() -> Vec<Sample<3>> {
    vec![sample("unit", unit(), 1.0 / 6.0, 1)]
}
