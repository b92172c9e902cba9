//! Copies some crates of the workspace to another one: [`members`] (the list of crates),
//! [`manifest`] (manifests without the other crates), [`lock`] (the lock file without their
//! dependencies).

pub mod lock;
pub mod manifest;
pub mod members;
