//! What every mesh satisfies.

use std::collections::BTreeSet;

use mpm_mesh::{NO_CELL, SimplexMesh};
use mpm_tensor::vector::{accumulate, dot, norm, subtract};

use super::samples::{self, Sample};

#[test]
fn every_mesh_in_every_dimension() {
    samples::one_dimensional().iter().for_each(check);
    samples::two_dimensional().iter().for_each(check);
    samples::three_dimensional().iter().for_each(check);
}

pub fn check<const D: usize>(sample: &Sample<D>) {
    let Sample {
        name,
        mesh,
        volume,
        euler,
    } = sample;
    let relative = (mesh.total_volume() - volume).abs() / volume;
    assert!(relative < 1e-12, "{name}: volume {} ≠ {volume}", mesh.total_volume());
    assert!((0..mesh.cell_count()).all(|cell| mesh.volume(cell) > 0.0), "{name}");
    assert_eq!(euler_characteristic(mesh), *euler, "{name}");
    // Construction checks everything else that a mesh promises; a second time for meshes made by other ways.
    let again = SimplexMesh::new(mesh.vertices().to_vec(), mesh.cells().flatten().copied().collect());
    assert_eq!(again.as_ref(), Ok(mesh), "{name}");
    neighbours_are_symmetric(mesh, name);
    boundary_is_closed(mesh, name);
    barycentric_coordinates(mesh, name);
    qualities(mesh, name);
}

/// χ = Σ_k (−1)^k (number of k-simplices).
fn euler_characteristic<const D: usize>(mesh: &SimplexMesh<D>) -> i64 {
    let mut simplices = BTreeSet::new();
    for cell in mesh.cells() {
        for mask in 1u32..1 << (D + 1) {
            let mut part: Vec<u32> = (0..=D).filter(|k| mask >> k & 1 == 1).map(|k| cell[k]).collect();
            part.sort_unstable();
            simplices.insert(part);
        }
    }
    simplices
        .iter()
        .map(|part| if part.len() % 2 == 1 { 1 } else { -1 })
        .sum()
}

fn neighbours_are_symmetric<const D: usize>(mesh: &SimplexMesh<D>, name: &str) {
    for cell in 0..mesh.cell_count() {
        for (k, &neighbour) in mesh.neighbours(cell).iter().enumerate() {
            let facet = |cell: usize, k: usize| -> BTreeSet<u32> {
                let others = mesh.cell(cell).iter().enumerate().filter(|&(place, _)| place != k);
                others.map(|(_, &vertex)| vertex).collect()
            };
            let own = facet(cell, k);
            let owners = mesh.cells().filter(|members| own.iter().all(|v| members.contains(v)));
            assert_eq!(owners.count(), 1 + usize::from(neighbour != NO_CELL), "{name}");
            if neighbour != NO_CELL {
                let back = mesh.neighbours(neighbour as usize);
                let place = back.iter().position(|&other| other as usize == cell);
                let place = place.unwrap_or_else(|| panic!("{name}: {neighbour} does not know {cell}"));
                assert_eq!(own, facet(neighbour as usize, place), "{name}");
            }
        }
    }
}

/// Σ A n = 0, and the divergence theorem for the field x: Σ A n · x_c = D V, with x_c the facet's centroid.
fn boundary_is_closed<const D: usize>(mesh: &SimplexMesh<D>, name: &str) {
    let (mut sum, mut flux, mut total) = ([0.0; D], 0.0, 0.0);
    let mut marks = vec![false; mesh.vertices().len()];
    for facet in mesh.boundary() {
        assert!((norm(&facet.normal) - 1.0).abs() < 1e-12, "{name}");
        let mut centroid = [0.0; D];
        for &vertex in &facet.vertices {
            accumulate(&mut centroid, 1.0 / D as f64, &mesh.vertices()[vertex as usize]);
            marks[vertex as usize] = true;
        }
        let opposite = mesh.vertices()[mesh.cell(facet.cell as usize)[facet.opposite] as usize];
        assert!(dot(&facet.normal, &subtract(&opposite, &centroid)) < 0.0, "{name}");
        assert!(dot(&turn(mesh, &facet.vertices), &facet.normal) > 0.0, "{name}");
        accumulate(&mut sum, facet.area, &facet.normal);
        flux += facet.area * dot(&facet.normal, &centroid);
        total += facet.area;
    }
    assert!(norm(&sum) < 1e-11 * total, "{name}: {sum:?}");
    let volume = mesh.total_volume();
    assert!((flux - D as f64 * volume).abs() < 1e-10 * volume.max(total), "{name}");
    assert_eq!(marks, mesh.on_boundary(), "{name}");
}

/// The normal that the order of a facet's vertices says.
fn turn<const D: usize>(mesh: &SimplexMesh<D>, facet: &[u32; D]) -> [f64; D] {
    let edge = |k: usize| subtract(&mesh.vertices()[facet[k] as usize], &mesh.vertices()[facet[0] as usize]);
    std::array::from_fn(|axis| match D {
        2 => [edge(1)[D - 1], -edge(1)[0]][axis],
        3 => {
            let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
            edge(1)[a] * edge(2)[b] - edge(1)[b] * edge(2)[a]
        }
        // A point has no order.
        _ => {
            mesh.boundary()
                .iter()
                .find(|f| f.vertices == *facet)
                .expect("it")
                .normal[axis]
        }
    })
}

fn barycentric_coordinates<const D: usize>(mesh: &SimplexMesh<D>, name: &str) {
    for cell in 0..mesh.cell_count() {
        let frame = mesh.frame(cell);
        let mut sum = [0.0; D];
        for k in 0..=D {
            for (j, &vertex) in mesh.cell(cell).iter().enumerate() {
                let coordinate = frame.coordinate(k, &mesh.vertices()[vertex as usize]);
                assert!((coordinate - f64::from(u8::from(j == k))).abs() < 1e-9, "{name}");
            }
            accumulate(&mut sum, 1.0, &frame.gradient(k));
        }
        assert!(norm(&sum) < 1e-9 * norm(&frame.gradient(0)), "{name}");
    }
}

fn qualities<const D: usize>(mesh: &SimplexMesh<D>, name: &str) {
    let summary = mesh.quality_summary();
    for cell in 0..mesh.cell_count() {
        let quality = mesh.quality(cell);
        assert!(
            quality.radius_ratio > 0.0 && quality.radius_ratio < 1.0 + 1e-12,
            "{name}"
        );
        assert!(quality.radius_ratio >= summary.worst.radius_ratio, "{name}");
        assert!(quality.smallest_angle >= summary.worst.smallest_angle, "{name}");
        assert!(quality.largest_angle <= summary.worst.largest_angle, "{name}");
    }
}
