//! Moves points until triangles are near to equilateral.

use std::collections::HashSet;

use mpm_tensor::vector::distance;

use super::delaunay::Triangulation;
use super::outline::Outline;
use crate::adjacency::Lists;
use crate::generate::GenerationError;

/// Rounds of triangulating and moving; ours. After them little changes.
const ROUNDS: usize = 10;

/// Moves of every point in a round.
const SWEEPS: usize = 3;

/// Rounds, from the first, in which points come and go; the others only move them.
const CHANGES: usize = 7;

/// No inner edge is to be longer than this many target lengths; as many rounds again are made until it is so, in which
/// points only come.
const LIMIT: f64 = 1.5;

/// Edges longer than this many target lengths are divided.
const LONG: f64 = 1.35;

/// In the first rounds one end of edges shorter than this many target lengths is dropped.
const SHORT: f64 = 0.6;

/// A move is refused if it brings a triangle below this share of the area of the equilateral one.
const LEAST_AREA: f64 = 0.1;

/// The triangles inside the outline; points after those of the outline move, come and go.
pub fn relax(points: &mut Vec<[f64; 2]>, outline: &Outline, length: f64) -> Result<Vec<[u32; 3]>, GenerationError> {
    let fixed = outline.points.len();
    for round in 0..2 * ROUNDS {
        let triangles = Triangulation::new(points, &outline.edges)?.inside;
        let edges = inner_edges(points, &triangles, outline, length);
        // The longest edge comes first.
        let too_long = edges.first().is_some_and(|edge| edge.ratio > LIMIT);
        if round >= ROUNDS && !too_long {
            return Ok(triangles);
        }
        let stars = stars(points.len(), &triangles);
        for _ in 0..SWEEPS {
            for vertex in fixed..points.len() {
                to_mean_of_neighbours(points, &triangles, stars.get(vertex), vertex as u32, length);
            }
        }
        if round < CHANGES || too_long {
            // Points that came may go again for a short edge, which leaves a long one, and so on in a circle.
            let shortest = if round < ROUNDS { SHORT } else { 0.0 };
            change(points, fixed, &edges, shortest);
        }
    }
    Ok(Triangulation::new(points, &outline.edges)?.inside)
}

/// One round: points after those of the outline move to the mean of their neighbours; `size` is the length of edges at a point.
pub fn smooth(
    points: &mut [[f64; 2]],
    outline: &Outline,
    size: impl Fn(&[f64; 2]) -> f64,
) -> Result<(), GenerationError> {
    let triangles = Triangulation::new(points, &outline.edges)?.inside;
    let stars = stars(points.len(), &triangles);
    for vertex in outline.points.len()..points.len() {
        let length = size(&points[vertex]);
        to_mean_of_neighbours(points, &triangles, stars.get(vertex), vertex as u32, length);
    }
    Ok(())
}

/// An edge inside the domain.
struct Edge {
    ends: [usize; 2],
    /// Its length over the target.
    ratio: f64,
}

/// The edges of triangles that are not part of the outline and are long or short, the longest first.
fn inner_edges(points: &[[f64; 2]], triangles: &[[u32; 3]], outline: &Outline, length: f64) -> Vec<Edge> {
    let sides = triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    // An inner edge belongs to two triangles, which pass it in opposite directions.
    let once = sides.map(|ends| ends.map(|v| v as usize)).filter(|[a, b]| a < b);
    let edges = once.map(|ends| Edge {
        ends,
        ratio: distance(&points[ends[0]], &points[ends[1]]) / length,
    });
    let outer: HashSet<[usize; 2]> = outline.edges.iter().map(|&[a, b]| [a.min(b), a.max(b)]).collect();
    let mut edges: Vec<Edge> = edges
        .filter(|edge| !(SHORT..=LONG).contains(&edge.ratio) && !outer.contains(&edge.ends))
        .collect();
    edges.sort_by(|a, b| b.ratio.total_cmp(&a.ratio).then(a.ends.cmp(&b.ends)));
    edges
}

/// For each vertex the triangles that it belongs to.
fn stars(count: usize, triangles: &[[u32; 3]]) -> Lists {
    let numbered = (0u32..).zip(triangles);
    let pairs = numbered.flat_map(|(number, triangle)| triangle.iter().map(move |&v| (v as usize, number)));
    Lists::from_pairs(count, pairs)
}

fn to_mean_of_neighbours(points: &mut [[f64; 2]], triangles: &[[u32; 3]], star: &[u32], vertex: u32, length: f64) {
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    for &triangle in star {
        for &other in &triangles[triangle as usize] {
            // An inner vertex has every neighbour in two of its triangles.
            if other != vertex {
                sum = [0, 1].map(|axis| sum[axis] + points[other as usize][axis]);
                count += 1.0;
            }
        }
    }
    if count == 0.0 {
        return;
    }
    let before = std::mem::replace(&mut points[vertex as usize], sum.map(|x| x / count));
    let least = LEAST_AREA * 0.1875f64.sqrt() * length * length;
    let fits = star.iter().all(|&k| area(points, &triangles[k as usize]) > least);
    if !fits {
        points[vertex as usize] = before;
    }
}

/// Signed area of a triangle.
fn area(points: &[[f64; 2]], triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|v| points[v as usize]);
    0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
}

/// Divides long edges and drops one end of those below `shortest` target lengths, each vertex touched once at most.
fn change(points: &mut Vec<[f64; 2]>, fixed: usize, edges: &[Edge], shortest: f64) {
    let mut touched = vec![false; points.len()];
    let (mut dropped, mut added) = (vec![false; points.len()], Vec::new());
    for &Edge { ends: [a, b], ratio } in edges {
        // Across a right-angled corner of the outline there may be an edge of √2.
        let long = ratio > if b < fixed { LIMIT } else { LONG };
        let short = ratio < shortest && b >= fixed;
        if touched[a] || touched[b] || !(long || short) {
            continue;
        }
        (touched[a], touched[b]) = (true, true);
        if long {
            added.push([0, 1].map(|axis| 0.5 * (points[a][axis] + points[b][axis])));
        } else {
            dropped[b] = true;
        }
    }
    let mut kept = dropped.iter().map(|&dropped| !dropped);
    points.retain(|_| kept.next().unwrap_or(true));
    points.extend(added);
}
