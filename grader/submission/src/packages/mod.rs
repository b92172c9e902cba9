//! The crates of the workspace, and carrying some of them elsewhere: [`members`] (which there are), [`manifest`]
//! (manifests without the others), [`lock`] (the lock file without theirs).

pub mod lock;
pub mod manifest;
pub mod members;
