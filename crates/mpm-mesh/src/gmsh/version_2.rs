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
/// tags and nodes. The first tag is that of the physical group, 0 for none. An element of several groups comes once for each, one after the other, with the other tags
/// and the nodes the same and its own number or another: it is one cell.
pub fn read_elements<const D: usize>(cursor: &mut Cursor, raw: &mut Raw) -> Result<(), MshError> {
    let mut left = count(cursor, "the number of elements")?;
    let (mut nodes, mut tags) = (Vec::new(), Vec::new());
    let mut last = LastCell::default();
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
            tags.clear();
            for _ in 0..tag_count {
                tags.push(cursor.signed_integer("a tag")?);
            }
            let (group, other_tags) = tags
                .split_first()
                .map_or((0, &[][..]), |(&group, others)| (group, others));
            nodes.clear();
            for _ in 0..kind.node_count {
                nodes.push(cursor.integer("the tag of a node")?);
            }
            match role {
                Role::Cell if last.is_again(group, other_tags, &nodes) => {}
                Role::Cell => raw.add_cell(tag, mark, &nodes),
                Role::Facet => raw.add_facet(tag, mark, &nodes, &[group]),
                Role::Other => {}
            }
        }
        left -= block;
    }
    Ok(())
}

/// The cell that was read last.
#[derive(Default)]
struct LastCell {
    nodes: Vec<u64>,
    /// Its tags but the first.
    other_tags: Vec<i64>,
    /// The groups that it has come with.
    groups: Vec<i64>,
}

impl LastCell {
    /// Whether a cell is the last one, for one more group; if not it takes its place.
    fn is_again(&mut self, group: i64, other_tags: &[i64], nodes: &[u64]) -> bool {
        let same = self.nodes == nodes && self.other_tags == other_tags;
        let again = same && group != 0 && !self.groups.contains(&0) && !self.groups.contains(&group);
        if !again {
            self.nodes.clear();
            self.nodes.extend(nodes);
            self.other_tags.clear();
            self.other_tags.extend(other_tags);
            self.groups.clear();
        }
        self.groups.push(group);
        again
    }
}

/// A count as text; bytes follow after the end of its line.
fn count(cursor: &mut Cursor, expected: &'static str) -> Result<u64, MshError> {
    let count = cursor.parse(expected)?;
    if cursor.encoding != Encoding::Text {
        cursor.skip_line();
    }
    Ok(count)
}
