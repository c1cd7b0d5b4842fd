//! Files of Gmsh, `.msh` of versions 2.2 and 4.1, as text and binary.

mod cursor;
mod element_types;
mod error;
mod groups;
mod named;
mod raw;
mod read;
mod version_2;
mod version_4;
mod write;

pub use self::error::{MshError, Place};
pub use self::named::NamedMesh;
pub use self::read::{read_msh, read_named_msh};
pub use self::write::{MshFormat, write_msh};
