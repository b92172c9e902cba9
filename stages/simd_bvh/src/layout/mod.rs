//! The memory layout of boxes, triangles and spheres. Reading order: `space` (the tree's own space),
//! `packed_box` (boxes during the build), `node`, `vertex_list`, `triangle_block` and
//! `sphere_block`, `prefetch`.

pub(crate) mod node;
pub(crate) mod packed_box;
pub(crate) mod prefetch;
pub(crate) mod space;
pub(crate) mod sphere_block;
pub(crate) mod triangle_block;
pub(crate) mod vertex_list;

/// The number of children of a node and of primitives of a block, which are tested at once.
pub(crate) const LANES: usize = 8;
