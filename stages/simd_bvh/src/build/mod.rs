//! From primitives to a wide tree. Reading order: `builder` (from triangles to the tree), `presplit`
//! (long thin triangles), `large` (walls), `sah` and `binary` (the binary tree of least cost),
//! `collapse` and `widen` (from two to eight children per node).

pub(crate) mod binary;
pub(crate) mod builder;
pub(crate) mod collapse;
pub(crate) mod large;
pub(crate) mod presplit;
pub(crate) mod sah;
pub(crate) mod widen;
