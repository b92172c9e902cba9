//! The traversal by a tile: up to 64 rays from one point, the apex, which visit each node and each
//! block once, together. Reading order: `rays` (the rays in columns), `frustum` (eight boxes
//! against all rays at once), `planes` (the triangles of a block against rays, with the proof that
//! no hit is lost), `traversal`.

pub(crate) mod frustum;
pub(crate) mod planes;
pub(crate) mod rays;
pub(crate) mod traversal;

/// The number of rays of a tile: more share more nodes, but go apart further.
pub(crate) const SIZE: usize = 64;

/// The number of rays that are tested against a triangle at once.
pub(crate) const GROUP: usize = 16;
