//! Meshes that tests run over.

use mpm_mesh::SimplexMesh;
use mpm_mesh::generate::{self, EdgeTarget};

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

/// Six tetrahedra about the main diagonal of every cube chosen out of `counts`, of edge 1.
pub fn cubes(counts: [usize; 3], chosen: impl Fn([usize; 3]) -> bool) -> SimplexMesh<3> {
    let number = |p: [usize; 3]| ((p[0] * (counts[1] + 1) + p[1]) * (counts[2] + 1) + p[2]) as u32;
    let grid =
        |n: [usize; 3]| (0..n[0]).flat_map(move |i| (0..n[1]).flat_map(move |j| (0..n[2]).map(move |k| [i, j, k])));
    let vertices: Vec<[f64; 3]> = grid(counts.map(|n| n + 1)).map(|p| p.map(|x| x as f64)).collect();
    let mut cells = Vec::new();
    for cube in grid(counts).filter(|&cube| chosen(cube)) {
        for (axes, even) in [
            ([0, 1, 2], true),
            ([1, 2, 0], true),
            ([2, 0, 1], true),
            ([0, 2, 1], false),
            ([2, 1, 0], false),
            ([1, 0, 2], false),
        ] {
            let mut corner = cube;
            let mut cell = vec![number(corner)];
            for axis in axes {
                corner[axis] += 1;
                cell.push(number(corner));
            }
            if !even {
                cell.swap(0, 1);
            }
            cells.extend(cell);
        }
    }
    SimplexMesh::from_used(&vertices, &cells).expect("cubes")
}

pub const ELL: [[f64; 2]; 6] = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];

/// Ten corners, alternately at radius 1 and 1/2.
pub fn star() -> Vec<[f64; 2]> {
    let corner = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::PI / 5.0).sin_cos();
        let radius = if k.is_multiple_of(2) { 1.0 } else { 0.5 };
        [radius * cosine, radius * sine]
    };
    (0..10).map(corner).collect()
}

/// ½ |Σ x_k y_{k+1} − x_{k+1} y_k|.
pub fn polygon_area(corners: &[[f64; 2]]) -> f64 {
    let following = corners.iter().cycle().skip(1);
    let sum: f64 = corners
        .iter()
        .zip(following)
        .map(|(a, b)| a[0] * b[1] - b[0] * a[1])
        .sum();
    0.5 * sum.abs()
}

pub fn one_dimensional() -> Vec<Sample<1>> {
    let chain = SimplexMesh::new(vec![[0.0], [3.0], [1.0]], vec![0, 2, 2, 1]).expect("a chain");
    let sizes = generate::cyclic_sizes(5.0, 17, &[1.0, 1.2, 1.44]).expect("sizes");
    let cyclic = generate::segments(-1.0, &sizes).expect("segments");
    let apart = SimplexMesh::new(vec![[0.0], [1.0], [1.5], [4.0]], vec![0, 1, 2, 3]).expect("two");
    vec![
        sample("unit", unit(), 1.0, 1),
        sample("chain", chain, 3.0, 1),
        sample("cyclic", cyclic, 5.0, 1),
        sample("apart", apart, 3.5, 2),
    ]
}

pub fn two_dimensional() -> Vec<Sample<2>> {
    let target = EdgeTarget {
        length: 0.19,
        angle: 0.3,
    };
    let sides = (std::f64::consts::TAU / 0.19).round();
    let disk_area = 0.5 * sides * (std::f64::consts::TAU / sides).sin();
    let hole: Vec<[f64; 2]> = star().iter().map(|p| p.map(|x| 3.0 * x)).collect();
    let pierced = [hole.clone(), star()];
    vec![
        sample("unit", unit(), 0.5, 1),
        sample("square", square(), 1.0, 1),
        sample("frame", frame(), 8.0, 0),
        sample(
            "rectangle",
            generate::rectangle([-1.0, 2.0], [0.3, 3.1], &target).expect("it"),
            1.43,
            1,
        ),
        sample("ell", generate::polygon(&ELL, &target).expect("it"), 3.0, 1),
        sample(
            "star",
            generate::polygon(&star(), &target).expect("it"),
            polygon_area(&star()),
            1,
        ),
        sample(
            "pierced",
            generate::outlines(&pierced, &target).expect("it"),
            8.0 * polygon_area(&star()),
            0,
        ),
        sample(
            "disk",
            generate::disk([5.0, -1.0], 1.0, &target).expect("it"),
            disk_area,
            1,
        ),
        channel(0.0),
        channel(-3.3),
    ]
}

/// The channel of Cao et al.; its area is 2 (height − floor), whatever the wall, as both walls are the same.
fn channel(floor: f64) -> Sample<2> {
    let target = EdgeTarget {
        length: 0.4,
        angle: 0.0,
    };
    let mesh = generate::wavy_channel([floor, 23.5], &target).expect("it");
    sample("channel", mesh, 47.0 - 2.0 * floor, 1)
}

pub fn three_dimensional() -> Vec<Sample<3>> {
    let cuboid = generate::cuboid([0.0, 1.0, -1.0], [1.0, 1.5, 0.2], 0.25).expect("a box");
    let slope = generate::slope(5.0, 10.0, 15.0, 2.0, 1.5).expect("a slope");
    let target = EdgeTarget {
        length: 0.4,
        angle: 0.2,
    };
    let ell = generate::polygon(&ELL, &target).expect("a polygon");
    let thick = generate::extruded(&ell, 0.5, 0.3).expect("a prism");
    let ball = generate::ball([1.0, 2.0, 3.0], 0.5, 0.13).expect("a ball");
    let ball_volume = ball.boundary().iter().map(|facet| cone(&ball, &facet.vertices)).sum();
    vec![
        sample("unit", unit(), 1.0 / 6.0, 1),
        sample("cuboid", cuboid, 0.6, 1),
        sample("slope", slope, 125.0, 1),
        sample("thick ell", thick, 1.5, 1),
        sample("ball", ball, ball_volume, 1),
        sample("corner", cubes([2; 3], |cube| cube != [1; 3]), 7.0, 1),
        sample("ring", cubes([3, 3, 1], |cube| cube != [1, 1, 0]), 8.0, 0),
    ]
}

/// Volume between a facet and the point (1, 2, 3), with the facet's own sign.
fn cone(mesh: &SimplexMesh<3>, facet: &[u32; 3]) -> f64 {
    let [a, b, c] = facet.map(|v| {
        let x = mesh.vertices()[v as usize];
        [x[0] - 1.0, x[1] - 2.0, x[2] - 3.0]
    });
    let cross = [
        b[1] * c[2] - b[2] * c[1],
        b[2] * c[0] - b[0] * c[2],
        b[0] * c[1] - b[1] * c[0],
    ];
    (a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2]) / 6.0
}
