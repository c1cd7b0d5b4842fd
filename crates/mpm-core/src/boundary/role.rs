//! What walls do with the nodes.

/// What walls do with a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// What they do with nodes.
    Own,
    /// It is a repeated image of a node that is not active: it has no mirror image, and the walls hold it.
    Held,
    /// Nothing: it moves as its images do.
    Image,
}

/// The roles of all nodes; of those without one, their own.
#[derive(Default)]
pub(super) struct Roles(pub Vec<Role>);

impl Roles {
    /// What walls do with this node.
    pub fn of(&self, node: usize) -> Role {
        self.0.get(node).copied().unwrap_or(Role::Own)
    }
}
