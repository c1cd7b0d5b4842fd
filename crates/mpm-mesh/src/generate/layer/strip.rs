//! The layer around a mesh of triangles.

use std::collections::HashMap;
use std::f64::consts::FRAC_PI_3;

use mpm_tensor::vector::distance;

use super::joined;
use crate::generate::plane::{encloses, squared_distance_to_segment};
use crate::generate::{GenerationError, Triangulation};
use crate::{BoundaryFacet, SimplexMesh};

/// New points keep this many edge lengths from the boundary and from each other. At a right re-entrant corner one point of
/// the two above its edges remains, 0.68 away from both.
const CLEARANCE: f64 = 0.5;

/// A point that the layer may have.
struct Candidate {
    position: [f64; 2],
    /// Length of the edges nearby.
    length: f64,
}

pub fn surrounded<const D: usize>(mesh: &SimplexMesh<D>) -> Result<SimplexMesh<D>, GenerationError> {
    let boundary = mesh.boundary();
    let plane = |position: &[f64; D]| [position[0], position[1 % D]];
    // The points of the boundary, numbered by themselves.
    let mut numbers: Vec<u32> = boundary.iter().flat_map(|facet| facet.vertices).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let mut points: Vec<[f64; 2]> = numbers.iter().map(|&v| plane(&mesh.vertices()[v as usize])).collect();
    let place = |vertex: u32| numbers.partition_point(|&other| other < vertex);
    let edges: Vec<[usize; 2]> = boundary
        .iter()
        .map(|facet| [place(facet.vertices[0]), place(facet.vertices[1 % D])])
        .collect();
    let candidates = candidates(&boundary, &edges, &points);
    let segments: Vec<[[f64; 2]; 2]> = edges.iter().map(|ends| ends.map(|end| points[end])).collect();
    points.extend(choose(candidates, &segments));
    let triangles = Triangulation::new(&points, &edges)?.outside.into_iter();
    let touching: Vec<[u32; 3]> = triangles
        .filter(|triangle| (triangle[0] as usize) < numbers.len())
        .collect();
    // Where the boundary winds, a point may be shut off from it by others.
    let mut used: Vec<u32> = touching.as_flattened().to_vec();
    used.retain(|&point| point as usize >= numbers.len());
    used.sort_unstable();
    used.dedup();
    let number = |&point: &u32| match numbers.get(point as usize) {
        Some(&inner) => inner,
        None => (mesh.vertices().len() + used.partition_point(|&other| other < point)) as u32,
    };
    let cells: Vec<u32> = touching.as_flattened().iter().map(number).collect();
    let position = |&point: &u32| std::array::from_fn(|axis| points[point as usize][axis % 2]);
    joined(mesh, &used.iter().map(position).collect::<Vec<_>>(), &cells)
}

/// Above every edge a point, and at every convex corner more of them.
fn candidates<const D: usize>(
    boundary: &[BoundaryFacet<D>],
    edges: &[[usize; 2]],
    points: &[[f64; 2]],
) -> Vec<Candidate> {
    let apex = |facet: usize| {
        let [a, b] = edges[facet].map(|end| points[end]);
        let BoundaryFacet { normal, area, .. } = &boundary[facet];
        std::array::from_fn(|axis| 0.5 * (a[axis] + b[axis]) + 0.75f64.sqrt() * area * normal[axis % D])
    };
    let mut candidates: Vec<Candidate> = (0..edges.len())
        .map(|facet| Candidate {
            position: apex(facet),
            length: boundary[facet].area,
        })
        .collect();
    let leaving: HashMap<usize, usize> = edges.iter().enumerate().map(|(facet, ends)| (ends[0], facet)).collect();
    for (arriving, ends) in edges.iter().enumerate() {
        let Some(&leaving) = leaving.get(&ends[1]) else {
            continue;
        };
        let corner = points[ends[1]];
        let direction = |facet: usize| {
            let apex: [f64; 2] = apex(facet);
            (apex[1] - corner[1]).atan2(apex[0] - corner[0])
        };
        // The mesh is to the left, so outside a convex corner one turns anticlockwise from one apex to the next.
        let (from, to) = (direction(arriving), direction(leaving));
        let turn = (to - from + FRAC_PI_3).rem_euclid(6.0 * FRAC_PI_3) - FRAC_PI_3;
        let length = 0.5 * (boundary[arriving].area + boundary[leaving].area);
        let parts = (turn / FRAC_PI_3 - 0.4).ceil().max(1.0) as usize;
        candidates.extend((1..parts).map(|part| {
            let (sine, cosine) = (from + turn * part as f64 / parts as f64).sin_cos();
            let position = [corner[0] + length * cosine, corner[1] + length * sine];
            Candidate { position, length }
        }));
        // At a re-entrant corner the two points above its edges come near each other: one between them.
        if turn < 0.6 * FRAC_PI_3 {
            let (a, b): ([f64; 2], [f64; 2]) = (apex(arriving), apex(leaving));
            let position = [0, 1].map(|axis| 0.5 * (a[axis] + b[axis]));
            candidates.push(Candidate { position, length });
        }
    }
    candidates
}

/// The candidates outside that are clear of the boundary and of those chosen before; later ones, at corners, come first.
fn choose(candidates: Vec<Candidate>, segments: &[[[f64; 2]; 2]]) -> Vec<[f64; 2]> {
    let mut chosen: Vec<Candidate> = Vec::new();
    for candidate in candidates.into_iter().rev() {
        let Candidate { position, length } = &candidate;
        let limit = CLEARANCE * length;
        let near = |[a, b]: &[[f64; 2]; 2]| squared_distance_to_segment(position, a, b) < limit * limit;
        let crowded = |other: &Candidate| distance(&other.position, position) < limit;
        if !segments.iter().any(near) && !encloses(segments, position) && !chosen.iter().any(crowded) {
            chosen.push(candidate);
        }
    }
    chosen.into_iter().map(|candidate| candidate.position).collect()
}
