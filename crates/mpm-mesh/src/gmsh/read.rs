//! The sections of a file.

use super::cursor::{Cursor, Encoding};
use super::raw::Raw;
use super::{MshError, NamedMesh, version_2, version_4};
use crate::{MeshError, SimplexMesh};

/// Reads the mesh in the bytes of a `.msh` file, of version 2.2 or 4.1, text or binary of either byte order.
///
/// Cells are the elements of dimension D with straight edges: segments (type 1), triangles (2), tetrahedra (4); everything else is passed over
/// ([`read_named_msh`] keeps physical groups). Vertices are numbered in the order of the file, without nodes that
/// belong to no cell; tags of nodes may have gaps and any order. A cell that version 2.2 repeats, once for each physical group that it is in, is one; meshes may be partitioned. In two dimensions all vertices have the same z, in one the same
/// y and z. Where all cells are negatively oriented (triangles clockwise), all are turned; where some are, the mesh is
/// refused.
///
/// Format: Gmsh reference manual, "MSH file format", and for 2.2 its "Legacy formats".
///
/// # Errors
/// [`MshError`], with tags as in the file and the line or the byte where it was seen.
pub fn read_msh<const D: usize>(bytes: &[u8]) -> Result<SimplexMesh<D>, MshError> {
    let (raw, cursor) = read_sections::<D>(bytes)?;
    raw.mesh(&cursor)
}

/// As [`read_msh`], with the physical groups of facets: elements of one dimension less (points, segments, triangles) that are in a group.
///
/// # Errors
/// [`MshError`], also for an element of a group that is no facet of a cell.
pub fn read_named_msh<const D: usize>(bytes: &[u8]) -> Result<NamedMesh<D>, MshError> {
    let (raw, cursor) = read_sections::<D>(bytes)?;
    raw.named_mesh(&cursor)
}

fn read_sections<const D: usize>(bytes: &[u8]) -> Result<(Raw, Cursor<'_>), MshError> {
    if !(1..=3).contains(&D) {
        return Err(MeshError::UnsupportedDimension { dimension: D }.into());
    }
    let mut cursor = Cursor::new(bytes);
    let version = read_format(&mut cursor)?;
    let (mut raw, mut nodes_seen, mut elements_seen) = (Raw::default(), false, false);
    while !cursor.at_end() {
        let mark = cursor.mark();
        match cursor.word("a section")? {
            "$Nodes" => {
                nodes_seen = true;
                match version {
                    Version::Two => version_2::read_nodes(&mut cursor, &mut raw)?,
                    Version::Four => version_4::read_nodes(&mut cursor, &mut raw)?,
                }
                cursor.expect("$EndNodes")?;
            }
            "$Elements" => {
                elements_seen = true;
                match version {
                    Version::Two => version_2::read_elements::<D>(&mut cursor, &mut raw)?,
                    Version::Four => version_4::read_elements::<D>(&mut cursor, &mut raw)?,
                }
                cursor.expect("$EndElements")?;
            }
            "$PhysicalNames" => {
                raw.groups.read_names(&mut cursor)?;
                cursor.expect("$EndPhysicalNames")?;
            }
            late @ ("$Entities" | "$PartitionedEntities") if elements_seen && matches!(version, Version::Four) => {
                return Err(cursor.malformed(mark, "a section that may follow $Elements", late));
            }
            "$Entities" if matches!(version, Version::Four) => {
                raw.groups.read_entities(&mut cursor)?;
                cursor.expect("$EndEntities")?;
            }
            "$PartitionedEntities" if matches!(version, Version::Four) => {
                raw.groups.read_partitioned_entities(&mut cursor)?;
                cursor.expect("$EndPartitionedEntities")?;
            }
            other => {
                let name = other.strip_prefix('$');
                let name = name.ok_or_else(|| cursor.malformed(mark, "the name of a section", other))?;
                cursor.skip_past(&format!("$End{name}"), "the end of a section")?;
            }
        }
    }
    for (name, seen) in [("Nodes", nodes_seen), ("Elements", elements_seen)] {
        if !seen {
            return Err(MshError::MissingSection { name });
        }
    }
    Ok((raw, cursor))
}

/// What the second number of the header has to be.
const BINARY: &str = "0 for text or 1 for binary";

enum Version {
    Two,
    Four,
}

/// The section `$MeshFormat`; in a binary file the number one in four bytes tells their order.
fn read_format(cursor: &mut Cursor) -> Result<Version, MshError> {
    cursor.expect("$MeshFormat")?;
    let version = match cursor.word("a version")? {
        "2.2" => Version::Two,
        "4.1" => Version::Four,
        other => {
            let version = other.to_owned();
            return Err(MshError::UnsupportedVersion { version });
        }
    };
    let mark = cursor.mark();
    let binary: u64 = cursor.parse(BINARY)?;
    let size = cursor.parse("the size of numbers")?;
    match (binary, size) {
        (0, _) => {}
        (1, 8) => {
            cursor.skip_line();
            cursor.encoding = Encoding::LittleEndian;
            let mark = cursor.mark();
            match cursor.integer("the number one")? {
                1 => {}
                0x0100_0000 => cursor.encoding = Encoding::BigEndian,
                other => return Err(cursor.malformed(mark, "the number one", &other.to_string())),
            }
        }
        (1, _) => return Err(MshError::UnsupportedDataSize { size }),
        (other, _) => return Err(cursor.malformed(mark, BINARY, &other.to_string())),
    }
    cursor.expect("$EndMeshFormat")?;
    Ok(version)
}
