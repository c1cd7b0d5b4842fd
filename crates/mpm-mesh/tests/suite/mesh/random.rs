//! Random shapes, sizes and numberings.

use mpm_mesh::generate::{self, EdgeTarget, with_outer_layer};
use mpm_mesh::{Rings, SimplexMesh};
use proptest::prelude::*;

use super::conformance;
use super::samples::{self, polygon_area, sample};

/// Star-shaped polygons: corners at increasing angles and any radius from 0.6 to 1.6.
fn polygons() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec(0.6..1.6f64, 5..12).prop_map(|radii| {
        let step = std::f64::consts::TAU / radii.len() as f64;
        let corner = |(k, radius): (usize, &f64)| [radius * (k as f64 * step).cos(), radius * (k as f64 * step).sin()];
        radii.iter().enumerate().map(corner).collect()
    })
}

/// The mesh with vertices and cells in another order, and the vertices of each cell turned.
fn renumbered<const D: usize>(mesh: &SimplexMesh<D>, seed: u64) -> (SimplexMesh<D>, Vec<usize>, Vec<usize>) {
    let shuffled = |count: usize, seed: u64| {
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|&k| {
            (k as u64 + 1)
                .wrapping_mul(seed | 1)
                .wrapping_mul(0x9E37_79B9_7F4A_7C15)
                >> 7
        });
        order
    };
    let vertices = shuffled(mesh.vertices().len(), seed);
    let cells = shuffled(mesh.cell_count(), seed ^ 0xABCD);
    let mut numbers = vec![0u32; vertices.len()];
    (0u32..).zip(&vertices).for_each(|(new, &old)| numbers[old] = new);
    let mut list = Vec::new();
    for &cell in &cells {
        let mut members: Vec<u32> = mesh.cell(cell).iter().map(|&v| numbers[v as usize]).collect();
        // Even permutations only.
        match D {
            1 => {}
            _ => members[..3].rotate_left(cell % 3),
        }
        list.extend(members);
    }
    let positions = vertices.iter().map(|&v| mesh.vertices()[v]).collect();
    (
        SimplexMesh::new(positions, list).expect("the same mesh"),
        vertices,
        cells,
    )
}

/// Points that came and went in turn, until the last round was one with an edge of 1.56 h.
#[test]
fn edges_of_a_polygon_do_not_stay_long() {
    let radii = [0.7658, 1.2505, 1.1517, 1.2341, 0.7083, 0.8321, 0.7215, 1.3116];
    let corners: Vec<_> = (0..8)
        .map(|k| {
            let (sine, cosine) = (std::f64::consts::FRAC_PI_4 * k as f64).sin_cos();
            [radii[k] * cosine, radii[k] * sine]
        })
        .collect();
    let length = 0.370_73;
    let mesh = generate::polygon(&corners, &EdgeTarget { length, angle: 1.1423 }).expect("a mesh");
    assert!(mesh.edge_lengths().longest <= 1.5 * length);
}

fn same_geometry<const D: usize>(mesh: &SimplexMesh<D>, seed: u64) {
    let (other, vertices, cells) = renumbered(mesh, seed);
    let (rings, others) = (Rings::new(mesh), Rings::new(&other));
    for (new, &old) in cells.iter().enumerate() {
        assert!((mesh.volume(old) - other.volume(new)).abs() < 1e-14 + 1e-12 * mesh.volume(old));
        let (quality, same) = (mesh.quality(old), other.quality(new));
        assert!((quality.radius_ratio - same.radius_ratio).abs() < 1e-9);
        let mut ring: Vec<u32> = others.ring(new).iter().map(|&v| vertices[v as usize] as u32).collect();
        ring.sort_unstable();
        assert_eq!(rings.ring(old), ring);
    }
    let (lengths, same) = (mesh.edge_lengths(), other.edge_lengths());
    assert_eq!((lengths.shortest, lengths.longest), (same.shortest, same.longest));
    let area = |mesh: &SimplexMesh<D>| mesh.boundary().iter().map(|facet| facet.area).sum::<f64>();
    assert!((area(mesh) - area(&other)).abs() < 1e-9 * area(mesh));
    let boundary = mesh.on_boundary();
    assert!(
        other
            .on_boundary()
            .iter()
            .zip(&vertices)
            .all(|(&mark, &old)| mark == boundary[old])
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn polygons_are_filled(corners in polygons(), length in 0.1..0.4f64, angle in -4.0..4.0f64) {
        let target = EdgeTarget { length, angle };
        let mesh = generate::polygon(&corners, &target).expect("a mesh");
        prop_assert!(mesh.edge_lengths().longest <= 1.5 * length);
        let again = generate::polygon(&corners, &target).expect("a mesh");
        prop_assert_eq!(&again, &mesh);
        let (whole, layer) = with_outer_layer(&mesh).expect("a layer");
        prop_assert!(!whole.on_boundary()[..layer.first_vertex].contains(&true));
        conformance::check(&sample("polygon", mesh, polygon_area(&corners), 1));
    }

    #[test]
    fn the_way_round_does_not_matter(corners in polygons()) {
        let target = EdgeTarget { length: 0.3, angle: 0.0 };
        let reversed: Vec<[f64; 2]> = corners.iter().rev().copied().collect();
        let mesh = generate::polygon(&reversed, &target).expect("a mesh");
        conformance::check(&sample("reversed", mesh, polygon_area(&corners), 1));
    }

    #[test]
    fn intervals_of_any_sizes(sizes in prop::collection::vec(1e-3..10.0f64, 1..40), start in -5.0..5.0f64) {
        let mesh = generate::segments(start, &sizes).expect("segments");
        for (cell, size) in sizes.iter().enumerate() {
            prop_assert!((mesh.volume(cell) - size).abs() < 1e-12);
        }
        let volume = sizes.iter().sum();
        conformance::check(&sample("segments", mesh.clone(), volume, 1));
        let (whole, _) = with_outer_layer(&mesh).expect("a layer");
        prop_assert_eq!(whole.cell_count(), sizes.len() + 2);
    }

    #[test]
    fn boxes_and_balls_of_any_size(extents in prop::array::uniform3(0.3..2.0f64), length in 0.4..1.0f64) {
        let cuboid = generate::cuboid([0.0; 3], extents, length).expect("a box");
        with_outer_layer(&cuboid).expect("a layer");
        conformance::check(&sample("cuboid", cuboid, extents.iter().product(), 1));
        let ball = generate::ball(extents, 1.0, length).expect("a ball");
        with_outer_layer(&ball).expect("a layer");
    }

    #[test]
    fn numbering_does_not_matter(seed in any::<u64>()) {
        samples::one_dimensional().iter().for_each(|sample| same_geometry(&sample.mesh, seed));
        samples::two_dimensional().iter().for_each(|sample| same_geometry(&sample.mesh, seed));
        samples::three_dimensional().iter().for_each(|sample| same_geometry(&sample.mesh, seed));
    }
}
