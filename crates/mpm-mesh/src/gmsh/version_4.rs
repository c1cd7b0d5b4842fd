//! Sections of version 4.1: blocks by the geometrical entity that elements lie on.

use super::MshError;
use super::cursor::{Cursor, Encoding};
use super::raw::{Raw, Role, check_kind};

/// Blocks of: dimension, tag of the entity, whether parametric, count; tags; positions, and as many parameters as the
/// entity has dimensions.
pub fn read_nodes(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    for _ in 0..block_count(cursor)? {
        let dimension = cursor.integer("the dimension of an entity")?;
        cursor.signed_integer("the tag of an entity")?;
        let parametric = cursor.integer("whether there are parameters")? != 0;
        let count = cursor.size("a number of nodes")?;
        let mut tags = Vec::new();
        for _ in 0..count {
            tags.push((cursor.mark(), cursor.size("the tag of a node")?));
        }
        for (mark, tag) in tags {
            raw.add_node(tag, mark, cursor)?;
            for _ in 0..if parametric { dimension } else { 0 } {
                cursor.real("a parameter")?;
            }
        }
    }
    Ok(())
}

/// Blocks of: dimension, tag of the entity, type, count; for each element its tag and nodes.
pub fn read_elements<const D: usize>(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let mut nodes = Vec::new();
    for _ in 0..block_count(cursor)? {
        let mark = cursor.mark();
        let dimension = cursor.integer("the dimension of an entity")?;
        let entity = cursor.signed_integer("the tag of an entity")?;
        let groups = raw.groups.of_entity(dimension, entity).to_vec();
        let (kind, role) = check_kind::<D>(cursor.integer("the type of elements")?, mark, cursor)?;
        for _ in 0..cursor.size("a number of elements")? {
            let tag = cursor.size("the tag of an element")?;
            nodes.clear();
            for _ in 0..kind.node_count {
                nodes.push(cursor.size("the tag of a node")?);
            }
            match role {
                Role::Cell => raw.add_cell(tag, &nodes),
                Role::Facet => raw.add_facet(tag, &nodes, &groups),
                Role::Other => {}
            }
        }
    }
    Ok(())
}

/// Number of blocks; behind it the numbers of all entries, of the least tag and of the greatest.
fn block_count(cursor: &mut Cursor) -> Result<u64, MshError> {
    if cursor.encoding != Encoding::Text {
        cursor.skip_line();
    }
    let blocks = cursor.size("a number of blocks")?;
    for _ in 0..3 {
        cursor.size("a count or a bound of tags")?;
    }
    Ok(blocks)
}
