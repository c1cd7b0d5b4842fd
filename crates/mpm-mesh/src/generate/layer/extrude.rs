//! The layer around a mesh as prisms on the facets of its boundary.

use mpm_tensor::vector::{accumulate, add_scaled, distance, dot, norm, scale};

use super::joined;
use crate::generate::GenerationError;
use crate::mesh::signed_volume;
use crate::{BoundaryFacet, MeshError, SimplexMesh};

/// Length of an offset in units of the boundary's edges nearby: the height of a regular tetrahedron.
const HEIGHT: f64 = 0.8;

/// Cells of the layer have at least this share of the volume that they would have in an upright prism.
const LEAST_VOLUME: f64 = 0.25;

/// Heights are reduced by this factor where cells fold or meet.
const REDUCTION: f64 = 0.8;

/// Below this share of its full height the layer is given up.
const LEAST_HEIGHT: f64 = 1e-3;

/// What is known of a vertex of the boundary.
struct Stem<const D: usize> {
    vertex: u32,
    /// From the vertex to its copy outside, at full height.
    offset: [f64; D],
    /// Share of the full height.
    share: f64,
}

pub fn surrounded<const D: usize>(mesh: &SimplexMesh<D>) -> Result<SimplexMesh<D>, GenerationError> {
    let boundary = mesh.boundary();
    let mut stems = stems(mesh, &boundary)?;
    let prisms: Vec<Prism<D>> = boundary.iter().map(|facet| Prism::new(mesh, &stems, facet)).collect();
    let cells: Vec<u32> = prisms
        .iter()
        .flat_map(|prism| prism.cells(mesh.vertices().len()))
        .collect();
    loop {
        unfold(mesh, &mut stems, &prisms)?;
        let vertices: Vec<[f64; D]> = stems.iter().map(|stem| stem.end(mesh)).collect();
        match joined(mesh, &vertices, &cells) {
            Err(GenerationError::Mesh(MeshError::VertexInsideCell { .. } | MeshError::HangingVertex { .. }))
                if stems[0].share > LEAST_HEIGHT =>
            {
                stems.iter_mut().for_each(|stem| stem.share *= REDUCTION);
            }
            result => return result,
        }
    }
}

/// The vertices of the boundary, in ascending order.
fn stems<const D: usize>(
    mesh: &SimplexMesh<D>,
    boundary: &[BoundaryFacet<D>],
) -> Result<Vec<Stem<D>>, GenerationError> {
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); mesh.vertices().len()];
    for (number, facet) in boundary.iter().enumerate() {
        facet.vertices.iter().for_each(|&v| around[v as usize].push(number));
    }
    let numbered = around.iter().enumerate().filter(|(_, facets)| !facets.is_empty());
    numbered
        .map(|(vertex, facets)| {
            let normals: Vec<[f64; D]> = facets.iter().map(|&k| boundary[k].normal).collect();
            let direction = central_direction(&normals);
            let least = normals.iter().map(|n| dot(n, &direction)).fold(1.0, f64::min);
            if least <= 1e-3 {
                return Err(GenerationError::NoLayer { vertex });
            }
            let height = HEIGHT * mean_edge(mesh, vertex as u32, facets, boundary);
            Ok(Stem {
                vertex: vertex as u32,
                offset: scale(&direction, height),
                share: 1.0,
            })
        })
        .collect()
}

/// The unit vector whose least product with any of the normals is greatest: the centre of the smallest ball around them,
/// approached by steps towards the normal that is furthest away (Bădoiu & Clarkson 2003).
fn central_direction<const D: usize>(normals: &[[f64; D]]) -> [f64; D] {
    let mut centre = [0.0; D];
    normals
        .iter()
        .for_each(|n| accumulate(&mut centre, 1.0 / normals.len() as f64, n));
    for step in 0..200 {
        let furthest = normals
            .iter()
            .max_by(|a, b| distance(a, &centre).total_cmp(&distance(b, &centre)));
        let Some(furthest) = furthest else { break };
        let share = 1.0 / (step + 2) as f64;
        centre = add_scaled(&scale(&centre, 1.0 - share), share, furthest);
    }
    scale(&centre, 1.0 / norm(&centre).max(f64::MIN_POSITIVE))
}

/// Mean length of the boundary's edges at a vertex; in one dimension the length of its cell.
fn mean_edge<const D: usize>(
    mesh: &SimplexMesh<D>,
    vertex: u32,
    facets: &[usize],
    boundary: &[BoundaryFacet<D>],
) -> f64 {
    let position = |v: u32| &mesh.vertices()[v as usize];
    let of_facet = |&facet: &usize| match D {
        1 => mesh.cell(boundary[facet].cell as usize).to_vec(),
        _ => boundary[facet].vertices.to_vec(),
    };
    let others = facets.iter().flat_map(of_facet).filter(|&other| other != vertex);
    let lengths: Vec<f64> = others
        .map(|other| distance(position(other), position(vertex)))
        .collect();
    lengths.iter().sum::<f64>() / lengths.len() as f64
}

impl<const D: usize> Stem<D> {
    fn end(&self, mesh: &SimplexMesh<D>) -> [f64; D] {
        add_scaled(&mesh.vertices()[self.vertex as usize], self.share, &self.offset)
    }
}

/// A facet and its copy outside.
struct Prism<const D: usize> {
    /// The stems of its vertices, in ascending order.
    stems: [usize; D],
    /// The vertices.
    vertices: [u32; D],
    /// Whether (vertices, copy of the last) is a positively oriented cell.
    positive: bool,
    /// Measure of the facet.
    area: f64,
    /// Outward normal of the facet.
    normal: [f64; D],
}

impl<const D: usize> Prism<D> {
    fn new(mesh: &SimplexMesh<D>, stems: &[Stem<D>], facet: &BoundaryFacet<D>) -> Self {
        let mut vertices = facet.vertices;
        vertices.sort_unstable();
        let mut corners: Vec<[f64; D]> = vertices.iter().map(|&v| mesh.vertices()[v as usize]).collect();
        corners.push(add_scaled(
            &corners[D - 1],
            facet.area.powf(1.0 / D as f64),
            &facet.normal,
        ));
        let cell: Vec<u32> = (0..=D as u32).collect();
        Self {
            stems: vertices.map(|v| stems.partition_point(|stem| stem.vertex < v)),
            vertices,
            positive: signed_volume(&corners, &cell) > 0.0,
            area: facet.area,
            normal: facet.normal,
        }
    }

    /// The D cells (s₀ … s_j, s′_j … s′_{D−1}), s′ being the copy of s: of the two diagonals of a side each prism takes the
    /// one from the smaller number inside to the larger outside, so those of neighbours agree.
    fn cells(&self, first_copy: usize) -> Vec<u32> {
        let mut cells = Vec::with_capacity(D * (D + 1));
        for j in 0..D {
            let start = cells.len();
            cells.extend(&self.vertices[..=j]);
            cells.extend(self.stems[j..].iter().map(|&stem| (first_copy + stem) as u32));
            if self.positive != (D - 1 - j).is_multiple_of(2) {
                cells.swap(start, start + 1);
            }
        }
        cells
    }
}

/// Reduces heights until no cell of the layer is inverted or much smaller than it would be in an upright prism.
fn unfold<const D: usize>(
    mesh: &SimplexMesh<D>,
    stems: &mut [Stem<D>],
    prisms: &[Prism<D>],
) -> Result<(), GenerationError> {
    loop {
        let mut folded = vec![false; stems.len()];
        for prism in prisms {
            // The prism alone: its vertices first, then their copies.
            let own = prism.vertices.iter().map(|&v| mesh.vertices()[v as usize]);
            let corners: Vec<[f64; D]> = own
                .chain(prism.stems.iter().map(|&stem| stems[stem].end(mesh)))
                .collect();
            let local = Prism {
                stems: std::array::from_fn(|k| k),
                vertices: std::array::from_fn(|k| k as u32),
                ..*prism
            };
            let heights = prism
                .stems
                .iter()
                .map(|&s| dot(&stems[s].offset, &prism.normal) * stems[s].share);
            let least = LEAST_VOLUME * prism.area * heights.fold(f64::INFINITY, f64::min) / D as f64;
            let cells = local.cells(D);
            if cells
                .chunks_exact(D + 1)
                .any(|cell| signed_volume(&corners, cell) < least)
            {
                prism.stems.iter().for_each(|&stem| folded[stem] = true);
            }
        }
        if !folded.contains(&true) {
            return Ok(());
        }
        for (stem, _) in stems.iter_mut().zip(&folded).filter(|(_, folded)| **folded) {
            stem.share *= REDUCTION;
            if stem.share < LEAST_HEIGHT {
                return Err(GenerationError::NoLayer {
                    vertex: stem.vertex as usize,
                });
            }
        }
    }
}
