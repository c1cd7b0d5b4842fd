//! Results as rows of named cells, and what tables and figures say of many of them.

mod against;
mod lines;
mod row;
mod rows;
mod statistic;
mod value;

pub use against::Contest;
pub use row::Row;
pub use rows::Rows;
pub use value::Value;
