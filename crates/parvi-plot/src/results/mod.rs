//! Results as rows of named cells, and what tables and figures say of many of them.

mod row;
mod rows;
mod value;

pub use row::Row;
pub use rows::Rows;
pub use value::Value;
