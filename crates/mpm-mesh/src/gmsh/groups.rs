//! Physical groups: names of parts of the geometry.

use std::collections::HashMap;

use super::MshError;
use super::cursor::{Cursor, Encoding};

/// The groups that a file tells of, by dimension and tag.
#[derive(Default)]
pub struct Groups {
    names: HashMap<(u64, i64), String>,
    /// Version 4.1: the groups that an entity of the geometry is in.
    entities: HashMap<(u64, i64), Vec<i64>>,
}

impl Groups {
    /// The section `$PhysicalNames`, which is text in binary files too: a count; for each group its dimension, its tag and its name.
    pub fn read_names(&mut self, cursor: &mut Cursor) -> Result<(), MshError> {
        let count: u64 = cursor.parse("the number of physical names")?;
        for _ in 0..count {
            let dimension = cursor.parse("the dimension of a group")?;
            let tag = cursor.parse("the tag of a group")?;
            let mark = cursor.mark();
            let name = cursor.quoted("the name of a group in quotes")?;
            let named = self.names.insert((dimension, tag), name.to_owned());
            if named.is_some_and(|before| before != name) {
                return Err(cursor.malformed(mark, "the name that the group has already", name));
            }
        }
        Ok(())
    }

    /// The section `$Entities` of version 4.1: numbers of points, curves, surfaces and volumes; for each its tag, its position or its box, its groups and, but for points, what
    /// bounds it.
    pub fn read_entities(&mut self, cursor: &mut Cursor) -> Result<(), MshError> {
        if cursor.encoding != Encoding::Text {
            cursor.skip_line();
        }
        self.read_entities_of(cursor, false)
    }

    /// The section `$PartitionedEntities` of version 4.1, whose entities the elements of a partitioned mesh are on: how many partitions, and the ghosts, each with its tag and its
    /// partition; then as in `$Entities`, with dimension and tag of the parent and the list of partitions behind each tag.
    pub fn read_partitioned_entities(&mut self, cursor: &mut Cursor) -> Result<(), MshError> {
        if cursor.encoding != Encoding::Text {
            cursor.skip_line();
        }
        cursor.size("the number of partitions")?;
        for _ in 0..cursor.size("a number of ghost entities")? {
            cursor.signed_integer("the tag of a ghost entity")?;
            cursor.signed_integer("the partition of a ghost entity")?;
        }
        self.read_entities_of(cursor, true)
    }

    fn read_entities_of(&mut self, cursor: &mut Cursor, partitioned: bool) -> Result<(), MshError> {
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = cursor.size("a number of entities")?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let tag = cursor.signed_integer("the tag of an entity")?;
                if partitioned {
                    cursor.signed_integer("the dimension of a parent")?;
                    cursor.signed_integer("the tag of a parent")?;
                    for _ in 0..cursor.size("a number of partitions")? {
                        cursor.signed_integer("the number of a partition")?;
                    }
                }
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    cursor.real("a coordinate of an entity")?;
                }
                let mut groups = Vec::new();
                for _ in 0..cursor.size("a number of groups")? {
                    groups.push(cursor.signed_integer("the tag of a group")?);
                }
                if dimension > 0 {
                    for _ in 0..cursor.size("a number of bounding entities")? {
                        cursor.signed_integer("the tag of a bounding entity")?;
                    }
                }
                self.entities.insert((dimension, tag), groups);
            }
        }
        Ok(())
    }

    /// The groups that an entity of version 4.1 is in.
    pub fn of_entity(&self, dimension: u64, tag: i64) -> &[i64] {
        self.entities.get(&(dimension, tag)).map_or(&[], Vec::as_slice)
    }

    /// The names of the groups of a dimension.
    pub fn named(&self, dimension: usize) -> impl Iterator<Item = &str> {
        let own = self.names.iter().filter(move |((own, _), _)| *own == dimension as u64);
        own.map(|(_, name)| name.as_str())
    }

    /// The name of a group: its tag where it has none. Tags may be negative, for entities of the other orientation.
    pub fn name(&self, dimension: usize, tag: i64) -> String {
        let name = self.names.get(&(dimension as u64, tag.abs()));
        name.cloned().unwrap_or_else(|| tag.abs().to_string())
    }
}
