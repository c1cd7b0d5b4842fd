//! Sections of version 2.2. Counts are text in binary files too.

use super::MshError;
use super::cursor::{Cursor, Encoding};
use super::raw::{Raw, Role, check_kind};

pub fn read_nodes(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    for _ in 0..count(cursor, "the number of nodes")? {
        let mark = cursor.mark();
        let tag = cursor.integer("the tag of a node")?;
        raw.add_node(tag, mark, cursor)?;
    }
    Ok(())
}

/// As text: tag, type, number of tags, tags, nodes. As bytes: type, number of elements, number of tags, and for each element its tag,
/// tags and nodes. The first tag is that of the physical group, 0 for none.
pub fn read_elements<const D: usize>(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let mut left = count(cursor, "the number of elements")?;
    let mut nodes = Vec::new();
    while left > 0 {
        let mark = cursor.mark();
        let text = cursor.encoding == Encoding::Text;
        let first_tag = if text {
            cursor.integer("the tag of an element")?
        } else {
            0
        };
        let (kind, role) = check_kind::<D>(cursor.integer("the type of an element")?, mark, cursor)?;
        let block = if text {
            1
        } else {
            cursor.integer("a number of elements")?
        };
        let tag_count = cursor.integer("a number of tags")?;
        if block == 0 || block > left {
            return Err(cursor.malformed(mark, "a number of elements that are left", &block.to_string()));
        }
        for _ in 0..block {
            let mark = if text { mark } else { cursor.mark() };
            let tag = if text {
                first_tag
            } else {
                cursor.integer("the tag of an element")?
            };
            let mut group = 0;
            for place in 0..tag_count {
                let found = cursor.signed_integer("a tag")?;
                group = if place == 0 { found } else { group };
            }
            nodes.clear();
            for _ in 0..kind.node_count {
                nodes.push(cursor.integer("the tag of a node")?);
            }
            match role {
                Role::Cell => raw.add_cell(tag, mark, &nodes),
                Role::Facet => raw.add_facet(tag, mark, &nodes, &[group]),
                Role::Other => {}
            }
        }
        left -= block;
    }
    Ok(())
}

/// A count as text; bytes follow after the end of its line.
fn count(cursor: &mut Cursor, expected: &'static str) -> Result<u64, MshError> {
    let count = cursor.parse(expected)?;
    if cursor.encoding != Encoding::Text {
        cursor.skip_line();
    }
    Ok(count)
}
