//! Copies the course, or some crates of it, to another folder: [`file_tree`] (lists, reads and writes
//! files), [`members`] (the list of crates), [`manifest`] (manifests without the other crates),
//! [`lock`] (the lock file without their dependencies).

pub mod file_tree;
pub mod lock;
pub mod manifest;
pub mod members;
