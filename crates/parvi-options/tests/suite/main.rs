//! Options as files and command lines state them. One theme per file.

mod refusals;
