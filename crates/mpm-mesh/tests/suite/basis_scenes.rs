//! Meshes and the textbook form of the weights, which the tests of kernel, search, basis and step share.

#![allow(dead_code, reason = "every test uses a part")]

use mpm_mesh::{SampleWeight, SimplexMesh};
use mpm_tensor::vector::{distance, subtract};
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

pub fn generator(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

/// Segments between ascending nodes.
pub fn line(nodes: &[f64]) -> SimplexMesh<1> {
    let cells = (1..nodes.len() as u32).flat_map(|k| [k - 1, k]).collect();
    SimplexMesh::new(nodes.iter().map(|&x| [x]).collect(), cells).unwrap()
}

/// A cube of `cells`ᴰ cubes of edge `h` from the origin on, each cut into D! simplices (Kuhn 1960); inner nodes are moved at random by up to
/// `jitter` h along each axis, nodes on a face of the cube within the face.
pub fn cube<const D: usize>(cells: usize, h: f64, jitter: f64, seed: u64) -> SimplexMesh<D> {
    let mut random = generator(seed);
    let nodes = cells + 1;
    let coordinates =
        |place: usize| -> [usize; D] { std::array::from_fn(|a| place / nodes.pow((D - 1 - a) as u32) % nodes) };
    let vertices = (0..nodes.pow(D as u32)).map(|place| {
        coordinates(place).map(|c| {
            let inner = c > 0 && c < cells;
            let shift = jitter * random.random_range(-1.0..1.0);
            h * (c as f64 + if inner { shift } else { 0.0 })
        })
    });
    let vertices: Vec<[f64; D]> = vertices.collect();
    let mut members = Vec::new();
    for cube in (0..nodes.pow(D as u32)).filter(|&place| coordinates(place).iter().all(|&c| c < cells)) {
        for (axes, even) in permutations(D) {
            let mut simplex = vec![cube as u32];
            let mut node = cube;
            for a in axes {
                node += nodes.pow((D - 1 - a) as u32);
                simplex.push(node as u32);
            }
            if !even {
                simplex.swap(0, 1);
            }
            members.extend(simplex);
        }
    }
    SimplexMesh::new(vertices, members).unwrap()
}

/// The permutations of 0..n, and whether they are even.
fn permutations(n: usize) -> Vec<(Vec<usize>, bool)> {
    if n == 0 {
        return vec![(Vec::new(), true)];
    }
    let mut all = Vec::new();
    for (shorter, even) in permutations(n - 1) {
        for place in 0..n {
            let mut longer = shorter.clone();
            longer.insert(place, n - 1);
            all.push((longer, even == (n - 1 - place).is_multiple_of(2)));
        }
    }
    all
}

/// Random points of the box from `low` to `high`.
pub fn cloud<const D: usize>(count: usize, low: f64, high: f64, seed: u64) -> Vec<[f64; D]> {
    let mut random = generator(seed);
    (0..count)
        .map(|_| std::array::from_fn(|_| random.random_range(low..high)))
        .collect()
}

/// Weight and diffuse gradient of every vertex of the mesh at `x` in `cell`, by the definitions: sums over all vertices, barycentric coordinates and
/// M_p⁻¹ by elimination, offsets in units of h.
pub fn naive_weights<const D: usize>(
    mesh: &SimplexMesh<D>,
    cell: usize,
    x: &[f64; D],
    weight: SampleWeight,
) -> Vec<(f64, [f64; D])> {
    let h = mesh.edge_lengths().longest;
    let members = mesh.cell(cell);
    let vertex = |i: u32| &mesh.vertices()[i as usize];
    // Σ_n b_n [1, x_n] = [1, x].
    let corner_rows = |row: usize| -> Vec<f64> {
        let entry = |&n: &u32| if row == 0 { 1.0 } else { vertex(n)[row - 1] };
        let right = if row == 0 { 1.0 } else { x[row - 1] };
        members.iter().map(entry).chain([right]).collect()
    };
    let barycentric = solve((0..=D).map(corner_rows).collect());
    let reached: Vec<u32> = mesh
        .cells()
        .filter(|cell| members.iter().any(|n| cell.contains(n)))
        .flatten()
        .copied()
        .collect();
    let joined = |a: u32, b: u32| {
        reached.contains(&b) && (a == b || mesh.cells().any(|cell| cell.contains(&a) && cell.contains(&b)))
    };
    let sample = |i: u32| {
        let r = distance(vertex(i), x) / h;
        let spline = match r {
            r if r < 0.5 => 0.75 - r * r,
            r if r < 1.5 => 0.5 * (1.5 - r).powi(2),
            _ => 0.0,
        };
        let shares = members.iter().zip(&barycentric).filter(|&(&n, _)| joined(n, i));
        match weight {
            SampleWeight::Continuous => spline * shares.map(|(_, b)| b).sum::<f64>(),
            SampleWeight::Smooth => {
                let share = shares.map(|(_, b)| b).sum::<f64>();
                spline * share.powi(2) * (3.0 - 2.0 * share)
            }
            SampleWeight::CellAlone => unreachable!("hat functions have an oracle of their own"),
            SampleWeight::DistanceAlone => spline * f64::from(u8::from(shares.count() > 0)),
        }
    };
    let count = mesh.vertices().len() as u32;
    let samples: Vec<f64> = (0..count).map(sample).collect();
    let polynomials: Vec<Vec<f64>> = (0..count)
        .map(|i| {
            std::iter::once(1.0)
                .chain(subtract(vertex(i), x).map(|c| c / h))
                .collect()
        })
        .collect();
    let moment = |a: usize, b: usize| -> f64 { samples.iter().zip(&polynomials).map(|(d, p)| d * p[a] * p[b]).sum() };
    let each = samples.iter().zip(&polynomials);
    each.map(|(d, p)| {
        if *d == 0.0 {
            return (0.0, [0.0; D]);
        }
        let rows = (0..=D).map(|a| (0..=D).map(|b| moment(a, b)).chain([p[a]]).collect());
        let solution = solve(rows.collect());
        (d * solution[0], std::array::from_fn(|a| d * solution[a + 1] / h))
    })
    .collect()
}

/// Gaussian elimination with row pivoting; every row ends with its right-hand side.
pub fn solve(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let count = rows.len();
    for k in 0..count {
        let pivot = (k..count)
            .max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()))
            .unwrap();
        rows.swap(k, pivot);
        for i in 0..count {
            if i != k {
                let factor = rows[i][k] / rows[k][k];
                for j in k..=count {
                    rows[i][j] -= factor * rows[k][j];
                }
            }
        }
    }
    (0..count).map(|k| rows[k][count] / rows[k][k]).collect()
}
