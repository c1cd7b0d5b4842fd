//! What a scene is computed on: a grid or a mesh, and the room that bodies have there.

mod generate;
mod layer;
mod named_facets;
mod sides;

use std::collections::BTreeMap;

use mpm_mesh::{NamedMesh, SimplexMesh};

use crate::scene::{Discretisation, DomainTable, Scene};
use crate::shape::Bounds;
use crate::{SceneFault, rotation};

pub(crate) use generate::of_shape;
pub(crate) use named_facets::{facet_keys, named_facets, smooth_parts};

/// The background of a scene.
pub(crate) enum Background<const D: usize> {
    /// A uniform grid.
    Grid {
        /// h.
        spacing: f64,
        /// The domain.
        room: Bounds<D>,
    },
    /// A mesh.
    Mesh {
        /// Without its outer layer: where bodies may be.
        inner: SimplexMesh<D>,
        /// With its outer layer.
        whole: SimplexMesh<D>,
        /// Mean edge of the mesh without its layer.
        spacing: f64,
        /// The domain, or the box around the mesh without its layer.
        room: Bounds<D>,
        /// Facets of the mesh without its layer by the names of their groups, D vertices each; `boundary` has all of the boundary.
        groups: BTreeMap<String, Vec<u32>>,
        /// Fingerprint of its file, where it has one.
        file_contents: Option<u64>,
    },
}

impl<const D: usize> Background<D> {
    /// Makes or reads what the scene asks for.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for a mesh that cannot be made or read, and for what [`Scene::read`] refuses.
    pub fn build(scene: &Scene) -> Result<Self, SceneFault> {
        let domain = scene.domain.as_ref().map(DomainTable::room).transpose()?;
        let table = match (scene.discretisation()?, domain) {
            (Discretisation::Mesh(table), _) => table,
            (Discretisation::Grid(table), Some(room)) => {
                let spacing = table.spacing;
                return Ok(Self::Grid { spacing, room });
            }
            (Discretisation::Grid(_), None) => return Err(SceneFault::missing("domain", "given with a [grid]")),
        };
        let rotation = rotation::build::<D>("mesh.rotation", table.rotation.as_ref())?;
        let (named, file_contents) = generate::inner::<D>(scene, table, rotation.as_ref())?;
        let NamedMesh {
            mesh: inner,
            facets: groups,
        } = named;
        let room = domain.unwrap_or_else(|| Bounds::around(inner.vertices()));
        let whole = if table.outer_layer {
            layer::around(scene, &inner, &room, &groups)?
        } else {
            inner.clone()
        };
        let spacing = inner.edge_lengths().mean;
        Ok(Self::Mesh {
            inner,
            whole,
            spacing,
            room,
            groups,
            file_contents,
        })
    }

    /// Length over which a field is resolved: the spacing of the grid, or the mean edge of the mesh.
    pub fn spacing(&self) -> f64 {
        match self {
            Self::Grid { spacing, .. } | Self::Mesh { spacing, .. } => *spacing,
        }
    }

    /// Fingerprint of the file of a mesh that was read.
    pub fn file_contents(&self) -> Option<u64> {
        match self {
            Self::Grid { .. } => None,
            Self::Mesh { file_contents, .. } => *file_contents,
        }
    }

    /// Where bodies may be at the start.
    pub fn room(&self) -> &Bounds<D> {
        match self {
            Self::Grid { room, .. } | Self::Mesh { room, .. } => room,
        }
    }
}
