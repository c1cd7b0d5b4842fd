//! The search for cells against a look at all of them.

use crate::basis_scenes::{cloud, cube, generator, line};
use mpm_mesh::{CellSearch, SimplexMesh};
use mpm_tensor::vector::distance;
use rand::RngExt;

/// Points inside and outside, in random order, each looked for from the cell of the point before.
fn agrees<const D: usize>(mesh: &SimplexMesh<D>, extent: f64) {
    let search = CellSearch::new(mesh.clone());
    let mut near = None;
    for x in cloud::<D>(2000, -0.2 * extent, 1.2 * extent, 5) {
        let expected = search.locate_by_brute_force(&x);
        for from in [None, near] {
            let found = search.locate(&x, from);
            assert_eq!(
                found.map(|located| located.cell),
                expected,
                "D = {D}, {x:?} from {from:?}"
            );
        }
        near = expected.or(near);
    }
}

#[test]
fn agrees_with_brute_force() {
    agrees(&line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]), 3.0);
    agrees(&cube::<2>(12, 0.25, 0.2, 5), 3.0);
    agrees(&cube::<3>(6, 0.5, 0.15, 6), 3.0);
}

/// A square with a square hole, over which walks have to find their way, in cells whose sizes differ by a hundred.
#[test]
fn agrees_with_brute_force_on_a_graded_mesh_with_a_hole() {
    let whole = cube::<2>(12, 0.25, 0.0, 0);
    let stretched: Vec<[f64; 2]> = whole.vertices().iter().map(|x| x.map(|c| c * c * c / 9.0)).collect();
    let outside = |cell: &&[u32]| {
        let centre = |a: usize| cell.iter().map(|&v| whole.vertices()[v as usize][a]).sum::<f64>() / 3.0;
        !((1.0..2.0).contains(&centre(0)) && (1.0..2.0).contains(&centre(1)))
    };
    let cells: Vec<u32> = whole.cells().filter(outside).flatten().copied().collect();
    agrees(&SimplexMesh::from_used(&stretched, &cells).unwrap(), 3.0);
}

#[test]
fn points_on_facets_edges_and_vertices_belong_to_the_lowest_cell_from_wherever_they_are_looked_for() {
    fn check<const D: usize>(mesh: SimplexMesh<D>) {
        let search = CellSearch::new(mesh);
        let mesh = search.mesh();
        let mut random = generator(3);
        for cell in 0..mesh.cell_count() {
            let corner = |n: usize| mesh.vertices()[mesh.cell(cell)[n] as usize];
            let middle = std::array::from_fn(|a| (1..=D).map(|n| corner(n)[a]).sum::<f64>() / D as f64);
            let edge = std::array::from_fn(|a| 0.5 * (corner(0)[a] + corner(1)[a]));
            for x in [corner(0), middle, edge] {
                let holds = |&other: &usize| mesh.frame(other).least_coordinate(&x) > -1e-12;
                let lowest = (0..mesh.cell_count()).find(holds).map(|cell| cell as u32);
                for _ in 0..8 {
                    let from = random.random_range(0..mesh.cell_count() as u32);
                    assert_eq!(search.locate(&x, Some(from)).map(|located| located.cell), lowest);
                }
                assert_eq!(search.locate_by_brute_force(&x), lowest);
            }
        }
    }
    check(line(&[0.0, 0.4, 1.3, 1.7, 2.6, 3.0]));
    check(cube::<2>(5, 0.7, 0.2, 1));
    check(cube::<3>(3, 0.7, 0.15, 1));
}

#[test]
fn what_is_not_finite_or_far_away_is_in_no_cell() {
    let search = CellSearch::new(cube::<2>(4, 1.0, 0.1, 2));
    for c in [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        1e300,
        -1e300,
        -1e-9,
        4.0 + 1e-9,
    ] {
        for near in [None, Some(3), Some(u32::MAX)] {
            assert_eq!(search.locate(&[2.0, c], near), None);
            assert_eq!(search.locate(&[c, 2.0], near), None);
        }
        assert!(c.abs() < 5.0 || search.nearest(&[2.0, c], 1.0).is_none());
    }
}

#[test]
fn the_nearest_point_of_a_cube_is_the_one_clamped_into_it() {
    fn check<const D: usize>(cells: usize) {
        let search = CellSearch::new(cube::<D>(cells, 1.0, 0.1, 7));
        let edge = cells as f64;
        for x in cloud::<D>(500, -0.8, edge + 0.8, 9) {
            let clamped = x.map(|c| c.clamp(0.0, edge));
            let far = distance(&x, &clamped);
            let near = search.nearest(&x, 0.8);
            assert_eq!(near.is_some(), far <= 0.8, "{x:?}");
            if let Some(near) = near {
                assert!(distance(&near.position, &clamped) < 1e-13, "{x:?}: {near:?}");
                assert!((near.distance - far).abs() < 1e-13);
                assert!(search.locate_by_brute_force(&clamped).is_some());
            }
        }
    }
    check::<1>(5);
    check::<2>(4);
    check::<3>(3);
}
