//! Sections of version 4.1: blocks by the geometrical entity that elements lie on.

use super::MshError;
use super::cursor::{Cursor, Encoding};
use super::raw::{Raw, Role, check_kind};

/// Blocks of: dimension, tag of the entity, whether parametric, count; tags; positions, and as many parameters as the
/// entity has dimensions.
pub fn read_nodes(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let counts = Counts::read(cursor)?;
    let mut read = 0;
    for _ in 0..counts.blocks {
        let dimension = cursor.integer("the dimension of an entity")?;
        cursor.signed_integer("the tag of an entity")?;
        let parametric = cursor.integer("whether there are parameters")? != 0;
        let count = cursor.size("a number of nodes")?;
        read += count;
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
    counts.check(read, "the number of nodes in all blocks", cursor)
}

/// Blocks of: dimension, tag of the entity, type, count; for each element its tag and nodes.
pub fn read_elements<const D: usize>(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let mut nodes = Vec::new();
    let counts = Counts::read(cursor)?;
    let mut read = 0;
    for _ in 0..counts.blocks {
        let mark = cursor.mark();
        let dimension = cursor.integer("the dimension of an entity")?;
        let entity = cursor.signed_integer("the tag of an entity")?;
        let groups = raw.groups.of_entity(dimension, entity).to_vec();
        let (kind, role) = check_kind::<D>(cursor.integer("the type of elements")?, mark, cursor)?;
        let count = cursor.size("a number of elements")?;
        read += count;
        for _ in 0..count {
            let mark = cursor.mark();
            let tag = cursor.size("the tag of an element")?;
            nodes.clear();
            for _ in 0..kind.node_count {
                nodes.push(cursor.size("the tag of a node")?);
            }
            match role {
                Role::Cell => raw.add_cell(tag, mark, &nodes),
                Role::Facet => raw.add_facet(tag, mark, &nodes, &groups),
                Role::Other => {}
            }
        }
    }
    counts.check(read, "the number of elements in all blocks", cursor)
}

/// What a section begins with.
struct Counts {
    blocks: u64,
    /// Entries of all blocks.
    entries: u64,
    /// Where this number stands.
    mark: usize,
}

impl Counts {
    /// Behind the two numbers are the least tag and the greatest.
    fn read(cursor: &mut Cursor) -> Result<Self, MshError> {
        if cursor.encoding != Encoding::Text {
            cursor.skip_line();
        }
        let blocks = cursor.size("a number of blocks")?;
        let mark = cursor.mark();
        let entries = cursor.size("the number of all entries")?;
        for _ in 0..2 {
            cursor.size("a bound of tags")?;
        }
        Ok(Self { blocks, entries, mark })
    }

    /// Whether so many were read.
    fn check(&self, read: u64, expected: &'static str, cursor: &Cursor) -> Result<(), MshError> {
        if read == self.entries {
            return Ok(());
        }
        Err(cursor.malformed(self.mark, expected, &self.entries.to_string()))
    }
}
